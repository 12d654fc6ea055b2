# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Functions that the checkers share: finding source files and removing comments from their text."""
import re
import sys
from pathlib import Path

SOURCE_FOLDERS = ("engine", "modules", "shaders", "sandbox", "tests")

_TOKEN = re.compile(
    r'//(?:\\\n|[^\n])*'  # line comment, continued by a backslash
    r'|/\*.*?(?:\*/|\Z)'  # block comment
    r'|R"(?P<tag>[^()\s\\]{0,16})\(.*?\)(?P=tag)"'  # raw string
    r'|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9A-Za-z_])'(?:\\.|[^'\\\n])*'",  # not the digit separator of 1'000
    re.DOTALL)


def _keep_lines(text):
    return "".join(c if c == "\n" else " " for c in text)


def without_comments(text, blank_strings=False):
    """The text with comments (and, if wanted, the insides of strings) replaced by spaces; every line keeps its number."""
    def replace(match):
        token = match.group(0)
        if token.startswith(("//", "/*")):
            return _keep_lines(token)
        return token[0].replace("R", '"') + _keep_lines(token[1:-1]) + token[-1] if blank_strings else token
    return _TOKEN.sub(replace, text)


def files(root, suffixes, folders=SOURCE_FOLDERS):
    """Files below the project's source folders, as paths relative to the root with forward slashes, sorted."""
    root = Path(root)
    found = []
    for folder in folders:
        for path in (root / folder).rglob("*"):
            if path.is_file() and path.name.endswith(tuple(suffixes)):
                found.append(path.relative_to(root).as_posix())
    return sorted(found)


def read(root, name):
    return (Path(root) / name).read_text(encoding="utf-8")


def report(title, faults, checked):
    """Prints the faults and returns the exit code. A checker that saw no files has not checked anything: a fault too."""
    if checked == 0:
        faults = faults + [f"{title}: found nothing to check"]
    for fault in faults:
        print(fault)
    print(f"{title}: {checked} files, {len(faults)} faults")
    return 1 if faults else 0


def root_argument():
    if len(sys.argv) != 2:
        sys.exit(f"usage: {Path(sys.argv[0]).name} ROOT")
    return Path(sys.argv[1])
