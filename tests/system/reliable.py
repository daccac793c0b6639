"""What the tests of reliability share: a small specimen, and what is asked of folders."""
import json

from case import Case

SAME = {"of a test": ["curve.csv", "events.csv", "energy.csv", "acoustic.csv", "summary.json"],
        "of a scene": ["curve.csv", "energy.csv", "particles.csv", "summary.json"]}
BODY = {"diameter": "50 mm", "height": "100 mm", "spheres": 500}


class Reliability(Case):
    def content(self, out, name):
        return (self.folder / out / name).read_bytes()

    def assertSame(self, out, reference):
        scene = (self.folder / reference / "particles.csv").exists()
        for name in SAME["of a scene" if scene else "of a test"]:
            self.assertEqual(self.content(out, name), self.content(reference, name), name)
        fields = sorted(p.name for p in (self.folder / reference / "fields").iterdir())
        self.assertEqual(sorted(p.name for p in (self.folder / out / "fields").iterdir()), fields)
        for field in fields:
            self.assertEqual(self.content(out, "fields/" + field), self.content(reference, "fields/" + field), field)

    def status(self, out="out"):
        return json.loads((self.folder / out / "manifest.json").read_text())["status"]

    def assertWhole(self, out):
        """No file is half: what is there can be read to its end."""
        for path in (self.folder / out).rglob("*"):
            if path.suffix == ".json":
                json.loads(path.read_text())
            elif path.suffix in (".partial", ".next"):
                continue  # under names that say so, and gone once the run goes on
            elif path.suffix == ".csv":
                rows = [line for line in path.read_text().splitlines() if not line.startswith("#")]
                self.assertTrue(all(row.count(",") == rows[0].count(",") for row in rows), path)
            elif path.suffix == ".html":
                self.assertTrue(path.read_text().rstrip().endswith("</html>"), path)
            elif path.suffix == ".vtp":
                self.assertTrue(path.read_bytes().rstrip().endswith(b"</VTKFile>"), path)

    def no_halves(self, out):
        self.assertEqual([p.name for p in (self.folder / out).rglob("*") if p.suffix in (".partial", ".next")], [])
