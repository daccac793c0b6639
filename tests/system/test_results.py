#!/usr/bin/env python3
"""The program from outside: pictures, scripts and tables of a result folder, results compared, plotted and reported anew."""
import importlib.util
import json
import re
import shutil
import struct
import subprocess
import xml.etree.ElementTree

from case import Case, main

BODY = {"diameter": "50 mm", "height": "100 mm", "spheres": 500}


def size_of_png(content):
    """Width and height from a PNG file's header."""
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", content[16:24])


class Results(Case):
    def run_deck(self, out, **changes):
        deck = {"test": "ucs", "specimen": BODY, "output": {"fields": 2, "samples": 100, "pictures": 240}, **changes}
        done = self.run_program("run", self.deck(deck, out + ".json"), "--out", out, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / out

    def test_pictures_are_files_and_stand_on_the_page(self):
        out = self.run_deck("r")
        for moment in ("intact", "peak", "past_peak", "end"):
            for what in ("cut",) if moment == "intact" else ("displacement", "cut"):
                _, height = size_of_png((out / "pictures" / f"{moment}_{what}.png").read_bytes())
                self.assertEqual(height, 240)
        self.assertTrue((out / "pictures" / "end_cracks.png").exists())
        self.assertFalse((out / "pictures" / "intact_cracks.png").exists())
        fields = len(list((out / "fields").glob("spheres_*.vtp")))
        self.assertEqual(len(list((out / "pictures").glob("still_*.png"))), fields)
        page = (out / "report.html").read_text()
        images = re.findall(r'<img alt="([^"]+)" src="data:image/png;base64,', page)
        self.assertGreaterEqual(len(images), 8)
        self.assertIn("bonds have failed", " ".join(images))
        self.assertLess(len(page), 2_000_000)
        none = self.run_deck("none", output={"fields": 0, "pictures": 0})
        self.assertFalse((none / "pictures").exists())

    def test_field_series_are_read_by_vtk_at_physical_times(self):
        out = self.run_deck("r")
        entries = {}
        for part in ("series", "spheres", "bonds", "platens"):
            tree = xml.etree.ElementTree.parse(out / (part + ".pvd"))
            entries[part] = [(float(e.get("timestep")), e.get("name"), e.get("file")) for e in tree.iter("DataSet")]
            for _, _, file in entries[part]:
                self.assertTrue((out / file).exists(), file)
        self.assertEqual(len(entries["series"]), sum(len(entries[p]) for p in ("spheres", "bonds", "platens")))
        times = [t for t, _, _ in entries["spheres"]]
        self.assertEqual(times, sorted(times))
        last = float(self.rows(out / "curve.csv")[-1]["time_s"])
        self.assertAlmostEqual(times[-1], last, delta=0.02 * last)
        compile((out / "views.py").read_text(), "views.py", "exec")
        if not self.vtk():
            self.skipTest("VTK's Python is not there")
        script = ("import sys, vtk\nr = vtk.vtkXMLPolyDataReader()\nr.SetFileName(sys.argv[1])\nr.Update()\nd = r.GetOutput()\n"
                  "print(d.GetNumberOfPoints(), d.GetPointData().HasArray('radius'), d.GetPointData().HasArray('displacement'))")
        done = subprocess.run(["/usr/bin/python3", "-c", script, out / entries["spheres"][-1][2]], capture_output=True, text=True)
        self.assertEqual(done.stdout.split(), ["500", "1", "1"], done.stderr)

    def vtk(self):
        return subprocess.run(["/usr/bin/python3", "-c", "import vtk"], capture_output=True).returncode == 0

    def test_curves_load_as_they_are(self):
        out = self.run_deck("r")
        rows = self.rows(out / "curve.csv")
        self.assertGreater(max(float(r["axial_stress_Pa"]) for r in rows), 1e7)
        if shutil.which("gnuplot"):
            script = ('set datafile separator ","; set datafile commentschars "#"; set key autotitle columnhead; set terminal svg; set output "g.svg"; '
                      'plot "r/curve.csv" using "axial_strain":"axial_stress_Pa" with lines')
            done = subprocess.run(["gnuplot", "-e", script], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("path", (self.folder / "g.svg").read_text())
        if importlib.util.find_spec("pandas"):
            import pandas
            table = pandas.read_csv(out / "curve.csv", comment="#")
            self.assertEqual(len(table), len(rows))
            self.assertTrue((table.dtypes == float).all() or table.select_dtypes("number").shape == table.shape)

    def test_results_are_compared_with_their_differences(self):
        self.run_deck("a")
        self.run_deck("b", specimen={**BODY, "seed": 2})
        self.run_deck("c", specimen={**BODY, "seed": [1, 3]})
        done = self.run_program("compare", "a", "b", "c", "--out", "both")
        self.assertEqual(done.returncode, 0, done.stderr)
        strength = [json.loads((self.folder / f / "summary.json").read_text())["results"]["strength"]["value"] for f in ("a", "b")]
        line = next(line for line in done.stdout.splitlines() if line.startswith("strength "))
        self.assertIn(f"{1e-6 * strength[0]:.1f}", line)
        off = 100 * (strength[1] / strength[0] - 1)
        self.assertIn(f"{off:+.{2 if abs(off) < 10 else 1}f} %", line)
        self.assertIn("+0.00 %", line)  # the first member of the series is the first test again
        table = self.rows(self.folder / "both" / "comparison.csv")
        row = next(r for r in table if r["result"] == "strength")
        self.assertEqual(float(row["b"]), strength[1])
        self.assertIn("c/seed_1", row)
        page = (self.folder / "both" / "report.html").read_text()
        self.assertIn("4 tests compared", page)
        for wrong, says in [(["nowhere"], "no such file"), (["a", "b", "--x", "axial_stain"], "axial_strain"), (["a", "--y", "owned"], "no column")]:
            done = self.run_program("compare", *wrong, "--out", "bad")
            self.assertEqual(done.returncode, 2)
            self.assertIn(says, done.stderr)
            self.assertFalse((self.folder / "bad").exists())

    def test_any_two_columns_are_plotted(self):
        self.run_deck("a")
        done = self.run_program("plot", "a", "--x", "axial_strain", "--y", "damage", "--out", "energy.svg")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "energy.svg").read_text()
        xml.etree.ElementTree.fromstring(text)
        self.assertIn("damage [J]", text)
        self.assertEqual(self.run_program("plot", "a", "--out", "energy.bmp").returncode, 2)

    def test_a_report_is_made_anew_from_the_checkpoint(self):
        out = self.run_deck("r")
        kept = {name: (out / name).read_bytes() for name in ("curve.csv", "events.csv", "summary.json", "report.html")}
        for name in ("report.html", "summary.json", "curve.csv"):
            (out / name).unlink()
        shutil.rmtree(out / "pictures")
        done = self.run_program("report", "r", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("curve.csv", "events.csv", "summary.json"):
            self.assertEqual((out / name).read_bytes(), kept[name], name)
        for name in ("end_cut.png", "end_sideways.png"):
            self.assertTrue((out / "pictures" / name).exists(), name)
        self.assertEqual(json.loads((out / "manifest.json").read_text())["resumed"], [])
        self.assertEqual(self.run_program("report", "nowhere").returncode, 2)


if __name__ == "__main__":
    main()
