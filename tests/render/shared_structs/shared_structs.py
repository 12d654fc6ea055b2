# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Writes the table of shared_structs_test.cpp: every structure of shaders/**/*_shared.h with its members as C++ lays them out.
usage: shared_structs.py ROOT OUTPUT"""
import re
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "hygiene"))
import source_text  # noqa: E402

STRUCT = re.compile(r"\bstruct (\w+)\s*\{(.*?)\};", re.DOTALL)
DECLARATION = re.compile(r"\w+ (\w+(?:\[\w+\])?(?:, \w+(?:\[\w+\])?)*)")


def members(struct, body):
    """Names of the members of a structure."""
    names = []
    for declaration in filter(None, map(str.strip, body.split(";"))):
        match = DECLARATION.fullmatch(declaration)
        if not match:
            sys.exit(f"{struct}: '{declaration}' is not understood: TYPE NAME or TYPE NAME[COUNT]")
        names += [name.partition("[")[0] for name in match.group(1).split(", ")]
    return names


def main(root, output):
    headers = source_text.files(root, ("_shared.h",), ("shaders",))
    rows = []
    for header in headers:
        for name, body in STRUCT.findall(source_text.without_comments(source_text.read(root, header))):
            fields = ", ".join(f"GLOAM_MEMBER({name}, {member})" for member in members(name, body))
            rows.append(f'{{"{name}", sizeof(shaders::{name}), {{{fields}}}}},\n')
    includes = "".join(f'#include "{header}"\n' for header in headers)
    Path(output).parent.mkdir(parents=True, exist_ok=True)
    Path(output).write_text(f'#pragma once\n#include "tests/render/shared_structs/shared_structs.h"\n{includes}\nnamespace gloam::test {{\n'
                            f"inline const std::vector<SharedStruct> kSharedStructs = {{\n{''.join(rows)}}};\n}}\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: shared_structs.py ROOT OUTPUT")
    main(*sys.argv[1:])
