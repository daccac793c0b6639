"""A sweep that takes seconds, for the tests of sweeps and clusters."""
import json

# Softening by ratio and elasticity as given: then few spheres do, and a test takes a fraction of a second.
DECK = {
    "test": "ucs",
    "specimen": {"diameter": "50 mm", "height": "100 mm", "spheres": 300},
    "material": {"card": "custom", "fracture_energy_tension": 0, "fracture_energy_shear": 0, "elasticity": "as-given"},
    "loading": {"rate": "0.4 m/s", "stop": {"axial_strain": 0.006, "post_peak_drop": 0.3}},
    "output": {"samples": 60},
}
PARAMETERS = [
    {"path": "material.tau_f", "low": "10 MPa", "high": "20 MPa"},
    {"path": "material.sigma_f", "low": "2 MPa", "high": "5 MPa"},
]


def sweep(**changes):
    content = {"title": "Small", "tests": [{"name": "press", "deck": DECK}], "parameters": PARAMETERS, "design": "sobol", "points": 4}
    content |= changes
    if content["design"] == "grid":
        content.pop("points")  # which it has none of
    return json.loads(json.dumps(content))
