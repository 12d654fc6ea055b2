# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Fails when two files define a type of the same qualified name. usage: one_definition.py ROOT

C++ allows one definition of a type in a program and linkers do not notice a second one. Types in anonymous namespaces and types
inside functions or other types are not counted. Alternatives (#else, #elif) count as sizes.py counts them: only the first."""
import re
import sys
from collections import defaultdict

import sizes
import source_text

SUFFIXES = (".h", ".cpp")

_TOKEN = re.compile(
    r"\bnamespace(?:\s+(?P<namespace>\w[\w:]*))?\s*\{"
    r"|\b(?:struct|class|union|enum(?:\s+(?:class|struct))?)\s+(?:\[\[[^\]]*\]\]\s*)?(?P<type>\w[\w:]*)\s*"
    r"(?:final\s*)?(?::(?!:)[^;{}()]*)?\{"
    r"|[{}]")


def types_of(text):
    """Pairs of a qualified name and a line: types that other files can name."""
    clean = sizes.structure_text(text)
    scopes = []  # one per open brace: the name it adds, or None if names inside are not visible to other files
    found = []
    for match in _TOKEN.finditer(clean):
        if match[0] == "}":
            if scopes:
                scopes.pop()
            continue
        is_type = match["type"] is not None
        if is_type and None not in scopes:
            line = clean.count("\n", 0, match.start()) + 1
            found.append(("::".join([*scopes, match["type"]]), line))
        scopes.append(match["namespace"])  # no name: an anonymous namespace, a type or a body
    return found


def check(root):
    names = source_text.files(root, SUFFIXES)
    places = defaultdict(dict)
    for name in names:
        for type_name, line in types_of(source_text.read(root, name)):
            places[type_name].setdefault(name, line)
    faults = []
    for type_name, where in sorted(places.items()):
        (first, line), *others = sorted(where.items())
        faults += [f"{name}:{other}: {type_name} is also defined at {first}:{line}; rename one of them, or put it into an "
                   "anonymous namespace" for name, other in others]
    return faults, len(names)


if __name__ == "__main__":
    sys.exit(source_text.report("one_definition", *check(source_text.root_argument())))
