# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Fails on a header that does not compile alone. usage: headers_alone.py ROOT BUILD [FOLDER]

FOLDER, a name or a pattern of names, limits the check to the headers below it.

A header that a built source includes first has been compiled alone already. Each other header is compiled here, included twice
in one file (so that a missing guard shows), with the flags of the nearest source in BUILD/compile_commands.json and with the
standard library, GLM and GoogleTest precompiled, for speed. Precompiling hides an absent standard include, so a header that uses
a name from the table below without including its standard header is compiled without it. Headers that passed before with the
same text, includes and flags are not compiled again (BUILD/hygiene/headers_alone.json)."""
import collections
import concurrent.futures
import fnmatch
import hashlib
import json
import re
import shlex
import subprocess
import sys
from pathlib import Path

import include_arrows
import source_text

PARALLEL = 2
STANDARD = {  # standard header: names that it provides
    "algorithm": r"sort|stable_sort|clamp|min|max|fill|copy|find|find_if|lower_bound|upper_bound|count|count_if|all_of|any_of",
    "array": r"array", "atomic": r"atomic(?:_\w+)?", "bit": r"bit_cast|popcount|countr_zero|countl_zero|bit_ceil|bit_width",
    "chrono": r"chrono", "cmath": r"sqrt|sin|cos|tan|atan2|acos|asin|pow|exp|exp2|log|log2|floor|ceil|round|fabs|isfinite|isnan",
    "condition_variable": r"condition_variable", "cstdint": r"u?int(?:8|16|32|64)_t", "deque": r"deque",
    "filesystem": r"filesystem", "functional": r"function", "future": r"future|promise|async", "limits": r"numeric_limits",
    "map": r"map|multimap", "memory": r"unique_ptr|shared_ptr|weak_ptr|make_unique|make_shared", "mutex": r"mutex|scoped_lock|lock_guard|unique_lock",
    "numeric": r"iota|accumulate|reduce", "optional": r"optional|nullopt", "random": r"mt19937(?:_64)?|uniform_\w+_distribution",
    "set": r"set|multiset", "span": r"span|as_bytes|as_writable_bytes", "sstream": r"i?o?stringstream", "string": r"string|to_string",
    "string_view": r"string_view", "thread": r"thread|this_thread", "tuple": r"tuple|tie", "type_traits": r"is_\w+_v|enable_if_t|decay_t",
    "unordered_map": r"unordered_map", "unordered_set": r"unordered_set", "variant": r"variant|monostate|get_if|holds_alternative",
    "vector": r"vector",
}
IMPLIED = {"string": {"string_view"}, "unordered_map": {"type_traits"}, "functional": {"type_traits"}, "memory": {"type_traits"},
           "variant": {"type_traits"}, "tuple": {"type_traits"}, "utility": {"type_traits"}, "atomic": {"type_traits"}}
# Flags that are left out, so that one precompiled header fits all targets and nothing is optimised.
_DROPPED = re.compile(r"-c|-MD|-MMD|-f(no-)?(pic|PIC|pie|PIE)|-O.|-O|-g.?")
_DROPPED_WITH_VALUE = ("-o", "-MF", "-MT", "-MQ")


def absent_standard(text, includes):
    """A standard header that the text uses a name of and that is not among the includes; None if there is none."""
    given = set(includes).union(*(IMPLIED.get(name, ()) for name in includes))
    return next((standard for standard, names in STANDARD.items()
                 if standard not in given and re.search(rf"\bstd::(?:ranges::)?(?:{names})\b(?!::)", text)), None)


class Build:
    """The sources of a build tree and their compile flags."""

    def __init__(self, root, build):
        self.root, self.build = Path(root), Path(build)
        self.commands = {}
        self.outputs = {}
        database = self.build / "compile_commands.json"
        if not database.is_file():
            sys.exit(f"{database} is absent: configure with CMAKE_EXPORT_COMPILE_COMMANDS=ON")
        for entry in json.loads(database.read_text(encoding="utf-8")):
            arguments = entry.get("arguments") or shlex.split(entry["command"])
            flags = self.flags_of(arguments, entry["file"])
            output = arguments[arguments.index("-o") + 1] if "-o" in arguments else entry.get("output", "")
            for name in self.sources_of(Path(entry["directory"], entry["file"]).resolve()):
                self.commands[name] = flags
                # In a group of sources that are compiled together, only the first shows that its first header stands alone.
                self.outputs.setdefault(output, (name, Path(entry["directory"], output)))

    def sources_of(self, path):
        """The project's sources that a compiler run for this path compiles: the path itself, or the group that CMake's file
        of a unity build includes."""
        paths = [path]
        if path.parent.name == "Unity" and path.is_file():
            paths = [Path(i) for i in re.findall(r'^#include "([^"]+)"', path.read_text(encoding="utf-8"), re.MULTILINE)]
        return [p.relative_to(self.root).as_posix() for p in paths
                if p.suffix == ".cpp" and p.is_relative_to(self.root) and not p.is_relative_to(self.build)]

    @staticmethod
    def flags_of(arguments, source):
        flags, skip = [], False
        for argument in arguments:
            if skip:
                skip = False
            elif argument in _DROPPED_WITH_VALUE:
                skip = True
            elif not _DROPPED.fullmatch(argument) and argument != source and Path(argument).name != "ccache":
                flags.append(argument)
        return flags

    def flags_near(self, header):
        """Compiler and flags of the source whose path shares the most leading folders; of equals, the one with the shorter path."""
        def likeness(name):
            common = 0
            for a, b in zip(name.split("/"), header.split("/")):
                if a != b:
                    break
                common += 1
            return (common, -len(name), name)
        return self.commands[max(self.commands, key=likeness)]

    def first_includes(self):
        """Headers that are the first include of an up-to-date compiled source."""
        found = set()
        for name, output in self.outputs.values():
            if output.is_file():
                included = include_arrows.includes(source_text.read(self.root, name))
                if included and output.stat().st_mtime >= self.newest(included[0][1]):
                    found.add(included[0][1])
        return found

    def newest(self, header):
        return max((p.stat().st_mtime for p in self.closure(header)), default=0.0)

    def closure(self, header):
        """The header and all project files that it includes, directly or not; itself first."""
        seen, todo = {}, [header]
        while todo:
            name = todo.pop()
            path = next((p for p in (self.root / name, self.build / "generated" / name) if p.is_file()), None)
            if path is None or path in seen:
                continue
            seen[path] = True
            todo += [i[1] for i in include_arrows.includes(path.read_text(encoding="utf-8"))]
        return list(seen)

    def fingerprint(self, header):
        digest = hashlib.sha256("\0".join(self.flags_near(header)).encode())
        for path in sorted(self.closure(header)):
            digest.update(path.read_bytes() + b"\0")
        return digest.hexdigest()

    def lacks_standard(self, header):
        """Whether the header uses a name of the table without including its standard header, directly or through project files."""
        includes = {i[1] for path in self.closure(header) for i in include_arrows.includes(path.read_text(encoding="utf-8"))}
        text = source_text.without_comments(source_text.read(self.root, header), blank_strings=True)
        return absent_standard(text, includes) is not None

    def precompile(self, headers):
        """Precompiles BUILD/hygiene/system.h(.gch) from GLM and the standard headers that many of these headers include. Loading
        rarely used ones would cost more than it saves. Returns the compiler arguments that use it."""
        users = collections.Counter()
        for header in headers:
            for _, include, quoted in include_arrows.includes(source_text.read(self.root, header)):
                if not quoted and (re.fullmatch(r"[a-z_]+|gtest/gtest\.h|gmock/gmock\.h", include) or include.startswith("glm/")):
                    users[include] += 1
        wanted = [i for i, count in users.items() if i.startswith("glm/ext") or count * 12 >= len(headers)]
        text = "".join(f"#include <{include}>\n" for include in sorted(wanted))
        header = self.build / "hygiene" / "system.h"
        compiled = header.with_name("system.h.gch")
        header.parent.mkdir(exist_ok=True)
        command = self.flags_near(headers[0]) + ["-x", "c++-header", str(header), "-o", str(compiled)]
        stamp = hashlib.sha256((text + "\0".join(command)).encode()).hexdigest()
        stamp_file = header.with_name("system.h.stamp")
        if not (compiled.is_file() and stamp_file.is_file() and stamp_file.read_text(encoding="utf-8") == stamp):
            header.write_text(text, encoding="utf-8")
            subprocess.run(command, check=True, cwd=self.build)
            stamp_file.write_text(stamp, encoding="utf-8")
        return ["-include", str(header)]

    def fault_of(self, header, precompiled=()):
        if self.lacks_standard(header):
            precompiled = ()
        command = self.flags_near(header) + [*precompiled, "-fsyntax-only", "-x", "c++", "-"]
        text = f'#include "{header}"\n#include "{header}"\n'
        done = subprocess.run(command, input=text, capture_output=True, text=True, cwd=self.build, check=False)
        if done.returncode == 0:
            return None
        errors = [line for line in done.stderr.split("\n") if re.search(r"\b(error|fatal)\b", line)]
        return f"{header}: does not compile alone: {(errors or [done.stderr.strip()])[0]}"


def in_share(header, share):
    return not share or fnmatch.fnmatchcase(header, share + "/*")


def check_once(build, memory, names, proven, faults_of):
    """The faults of those names that are not in proven and did not pass before with the same text, includes and flags.
    faults_of: compiles the names it is given and returns a fault or None for each. memory: the file that lists what passed."""
    memory = build.build / "hygiene" / memory
    known = json.loads(memory.read_text(encoding="utf-8")) if memory.is_file() else {}
    passed, todo = {}, {}
    for name in names:
        fingerprint = build.fingerprint(name)
        (passed if name in proven or known.get(name) == fingerprint else todo)[name] = fingerprint
    results = faults_of(list(todo))
    passed |= {name: todo[name] for name, fault in zip(todo, results) if fault is None}
    memory.parent.mkdir(exist_ok=True)
    memory.write_text(json.dumps(passed, indent=0), encoding="utf-8")
    print(f"compiled {len(todo)} of {len(names)} files")
    return [fault for fault in results if fault]


def check(root, build, share=""):
    build = Build(Path(root).resolve(), Path(build).resolve())
    headers = [header for header in source_text.files(build.root, (".h",)) if in_share(header, share)]

    def faults_of(todo):
        precompiled = build.precompile(headers) if len(todo) > 4 else ()
        with concurrent.futures.ThreadPoolExecutor(PARALLEL) as pool:
            return list(pool.map(lambda header: build.fault_of(header, precompiled), todo))

    memory = f"headers_alone{re.sub('[^a-z]', '_', share)}.json"
    return check_once(build, memory, headers, build.first_includes(), faults_of), len(headers)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit("usage: headers_alone.py ROOT BUILD [FOLDER]")
    sys.exit(source_text.report("headers_alone", *check(*sys.argv[1:])))
