#!/usr/bin/env python3
"""A known card is found again: targets are computed with it, and a calibration starts from random points. Started as: test_recovery.py PROVETA"""
import csv
import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "system"))
from case import Case, main  # noqa: E402

# Tough enough that no bond of a specimen of 1,000 spheres snaps back within the bounds.
COMMON = {
    "specimen": {"spheres": 1000},
    "material": {"card": "custom", "fracture_energy_tension": 40, "fracture_energy_shear": 2500},
    "output": {"fields": 0},
}
TRUTH = {"young_modulus": 31e9, "tau_f": 14e6, "sigma_f": 4.2e6, "lcs": [24e6, 45e6, 70e6]}
TESTS = {
    "ucs": {"test": "ucs"},
    "p_20": {"test": "triaxial", "loading": {"confining_pressure": "20 MPa", "stop": {"axial_strain": 0.012}}},
    "bts": {"test": "brazilian"},
}
PARAMETERS = [
    {"name": "young_modulus", "path": "material.young_modulus", "low": "20 GPa", "high": "40 GPa"},
    {"name": "tau_f", "path": "material.tau_f", "low": "8 MPa", "high": "24 MPa"},
    {"name": "sigma_f", "path": "material.sigma_f", "low": "2.5 MPa", "high": "7 MPa"},
    {"name": "LCS1", "path": "material.lcs.0", "low": "10 MPa", "high": "42 MPa"},
]
WANTED = {"young_modulus": 31e9, "tau_f": 14e6, "sigma_f": 4.2e6, "LCS1": 24e6}


class Recovery(Case):
    def compute(self, name):
        """The loading's curve of a test with the card that is to be found, and its results."""
        deck = json.loads(json.dumps({**COMMON, **TESTS[name]}))
        deck["material"].update(TRUTH)
        deck["specimen"]["seed"] = 3
        self.assertEqual(self.run_program("run", self.deck(deck, f"{name}.json"), "--out", name, "--quiet").returncode, 0)
        rows = self.rows(self.folder / name / "curve.csv")
        start = max((float(r["axial_strain"]) for r in rows if float(r["phase"]) == 0), default=0.0)
        points = [(float(r["axial_strain"]) - start, float(r["axial_stress_Pa"])) for r in rows if float(r["phase"]) == 1]
        with open(self.folder / f"{name}.csv", "w", newline="") as f:
            csv.writer(f).writerows(points)
        results = json.loads((self.folder / name / "summary.json").read_text())["results"]
        return {k: v["value"] for k, v in results.items()}

    def test_a_known_card_is_found_again(self):
        known = {name: self.compute(name) for name in TESTS}
        ucs = known["ucs"]
        curve = {"y": "total_stress", "kind": "computed", "tolerance": 0.03}
        calibration = {
            "title": "Recovery of a known card",
            "deck": COMMON,
            "tests": [{"name": n, "deck": t, "seeds": [3]} for n, t in TESTS.items()],
            "parameters": PARAMETERS,
            "targets": [
                # Past the peak so few spheres fall at random.
                {"test": "ucs", "curve": "ucs.csv", "to": 1.05 * ucs["strain_at_peak"], **curve},
                {"test": "p_20", "curve": "p_20.csv", **curve},
                {"test": "ucs", "result": "young_modulus", "value": ucs["young_modulus"], "tolerance": 0.02, "kind": "computed"},
                {"test": "ucs", "result": "strength", "value": ucs["strength"], "tolerance": 0.03, "kind": "computed"},
                {"test": "bts", "result": "splitting_strength", "value": known["bts"]["splitting_strength"], "tolerance": 0.03, "kind": "computed"},
            ],
            "search": {"spheres": 1, "trials": 150, "seed": 11},
            "finish": {"rounds": 0},
            "confidence": {"seeds": 0},
        }
        path = self.deck(calibration, "calibration.json")
        done = self.run_program("calibrate", path, "--out", "found", "--quiet", timeout=7000)
        self.assertEqual(done.returncode, 0, done.stderr)
        print(done.stdout)
        evidence = json.loads((self.folder / "found" / "card.json").read_text())["evidence"]
        for name, value in WANTED.items():
            self.assertLess(abs(evidence["parameters"][name]["value"] / value - 1), 0.10, name)
        for target in evidence["targets"]:
            if "wanted" not in target:
                self.assertLess(target["distance"], 0.03, target["target"])


if __name__ == "__main__":
    main()
