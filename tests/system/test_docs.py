#!/usr/bin/env python3
"""Every command of the documentation is run, in a folder like a checkout: whole where it is cheap, on 200 spheres, or only checked, planned or
listed where it would take minutes. Names in running text must exist."""
import pathlib
import re
import shlex
import shutil
import sys

from case import Case, main

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
SMALL = ["--set", "specimen.spheres=200", "--set", "output.fields=0", "--set", "output.pictures=0", "--set", "loading.rate=1 m/s", "--quiet"]


def block_commands(page):
    """Commands in indented blocks, lines that end in a backslash joined."""
    text = page.read_text().replace("\\\n", " ")
    for line in text.splitlines():
        found = re.match(r"^    (?:build/release/)?proveta (.*)$", line)
        if found:
            yield found.group(1)


def inline_commands(page):
    yield from re.findall(r"`(?:build/release/)?proveta ([^`]*)`", page.read_text())


class Docs(Case):
    def test_measured_figures_stand_on_the_page_as_they_were_measured(self):
        sys.path.insert(0, str(ROOT / "docs"))
        import measure
        page = (ROOT / "docs" / "results.md").read_text()
        tables, measured = measure.read_tables(), measure.read_measured()
        self.assertTrue(measured)
        for name, kept in measured.items():
            self.assertIn(f"<!-- measured: {name} -->\n\n{measure.markdown(tables[name], kept)}\n\n<!-- end -->", page)

    def shortened(self, words):
        """The same command, made cheap; without a folder of its own to go to, sweeps and calibrations are planned where they would be carried out."""
        verb = words[0]
        granular = any("granular" in w for w in words)
        if verb == "run" and granular:
            return ["check", *[w for w in words[1:] if w != "--quiet"]]
        if verb in ("run", "study"):
            values = list(words)
            if "size" in words:  # the spheres of a study of sizes
                at = words.index("--values") + 1
                values[at] = ",".join(str(int(v) // 10) for v in words[at].split(","))
            more = SMALL if verb == "run" else [w for w in SMALL if w != "--quiet"] + ["--quiet"]
            if verb == "study" and "rate" in words:
                more = [w for k, w in enumerate(more) if "loading.rate" not in w and not (w == "--set" and k + 1 < len(more) and "loading.rate" in more[k + 1])]
            return values if any(w.endswith("manifest.json") for w in words) else [*values, *more]
        if verb == "scene":
            return words if "--check" in words else [*words, "--check"]
        if verb in ("sweep", "calibrate"):
            planned = any(w in words for w in ("--plan", "--status", "--collect"))
            return words if planned else [*words, "--plan"]
        if verb == "bench":
            return ["bench", "--help"]
        if verb == "verify":
            return ["verify", "--list"]
        return words

    def fixtures(self):
        shutil.copytree(ROOT / "examples", self.folder / "examples")
        for name in ("ucs", "brazilian", "triaxial", "triaxial-series", "sweep"):
            shutil.copy(ROOT / "examples" / (name + ".json"), self.folder)
        shutil.copy(ROOT / "examples" / "silo.json", self.folder / "mine-scene.json")
        for name in ("mine", "mydeck"):
            self.deck({"test": "ucs"}, name + ".json")
        (self.folder / "mesh.csv").write_text("".join(f"{0.02 * i} {0.02 * j} {0.02 * k} 0.01\n"
                                                      for i in range(-3, 4) for j in range(14) for k in range(-3, 4) if i * i + k * k < 12))
        self.assertEqual(self.run_program("specimen", "make", "s.h5", "--set", "spheres=500").returncode, 0)
        for out in ("results/mine", "results/other"):
            done = self.run_program("run", "ucs.json", "--out", out, *SMALL)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_commands_in_blocks_run(self):
        self.fixtures()
        cases = self.run_program("verify", "--list", "--all").stdout
        seen = set()
        for page in PAGES:
            for line in block_commands(page):
                if line in seen or re.search(r"\w\|\w", line.split("#")[0]) or "relaxation" in line:
                    continue  # the alternatives of a|b|c have lines of their own; relaxation is there once it has been added
                seen.add(line)
                words = shlex.split(line, comments=True)
                with self.subTest(page=page.name, command=line):
                    if words[0] == "scene":
                        words = ["mine-scene.json" if w == "mine.json" else w for w in words]
                    if words[0] == "verify":
                        for name in words[1:]:
                            if not name.startswith("-") and words[words.index(name) - 1] != "--out":
                                self.assertIn(name, cases)
                    done = self.run_program(*self.shortened(words), timeout=600)
                    late = any(w in words for w in ("--status", "--collect", "--plan")) or words[0] in ("sweep", "calibrate")
                    self.assertIn(done.returncode, (0, 3) if late else (0,), done.stdout[-2000:] + done.stderr[-2000:])
        self.assertGreater(len(seen), 40)

    def test_names_in_text_exist(self):
        commands = self.run_program("--help").stdout
        cases = self.run_program("verify", "--list", "--all").stdout
        for page in PAGES:
            for line in inline_commands(page):
                words = line.split()
                with self.subTest(page=page.name, command=line):
                    self.assertRegex(commands, rf"(?m)^  {re.escape(words[0])}\b")
                    if words[0] == "verify":
                        for name in words[1:]:
                            if name.startswith("-"):
                                break
                            self.assertIn(name, cases)
                    for word in words:
                        if word.startswith("examples/"):
                            self.assertTrue((ROOT / word).exists(), word)

    def test_links_lead_somewhere(self):
        for page in PAGES:
            text = re.sub(r"```.*?```", "", page.read_text(), flags=re.S)
            for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", text):
                if not re.match(r"[a-z]+:", target):
                    with self.subTest(page=page.name, link=target):
                        self.assertTrue((page.parent / target).exists())


if __name__ == "__main__":
    main()
