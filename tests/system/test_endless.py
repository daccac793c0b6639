#!/usr/bin/env python3
"""The program from outside: every run ends, or says at once why it would not."""
import json
import time

from case import Case, main

SPECIMEN = {"spheres": 300, "seed": 1}
# Without strength in both families of laws: bonds that fail at no strain, and rubble without friction.
FEEBLE = [
    {"law": "dempack", "sigma_f": 0},
    {"law": "dempack", "sigma_f": 1, "tau_f": 1, "mu_s": 0, "mu_d": 0},
    {"tensile_strength": 1, "compressive_yield_strength": 1, "shear_strength_ratio": 0.01, "initial_friction": 0, "asymptotic_friction": 0,
     "mu_d": 0},
]


class Endless(Case):
    def result(self, out):
        return json.loads((self.folder / out / "summary.json").read_text())

    def test_bonds_without_strength_are_soon_through(self):
        for k, material in enumerate(FEEBLE):
            for control in ("platens", "girth"):
                deck = self.deck({"test": "ucs", "specimen": SPECIMEN, "material": material, "loading": {"control": control},
                                  "output": {"fields": 0}})
                begin = time.monotonic()
                done = self.run_program("run", deck, "--out", f"r{k}{control}", "--threads", 1, "--quiet", timeout=240)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                summary = self.result(f"r{k}{control}")
                self.assertLess(summary["results"]["strength"]["value"] or 0.0, 0.1e6, material)
                self.assertLess(time.monotonic() - begin, 200.0)

    def test_rates_and_ramps_without_end_are_refused(self):
        for loading, path in [({"rate": "1 um/s"}, "/loading/rate"),
                              ({"confining_pressure": "1 MPa", "pressure_ramp": "1000 s"}, "/loading/pressure_ramp")]:
            test = "triaxial" if "confining_pressure" in loading else "ucs"
            deck = self.deck({"test": test, "specimen": SPECIMEN, "loading": loading})
            for command in (["check", deck], ["run", deck, "--out", "r"]):
                done = self.run_program(*command)
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn(path, done.stderr)
        self.assertFalse((self.folder / "r").exists())

    def test_a_slow_rate_that_a_time_ends_is_not(self):
        deck = self.deck({"test": "ucs", "specimen": SPECIMEN, "loading": {"rate": "1 um/s", "stop": {"time": "0.1 ms"}}, "output": {"fields": 0}})
        done = self.run_program("run", deck, "--out", "r", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("time of", self.result("r")["stopped_by"])

    def test_platens_that_stand_still_end_the_run_and_are_named(self):
        # A ramp so long that nothing moves for thousands of crossings of a wave.
        deck = self.deck({"test": "ucs", "specimen": SPECIMEN, "loading": {"rate": "0.05 m/s", "ramp": "1000 s"}, "output": {"fields": 0}})
        done = self.run_program("run", deck, "--out", "r", "--threads", 1, timeout=240)
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("does not get on", self.result("r")["stopped_by"])


if __name__ == "__main__":
    main()
