#!/usr/bin/env python3
"""Signals at random moments and spacings, to runs, sweeps and scenes: nothing is lost, and what goes on ends with the bytes of what was
never stopped. PROVETA_SIGNALS sets how many are sent, PROVETA_SEED the moments."""
import collections
import json
import os
import random
import signal
import subprocess
import time

import case
from case import main
from reliable import BODY, Reliability
from small_sweep import sweep

SIGNALS = int(os.environ.get("PROVETA_SIGNALS", "200"))
SEED = int(os.environ.get("PROVETA_SEED", "1"))
CODES = {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGHUP: 129}
OF_SWEEP = ("table.csv", "failures.csv", "sensitivity.csv", "summary.json")


def scene():
    material = {"card": "custom", "density": 2500, "young_modulus": "5 MPa", "elasticity": "as-given", "contact_law": "hertz",
                "contact_restitution": 0.4, "mu_d": 0.4}
    poured = {"name": "grains", "size": "12 mm", "from": ["-60 mm", "-60 mm", "0.1 m"], "to": ["60 mm", "60 mm", "0.3 m"],
              "velocity": [0, 0, -1], "count": 200, "rate": 1000}
    return {"scene": "poured", "materials": [{"name": "grain", "material": material}], "particles": [poured],
            "surfaces": [{"name": "floor", "shape": "plane", "size": ["0.3 m", "0.3 m"]}],
            "stop": {"time": 0.5}, "output": {"samples": 50, "fields": 3, "checkpoint_every": 0.1}}


class Interrupts(Reliability):
    def setUp(self):
        super().setUp()
        self.chance = random.Random(SEED)
        self.counts = collections.Counter()
        self.seconds = {}

    def whole(self, kind, *command):
        begun = time.monotonic()
        done = self.run_program(*command, "--out", kind + "-whole", "--quiet", "--threads", 1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.seconds[kind] = time.monotonic() - begun

    def stopped(self, command):
        """Carries a command out, sends signals to it, and returns its exit code."""
        process = subprocess.Popen([case.PROGRAM, *command, "--quiet", "--threads", "1"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        kind = command[-1].split("-")[0]
        time.sleep(self.chance.uniform(0.0, 0.7 * self.seconds[kind]))
        sent = []
        for _ in range(self.chance.choice((1, 1, 2, 3, 5))):
            if process.poll() is not None:
                break
            sent.append(self.chance.choice(tuple(CODES)))
            process.send_signal(sent[-1])
            time.sleep(self.chance.choice((0.0, 0.001, 0.03, 0.2)))
        _, log = process.communicate(timeout=120)
        self.counts["signals"] += len(sent)
        code = process.returncode
        if code < 0:  # it had not begun: the signal ended it as it ends any program
            self.counts["before it began"] += 1
            code = 128 - code
        self.assertIn(code, {0, *(CODES[s] for s in sent)}, log)
        self.counts[f"code {code}"] += 1
        return code

    def assertSameAsWhole(self, kind, out):
        if kind != "sweep":
            self.assertSame(out, kind + "-whole")
            return
        for name in OF_SWEEP:
            self.assertEqual(self.content(out, name), self.content("sweep-whole", name), name)
        keys = [json.loads(line)["trial"] for line in self.content(out, "ledger.jsonl").splitlines()]
        self.assertEqual(len(keys), len(set(keys)))  # none was carried out twice

    def test_signals_lose_nothing(self):
        run = self.deck({"test": "ucs", "specimen": BODY, "loading": {"rate_check": "half_rate"},
                         "output": {"samples": 60, "fields": 3, "pictures": 0, "checkpoint_every": 0.1}}, "run.json").name
        self.deck(sweep(points=4), "sweep.json")
        self.deck(scene(), "scene.json")
        kinds = {"run": ["run", run], "sweep": ["sweep", "sweep.json"], "scene": ["scene", "scene.json"]}
        for kind, command in kinds.items():
            self.whole(kind, *command)
        ended = collections.Counter()
        while self.counts["signals"] < SIGNALS or min(ended[k] for k in kinds) == 0:
            kind = self.chance.choice(sorted(kinds))
            out = f"{kind}-{ended[kind]}"
            begun = (self.folder / out / "manifest.json").exists()
            code = self.stopped(["resume", out] if begun else [*kinds[kind], "--out", out])
            self.counts[kind] += 1
            if (self.folder / out).exists():
                self.assertWhole(out)
            if code != 0:
                if (self.folder / out / "manifest.json").exists():
                    self.assertNotEqual(self.status(out), "complete")
                continue
            self.assertEqual(self.status(out), "complete")
            self.assertSameAsWhole(kind, out)
            self.no_halves(out)
            ended[kind] += 1
        for kind in kinds:  # what is left goes on to its end
            out = f"{kind}-{ended[kind]}"
            if (self.folder / out / "manifest.json").exists():
                done = self.run_program("resume", out, "--quiet", "--threads", 1)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertSameAsWhole(kind, out)
        print(", ".join(f"{what}: {n}" for what, n in sorted(self.counts.items())), "; ended:", dict(ended))


if __name__ == "__main__":
    main()
