"""What the tests of the program share. Each of them is started as: test_....py PROVETA"""
import csv
import json
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = ""
SMALL = {
    "test": "ucs",
    "specimen": {"diameter": "50 mm", "height": "100 mm", "spheres": 800},
    "loading": {"rate": "0.2 m/s"},
    "output": {"samples": 100, "fields": 2},
}
FILES = ["manifest.json", "curve.csv", "events.csv", "acoustic.csv", "energy.csv", "summary.json", "series.pvd", "checkpoint.h5", "report.html"]


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="proveta_system_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def run_program(self, *arguments, timeout=300, **options):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder, timeout=timeout, **options)

    def start(self, *arguments, until, at_most=60.0):
        """The program in the background, once the path `until` exists in the folder, or after `at_most` seconds."""
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        end = time.monotonic() + at_most
        while not (self.folder / until).exists() and time.monotonic() < end and process.poll() is None:
            time.sleep(0.01)
        return process

    def interrupt(self, process):
        """Stops it as a user's Ctrl-C does, once it is well under way. Returns what it wrote to stdout."""
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        out, log = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, log)
        return out

    def deck(self, content=None, name="deck.json", **changes):
        text = content if isinstance(content, str) else json.dumps({**SMALL, **changes} if content is None else content)
        path = self.folder / name
        path.write_text(text)
        return path

    def rows(self, path):
        with open(path) as f:
            return list(csv.DictReader(line for line in f if not line.startswith("#")))


def main():
    global PROGRAM
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(module="__main__")
