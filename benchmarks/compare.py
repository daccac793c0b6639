#!/usr/bin/env python3
"""Times Proveta, LAMMPS and YADE on the same packing and the same bonds, in turn, and prints the ratios of the medians.

    benchmarks/compare.py [--proveta build/release/proveta] [--spheres 13500] [--repeats 5] [--threads 1 2] [--without yade lammps]

Needs Debian's packages `lammps` and `yade` (not part of packages.txt: the program itself does not need them). docs/performance.md says what
the three compute and what they do not.
"""
import argparse
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))


def call(command, **more):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **more)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\nfailed with {done.returncode}:\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return done.stdout


def figure(text, name):
    return float(re.search(name + r"\s+([-+.0-9e]+)", text).group(1))


def bonded_pairs(spheres, reach):
    """Pairs with d <= reach (r_i + r_j), as (i, j, d)."""
    size = 2.0 * reach * max(s[3] for s in spheres)
    cells = {}
    for k, s in enumerate(spheres):
        cells.setdefault(tuple(int(math.floor(c / size)) for c in s[:3]), []).append(k)
    around = [(a, b, c) for a in (-1, 0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1)]
    pairs = []
    for cell, members in cells.items():
        near = [j for step in around for j in cells.get(tuple(c + s for c, s in zip(cell, step)), ())]
        for i in members:
            for j in near:
                if i < j:
                    d = math.dist(spheres[i][:3], spheres[j][:3])
                    if d <= reach * (spheres[i][3] + spheres[j][3]):
                        pairs.append((i, j, d))
    return sorted(pairs)


def write_lammps(path, spheres, pairs, young=28e9, density=2500.0):
    """A data file in which every bond is a type of its own: its length and E A / d."""
    degree = [0] * len(spheres)
    for i, j, _ in pairs:
        degree[i] += 1
        degree[j] += 1
    with open(path, "w") as f:
        f.write(f"spheres and bonds\n\n{len(spheres)} atoms\n{len(pairs)} bonds\n1 atom types\n{len(pairs)} bond types\n"
                f"{max(degree)} extra bond per atom\n\n")
        for k, axis in enumerate("xyz"):
            low, high = min(s[k] for s in spheres), max(s[k] for s in spheres)
            f.write(f"{low - 0.2 * (high - low):.9g} {high + 0.2 * (high - low):.9g} {axis}lo {axis}hi\n")
        f.write("\nBond Coeffs\n\n")
        for k, (i, j, d) in enumerate(pairs, 1):
            area = math.pi * min(spheres[i][3], spheres[j][3]) ** 2
            f.write(f"{k} {0.5 * young * area / d:.9g} {d:.12g}\n")  # LAMMPS' energy is K (r - r0)^2
        f.write("\nAtoms # hybrid\n\n")
        for k, (x, y, z, r) in enumerate(spheres, 1):
            f.write(f"{k} 1 {x:.12g} {y:.12g} {z:.12g} {2 * r:.9g} {density:g} 1\n")
        f.write("\nBonds\n\n")
        for k, (i, j, _) in enumerate(pairs, 1):
            f.write(f"{k} {k} {i + 1} {j + 1}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--proveta", default=os.path.join(HERE, "..", "build", "release", "proveta"))
    parser.add_argument("--spheres", type=int, default=13500)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--seconds", type=float, default=4.0, help="length of one measurement")
    parser.add_argument("--without", nargs="*", default=[], choices=["lammps", "yade"])
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        stored, packing, data = (os.path.join(work, name) for name in ("specimen.h5", "packing.txt", "lammps.data"))
        call([a.proveta, "specimen", "make", stored, "--set", f"spheres={a.spheres}"])
        call([a.proveta, "specimen", "export", stored, os.path.join(work, "specimen.csv")])
        spheres = [tuple(float(v) for v in line.split(",")[:4]) for line in open(os.path.join(work, "specimen.csv")) if line[0] in "-.0123456789"]
        with open(packing, "w") as f:
            f.writelines("%.12g %.12g %.12g %.12g\n" % s for s in spheres)
        head = call([a.proveta, "bench", "--specimen", stored, "--threads", "1", "--repeats", "1", "--seconds", "0.05"])
        reach, bonds = figure(head, "interaction range"), figure(head, r"\d+ spheres,")
        pairs = bonded_pairs(spheres, reach)
        print(f"{len(spheres)} spheres; bonds: proveta {bonds:.0f}, written for lammps {len(pairs)}; interaction range {reach}", flush=True)
        if abs(len(pairs) - bonds) > 1e-3 * bonds:
            sys.exit("the bonds differ: the comparison would not be one")
        write_lammps(data, spheres, pairs)
        largest = max(s[3] for s in spheres)
        lengths = ["-var", "reach", f"{2.5 * reach * largest:.6g}", "-var", "skin", f"{0.1 * largest:.6g}", "-var", "end", f"{largest:.6g}"]

        found = {}

        def note(name, threads, value):
            found.setdefault((name, threads), []).append(value)
            print(f"{name}  threads {threads}  ns_per_bond_step {value:.2f}", flush=True)

        def proveta(threads):
            text = call([a.proveta, "bench", "--specimen", stored, "--threads", str(threads), "--repeats", "1", "--seconds", str(a.seconds)])
            for state in ("elastic", "past_peak"):
                line = next(x for x in text.splitlines() if f"state {state} " in x)
                note(f"proveta, {state}", threads, figure(line, "ns_per_bond_step"))

        def lammps(threads, contact):
            def run(steps):
                text = call(["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", str(threads), "lmp", "-in", os.path.join(HERE, "lammps.in"),
                             "-var", "data", data, "-var", "contact", str(contact), "-var", "steps", str(steps), "-log", "none"] + lengths)
                line = [x for x in text.splitlines() if x.startswith("Loop time")][-1].split()
                return 1e9 * float(line[3]) / steps / len(pairs)
            trial = run(100)
            steps = max(100, int(a.seconds * 1e9 / trial / len(pairs)))
            note("lammps, bonds and contact" if contact else "lammps, bare bonds", threads, run(steps))

        def yade(threads):
            text = call(["yade", "-n", "-x", f"-j{threads}", os.path.join(HERE, "yade_concrete.py")],
                        env=dict(os.environ, PACKING=packing, RANGE=str(reach), SECONDS=str(a.seconds)))
            note("yade, concrete model", threads, figure(text, "ns_per_bond_step"))

        for _ in range(a.repeats):
            for threads in a.threads:
                proveta(threads)
                if "lammps" not in a.without:
                    lammps(threads, 1)
                    lammps(threads, 0)
                if "yade" not in a.without:
                    yade(threads)

        print("\n| what | threads | median ns per bond and step | lowest | highest | over proveta, elastic | over proveta, past the peak |")
        print("|---|---|---|---|---|---|---|")
        for (name, threads), values in sorted(found.items()):
            median = statistics.median(values)
            ratios = [f"{median / statistics.median(found[(f'proveta, {state}', threads)]):.2f}" for state in ("elastic", "past_peak")]
            print(f"| {name} | {threads} | {median:.2f} | {min(values):.2f} | {max(values):.2f} | {ratios[0]} | {ratios[1]} |")


if __name__ == "__main__":
    main()
