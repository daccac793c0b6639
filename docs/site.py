#!/usr/bin/env python3
"""Gathers the pages of the documentation for mkdocs, and makes those that the program itself knows best: one a test, with a run of it.

Usage: site.py PROVETA SOURCE PAGES [--spheres N]
    PROVETA  the program
    SOURCE   the checkout
    PAGES    folder for the pages, made anew
"""
import argparse
import json
import pathlib
import re
import shutil
import subprocess
import tempfile

# A deck of each test, small enough that all of them take a few minutes: the pages say so.
DECKS = {
    "ucs": {"specimen": {"spheres": 4000}},
    "triaxial": {"specimen": {"spheres": 4000}, "loading": {"confining_pressure": "4.5 MPa", "stop": {"axial_strain": 0.008}}},
    "brazilian": {"specimen": {"spheres": 4000}},
    "direct-tension": {"specimen": {"spheres": 4000}},
    "oedometric": {"specimen": {"spheres": 3000}, "loading": {"stop": {"axial_strain": 0.01}}},
    "hydrostatic": {"specimen": {"spheres": 3000}, "loading": {"pressure": "60 MPa"}},
    "granular-triaxial": {"specimen": {"diameter": "150 mm", "height": "300 mm", "particles": {"size": "30 mm", "spheres": 8, "forms": 6}},
                          "loading": {"rate": "0.3 m/s", "stop": {"axial_strain": 0.08}}},
}
SHOWN = {("intact", "cut"), ("peak", "cut"), ("past_peak", "cut"), ("end", "cut"), ("end", "cracks"), ("end", "displacement")}
UNITS = {"Pa": ("MPa", 1e-6), "N": ("kN", 1e-3)}


def described(program, name):
    """What the program says of a test: title, about, standards, keys."""
    text = subprocess.run([program, "describe", name], capture_output=True, text=True, check=True).stdout
    head, _, keys = text.partition("\nloading\n")
    lines = head.splitlines()
    title = lines[0].split(": ", 1)[1]
    about, standards, standard = [], [], None
    for line in lines[1:]:
        if line.startswith("    mimicked: "):
            standards.append([standard, line.removeprefix("    mimicked: "), ""])
        elif line.startswith("    not mimicked: "):
            standards[-1][2] = line.removeprefix("    not mimicked: ")
        elif line.strip():
            standard = line
            about.append(line)
    names = {row[0] for row in standards}
    return title, " ".join(line for line in about if line not in names), standards, "loading\n" + keys


def value_of(result):
    value, unit = result["value"], result["unit"]
    if value is None:
        return "not determined", unit
    unit, factor = UNITS.get(unit, (unit, 1.0))
    return f"{value * factor:.4g}", unit


def page_of(program, name, deck, pages, work):
    title, about, standards, keys = described(program, name)
    path = work / (name + ".json")
    full = {"test": name, **deck}
    path.write_text(json.dumps(full))
    out = work / name
    subprocess.run([program, "run", str(path), "--out", str(out), "--quiet"], check=True, capture_output=True)
    summary = json.loads((out / "summary.json").read_text())
    pictures = pages / "pictures" / name
    pictures.mkdir(parents=True)
    y = "deviatoric_stress" if "triaxial" in name else "axial_stress"
    subprocess.run([program, "plot", str(out), "--x", "axial_strain", "--y", y, "--out", str(pictures / "curve.svg")], check=True, capture_output=True)
    shown = []
    for moment in ("intact", "peak", "past_peak", "end"):
        for what in ("displacement", "cut", "cracks"):
            file = out / "pictures" / f"{moment}_{what}.png"
            if file.exists() and (moment, what) in SHOWN:
                shutil.copy(file, pictures)
                shown.append((f"{moment}_{what}", f"{what}, {moment.replace('_', ' ')}"))
    text = [f"# {title}", "", about, "", "## Standards", "", "| standard | what of it the test does | what it does not |", "|---|---|---|"]
    text += [f"| {a} | {b} | {c} |" for a, b, c in standards]
    text += ["", "## A run", "", "Every picture and number of this page is of this deck, run when the page was made; specimens of the size that the test",
             "takes by itself give better curves.", "", "```json", json.dumps(full, indent=2), "```", "",
             f"![{y.replace('_', ' ')} over axial strain](pictures/{name}/curve.svg)", ""]
    text += [f'<img src="pictures/{name}/{file}.png" alt="{alt}" height="260">' for file, alt in shown]
    text += ["", f"It ended because: {summary['stopped_by']}.", "", "| result | value | unit | how it is found |", "|---|---|---|---|"]
    for key, result in summary["results"].items():
        value, unit = value_of(result)
        text.append(f"| {key.replace('_', ' ')} | {value} | {unit} | {result['formula'].replace('|', '/')} |")
    text += ["", "## Keys of its loading", "", "```text", keys.strip(), "```", ""]
    (pages / f"test-{name}.md").write_text("\n".join(text))
    return title, standards


def conformity(tests):
    text = ["# Conformity with standards", "", "What of each standard the laboratory's tests do, and what they do not: no claim of conformity is made beyond this table.", "",
            "| test | standard | what of it the test does | what it does not |", "|---|---|---|---|"]
    for name, (title, standards) in tests.items():
        text += [f"| [{title}](test-{name}.md) | {a} | {b} | {c} |" for a, b, c in standards]
    return "\n".join(text) + "\n"


def home(source):
    """The README, its links to pages turned to where these are in the site."""
    text = (source / "README.md").read_text()
    text = re.sub(r"\]\(docs/", "](", text)
    return re.sub(r"\[([^\]]+)\]\((?:CHANGELOG\.md|CONTRIBUTING\.md|LICENSE|examples/[^)]*|materials/[^)]*)\)", r"\1", text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("pages", type=pathlib.Path)
    parser.add_argument("--spheres", type=int, help="spheres of every specimen, and a short test of stones, to be done sooner")
    a = parser.parse_args()
    shutil.rmtree(a.pages, ignore_errors=True)
    shutil.copytree(a.source / "docs", a.pages, ignore=shutil.ignore_patterns("*.py"))
    (a.pages / "index.md").write_text(home(a.source))
    tests = {}
    with tempfile.TemporaryDirectory() as work:
        for name, deck in DECKS.items():
            if a.spheres and "spheres" in deck["specimen"]:
                deck = {**deck, "specimen": {**deck["specimen"], "spheres": a.spheres}}
            elif a.spheres:  # stones
                deck = {**deck, "loading": {**deck["loading"], "stop": {"axial_strain": 0.003}}}
            print(f"a run of {name}", flush=True)
            tests[name] = page_of(str(a.program.resolve()), name, deck, a.pages, pathlib.Path(work))
    (a.pages / "conformity.md").write_text(conformity(tests))


if __name__ == "__main__":
    main()
