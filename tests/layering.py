#!/usr/bin/env python3
"""Fails on an include that points up or sideways in the house, core <- materials, specimens, reports <- lab, and on a call of a shell.

Usage: layering.py ROOT
"""
import pathlib
import re
import sys

ROOMS = {
    "core": {"core"},
    "materials": {"core", "materials"},
    "specimens": {"core", "specimens"},
    "reports": {"core", "reports"},
    "lab": {"core", "materials", "specimens", "reports", "lab"},
    "tests": {"core", "materials", "specimens", "reports", "lab", "tests"},
}
# Outside libraries and who may see them. The physics of core needs Eigen and OpenMP and nothing more.
LIBRARIES = {
    r"nlohmann/": ("core/input/json.hpp", "materials", "specimens", "reports", "lab", "tests"),
    r"hdf5|H5": ("specimens", "reports"),
    r"vtk": ("reports", "specimens", "tests"),
    r"voro\+\+/": ("specimens",),
    r"fmt/": ("core/input", "materials", "specimens", "reports", "lab", "tests"),
    r"fast_float/|boost/locale/encoding": ("core/input",),
    r"spdlog/|CLI/|dlib/|boost/(?!locale/encoding)|muParser": ("lab",),
}
# No text of a user ever reaches a shell.
SHELL = re.compile(r"\b(?:std::system|popen|system)\s*\(")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)


def problems(root):
    for file in sorted(root.rglob("*.[ch]pp")):
        path = file.relative_to(root).as_posix()
        room = path.split("/")[0]
        if room not in ROOMS:
            continue
        if SHELL.search(file.read_text()):
            yield f"{path}: calls a shell"
        for kind, name in INCLUDE.findall(file.read_text()):
            target = name.split("/")[0]
            if kind == '"' and target not in ROOMS[room]:
                yield f"{path}: includes {name}, which {room} may not see"
            if path.startswith("core/") and not path.startswith("core/input/") and name.startswith("core/input/"):
                yield f"{path}: the physics includes {name}"
            for pattern, allowed in LIBRARIES.items():
                if kind == "<" and re.match(pattern, name) and not path.startswith(tuple(allowed)):
                    yield f"{path}: includes <{name}>, which only {', '.join(allowed)} may see"


def main():
    found = list(problems(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "layering: no include points up or sideways")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
