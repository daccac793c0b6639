#!/usr/bin/env python3
"""Writes the first block of C++ of a page to a file. Usage: documented_code.py PAGE FILE"""
import pathlib
import re
import sys

page, file = map(pathlib.Path, sys.argv[1:])
file.write_text(re.search(r"```cpp\n(.*?)```", page.read_text(), re.S).group(1))
