#!/usr/bin/env python3
"""The program from outside: what cannot be written, read or held is said, and nothing half-written is left."""
import ctypes
import json
import resource
import shutil
import signal
import subprocess
import time

from case import FILES, main
from reliable import BODY, Reliability
from small_sweep import sweep


def limited(which, bytes_):
    """For preexec_fn: a limit of the operating system on the program."""
    return lambda: resource.setrlimit(which, (bytes_, bytes_))


def without_privilege():
    """For preexec_fn: root that must keep to the rights of files as anybody else (drops CAP_DAC_OVERRIDE and CAP_DAC_READ_SEARCH)."""
    for capability in (1, 2):
        ctypes.CDLL(None).prctl(24, capability, 0, 0, 0)


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

    def vanishes(self, command, deck, until):
        """Moves the folder away once it holds `until`; says whether the program had not ended by then."""
        process = self.start(command, deck, "--out", "gone", "--quiet", until="gone/" + until)
        vanished = (self.folder / "gone").rename(self.folder / "vanished")  # at once: one in use is not emptied at the first try
        _, log = process.communicate(timeout=60)
        running = json.loads((vanished / "manifest.json").read_text())["status"] == "running"
        if running:
            self.assertEqual(process.returncode, 4, log)
            self.assertRegex(log, "cannot be (written|made)|moved or removed")
            self.assertFalse((self.folder / "gone").exists(), "what is begun in one folder was gone on with in another")
        shutil.rmtree(vanished)
        shutil.rmtree(self.folder / "gone", ignore_errors=True)
        return running

    def test_a_folder_that_vanishes(self):
        # A busy machine may come to the later moments too late; but not to all of them.
        moments = [self.vanishes("run", self.small(), until) for until in ("manifest.json", "fields", "series.pvd", "checkpoint.h5", "curve.csv")]
        self.assertIn(True, moments)
        bare = self.deck({"test": "ucs", "specimen": BODY, "output": {"fields": 0, "checkpoint_every": 60}})
        self.vanishes("run", bare, "manifest.json")

    def test_a_folder_in_whose_place_another_result_is_put(self):
        self.assertEqual(self.run_program("run", self.small(), "--out", "other", "--quiet").returncode, 0)
        before = {p: p.read_bytes() for p in (self.folder / "other").rglob("*") if p.is_file()}
        for until, spheres in (("", 20000), ("checkpoint.h5", 500)):  # before the test has begun, which takes seconds, and in its midst
            deck = self.small(loading={"rate": "0.01 m/s"}, specimen={**BODY, "spheres": spheres})
            process = self.start("run", deck, "--out", "gone", "--quiet", until="gone/" + until)
            time.sleep(0.3)  # made is not yet claimed
            (self.folder / "gone").rename(self.folder / "vanished")
            (self.folder / "other").rename(self.folder / "gone")
            _, log = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 4, log)
            self.assertIn("moved or removed", log)
            (self.folder / "gone").rename(self.folder / "other")
            self.assertEqual({p: p.read_bytes() for p in (self.folder / "other").rglob("*") if p.is_file()}, before)
            shutil.rmtree(self.folder / "vanished")

    def test_the_folder_of_a_series_that_vanishes(self):
        deck = self.deck({"test": "ucs", "specimen": {**BODY, "seed": [1, 2]}, "output": {"fields": 2}})
        self.assertIn(True, [self.vanishes("run", deck, until) for until in ("manifest.json", "seed_1/fields", "seed_2/fields")])

    def test_the_folder_of_a_sweep_that_vanishes(self):
        deck = self.deck(sweep(points=4))
        self.assertIn(True, [self.vanishes("sweep", deck, until) for until in ("manifest.json", "trials", "table.csv")])

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

    def test_the_half_of_a_first_file_is_no_other_file(self):
        (self.folder / "out").mkdir()
        (self.folder / "out" / "manifest.json.partial").write_text("{")  # killed before it had its name
        done = self.run_program("run", self.small(), "--out", "out", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.no_halves("out")

    def test_two_runs_into_one_folder(self):
        process = self.start("run", self.small(loading={"rate": "0.002 m/s"}), "--out", "out", "--quiet", until="out/manifest.json")
        second = self.run_program("run", self.small(), "--out", "out", "--quiet")
        third = self.run_program("resume", "out", "--quiet")
        self.fails(second, 2, "another run is writing")
        self.fails(third, 2, "another run is writing")
        process.send_signal(signal.SIGINT)
        _, log = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, log)
        self.assertEqual(self.status(), "interrupted")

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
        self.fails(self.run_program("resume", "part", "--quiet"), 2, "checkpoint.h5", "checkpoint.earlier.h5", "begin anew")
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


if __name__ == "__main__":
    main()
