# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Checks the graph of modules. usage: module_graph.py ROOT [--write]

A module stands on the modules whose targets its CMakeLists.txt links. Fails if the graph has a cycle, if make_all_modules does
not hold every module in an order of the graph, if a module has no folder of tests, or if docs/architecture.md shows another
graph; --write corrects that page."""
import re
import sys
from pathlib import Path

import source_text

LIST = "module_list"  # links all modules; none links it
ABOVE = (LIST, "c_interface")  # stand on all modules
PAGE = "docs/architecture.md"
PAGE_LINE = re.compile(r"(?<=^modules/   ).*$", re.MULTILINE)


def read(root):
    """The modules that each module links directly, by name."""
    lists = {path.parent.name: path.read_text(encoding="utf-8") for path in sorted((Path(root) / "modules").glob("*/CMakeLists.txt"))}
    for name in ABOVE:
        lists.pop(name, None)
    graph = {}
    for name, text in lists.items():
        links = (re.sub("_cpu$", "", link) for link in re.findall(r"gloam::(\w+)", text))
        graph[name] = tuple(dict.fromkeys(link for link in links if link in lists and link != name))
    return graph


def closure(graph):
    """The nodes that each node reaches, directly or through others; itself only if it is in a cycle."""
    reach = {}
    for name in graph:
        seen, todo = set(), list(graph[name])
        while todo:
            at = todo.pop()
            if at not in seen:
                seen.add(at)
                todo.extend(graph[at])
        reach[name] = seen
    return reach


def levels(graph):
    """The modules in rows: each stands on modules of earlier rows only. Without cycles."""
    rows, placed = [], set()
    while len(placed) < len(graph):
        rows.append(sorted(name for name in graph if name not in placed and placed.issuperset(graph[name])))
        placed.update(rows[-1])
    return rows


def words(graph):
    """The graph in one line: later rows stand on earlier ones."""
    return " → ".join(row[0] if len(row) == 1 else "{" + ", ".join(row) + "}" for row in levels(graph))


def list_faults(root, graph):
    makers = re.compile(r"\bmake_(\w+)_module\(")
    listed = makers.findall(source_text.without_comments(source_text.read(root, f"modules/{LIST}/{LIST}.cpp")))
    reach = closure(graph)
    faults = [f"make_all_modules: {name} comes after {listed[i]}, which stands on it"
              for i in range(len(listed)) for name in listed[i + 1:] if name in reach.get(listed[i], ())]
    for name in graph:
        header = Path(root) / "modules" / name / "module.h"
        made = makers.findall(header.read_text(encoding="utf-8")) if header.is_file() else []
        faults += [f"make_all_modules lacks {name}" for maker in made if maker == name and name not in listed]
    return faults


def page_faults(root, graph, write):
    page = Path(root) / PAGE
    text = page.read_text(encoding="utf-8")
    right = PAGE_LINE.sub(words(graph), text, count=1)
    if write:
        page.write_text(right, encoding="utf-8")
    return [] if write or text == right else [f"{PAGE} shows another graph than {words(graph)} (--write corrects it)"]


def check(root, write=False):
    graph = read(root)
    cycles = [f"modules/{name} stands on itself" for name, below in closure(graph).items() if name in below]
    if cycles:
        return cycles, len(graph)
    faults = [f"modules/{name} has no tests/modules/{name}/CMakeLists.txt" for name in graph
              if not (Path(root) / "tests/modules" / name / "CMakeLists.txt").is_file()]
    return faults + list_faults(root, graph) + page_faults(root, graph, write), len(graph)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--write"]):
        sys.exit("usage: module_graph.py ROOT [--write]")
    sys.exit(source_text.report("module_graph", *check(sys.argv[1], "--write" in sys.argv)))
