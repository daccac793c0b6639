#!/usr/bin/env python3
"""Measures the figures of docs/results.md anew, and writes them there.

Usage: measure.py PROVETA [TABLE ...] [--runs FOLDER] [--jobs N] [--check]
    PROVETA  the program
    TABLE    names in docs/measures.json; none: all
    --runs   folder that the runs are kept in: a measurement that was stopped goes on where it was
    --jobs   tests side by side, each on one thread
    --check  writes nothing; fails where a mean has moved by more than the row's scatter from what docs/measured.json holds

A table stands in results.md between "<!-- measured: NAME -->" and "<!-- end -->". docs/measures.json says what each is made of: tests by
their example, what is set in it and the seeds (1 unless said), and rows: what it is, "test.result" or a formula of such, unit, what is
wanted, and the relative scatter that a mean may move by. "rows" may name a table that has the same. Of a formula there are as many values
as its tests have seeds in common. docs/measured.json keeps every value with the program and the day that it was measured by.
"""
import argparse
import concurrent.futures
import datetime
import json
import pathlib
import re
import statistics
import subprocess
import sys
import textwrap

DOCS = pathlib.Path(__file__).resolve().parent
UNITS = {"": 1.0, "%": 1e2, "kPa": 1e-3, "MPa": 1e-6, "GPa": 1e-9, "J/m2": 1.0, "deg": 1.0}
COLUMNS = ["row", "result", "unit", "wanted", "scatter"]


def read_tables():
    tables = json.loads((DOCS / "measures.json").read_text())
    for table in tables.values():
        rows = tables[table["rows"]]["rows"] if isinstance(table["rows"], str) else table["rows"]
        table["rows"] = [row if isinstance(row, dict) else dict(zip(COLUMNS, row)) for row in rows]
    return tables


def read_measured():
    file = DOCS / "measured.json"
    return json.loads(file.read_text()) if file.exists() else {}


def measured_by(program):
    return subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip()


def run(program, folder, test, seed):
    """Results of one test: read from its folder if it is done there by the same program, else run."""
    version = measured_by(program)
    done = folder / "measured_by"
    if not (done.exists() and done.read_text() == version):
        command = [program, "run", DOCS.parent / "examples" / f"{test['deck']}.json", "--out", folder, "--threads", "1", "--quiet"]
        for setting in [*test.get("set", []), f"specimen.seed={seed}", "output.fields=0"]:
            command += ["--set", setting]
        ran = subprocess.run(command, capture_output=True, text=True)
        if ran.returncode != 0:
            raise SystemExit(f"{folder}: exit {ran.returncode}: {ran.stderr.strip()}")
        done.write_text(version)
    summary = json.loads((folder / "summary.json").read_text())
    results = {name: result["value"] for name, result in summary["results"].items()}
    if isinstance(summary.get("rate_check"), dict):
        results["rate_effect"] = summary["rate_check"]["peak_at_rate_over_that_minus_1"]
    return results


def tests_of(result):
    """Names of the tests that a result or a formula is made of."""
    return sorted(set(re.findall(r"([a-z]\w*)\.", result)))


def value_of(result, measured):
    """A row's value, from the results of each of its tests."""
    def number(match):
        value = measured[match[1]][match[2]]
        if value is None:
            raise SystemExit(f"{result}: the test did not determine it")
        return repr(value)

    return eval(re.sub(r"([a-z]\w*)\.(\w+)", number, result), {"__builtins__": {}})


def measure(program, name, table, runs, pool):
    """Values of each row, one a seed."""
    def started(key, test, seed):
        return pool.submit(run, program, runs / f"{name}-{key}-{seed}", test, seed)

    found = {key: [started(key, test, seed) for seed in test.get("seeds", [1])] for key, test in table["tests"].items()}
    found = {key: [future.result() for future in futures] for key, futures in found.items()}
    values = {}
    for row in table["rows"]:
        tests = tests_of(row["result"])
        values[row["row"]] = [value_of(row["result"], dict(zip(tests, seed))) for seed in zip(*(found[test] for test in tests))]
    return values


def digits(value):
    return f"{value:.4g}" if abs(value) >= 1000 else f"{value:#.3g}".rstrip(".")


def off(wanted, mean):
    """How far a mean is from what was wanted, a number or a range."""
    bounds = [float(x) for x in re.findall(r"-?\d+\.?\d*", wanted)]
    if len(bounds) == 2:
        return "inside" if min(bounds) <= mean <= max(bounds) else "outside"
    return f"{100.0 * (mean / bounds[0] - 1.0):+.1f} %" if bounds else ""


def settings_of(table):
    """What is set in the examples: what all tests share, and what each has besides."""
    tests = table["tests"]
    shared = [s for s in next(iter(tests.values())).get("set", []) if all(s in t.get("set", []) for t in tests.values())]
    own = {key: [s for s in test.get("set", []) if s not in shared] for key, test in tests.items()}
    spoken = {key: re.sub(r"(\d)_(\d)", r"\1.\2", key).replace("_", " ") for key in tests}
    said = [f"`{s}`" for s in shared] + [f"{spoken[key]}: `{', '.join(some)}`" for key, some in own.items() if some]
    return f" ({'; '.join(said)})" if said else ""


def markdown(table, measured):
    wanted = any(row["wanted"] for row in table["rows"])
    heads = ["", "example", *(["wanted"] if wanted else []), "found", *(["off"] if wanted else [])]
    lines = [heads, ["---"] * len(heads)]
    for row in table["rows"]:
        scaled = [value * UNITS[row["unit"]] for value in measured["values"][row["row"]]]
        mean = statistics.fmean(scaled)
        unit = f" {row['unit']}" if row["unit"] else ""
        seeds = f" ({', '.join(map(digits, scaled))})" if len(scaled) > 1 else ""
        decks = dict.fromkeys(table["tests"][test]["deck"] for test in tests_of(row["result"]))
        cells = [row["row"], ", ".join(f"`{deck}`" for deck in decks)]
        cells += [row["wanted"] + (unit if row["wanted"] else "")] if wanted else []
        lines.append([*cells, f"{digits(mean)}{unit}{seeds}", *([off(row["wanted"], mean)] if wanted else [])])
    out = [f"{table['about'][0].upper()}{table['about'][1:]}:", "", *("| " + " | ".join(line) + " |" for line in lines)]
    how = f"Measured on {measured['date']} by {measured['by']}; `docs/measure.py PROVETA {measured['name']}`{settings_of(table)}."
    return "\n".join([*out, "", textwrap.fill(how, 120, break_long_words=False, break_on_hyphens=False)])


def moved(table, before, after):
    """What has moved by more than its scatter, in words."""
    out = []
    for row in table["rows"]:
        was, now = (statistics.fmean(v[row["row"]]) for v in (before, after))
        if abs(now - was) > row["scatter"] * abs(was):
            out.append(f"{row['row']}: {digits(was * UNITS[row['unit']])} became {digits(now * UNITS[row['unit']])} {row['unit']}, "
                       f"more than {100 * row['scatter']:g} %")
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("tables", nargs="*")
    parser.add_argument("--runs", type=pathlib.Path, default=pathlib.Path("results/measured"))
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    tables = read_tables()
    kept = read_measured()
    if unknown := [name for name in arguments.tables if name not in tables]:
        raise SystemExit(f"no table {', '.join(unknown)}; there are {', '.join(tables)}")
    program = str(pathlib.Path(arguments.program).resolve())
    page = (DOCS / "results.md").read_text()
    worse = []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for name in arguments.tables or tables:
            if arguments.check and name not in kept:
                worse.append(f"{name}: never measured by this command")
                continue
            values = measure(program, name, tables[name], arguments.runs, pool)
            if arguments.check:
                worse += [f"{name}: {what}" for what in moved(tables[name], kept[name]["values"], values)]
                continue
            kept[name] = {"name": name, "date": datetime.date.today().isoformat(), "by": measured_by(program), "values": values}
            (DOCS / "measured.json").write_text(json.dumps(kept, indent=1) + "\n")
            begin = f"<!-- measured: {name} -->\n"
            if begin not in page:
                raise SystemExit(f"results.md has no place for {name}: {begin.strip()} ... <!-- end -->")
            head, _, rest = page.partition(begin)
            page = head + begin + "\n" + markdown(tables[name], kept[name]) + "\n\n<!-- end -->" + rest.partition("<!-- end -->")[2]
            (DOCS / "results.md").write_text(page)
    print("\n".join(worse) if worse else "as documented" if arguments.check else "docs/results.md is written")
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
