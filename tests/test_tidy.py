#!/usr/bin/env python3
"""The static checks fail where clang-tidy alone would look at nothing, or at something else, and pass.

Usage: test_tidy.py ROOT
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
CONFIGURATION = "Checks: >\n  -*,\n  bugprone-use-after-move,\n  modernize-use-override\nWarningsAsErrors: '*'\n"
GOOD = "struct A { virtual ~A() = default; virtual void f() {} };\nstruct B : A { void f() override {} };\n"


@unittest.skipUnless(shutil.which("clang-tidy"), "no clang-tidy (packages.txt names it)")
class Tidy(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="proveta_tidy_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.write(".clang-tidy", CONFIGURATION)
        self.write("a.cpp", GOOD)
        self.write("compile_commands.json", json.dumps([{"directory": str(self.folder), "command": "clang++ -c a.cpp", "file": "a.cpp"}]))

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def tidy(self, *sources):
        return subprocess.run([str(ROOT / ".ci" / "tidy"), ".", *sources], cwd=self.folder, capture_output=True, text=True, timeout=120)

    def fails(self, said, *sources):
        done = self.tidy(*sources)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn(said, done.stdout + done.stderr)

    def test_clean_sources_pass_without_a_word(self):
        done = self.tidy("a.cpp")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_findings_fail(self):
        self.write("a.cpp", GOOD.replace(" override", ""))
        self.fails("modernize-use-override", "a.cpp")

    def test_what_cannot_be_compiled_fails_and_says_why(self):
        self.write("a.cpp", "#include <nowhere.h>\n")
        self.fails("nowhere.h", "a.cpp")

    def test_a_broken_configuration_fails(self):
        for broken in (CONFIGURATION.replace("Checks: ", "Checks "), CONFIGURATION.replace("WarningsAs", "WarningAs"),
                       CONFIGURATION.replace("use-override", "use-overide"), ""):
            self.write(".clang-tidy", broken)
            self.fails(".clang-tidy is not what clang-tidy does", "a.cpp")

    def test_missing_compile_commands_fail(self):
        self.write("b.cpp", GOOD)
        self.fails("b.cpp is not in", "b.cpp")
        self.fails("no source")
        (self.folder / "compile_commands.json").unlink()
        self.fails("no ./compile_commands.json", "a.cpp")


if __name__ == "__main__":
    unittest.main()
