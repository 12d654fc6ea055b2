# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Fails on long files, functions and tables. usage: sizes.py ROOT

Lines of code are counted, without blank lines and comments. Limits: a function 80 lines without its data tables and 150 with
them; a test body or a table 150; a file 500."""
import re
import sys
from pathlib import Path

import source_text

FILE_LIMIT = 500
FUNCTION_LIMIT = 80
TABLE_LIMIT = 150

# Text that is allowed between a function's parameters and its body.
_AFTER_PARAMETERS = re.compile(
    r"\s*(?:(?:const|volatile|noexcept(?:\([^()]*\))?|override|final|mutable|try|&&?)\s*)*"
    r"(?:->[^={;]*|requires\b[^{;]*|:(?!:).*)?\s*", re.DOTALL)
_CONSTRUCTOR_LIST = re.compile(r"\)\s*(?:noexcept(?:\([^()]*\))?\s*)?:(?!:)")
_TEST = re.compile(r"^\s*(?:TEST|TEST_F|TEST_P|TYPED_TEST|TYPED_TEST_P|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\s*\(")
_CONDITIONAL = re.compile(r"^[ \t]*#[ \t]*(if|ifdef|ifndef|elif|else|endif)\b")


class Block:
    def __init__(self, kind, first_line, head=""):
        self.kind = kind  # "scope", "function", "table", "body" (a block within a function)
        self.first_line = first_line
        self.head = head
        self.tables = []  # (first, last) line of each outermost table inside a function


def structure_text(text):
    """The text without comments, strings and preprocessor lines. Of alternatives (#else, #elif) only the first stays."""
    lines = source_text.without_comments(text, blank_strings=True).split("\n")
    skipped = []  # one entry per open #if: whether its current branch is skipped
    continued = False
    for i, line in enumerate(lines):
        directive = _CONDITIONAL.match(line)
        is_directive = continued or line.lstrip().startswith("#")
        if directive and not continued:
            word = directive.group(1)
            if word == "endif":
                skipped and skipped.pop()
            elif word in ("else", "elif"):
                if skipped:
                    skipped[-1] = True
            else:
                skipped.append(False)
        continued = is_directive and line.rstrip().endswith("\\")
        if is_directive or any(skipped):
            lines[i] = ""
    return "\n".join(lines)


def without_parentheses(head):
    """The head without the text inside parentheses, and whether a parenthesis stays open."""
    out, depth = [], 0
    for c in head:
        if c == ")":
            depth = max(depth - 1, 0)
        if depth == 0:
            out.append(c)
        if c == "(":
            depth += 1
    return "".join(out), depth > 0


def kind_of(head, parent):
    """The kind of block that an opening brace begins, from the text before the brace and the enclosing block."""
    stripped = head.strip()
    if parent.kind == "table" and not stripped.endswith((")", "mutable", "noexcept")):
        return "table"
    flat, open_parenthesis = without_parentheses(stripped)
    last_parenthesis = stripped.rfind(")")
    inner = stripped[stripped.rfind("(") + 1:] if open_parenthesis else stripped
    callable_tail = last_parenthesis >= 0 and _AFTER_PARAMETERS.fullmatch(stripped[last_parenthesis + 1:]) is not None
    if parent.kind != "scope":
        if stripped == "" or stripped.endswith((";", "else", "do", "try", ":", "]")) or callable_tail:
            return "body"
        if re.search(r"\b(?:struct|class|enum|union)\b[^()=]*$", stripped):
            return "body"
        return "table"
    if re.match(r"^(?:inline\s+)?namespace\b", stripped) or stripped == 'extern " "' or stripped.startswith("extern \""):
        return "scope"
    if "(" not in flat and re.search(r"\b(?:struct|class|enum|union)\b", flat):
        return "scope"
    if re.search(r"\b(?:struct|class|union)\s+(?:\w+\s*)?(?:final\s*)?(?::(?!:).*)?$", flat) and not callable_tail:
        return "scope"
    if open_parenthesis and not re.search(r"\]\s*(?:\([^()]*\))?\s*$", inner):
        return "table"
    if _CONSTRUCTOR_LIST.search(flat) and re.search(r"[\w>]$", stripped) and \
            not re.search(r"\b(?:const|noexcept|override|final|try)$", stripped):
        return "table"  # a member's initialiser
    if callable_tail or re.search(r"\boperator\s*\S+\s*\(", stripped) and callable_tail:
        return "function"
    if stripped == "" or stripped.endswith("{}"):
        return "function" if "(" in stripped else "scope"
    return "table"


def blocks(text):
    """All functions and outermost tables as (kind, head, first line, last line, tables inside)."""
    stack = [Block("scope", 0)]
    found = []
    head, head_line, line = "", 0, 1
    for c in structure_text(text):
        if c == "\n":
            line += 1
            head += " "
        elif c == "{":
            kind = kind_of(head, stack[-1])
            stack.append(Block(kind, head_line if head.strip() else line, head))
            head = ""
        elif c == "}" and len(stack) > 1:
            block = stack.pop()
            parent = stack[-1]
            if block.kind == "function" or (block.kind == "table" and parent.kind == "scope"):
                found.append((block.kind, block.head, block.first_line, line, block.tables))
            enclosing = next((b for b in reversed(stack) if b.kind == "function"), None)
            if block.kind == "table" and parent.kind != "table" and enclosing is not None:
                enclosing.tables.append((block.first_line, line))
            # After an initialiser the declaration continues: constructor lists, several declarators.
            head = block.head + "{}" if block.kind == "table" else ""
            head_line = block.first_line
        elif c == ";":
            head = ""
        else:
            if not head.strip() and not c.isspace():
                head_line = line
            head += c
    return found


def check_text(name, text):
    """The faults of one file."""
    code = [bool(line.strip()) for line in source_text.without_comments(text).split("\n")]
    faults = []
    if sum(code) > FILE_LIMIT:
        faults.append(f"{name}: {sum(code)} lines of code, at most {FILE_LIMIT}")
    for kind, head, first, last, tables in blocks(text):
        total = sum(code[first - 1:last])
        in_tables = {i for begin, end in tables for i in range(begin, end - 1)}  # a table's first and last line stay
        own = sum(code[i] for i in range(first - 1, last) if i not in in_tables)
        is_test = _TEST.match(head) is not None
        title = " ".join(head.split())[:60]
        if kind == "function" and not is_test and own > FUNCTION_LIMIT:
            faults.append(f"{name}:{first}: function of {own} lines of code, at most {FUNCTION_LIMIT}: {title}")
        elif total > TABLE_LIMIT:
            what = "test" if is_test else kind
            faults.append(f"{name}:{first}: {what} of {total} lines of code, at most {TABLE_LIMIT}: {title}")
    return faults


def check(root):
    names = source_text.files(Path(root), (".h", ".cpp", ".glsl"))
    return [fault for name in names for fault in check_text(name, source_text.read(root, name))], len(names)


if __name__ == "__main__":
    sys.exit(source_text.report("sizes", *check(source_text.root_argument())))
