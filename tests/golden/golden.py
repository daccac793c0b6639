#!/usr/bin/env python3
"""Whether a program gives the same bytes as before: tables of small tests, scenes and campaigns, without their lines of comments.

Usage: golden.py PROVETA             compares with what hashes.json has of PROVETA's compiler
       golden.py PROVETA --write     writes it there: what changes a byte is to be meant, and said in the commit
       golden.py OLD NEW             compares two builds on every example, which takes an hour or more

A test of the registry that has no file of its own here is run as its smallest deck with 300 spheres.
"""
import argparse
import hashlib
import json
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
EXAMPLES = HERE.parents[1] / "examples"
HASHES = HERE / "hashes.json"
PASSING = ("seconds", "wall", "trial")  # columns of how long something took, and of keys, which change with every build
KEY = re.compile(r"\b[0-9a-f]{16}\b")


def output_of(*command):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, check=True).stdout


def compiler(program):
    """As "GNU 12.2.0": other compilers order sums otherwise."""
    return re.search(r"\b(GNU|Clang) [\d.]+", output_of(program, "--version"))[0]


def tests(program):
    return [one["properties"]["test"]["const"] for one in json.loads(output_of(program, "schema"))["oneOf"]]


def subcommand(content):
    return "scene" if "scene" in content else "calibrate" if "targets" in content else "sweep" if "parameters" in content else "run"


def digest(file):
    lines = [line for line in file.read_text().splitlines() if not line.startswith("#")]
    heads = lines[0].split(",") if lines else []
    timed = [k for k, head in enumerate(heads) if any(word in head for word in PASSING)]
    if timed:
        rows = [line.split(",") for line in lines]
        lines = [",".join(cell for k, cell in enumerate(row) if k not in timed) for row in rows]
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()[:16]


def hashes(program, file, *settings):
    """{table: hash} of what a program makes of a deck, scene, sweep or calibration."""
    command = subcommand(json.loads(file.read_text()))
    with tempfile.TemporaryDirectory(prefix="proveta_golden_") as out:
        ran = subprocess.run([program, command, file, "--out", out, "--quiet", *settings], capture_output=True, text=True)
        if ran.returncode != 0:
            raise SystemExit(f"{file.name}: exit {ran.returncode}: {ran.stderr.strip()}")
        found = {}
        for table in sorted(pathlib.Path(out).rglob("*.csv")):
            found.setdefault(KEY.sub("KEY", str(table.relative_to(out))), []).append(digest(table))
        return {name: " ".join(sorted(digests)) for name, digests in found.items()}


def small_cases(program):
    """{name: (file, settings)}"""
    out = {f.stem: (f, []) for f in sorted(HERE.glob("*.json")) if f != HASHES}
    for name in tests(program):
        if name not in out:
            deck = pathlib.Path(tempfile.mkdtemp(prefix="proveta_golden_")) / f"{name}.json"
            deck.write_text(json.dumps({"test": name, "specimen": {"spheres": 300}, "output": {"fields": 0, "samples": 100}}))
            out[name] = (deck, [])
    return out


def differences(before, now):
    out = []
    for case in sorted({*before, *now}):
        was, is_ = before.get(case, {}), now.get(case, {})
        out += [f"{case}/{table}: {was.get(table, 'not there')} became {is_.get(table, 'not there')}"
                for table in sorted({*was, *is_}) if was.get(table) != is_.get(table)]
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("new", nargs="?")
    parser.add_argument("--write", action="store_true")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.program).resolve())
    if arguments.new:
        new = str(pathlib.Path(arguments.new).resolve())
        cases = {f.stem: f for f in sorted(EXAMPLES.glob("*.json")) if subcommand(json.loads(f.read_text())) in ("run", "scene")}
        found = []
        for name, file in cases.items():
            found += differences({name: hashes(program, file)}, {name: hashes(new, file)})
            print(f"{name}: {'as before' if not any(line.startswith(name + '/') for line in found) else 'differs'}", flush=True)
    else:
        known = json.loads(HASHES.read_text()) if HASHES.exists() else {}
        if not arguments.write and compiler(program) not in known:
            print(f"no golden bytes of {compiler(program)}, only of {', '.join(known)}")
            return 0
        now = {}
        for name, (file, settings) in small_cases(program).items():
            now[name] = hashes(program, file, *settings)
            print(f"{name}: {len(now[name])} tables", flush=True)
        if arguments.write:
            known[compiler(program)] = now
            HASHES.write_text(json.dumps(known, indent=1, sort_keys=True) + "\n")
            return 0
        found = differences(known[compiler(program)], now)
    print("\n".join(found) if found else "the same bytes")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
