# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Checks that every hard case has a test. usage: hard_cases.py ROOT [--write]

tests/hygiene/hard_cases.txt lists the cases. A comment names those that a test covers, in its body or right above it:

    // Hard case: shadows.zero_radius, shadows.without_range

Fails if a case has no test, if a comment names no case or belongs to no test, if a case is listed twice, or if
docs/hard-cases.md shows anything else; --write corrects that page."""
import re
import sys
from pathlib import Path

import source_text

LIST = "tests/hygiene/hard_cases.txt"
PAGE = "docs/hard-cases.md"
SKIPPED = "tests/hygiene/"  # holds examples of comments
LINE = re.compile(r"(\w+\.\w+) \| (\S[^|]*) \| (\S[^|]*)")
TAG = re.compile(r"^\s*(?://|#) Hard cases?:(.*)$")
NEXT_COMMENT = re.compile(r"^\s*(?://|#|@)")
CPP_TEST = re.compile(r"^TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\)", re.MULTILINE)
PYTHON_TEST = re.compile(r"^    def (test_\w+)\(", re.MULTILINE)
PYTHON_CLASS = re.compile(r"^class (\w+)", re.MULTILINE)
HEAD = """<!-- SPDX-FileCopyrightText: The gloam authors -->
<!-- SPDX-License-Identifier: MIT -->
<!-- Written by tests/hygiene/hard_cases.py ROOT --write. -->
# Hard cases

Each hard case of the design pages (`../shared/design`), and each of those that were added since, with the tests that cover it. A
comment in the test names its case (`// Hard case: ID`). `tests/hygiene/hard_cases.txt` lists the cases, and `hygiene.hard_cases`
fails if one has no test.
"""


def read_cases(root):
    """Cases as {id: (page and section, words)} in the order of the list, and faults."""
    cases, faults = {}, []
    for number, line in enumerate(source_text.read(root, LIST).splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        match = LINE.fullmatch(line.rstrip())
        if not match:
            faults.append(f"{LIST}:{number}: not of the form ID | page and section | words")
        elif match[1] in cases:
            faults.append(f"{LIST}:{number}: {match[1]} is listed twice")
        else:
            cases[match[1]] = (match[2], match[3])
    return cases, faults


def tests_of(name, text):
    """The tests of a file: (first line, line after the last one, name)."""
    lines = text.splitlines()
    python = name.endswith(".py")
    found = []
    for match in (PYTHON_TEST if python else CPP_TEST).finditer(text):
        first = text.count("\n", 0, match.start())
        if python:
            test = [*PYTHON_CLASS.finditer(text, 0, match.start())][-1][1] + "." + match[1]
            ends = (i for i in range(first + 1, len(lines)) if re.match(r" {0,4}\S", lines[i]))
        else:
            test = match[1] + "." + match[2]
            ends = (i + 1 for i in range(first, len(lines)) if lines[i].startswith("}") or (i == first and lines[i].endswith("}")))
        found.append((first, next(ends, len(lines)), test))
    return found


def test_at(lines, tests, at):
    """The name of the test that a comment at a line belongs to."""
    for first, end, test in tests:
        if first <= at < end:
            return test
    while at < len(lines) and NEXT_COMMENT.match(lines[at]):
        at += 1
    return next((test for first, _, test in tests if first == at), None)


def read_tags(root):
    """Tests as {id: [(file, test)]}, faults, and the number of files."""
    tags, faults = {}, []
    names = [name for name in source_text.files(root, (".cpp", ".py"), ("tests",)) if not name.startswith(SKIPPED)]
    for name in names:
        text = source_text.read(root, name)
        lines, tests = text.splitlines(), tests_of(name, text)
        for at, line in enumerate(lines):
            tag = TAG.match(line)
            if not tag:
                continue
            test = test_at(lines, tests, at)
            if test is None:
                faults.append(f"{name}:{at + 1}: the hard case belongs to no test")
                continue
            for case in (part.strip().rstrip(".") for part in tag[1].split(",")):
                found = tags.setdefault(case, [])
                if (name, test) in found:
                    faults.append(f"{name}:{at + 1}: {test} has {case} twice")
                else:
                    found.append((name, test))
    return tags, faults, len(names)


def page(cases, tags):
    text, section = [HEAD], None
    for case, (where, words) in cases.items():
        if where != section:
            section = where
            text.append(f"\n## {where}\n\n| case | test | file |\n| --- | --- | --- |\n")
        found = tags.get(case, [])
        tests = "<br>".join(f"`{test}`" for _, test in found)
        files = "<br>".join(f"[{Path(name).name}](../{name})" for name, _ in found)
        text.append(f"| {words} | {tests} | {files} |\n")
    return "".join(text)


def check(root, write=False):
    cases, faults = read_cases(root)
    tags, tag_faults, files = read_tags(root)
    faults += tag_faults
    faults += [f"{found[0][0]}: {found[0][1]} names the hard case {case!r}, which {LIST} lacks"
               for case, found in tags.items() if case not in cases]
    faults += [f"{case} has no test: {where}: {words}" for case, (where, words) in cases.items() if case not in tags]
    sections = [where for where, _ in cases.values()]
    faults += [f"{LIST}: the cases of {where} are not together" for at, where in enumerate(sections)
               if at and where != sections[at - 1] and where in sections[:at]]
    path, right = Path(root) / PAGE, page(cases, tags)
    if write:
        path.write_text(right, encoding="utf-8")
    elif not path.is_file() or path.read_text(encoding="utf-8") != right:
        faults.append(f"{PAGE} shows something else (--write corrects it)")
    return faults, files


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--write"]):
        sys.exit("usage: hard_cases.py ROOT [--write]")
    sys.exit(source_text.report("hard_cases", *check(sys.argv[1], "--write" in sys.argv)))
