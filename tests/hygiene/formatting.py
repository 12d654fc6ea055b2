# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Fails on a C++ or GLSL source that clang-format would change. usage: formatting.py ROOT

The style is in .clang-format and shaders/.clang-format (and tests/shaders). Versions of clang-format differ in their results: version 14 decides.
To fix: git ls-files '*.h' '*.cpp' '*.glsl' | xargs clang-format-14 -i"""
import concurrent.futures
import re
import shutil
import subprocess
import sys
from pathlib import Path

import source_text

PARALLEL = 2
BATCH = 40  # files per call: starting the program takes longer than formatting one file
FORMATTER = "clang-format-14"
FAULT = re.compile(r"^(?P<place>[^\n:]+:\d+):\d+: (?:error|warning): code should be clang-formatted", re.MULTILINE)


def faults_of(root, names):
    """One fault per file that clang-format would change: the first place."""
    done = subprocess.run([FORMATTER, "--style=file", "--dry-run", "-Werror", *names], cwd=root, capture_output=True, text=True,
                          check=False)
    places = {}
    for match in FAULT.finditer(done.stderr):
        name, _, line = match["place"].rpartition(":")
        places.setdefault(name, f"{name}:{line}: {FORMATTER} would change it")
    if done.returncode != 0 and not places:
        return [f"{FORMATTER} failed: {done.stderr.strip()[:400]}"]
    return list(places.values())


def check(root):
    root = Path(root)
    names = source_text.files(root, (".h", ".cpp", ".glsl"))
    batches = [names[i:i + BATCH] for i in range(0, len(names), BATCH)]
    with concurrent.futures.ThreadPoolExecutor(PARALLEL) as pool:
        faults = [fault for found in pool.map(lambda batch: faults_of(root, batch), batches) for fault in found]
    return faults, len(names)


if __name__ == "__main__":
    if shutil.which(FORMATTER) is None:
        sys.exit(f"{FORMATTER} is not installed (package {FORMATTER})")
    sys.exit(source_text.report("formatting", *check(source_text.root_argument())))
