#!/usr/bin/env python3
"""The program from outside: what is killed goes on, what cannot be written is said, nothing half-written is left.

PROVETA_KILLS sets the number of random kills. The long tier takes 100, and kills every test; tests/verification/resume.cpp goes on with every
test at each commit, within one process."""
import ctypes
import html.parser
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import time

from case import FILES, Case, main
from small_sweep import sweep

SAME = ["curve.csv", "events.csv", "energy.csv", "acoustic.csv", "summary.json"]
KILLS = int(os.environ.get("PROVETA_KILLS", "8"))
INTERVAL = 0.2  # s between checkpoints
BODY = {"diameter": "50 mm", "height": "100 mm", "spheres": 500}
TESTS = {
    "ucs": {"test": "ucs", "specimen": BODY, "loading": {"cycles": [{"axial_strain": 0.0004}], "rate_check": "half_rate"}},
    "girth": {"test": "ucs", "specimen": BODY, "loading": {"control": "girth", "stop": {"axial_strain": 0.003}}},
    "triaxial": {"test": "triaxial", "specimen": BODY, "loading": {"confining_pressure": "2 MPa"}},
    "membrane": {"test": "triaxial", "specimen": BODY,
                 "loading": {"confining_pressure": "2 MPa", "confinement": "membrane", "rate": "0.5 m/s", "stop": {"axial_strain": 0.004}}},
    "brazilian": {"test": "brazilian", "specimen": {"shape": "disc", "diameter": "50 mm", "height": "25 mm", "spheres": 500}},
    "oedometric": {"test": "oedometric", "specimen": BODY, "loading": {"stop": {"axial_strain": 0.01}}},
    "hydrostatic": {"test": "hydrostatic", "specimen": BODY, "loading": {"pressure": "60 MPa"}},
    "direct-tension": {"test": "direct-tension", "specimen": BODY},
    "granular-triaxial": {"test": "granular-triaxial",
                          "specimen": {"diameter": "120 mm", "height": "240 mm", "seed": 3,
                                       "particles": {"form": "stone", "size": "30 mm", "spheres": 5, "forms": 4}},
                          "loading": {"confining_pressure": "60 kPa", "rate": "0.4 m/s", "stop": {"axial_strain": 0.02}}},
}


def killed_at_each_commit(name):
    return KILLS > 50 or name in ("ucs", "membrane", "granular-triaxial")


def limited(which, bytes_):
    """For preexec_fn: a limit of the operating system on the program."""
    return lambda: resource.setrlimit(which, (bytes_, bytes_))


def without_privilege():
    """For preexec_fn: root that must keep to the rights of files as anybody else (drops CAP_DAC_OVERRIDE and CAP_DAC_READ_SEARCH)."""
    for capability in (1, 2):
        ctypes.CDLL(None).prctl(24, capability, 0, 0, 0)


class Links(html.parser.HTMLParser):
    """Everything in a page that may lead somewhere."""

    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attributes):
        names = ("src", "srcset", "href", "xlink:href", "action", "formaction", "data", "poster", "background")
        self.found += [(tag, name, value or "") for name, value in attributes if name in names]


class Reliability(Case):
    def content(self, out, name):
        return (self.folder / out / name).read_bytes()

    def assertSame(self, out, reference):
        for name in SAME:
            self.assertEqual(self.content(out, name), self.content(reference, name), name)
        fields = sorted(p.name for p in (self.folder / reference / "fields").iterdir())
        self.assertEqual(sorted(p.name for p in (self.folder / out / "fields").iterdir()), fields)
        for field in fields:
            self.assertEqual(self.content(out, "fields/" + field), self.content(reference, "fields/" + field), field)

    def status(self, out="out"):
        return json.loads((self.folder / out / "manifest.json").read_text())["status"]

    def assertWhole(self, out):
        """No file is half: what is there can be read to its end."""
        for path in (self.folder / out).rglob("*"):
            if path.suffix == ".json":
                json.loads(path.read_text())
            elif path.suffix in (".partial", ".next"):
                continue  # under names that say so, and gone once the run goes on
            elif path.suffix == ".csv":
                rows = [line for line in path.read_text().splitlines() if not line.startswith("#")]
                self.assertTrue(all(row.count(",") == rows[0].count(",") for row in rows), path)
            elif path.suffix == ".html":
                self.assertTrue(path.read_text().rstrip().endswith("</html>"), path)
            elif path.suffix == ".vtp":
                self.assertTrue(path.read_bytes().rstrip().endswith(b"</VTKFile>"), path)

    def no_halves(self, out):
        self.assertEqual([p.name for p in (self.folder / out).rglob("*") if p.suffix in (".partial", ".next")], [])


class Killed(Reliability):
    def started(self, *arguments):
        return self.start(*arguments, until=".")

    def kill(self, process, after):
        """Waits so many seconds, kills; True when the process lived so long."""
        try:
            out, log = process.communicate(timeout=after)
            self.assertEqual(process.returncode, 0, out + log)
            return False
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.communicate()
            return True

    def test_every_test_goes_on_to_the_same_bytes(self):
        for name, deck in TESTS.items():
            if not killed_at_each_commit(name):
                continue
            with self.subTest(name):
                path = self.deck({**deck, "output": {"samples": 100, "fields": 3, "pictures": 0, "checkpoint_every": 0.05}}, name + ".json")
                whole, part = name + "-whole", name + "-part"
                begun = time.monotonic()
                done = self.run_program("run", path, "--out", whole, "--quiet")
                self.assertEqual(done.returncode, 0, done.stderr)
                seconds = time.monotonic() - begun
                for share in (0.6, 0.4, 0.2, 0.05, 0.0):  # killed too late on a machine that has become faster: again, earlier
                    shutil.rmtree(self.folder / part, ignore_errors=True)
                    process = self.start("run", path, "--out", part, "--quiet", until=part + "/checkpoint.h5")
                    if self.kill(process, share * seconds) and self.status(part) == "running":
                        break
                self.assertEqual(self.status(part), "running")
                resumed = self.run_program("resume", part, "--quiet")
                self.assertEqual(resumed.returncode, 0, resumed.stderr)
                self.assertSame(part, whole)
                self.assertEqual(self.status(part), "complete")
                self.assertEqual(len(json.loads(self.content(part, "manifest.json"))["resumed"]), 1)
                again = self.run_program("resume", part)
                self.assertEqual(again.returncode, 0)
                self.assertIn("complete", again.stdout)

    def test_kills_at_random_moments_lose_at_most_the_interval(self):
        deck = self.deck({"test": "ucs", "specimen": {**BODY, "spheres": 1500},
                          "output": {"samples": 100, "fields": 5, "pictures": 300, "checkpoint_every": INTERVAL}})
        begun = time.monotonic()
        self.assertEqual(self.run_program("run", deck, "--out", "whole", "--quiet").returncode, 0)
        seconds = time.monotonic() - begun
        chance = random.Random(12345)
        kills = ends = 0
        lost = []
        while kills < KILLS:
            out = f"out{ends}"
            # Killed several times before it ends, now and then before it has begun.
            begun = (self.folder / out / "manifest.json").exists()
            command = ["resume", out] if begun else ["run", deck, "--out", out]
            if not self.kill(self.started(*command, "--quiet"), chance.uniform(0.0, 0.5 * seconds)):
                self.assertSame(out, "whole")
                ends += 1
                continue
            kills += 1
            now = time.time()
            self.assertWhole(out)
            kept = [p.stat().st_mtime for p in (self.folder / out).glob("checkpoint*.h5")]
            self.assertLessEqual(len(kept), 2)
            if kept:
                lost.append(now - max(kept))
        last = f"out{ends}"
        if (self.folder / last / "manifest.json").exists():
            done = self.run_program("resume", last, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertSame(last, "whole")
        print(f"{kills} kills, {ends} tests ended in between; median age of the last checkpoint "
              f"{sorted(lost)[len(lost) // 2] if lost else float('nan'):.2f} s")

    def test_a_series_a_sweep_and_a_series_of_interrupts(self):
        series = self.deck({"test": "ucs", "specimen": {**BODY, "seed": [1, 2, 3]}, "output": {"fields": 0, "pictures": 0, "checkpoint_every": 0.1}})
        self.assertEqual(self.run_program("run", series, "--out", "whole", "--quiet").returncode, 0)
        process = self.start("run", series, "--out", "part", "--quiet", until="part/manifest.json")
        self.kill(process, 1.0)
        for _ in range(20):
            process = self.started("resume", "part", "--quiet")
            if not self.kill(process, 1.5):
                break
        done = self.run_program("resume", "part", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ["series.csv", "summary.json"]:
            self.assertEqual(self.content("part", name), self.content("whole", name), name)


class Signals(Reliability):
    def test_sigint_and_sigterm_end_with_a_partial_result_that_goes_on(self):
        deck = self.deck({"test": "ucs", "specimen": BODY, "output": {"checkpoint_every": 0}})
        self.assertEqual(self.run_program("run", deck, "--out", "whole", "--quiet").returncode, 0)
        for number, code in [(signal.SIGINT, 130), (signal.SIGTERM, 143)]:
            shutil.rmtree(self.folder / "part", ignore_errors=True)
            process = self.start("run", deck, "--out", "part", until="part/fields")
            process.send_signal(number)
            out, log = process.communicate(timeout=60)
            self.assertEqual(process.returncode, code, log)
            self.assertIn("proveta resume part", log)
            self.assertEqual(self.status("part"), "interrupted")
            self.assertWhole("part")
            self.assertIn("interrupted", self.content("part", "report.html").decode())
            done = self.run_program("resume", "part", "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertSame("part", "whole")


class Folders(Reliability):
    def small(self, **changes):
        return self.deck({"test": "ucs", "specimen": BODY, "output": {"fields": 2, "pictures": 300, "checkpoint_every": 0.1}, **changes})

    def fails(self, done, code, *says):
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        for text in says:
            self.assertIn(text, done.stderr)

    def test_a_full_disk(self):
        deck = self.small()
        self.assertEqual(self.run_program("run", deck, "--out", "whole", "--quiet").returncode, 0)
        # A limit on the size of a file is met as a full disk is: by a write that fails.
        done = self.run_program("run", deck, "--out", "part", "--quiet", preexec_fn=limited(resource.RLIMIT_FSIZE, 20000))
        self.fails(done, 4, "cannot be written", "proveta resume part")
        self.assertWhole("part")
        self.no_halves("part")
        done = self.run_program("resume", "part", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertSame("part", "whole")

    def test_a_file_system_that_fills_up(self):
        disk = self.folder / "disk"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=400k", "tmpfs", disk], capture_output=True).returncode != 0:
            self.skipTest("needs the right to mount")
        try:
            done = self.run_program("run", self.small(), "--out", "disk/out", "--quiet")
            self.fails(done, 4, "No space left on device")
            self.assertWhole("disk/out")
            self.no_halves("disk/out")
        finally:
            subprocess.run(["umount", disk], check=True)

    def test_a_folder_that_vanishes(self):
        process = self.start("run", self.small(), "--out", "gone", "--quiet", until="gone/fields")
        shutil.rmtree(self.folder / "gone")
        _, log = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 4, log)
        self.assertIn("cannot be written", log)
        self.assertFalse((self.folder / "gone" / "report.html").exists())

    def test_a_folder_that_cannot_be_written(self):
        locked = self.folder / "locked"
        locked.mkdir()
        locked.chmod(0o555)
        options = {"preexec_fn": without_privilege}
        deck = self.small()
        self.fails(self.run_program("run", deck, "--out", "locked/out", "--quiet", **options), 2, "locked/out", "cannot be made")
        self.fails(self.run_program("run", deck, "--out", "locked", "--quiet", **options), 2, "cannot be written")
        locked.chmod(0o755)

    def test_read_only_files_of_an_earlier_result_are_replaced(self):
        deck = self.small()
        self.assertEqual(self.run_program("run", deck, "--out", "out", "--quiet").returncode, 0)
        for name in FILES:
            (self.folder / "out" / name).chmod(0o444)
        done = self.run_program("run", deck, "--out", "out", "--seed", 5, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(self.content("out", "manifest.json"))["seed"], 5)

    def test_two_runs_into_one_folder(self):
        process = self.start("run", self.small(), "--out", "out", "--quiet", until="out/manifest.json")
        second = self.run_program("run", self.small(), "--out", "out", "--quiet")
        third = self.run_program("resume", "out", "--quiet")
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0)
        self.fails(second, 2, "another run is writing")
        self.fails(third, 2, "another run is writing")
        self.assertEqual(self.status(), "complete")

    def test_checkpoints_that_are_damaged(self):
        deck = self.small()
        self.assertEqual(self.run_program("run", deck, "--out", "whole", "--quiet").returncode, 0)

        def part():
            shutil.rmtree(self.folder / "part", ignore_errors=True)
            process = self.start("run", deck, "--out", "part", "--quiet", until="part/checkpoint.earlier.h5")
            process.send_signal(signal.SIGKILL)
            process.communicate()
            return self.folder / "part" / "checkpoint.h5", self.folder / "part" / "checkpoint.earlier.h5"

        def flip(path, at):
            content = bytearray(path.read_bytes())
            content[int(at * len(content))] ^= 0x55
            path.write_bytes(content)

        last, earlier = part()
        kept = last.read_bytes()
        for spoil in [lambda p: p.write_bytes(kept[: len(kept) // 2]), lambda p: p.write_bytes(b"not HDF5"), lambda p: flip(p, 0.5),
                      lambda p: p.unlink()]:
            shutil.copytree(self.folder / "part", self.folder / "spoilt")
            spoil(self.folder / "spoilt" / "checkpoint.h5")
            done = self.run_program("resume", "spoilt", "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertSame("spoilt", "whole")
            shutil.rmtree(self.folder / "spoilt")
        for path in (last, earlier):
            path.write_bytes(b"not HDF5")
        self.fails(self.run_program("resume", "part", "--quiet"), 2, "checkpoint.h5", "checkpoint.earlier.h5", "run the deck anew")
        other = self.deck({"test": "ucs", "specimen": {**BODY, "seed": 9}, "output": {"checkpoint_every": 0.1}}, "other.json")
        self.assertEqual(self.run_program("run", other, "--out", "other", "--quiet").returncode, 0)
        for path in (last, earlier):
            shutil.copy(self.folder / "other" / "checkpoint.h5", path)
        self.fails(self.run_program("resume", "part", "--quiet"), 2, "belongs to another calculation")

    def test_what_changed_between_stop_and_resume(self):
        card = self.folder / "mine.json"
        card.write_text(json.dumps({"card": "concrete_sfer", "young_modulus": "30 GPa"}))
        deck = self.small(material={"card": "mine.json"})
        whole = self.run_program("run", deck, "--out", "whole", "--quiet")
        self.assertEqual(whole.returncode, 0, whole.stderr)
        process = self.start("run", deck, "--out", "part", "--quiet", until="part/checkpoint.h5")
        process.send_signal(signal.SIGKILL)
        process.communicate()
        card.write_text(json.dumps({"card": "concrete_sfer", "young_modulus": "10 GPa"}))
        done = self.run_program("resume", "part", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("mine.json has changed since the test began", done.stderr)
        self.assertSame("part", "whole")
        manifest = json.loads(self.content("part", "manifest.json"))
        manifest["status"] = "running"
        manifest["deck"]["material"]["young_modulus"] = 1e10
        (self.folder / "part" / "manifest.json").write_text(json.dumps(manifest))
        self.fails(self.run_program("resume", "part", "--quiet"), 2, "belongs to another calculation")

    def test_folders_that_cannot_be_gone_on_with(self):
        self.fails(self.run_program("resume", "nowhere"), 2, "no such folder")
        (self.folder / "empty").mkdir()
        self.fails(self.run_program("resume", "empty"), 2, "without manifest.json")
        (self.folder / "empty" / "manifest.json").write_text("{}")
        self.fails(self.run_program("resume", "empty"), 2, "another kind")
        (self.folder / "empty" / "manifest.json").write_text('{"proveta_manifest": 1, "status": 7, "deck": []}')
        self.fails(self.run_program("resume", "empty"), 2)

    def test_not_enough_memory(self):
        deck = self.deck({"test": "ucs", "specimen": {**BODY, "spheres": 20000}})
        for megabytes in (130, 160):  # the program alone takes some 100
            done = self.run_program("run", deck, "--out", "out", "--quiet", "--threads", 1,
                                    preexec_fn=limited(resource.RLIMIT_AS, megabytes << 20))
            self.assertIn(done.returncode, (2, 3), done.stderr)
            self.assertIn("memory", done.stderr)
            self.assertFalse((self.folder / "out").exists() and any((self.folder / "out").iterdir()))


class Trust(Reliability):
    def test_nothing_is_written_outside_the_folder_and_texts_stay_texts(self):
        title = "<script>alert(1)</script> \"'&; $(touch owned) `touch owned` ../../owned"
        deck = self.deck({"test": "ucs", "title": title, "specimen": BODY, "output": {"fields": 1}})
        before = {p for p in self.folder.rglob("*")}
        self.assertEqual(self.run_program("run", deck, "--out", "out", "--quiet").returncode, 0)
        new = {p.relative_to(self.folder).parts[0] for p in self.folder.rglob("*") if p not in before}
        self.assertEqual(new, {"out"})
        page = self.content("out", "report.html").decode()
        self.assertNotIn("<script>alert", page)
        self.assertIn("&lt;script&gt;", page)
        bare = page.replace("http://www.w3.org/2000/svg", "")
        for outside in ("http:", "https:", "@import"):
            self.assertFalse(outside in bare, outside)
        for start in re.finditer(r"url\(", bare):  # a plot's own frame, by its name within the page
            self.assertRegex(bare[start.start():start.start() + 40], r"^url\(#")
        self.assertIn("default-src 'none'", page)
        links = Links()
        links.feed(page)
        self.assertGreater(len(links.found), 5)
        for tag, name, target in links.found:  # "//" stands in the scripts' comments, too, but in no address
            self.assertNotIn("//", "" if target.startswith("data:image/png;base64,") else target, (tag, name))
        names = [{"name": "../../owned", "card": "concrete_sfer"}]
        bad = self.deck({"test": "ucs", "specimen": BODY, "output": {"folder": "/tmp/owned"}, "more": names}, "bad.json")
        self.assertEqual(self.run_program("run", bad, "--out", "bad").returncode, 2)

    def test_a_series_manifest_cannot_lead_out_of_its_folder(self):
        for name in ("../owned", "/tmp/owned", "..", "a/b", ".hidden"):
            manifest = self.deck({"proveta_series_manifest": 1, "members": [{"name": name, "deck": {"test": "ucs"}}]}, "manifest.json")
            done = self.run_program("run", manifest, "--out", "out")
            self.assertEqual(done.returncode, 2, name)
            self.assertIn("the name of a folder", done.stderr)


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
