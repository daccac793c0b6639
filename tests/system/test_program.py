#!/usr/bin/env python3
"""The program from outside: single runs, bad input, specimens, self-description."""
import json
import os
import pathlib
import subprocess
import unittest

from case import FILES, SMALL, Case, main


class Running(Case):
    def test_a_run_leaves_every_file_whole(self):
        out = self.folder / "result"
        done = self.run_program("run", self.deck(), "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Compressive strength", done.stdout)
        for name in FILES:
            self.assertTrue((out / name).is_file(), name)
        self.assertFalse(list(out.rglob("*.partial")))
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(summary["status"], "complete")
        self.assertGreater(summary["results"]["strength"]["value"], 1e6)
        self.assertTrue(summary["verdicts"]["Energy balance"]["good"])
        curve = self.rows(out / "curve.csv")
        stress = [float(r["axial_stress_Pa"]) for r in curve]
        self.assertAlmostEqual(max(stress), summary["results"]["strength"]["value"], delta=1e-6 * max(stress))
        events = self.rows(out / "events.csv")
        self.assertEqual(len(events), int(float(curve[-1]["broken_bonds"])) + sum(float(e["axial_strain"]) > float(curve[-1]["axial_strain"]) for e in events))
        acoustic = self.rows(out / "acoustic.csv")
        self.assertEqual(sum(float(r["bonds"]) for r in acoustic), len(events))
        self.assertEqual(len(acoustic), summary["results"]["acoustic_events"]["value"])
        self.assertEqual(len(summary["stages"]), len(set(summary["stages"])))
        self.assertGreaterEqual(summary["mass_scaling"]["added_later"], 0.0)
        page = (out / "report.html").read_text()
        self.assertIn("Acoustic events by magnitude", page)
        self.assertNotIn("http://", page.replace("http://www.w3.org/2000/svg", ""))
        self.assertNotIn("https://", page)
        self.assertTrue(list((out / "fields").glob("spheres_*.vtp")))

    def test_output_never_touches_the_calculation(self):
        """Rows, fields, pictures and checkpoints are observers: the bonds fail the same, to the bit."""
        found = set()
        for output in ({"samples": 61, "fields": 0}, {"samples": 100, "fields": 3, "checkpoint_every": 0.05}, {"samples": 97, "pictures": 100}):
            with self.subTest(output):
                deck = self.deck(output=output, loading={"rate": "auto"})
                done = self.run_program("run", deck, "--out", "observed", "--quiet")
                self.assertEqual(done.returncode, 0, done.stderr)
                found.add((self.folder / "observed" / "events.csv").read_bytes())
                self.assertGreater(len(self.rows(self.folder / "observed" / "events.csv")), 20)
        self.assertEqual(len(found), 1)

    def test_bench_prints_a_line_a_measurement_and_writes_the_same_as_json(self):
        done = self.run_program("bench", "--sizes", "500", "--threads", "1,2", "--repeats", "1", "--seconds", "0.02", "--json", "bench.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = [line.split() for line in done.stdout.splitlines() if line.startswith("threads ")]
        self.assertEqual([line[1] for line in lines], ["1", "2", "1", "2"])
        found = json.loads((self.folder / "bench.json").read_text())["measurements"]
        self.assertEqual([m["state"] for m in found], ["elastic", "elastic", "past_peak", "past_peak"])
        for line, measured in zip(lines, found):
            self.assertAlmostEqual(float(line[line.index("ns_per_bond_step") + 1]), measured["ns_per_bond_step"], delta=0.006)
            self.assertGreater(measured["triad_bytes_per_s"], 0)
            self.assertGreater(measured["ns_forces"], 0)
        self.assertEqual(found[0]["failed_bonds"], 0)
        self.assertGreater(found[2]["failed_bonds"], 0)
        wrong = self.run_program("bench", "--sizes", "5")
        self.assertEqual(wrong.returncode, 2)
        missing = self.run_program("bench", "--specimen", "nowhere.h5")
        self.assertEqual(missing.returncode, 2)

    def test_a_run_at_the_rate_that_suits_it_says_what_it_chose(self):
        loading = {"rate": "auto", "rate_check": "half_rate", "stop": {"axial_strain": 0.004}}
        deck = self.deck(loading=loading, numerics={"mass_scaling": 0.02})
        done = self.run_program("run", deck, "--out", "result", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads((self.folder / "result" / "summary.json").read_text())
        rate = {k: summary["results"][k + "_rate"]["value"] for k in ["lowest", "mean", "highest"]}
        self.assertLess(0.0, rate["lowest"])
        self.assertLess(rate["lowest"], 0.5 * rate["mean"] + 0.5 * rate["highest"])
        self.assertLess(rate["mean"], rate["highest"])
        column = [float(r["rate_m/s"]) for r in self.rows(self.folder / "result" / "curve.csv")]
        self.assertAlmostEqual(max(column), rate["highest"], delta=0.2 * max(column))
        self.assertLess(column[0], 0.1 * max(column))
        self.assertGreater(summary["rate_check"]["peak_at_half_rate_Pa"], 1e6)
        self.assertIn("half the rate", json.dumps(summary["verdicts"]["Quasi-static loading"]["figures"]))
        scaling = summary["mass_scaling"]
        self.assertTrue(0.0 < scaling["added_mass"] <= 0.02 + 1e-9)
        self.assertGreater(scaling["stable_step_with_s"], 1.3 * scaling["stable_step_without_s"])
        self.assertIn("added mass", (self.folder / "result" / "report.html").read_text())

        deck = self.deck(name="off.json", loading={"rate": "auto", "stop": {"axial_strain": 0.0005}}, numerics={"mass_scaling": 0})
        self.assertEqual(self.run_program("run", deck, "--out", "off", "--quiet").returncode, 0)
        summary = json.loads((self.folder / "off" / "summary.json").read_text())
        self.assertEqual(summary["rate_check"], "not done")
        self.assertEqual(summary["mass_scaling"]["added_mass"], 0.0)
        wrong = self.run_program("check", self.deck(name="wrong.json", loading={"rate": "atuo"}, numerics={"mass_scaling": 2}))
        self.assertEqual(wrong.returncode, 2)
        for text in ["/loading/rate", '"auto"', "/numerics/mass_scaling"]:
            self.assertIn(text, wrong.stderr)

    def test_threads_and_the_manifest_repeat_a_run_to_the_byte(self):
        deck = self.deck()
        self.assertEqual(self.run_program("run", deck, "--out", "one", "--threads", 1, "--quiet").returncode, 0)
        self.assertEqual(self.run_program("run", deck, "--out", "two", "--threads", 2, "--quiet").returncode, 0)
        again = self.run_program("run", "one/manifest.json", "--out", "three", "--quiet")
        self.assertEqual(again.returncode, 0, again.stderr)
        for name in ["curve.csv", "events.csv", "energy.csv"]:
            first = (self.folder / "one" / name).read_bytes()
            self.assertEqual(first, (self.folder / "two" / name).read_bytes(), name)
            self.assertEqual(first, (self.folder / "three" / name).read_bytes(), name)
        hashes = {json.loads((self.folder / d / "summary.json").read_text())["final_state_hash"] for d in ["one", "two", "three"]}
        self.assertEqual(len(hashes), 1)

    def test_results_go_to_stdout_and_the_log_to_stderr(self):
        done = self.run_program("run", self.deck(), "--out", "r")
        self.assertIn("results in r", done.stdout)
        self.assertIn("info:", done.stderr)
        self.assertNotIn("info:", done.stdout)
        quiet = self.run_program("run", self.deck(), "--out", "r", "--quiet")
        self.assertEqual([line for line in quiet.stderr.splitlines() if not line.startswith("warning:")], [])

    def test_an_interrupt_ends_cleanly_with_a_partial_result(self):
        deck = self.deck(loading={"rate": "0.001 m/s"})
        process = self.start("run", deck, "--out", "r", until="r/fields")
        out = self.interrupt(process)
        summary = json.loads((self.folder / "r" / "summary.json").read_text())
        self.assertEqual(summary["status"], "interrupted")
        self.assertIn("partial", " ".join(summary["warnings"]))
        self.assertIn("interrupted", (self.folder / "r" / "report.html").read_text())
        self.assertEqual(json.loads((self.folder / "r" / "manifest.json").read_text())["status"], "interrupted")
        self.assertIn("interrupted", out)


class BadInput(Case):
    def refused(self, *arguments, says):
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertFalse((self.folder / "out").exists(), "a refused run left a folder")

    def test_decks_that_are_not_decks(self):
        for text, says in [("", "an empty file"), ('{"test": "ucs"', "not JSON"), ("[]", "a JSON array"), ('{"test": NaN}', "JSON has no NaN"),
                           ("{}", "no test"), ('{"test": 3}', "/test"), ("\x00\x01", "not JSON"), ("[" * 100000, "nested levels")]:
            with self.subTest(text[:20]):
                self.refused("run", self.deck(text), "--out", "out", says=says)
        self.refused("run", "nowhere.json", "--out", "out", says="no such file")
        self.refused("run", self.folder, "--out", "out", says="a folder")

    def test_values_that_cannot_be(self):
        for changes, says in [
            ({"specimen": {"smallest_radius": -1}}, "/specimen/smallest_radius"),
            ({"specimen": {"diameter": "-5 mm"}}, "/specimen/diameter"),
            ({"specimen": {"spheres": 1}}, "/specimen/spheres"),
            ({"specimen": {"sphers": 100}}, 'did you mean "spheres"?'),
            ({"loading": {"confining_pressure": "30 MPa"}}, ["/loading/confining_pressure", "triaxial"]),
            ({"loading": {"rate": "NaN"}}, "/loading/rate"),
            ({"loading": {"rate": "fast"}}, "/loading/rate"),
            ({"material": {"card": "granite"}}, "/material/card"),
            ({"material": {"card": "no/such/card.json"}}, "neither a card of the program nor a file"),
            ({"material": {"card": "custom", "yrc": [0.5, 2, 3]}}, "/material/yrc/0"),
            ({"specimen": {"file": "none.h5"}}, "/specimen/file"),
            ({"numerics": {"time_step": "1 s"}}, "stable step"),
            ({"bonding": {"coordination": 29}}, "/bonding/coordination"),
        ]:
            with self.subTest(str(changes)):
                self.refused("run", self.deck(**changes), "--out", "out", says=says)

    def test_folders_that_cannot_be_used(self):
        (self.folder / "file").write_text("x")
        (self.folder / "mine").mkdir()
        (self.folder / "mine" / "thesis.txt").write_text("x")
        self.refused("run", self.deck(), "--out", "file", says="which is a file")
        self.refused("run", self.deck(), "--out", "file/sub", says="cannot be made")
        self.refused("run", self.deck(), "--out", "mine", says="holds other files")
        self.assertTrue((self.folder / "mine" / "thesis.txt").exists())
        self.refused("run", self.deck(), "--out", "/proc/nowhere", says="cannot be made")

    def test_an_earlier_result_survives_a_refused_deck_and_is_replaced_by_a_good_one(self):
        self.assertEqual(self.run_program("run", self.deck(), "--out", "r", "--quiet").returncode, 0)
        before = (self.folder / "r" / "curve.csv").read_bytes()
        self.assertEqual(self.run_program("run", self.deck(numerics={"time_step": "1 s"}, name="bad.json"), "--out", "r").returncode, 2)
        self.assertEqual(before, (self.folder / "r" / "curve.csv").read_bytes())
        self.assertEqual(self.run_program("run", self.deck(), "--out", "r", "--quiet", "--seed", 5).returncode, 0)
        self.assertNotEqual(before, (self.folder / "r" / "curve.csv").read_bytes())

    def test_command_lines(self):
        self.refused("run", says="deck is required")
        self.refused("rum", says=['"rum" is no command', 'did you mean "run"?'])
        self.refused("run", self.deck(), "--threads", "0", says="--threads")
        self.refused("run", self.deck(), "--set", "rate", says="key=value")
        self.refused("describe", "loading.raet", says='did you mean "loading.rate"?')

    def test_check_reports_all_problems_at_once(self):
        deck = self.deck(specimen={"diameter": 0, "sphere": 3}, loading={"rat": 1}, colour="red")
        done = self.run_program("check", deck)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("error:"), 4, done.stderr)
        self.assertEqual(self.run_program("check", self.deck()).returncode, 0)


class Materials(Case):
    def test_a_card_file_based_on_another_and_overridden_by_the_deck(self):
        (self.folder / "mine.json").write_text(json.dumps({"card": "concrete_dempack", "sigma_f": "3 MPa", "mu_s": 0.5}))
        done = self.run_program("run", self.deck(material={"card": "mine.json", "mu_s": 0.7}), "--out", "r", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        material = json.loads((self.folder / "r" / "manifest.json").read_text())["deck"]["material"]
        self.assertEqual((material["name"], material["sigma_f"], material["mu_s"], material["area_rule"]), ("mine", 3e6, 0.7, "minimum_radius"))

    def test_the_program_needs_no_file_but_the_deck(self):
        done = self.run_program("describe", "concrete_sfer", env={"PATH": "/nowhere"})
        self.assertIn("tau_f [Pa]", done.stdout)


class Specimens(Case):
    def test_make_info_export_import_and_use(self):
        make = self.run_program("specimen", "make", "a.h5", "--set", "spheres=600", "--set", "diameter=50 mm", "--set", "height=100 mm")
        self.assertEqual(make.returncode, 0, make.stderr)
        info = self.run_program("specimen", "info", "a.h5")
        self.assertEqual(info.stdout, make.stdout)
        self.assertIn("spheres              600", info.stdout)
        self.assertEqual(self.run_program("specimen", "export", "a.h5", "a.csv").returncode, 0)
        back = self.run_program("specimen", "import", "a.csv", "b.h5", "--diameter", 0.05, "--height", 0.1)
        self.assertEqual(back.returncode, 0, back.stderr)
        self.assertEqual(self.run_program("specimen", "export", "b.h5", "b.csv").returncode, 0)
        for a, b in zip(self.rows(self.folder / "a.csv"), self.rows(self.folder / "b.csv")):
            for key in a:
                self.assertAlmostEqual(float(a[key]), float(b[key]), delta=1e-4)
        run = self.run_program("run", self.deck(specimen={"file": "a.h5"}), "--out", "r", "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        # A manifest notices that its specimen is another one now.
        self.run_program("specimen", "make", "a.h5", "--set", "spheres=600", "--set", "diameter=50 mm", "--set", "height=100 mm", "--set", "seed=2")
        changed = self.run_program("run", "r/manifest.json", "--out", "r2", "--quiet")
        self.assertEqual(changed.returncode, 2)
        self.assertIn("/specimen_hash", changed.stderr)
        disc = self.run_program("specimen", "make", "d.h5", "--set", "shape=disc", "--set", "height=90 mm", "--set", "spheres=2000")
        self.assertIn("cylinder 150 x 90 mm", disc.stdout)

    def test_sphere_tables_are_read_as_they_were_written_or_refused(self):
        self.assertEqual(self.run_program("specimen", "make", "s.h5", "--set", "spheres=200", "--set", "diameter=50 mm", "--set", "height=100 mm").returncode, 0)
        self.assertEqual(self.run_program("specimen", "export", "s.h5", "s.csv").returncode, 0)
        spheres = [line.split(",")[:4] for line in (self.folder / "s.csv").read_text().splitlines()[1:]]

        def imported(rows, heading="x,y,z,r", *options, separator=",", decimal="."):
            text = "".join(separator.join(cells).replace(".", decimal) + "\n" for cells in ([heading.split(",")] if heading else []) + rows)
            (self.folder / "t.csv").write_text(text)
            done = self.run_program("specimen", "import", "t.csv", "t.h5", *options)
            return done.stdout[done.stdout.index("shape"):done.stdout.index("relative")] if done.returncode == 0 else (done.returncode, done.stderr)

        scaled = lambda by: [[repr(by * float(c)) for c in row] for row in spheres]
        plain = imported(spheres)
        self.assertIn("200", plain)
        self.assertEqual(imported([r[3:] + r[:3] for r in spheres], "r,x,y,z"), plain)
        self.assertEqual(imported([r[:3] + [repr(2.0 * float(r[3]))] for r in spheres], "x,y,z,diameter"), plain)
        self.assertEqual(imported(spheres, separator=";", decimal=","), plain)
        self.assertEqual(imported(spheres, None), plain)
        self.assertEqual(imported(scaled(1e3), "x_mm,y_mm,z_mm,r_mm"), plain)
        self.assertEqual(imported(scaled(1e3), "x,y,z,r", "--scale", "0.001"), plain)
        self.assertEqual(imported([r + ["7"] for r in spheres], "x,y,z,r,density"), plain)
        self.assertEqual(imported([r[3:] + r[:3] for r in spheres], None, "--columns", "r,x,y,z"), plain)
        for rows, heading, words in ((spheres + spheres[:1], "x,y,z,r", "line 2 and line 202"), (spheres + [["9", "0", "0", "0.002"]], "x,y,z,r", "line 202"),
                                     ([r[3:] + r[:3] for r in spheres], None, "--columns"), (spheres, "x,y,z,q", "radius or the diameter"),
                                     ([r[:3] + [repr(2.0 * float(r[3]))] for r in spheres], "x,y,z,r", "diameters"), ([[r[0], r[2], r[1], r[3]] for r in spheres], "x,y,z,r", "--axis y"),
                                     (spheres[:9] + [spheres[9][:3]], "x,y,z,r", "line 11: 3 cells")):
            with self.subTest(words):
                found = imported(rows, heading)
                self.assertEqual(found[0], 2, found)
                self.assertIn(words, found[1])

    def test_files_that_are_not_specimens(self):
        (self.folder / "x.h5").write_text("no")
        (self.folder / "x.csv").write_text("1,2,3\n")
        self.assertEqual(self.run_program("specimen", "info", "x.h5").returncode, 2)
        self.assertEqual(self.run_program("specimen", "info", "none.h5").returncode, 2)
        bad = self.run_program("specimen", "import", "x.csv", "y.h5")
        self.assertEqual(bad.returncode, 2)
        self.assertIn("x.csv: 3 columns without headings", bad.stderr)
        self.assertFalse((self.folder / "y.h5").exists())


class SelfDescription(Case):
    def test_verify_prints_a_table_and_writes_plots(self):
        done = self.run_program("verify", "polygon-areas", "--out", "verified")
        self.assertEqual(done.returncode, 0)
        self.assertIn("1 of 1 cases hold", done.stdout)
        for name in ("verification.md", "polygon-areas.svg", "polygon-areas.csv"):
            self.assertTrue((self.folder / "verified" / name).is_file(), name)
        listed = self.run_program("verify", "--list").stdout
        self.assertIn("dempack-bond", listed)
        wrong = self.run_program("verify", "dempack-bnd")
        self.assertEqual(wrong.returncode, 2)
        self.assertIn('did you mean "dempack-bond"?', wrong.stderr)

    def test_version_describe_and_reference(self):
        self.assertIn("proveta", self.run_program("--version").stdout)
        self.assertIn("platen_friction", self.run_program("describe", "ucs").stdout)
        self.assertIn("above 0", self.run_program("describe", "rate").stdout)
        reference = pathlib.Path(__file__).parents[2] / "docs" / "reference.md"
        self.assertEqual(self.run_program("describe", "--markdown").stdout, reference.read_text(), "docs/reference.md is out of date: proveta describe --markdown")

    def test_the_schema_is_a_schema_and_agrees_with_the_program(self):
        node_modules = os.environ.get("PROVETA_NODE_MODULES", "")
        if not node_modules:
            self.skipTest("PROVETA_NODE_MODULES is not set (bootstrap.sh installs ajv and sets it)")
        (self.folder / "schema.json").write_text(self.run_program("schema").stdout)
        for kind in ("card", "scene", "sweep", "calibration"):
            (self.folder / f"{kind}.json").write_text(self.run_program("schema", kind).stdout)
        examples = pathlib.Path(__file__).parents[2]
        files = {f: json.loads(f.read_text()) for f in sorted((examples / "examples").glob("*.json"))}
        kinds = {f: "scene" if "scene" in j else "calibration" if "targets" in j else "sweep" if "tests" in j else "deck" for f, j in files.items()}
        decks = [(f, True) for f, kind in kinds.items() if kind == "deck"]
        decks += [(self.deck(**c, name=f"d{k}.json"), good) for k, (c, good) in enumerate([
            ({}, True), ({"loading": {"rate": "0.1 m/s", "platen_friction": "glued"}}, True), ({"loading": {"rate": 0}}, False),
            ({"loading": {"rat": 1}}, False), ({"specimen": {"spheres": 1}}, False), ({"material": {"card": "custom", "lcs": [1, 2]}}, False),
            ({"specimen": {"seed": [1, 2]}}, True), ({"specimen": {"seed": []}}, False), ({"specimen": {"seed": [1, 1]}}, False),
            ({"test": "triaxial", "loading": {"confining_pressure": ["0 MPa", 1e6]}}, True),
            ({"test": "none"}, False), ({"specimen": {"diameter": "5 parsec"}}, False), ({"material": {"card": "custom", "tau_f": "16 MPa"}}, True)])]
        for deck, good in decks:
            self.assertEqual(self.run_program("check", deck).returncode == 0, good, deck.read_text())
        jobs = [["schema.json", str(d), good] for d, good in decks]
        jobs += [["card.json", str(c), True] for c in sorted((examples / "materials" / "cards").glob("*.json"))]
        for file in (f for f, k in kinds.items() if k == "scene"):
            bad = self.deck({**files[file], "surfaces": [{"name": "floor", "shape": "plain"}]}, "bad_scene.json")
            self.assertEqual(self.run_program("scene", bad, "--check").returncode, 2)
            jobs += [["scene.json", str(file), True], ["scene.json", str(bad), False]]
        for kind, command in (("sweep", "sweep"), ("calibration", "calibrate")):
            for file in (f for f, k in kinds.items() if k == kind):
                bad = self.deck({**files[file], "parameters": [{"path": "material.tau_f", "low": "1 parsec", "high": "20 MPa"}]}, f"bad_{kind}.json")
                self.assertEqual(self.run_program(command, bad, "--out", "none").returncode, 2)
                jobs += [[f"{kind}.json", str(file), True], [f"{kind}.json", str(bad), False]]
        script = f"""
            const Ajv = require({json.dumps(node_modules + '/ajv/dist/2020')}).default, fs = require('fs');
            const read = f => JSON.parse(fs.readFileSync(f));
            const ajv = new Ajv({{strict: true, allErrors: true, strictTypes: false}}), compiled = {{}};
            for (const [schema, file, good] of {json.dumps(jobs)}) {{
                compiled[schema] ??= ajv.compile(read(schema));
                if (compiled[schema](read(file)) !== good) {{ console.log(file, good, JSON.stringify(compiled[schema].errors)); process.exitCode = 1; }}
            }}"""
        done = subprocess.run(["node", "-e", script], capture_output=True, text=True, cwd=self.folder, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    main()
