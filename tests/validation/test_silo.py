#!/usr/bin/env python3
"""Outflow of beads from a silo against the law of Beverloo, Leniger and van de Velde (Chem. Eng. Sci. 15 (1961) 260).

W = C rho_b sqrt(g) (D - k d)^(5/2), C = 0.58, k = 1.4 for spheres: a flat bottom, D at least 6 d, a silo of at least 2.5 D and filled higher
than it is wide (R. M. Nedderman, Statics and kinematics of granular materials, Cambridge 1992, chapter 10). Started as: test_silo.py PROVETA"""
import json
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "system"))
from case import Case, main  # noqa: E402

D, ORIFICE, SILO = 0.005, 0.030, 0.075  # diameters of beads, orifice and silo, m
SCENE = {
    "scene": "Outflow of a silo",
    "materials": [{"name": "glass", "material": {
        "card": "custom", "density": 2500, "young_modulus": "20 MPa", "poisson_ratio": 0.25, "elasticity": "as-given",
        "contact_law": "hertz", "contact_restitution": 0.7, "mu_d": 0.3}}],
    "surfaces": [
        {"name": "wall", "shape": "cylinder", "radius": SILO / 2, "height": 0.3, "sides": 64, "friction": 0.3},
        {"name": "floor", "shape": "cylinder", "radius": ORIFICE / 2, "top_radius": SILO / 2, "height": "0.1 mm", "sides": 64, "friction": 0.3}],
    "particles": [{"name": "beads", "size": D, "count": 4700, "place": "grow", "from": ["-26 mm", "-26 mm", "1 mm"],
                   "to": ["26 mm", "26 mm", "251 mm"]}],
    "outlets": [{"name": "below", "from": [-0.06, -0.06, -0.06], "to": [0.06, 0.06, -0.02]}],
    "measures": [{"name": "silo", "from": [-0.02, -0.02, 0.02], "to": [0.02, 0.02, 0.06]}],
    "stop": {"time": "0.9 s"},
    "output": {"samples": 180, "fields": 0},
}


class Silo(Case):
    def test_the_rate_of_outflow_is_beverloos(self):
        done = self.run_program("scene", self.deck(SCENE, "scene.json"), "--out", "out", "--quiet", timeout=3600)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads((self.folder / "out" / "summary.json").read_text())["results"]
        rows = [{k: float(v) for k, v in r.items()} for r in self.rows(self.folder / "out" / "curve.csv")]
        steady = [r for r in rows if r["time_s"] >= 0.4]
        first, last = steady[0], steady[-1]
        bead = 2500 * math.pi / 6 * D**3
        rate = bead * (last["taken_out"] - first["taken_out"]) / (last["time_s"] - first["time_s"])
        bulk = found["bulk_density_silo"]["value"]
        # Filled higher than wide to the end, and steady: both halves of the window flow alike.
        self.assertGreater(last["mass_kg"], bulk * math.pi / 4 * SILO**3)
        middle = steady[len(steady) // 2]
        halves = [(b["taken_out"] - a["taken_out"]) / (b["time_s"] - a["time_s"]) for a, b in ((first, middle), (middle, last))]
        self.assertAlmostEqual(halves[1] / halves[0], 1.0, delta=0.1)
        law = 0.58 * bulk * math.sqrt(9.81) * (ORIFICE - 1.4 * D)**2.5
        print(f"outflow {rate:.4f} kg/s, by the law {law:.4f} kg/s at a bulk density of {bulk:.0f} kg/m3: ratio {rate / law:.3f}")
        self.assertAlmostEqual(rate / law, 1.0, delta=0.1)


if __name__ == "__main__":
    main()
