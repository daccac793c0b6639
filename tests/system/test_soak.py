#!/usr/bin/env python3
"""The program from outside: many tests in a row leave no handle open and no memory behind."""
import os
import pathlib
import time

from case import main
from reliable import BODY, Reliability
from small_sweep import sweep


class Soak(Reliability):
    def watched(self, *arguments, until):
        """Open handles and resident kilobytes of a run, from its beginning to its end."""
        process = self.start(*arguments, until=until)
        handles, memory = [], []
        while process.poll() is None:
            try:
                open_now = len(os.listdir(f"/proc/{process.pid}/fd"))
                status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
                memory.append(int(status.split("VmRSS:")[1].split()[0]))
                handles.append(open_now)
            except (OSError, IndexError):
                pass
            time.sleep(0.05)
        _, log = process.communicate()
        self.assertEqual(process.returncode, 0, log)
        self.assertGreater(len(handles), 30)
        return handles, memory

    def assertSteady(self, handles, memory):
        third = len(handles) // 3
        self.assertLessEqual(max(handles[-third:]), max(handles[:third]) + 2)
        # The results of 24 tests are kept for the page: some hundred kilobytes each.
        self.assertLess(max(memory[-third:]) - max(memory[:third]), 40_000)
        print(f"{max(handles)} handles at most; {max(memory[:third])} kB in the first third, {max(memory[-third:])} kB in the last")

    def test_24_tests_of_a_series_leave_no_handle_open_and_no_memory_behind(self):
        seeds = list(range(1, 25))
        deck = self.deck({"test": "ucs", "specimen": {**BODY, "spheres": 300, "seed": seeds}, "loading": {"rate": "0.5 m/s"},
                          "output": {"fields": 1, "pictures": 300, "samples": 50}})
        self.assertSteady(*self.watched("run", deck, "--out", "out", "--threads", 1, "--quiet", until="out/manifest.json"))
        self.assertEqual(len(self.rows(self.folder / "out" / "series.csv")), len(seeds))

    def test_24_tests_of_a_sweep_leave_no_handle_open_and_no_memory_behind(self):
        path = self.deck(sweep(points=24), "sweep.json")
        self.assertSteady(*self.watched("sweep", path, "--out", "out", "--threads", 1, "--quiet", until="out/ledger.jsonl"))
        self.assertEqual(len(self.rows(self.folder / "out" / "table.csv")), 24)


if __name__ == "__main__":
    main()
