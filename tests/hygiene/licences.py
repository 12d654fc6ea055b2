# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Fails on a source that does not begin with the two licence lines. usage: licences.py ROOT"""
import sys
from pathlib import Path

import source_text

LINES = ("SPDX-FileCopyrightText: The gloam authors", "SPDX-License-Identifier: MIT")
SUFFIXES = {".cpp": "//", ".h": "//", ".glsl": "//", ".py": "#", ".cmake": "#", ".sh": "#", "CMakeLists.txt": "#"}
FOLDERS = source_text.SOURCE_FOLDERS + ("cmake", "packaging", "scripts")


def fault_of(text, mark):
    lines = text.split("\n")
    if lines[0].startswith("#!"):
        lines = lines[1:]
    if lines[:2] == [f"{mark} {line}" for line in LINES]:
        return None
    return f"does not begin with '{mark} {LINES[0]}' and '{mark} {LINES[1]}'"


def check(root):
    root = Path(root)
    names = source_text.files(root, tuple(SUFFIXES), FOLDERS)
    names += [path.name for path in root.glob("CMakeLists.txt")]
    faults = []
    for name in names:
        mark = next(mark for suffix, mark in SUFFIXES.items() if name.endswith(suffix))
        fault = fault_of(source_text.read(root, name), mark)
        if fault:
            faults.append(f"{name}: {fault}")
    return faults, len(names)


if __name__ == "__main__":
    sys.exit(source_text.report("licences", *check(source_text.root_argument())))
