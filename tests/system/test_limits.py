#!/usr/bin/env python3
"""The program from outside: input without end, files that are larger than they look, tests that need more memory than there is."""
import json
import os
import pathlib
import resource
import threading

import case
from case import Case, main

HUGE = 10 << 30  # bytes, of which a sparse file takes none
MOST = 1 << 30  # bytes that the program may take to refuse any of this; the most is a deck of 16 MiB whose every word is wrong


def seconds_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Limits(Case):
    def refused(self, *arguments, says, **options):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))

        done = self.run_program(*arguments, timeout=60, preexec_fn=limit, **options)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, done.stderr)
        self.assertLess(1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, MOST)

    def sparse(self, name, begin=b""):
        path = self.folder / name
        path.write_bytes(begin)
        with open(path, "r+b") as f:
            f.truncate(HUGE)
        return path

    def scene(self, **changes):
        whole = json.loads((pathlib.Path(__file__).resolve().parents[2] / "examples" / "silo.json").read_text())
        return self.deck({**whole, **changes}, "scene.json")

    def test_decks_without_end(self):
        self.refused("check", self.sparse("deck.json", b'{"test": "'), says="more than 16 MiB")
        self.refused("check", "/dev/zero", says="more than 16 MiB")
        read, write = os.pipe()

        def feed():
            try:
                with open(write, "wb") as f:
                    f.write(b'{"title": "')
                    while True:
                        f.write(b"a" * 65536)
            except BrokenPipeError:
                pass

        feeder = threading.Thread(target=feed)
        feeder.start()
        try:
            self.refused("check", "/dev/stdin", says="more than 16 MiB", stdin=read)
        finally:
            os.close(read)
            feeder.join()

    def test_decks_of_very_many_keys_and_very_many_mistakes(self):
        keys = ", ".join(f'"{k}": 0' for k in range(1000000))
        self.refused("check", self.deck('{"test": "ucs", "specimen": {' + keys + "}}"), says="10000 keys")
        wrong = ",".join(['"x"'] * 3000000)
        self.refused("check", self.deck('{"test": "ucs", "material": {"card": "custom", "lcs": [' + wrong + "]}}"), says="/material/lcs")

    def test_surfaces_and_meshes(self):
        for name in ("s.stl", "s.obj", "s.ply", "s.vtk", "s.vtp"):
            with self.subTest(name):
                self.sparse(name)
                self.refused("scene", self.scene(surfaces=[{"name": "s", "shape": "file", "file": name}]), "--out", "out", says="more than 1024 MiB")
        for name in ("b.msh", "b.vtk", "b.vtu"):
            with self.subTest(name):
                self.sparse(name)
                body = {"name": "b", "shape": "file", "file": name}
                self.refused("scene", self.scene(bodies=[body]), "--out", "out", says="more than 1024 MiB")

    def test_specimens(self):
        for name in ("s.csv", "s.mdpa", "s.msh"):
            self.sparse(name)
            self.refused("specimen", "import", name, "out.h5", says="more than 1024 MiB")
        self.sparse("s.h5")
        self.refused("run", self.deck(specimen={"file": "s.h5"}), "--out", "out", says="/specimen/file")
        self.refused("run", self.deck(specimen={"file": "/dev/zero"}), "--out", "out", says="/specimen/file")

    def test_curves(self):
        for curve in (self.sparse("curve.csv"), "/dev/zero"):
            content = {"tests": [{"name": "u", "deck": case.SMALL}], "parameters": [{"path": "material.tensile_strength", "low": 1e6, "high": 2e6}],
                       "targets": [{"test": "u", "curve": str(curve), "y": "total_stress"}]}
            before = seconds_of_children()
            self.refused("calibrate", self.deck(content, "calibration.json"), "--out", "out", says="more than 64 MiB")
            self.assertLess(seconds_of_children() - before, 5)  # no hash of 10 GB was taken

    def test_tests_that_need_more_memory_than_there_is(self):
        self.refused("run", self.deck(specimen={"spheres": 20000000}), "--out", "out", says=["/specimen/spheres", "GiB", "20000000"])
        cloud = {"name": "p", "size": "1 mm", "count": 50000000, "from": [0, 0, 0], "to": [10, 10, 10]}
        self.refused("scene", self.scene(particles=[cloud]), "--out", "out", says=["/particles/0/count", "GiB"])


if __name__ == "__main__":
    main()
