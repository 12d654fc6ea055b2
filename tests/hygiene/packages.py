# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Fails unless scripts/packages*.txt hold one Debian package name a line and nothing else. usage: packages.py ROOT"""
import re
import sys
from pathlib import Path

import source_text

NAME = re.compile(r"[a-z0-9][a-z0-9+.-]+")


def faults_of(name, text):
    faults = []
    if not text.endswith("\n"):
        faults.append(f"{name}: the last line ends without a line break")
    lines = text.removesuffix("\n").split("\n")
    for number, line in enumerate(lines, 1):
        if not NAME.fullmatch(line):
            faults.append(f"{name}:{number}: '{line}' is not a package's name")
        elif line in lines[:number - 1]:
            faults.append(f"{name}:{number}: {line} stands twice")
    return faults


def check(root):
    paths = sorted((Path(root) / "scripts").glob("packages*.txt"))
    return [fault for path in paths for fault in faults_of(path.name, path.read_text(encoding="utf-8"))], len(paths)


if __name__ == "__main__":
    sys.exit(source_text.report("packages", *check(source_text.root_argument())))
