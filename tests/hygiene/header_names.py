# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Fails on a header that uses a name and includes no header that declares it. usage: header_names.py ROOT

The quick form of headers_alone.py, which compiles each header: this one reads text. Checked are types, concepts, aliases, macros
and kConstants of the project, names of the standard library (the table in headers_alone.py), and the prefixes glm::, Vk, TEST and
nlohmann::. A name counts as declared by every header that declares anything of that name. Functions of the project are not checked:
of 21 faults made by removing an include, this check finds 19."""
import posixpath
import re
import sys
from collections import defaultdict

import headers_alone
import include_arrows
import source_text

_DECLARED = re.compile(
    r"\b(?:struct|class|union|concept|enum(?:\s+(?:class|struct))?|using)\s+(?:\[\[[^\]]*\]\]\s*|alignas\([^)]*\)\s*)*([A-Z]\w*)"
    r"|^\s*#\s*define\s+([A-Z]\w*)|\b(k[A-Z]\w*)\b(?=\s*(?:=|\{|\[\]|\[\d))", re.MULTILINE)
# Not members of a type (Type::Name, Type<…>::Name) and not names of GoogleMock.
_USED = re.compile(r"(?<![\w.])(?<!>::)(?<!testing::)(?<!\w->)(?<!\b[A-Z]::)((?:k?[A-Z])\w*)")
_TEMPLATE_PARAMETER = re.compile(r"\b(?:typename|class)\s*(?:\.\.\.)?\s*([A-Z]\w*)")
OUTSIDE = {  # a name of another library: the includes that bring it
    r"\bglm::": r"glm/.*", r"\bVk[A-Z]\w+": r"vulkan/.*|.*vk_mem_alloc.*|volk\.h", r"\bnlohmann::": r"nlohmann/.*",
    r"^\s*TEST(?:_[FP])?\(": r"g(?:test|mock)/.*", r"\bEXPECT_\w+\(": r"g(?:test|mock)/.*",
}


def declared(text):
    return {next(filter(None, match.groups())) for match in _DECLARED.finditer(text)}


class Headers:
    def __init__(self, root):
        self.names = source_text.files(root, (".h",))
        self.text, self.includes, self.declares = {}, {}, defaultdict(set)
        for name in self.names:
            raw = source_text.read(root, name)
            self.text[name] = source_text.without_comments(raw, blank_strings=True)
            # Paths are from the root, or beside the header.
            paths = {path for _, path, _ in include_arrows.includes(raw)}
            self.includes[name] = paths | {posixpath.join(posixpath.dirname(name), path) for path in paths if "/" not in path}
            for word in declared(self.text[name]):
                self.declares[word].add(name)

    def closure(self, name):
        """Everything that the header includes, directly or not, with itself."""
        seen, todo = set(), [name]
        while todo:
            at = todo.pop()
            if at not in seen:
                seen.add(at)
                todo += self.includes.get(at, ())
        return seen

    def faults_of(self, name):
        closure, text = self.closure(name), self.text[name]
        known = set(_TEMPLATE_PARAMETER.findall(text))
        body = re.sub(r"^\s*#\s*include.*$", "", text, flags=re.MULTILINE)
        for word in sorted(set(_USED.findall(body)) - known):
            if self.declares.get(word) and not self.declares[word] & closure:
                yield f"{name}: uses {word} without an include that declares it ({min(self.declares[word])} does)"
        for used, include in OUTSIDE.items():
            if re.search(used, body, re.MULTILINE) and not any(re.fullmatch(include, i) for i in closure):
                yield f"{name}: uses {used} without an include of its library"
        standard = headers_alone.absent_standard(text, closure)
        if standard:
            yield f"{name}: uses a name of <{standard}> without including it"


def check(root):
    headers = Headers(root)
    return [fault for name in headers.names for fault in headers.faults_of(name)], len(headers.names)


if __name__ == "__main__":
    sys.exit(source_text.report("header_names", *check(source_text.root_argument())))
