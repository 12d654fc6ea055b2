# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Prints a Markdown page as Doxygen reads it for the site: headings get the anchors that GitHub gives them, links to them
follow, and links to files that are not on the site become plain text. usage: site_filter.py PAGE"""
import posixpath
import re
import sys
from pathlib import Path

PAGES = ("README.md", "CHANGELOG.md", "docs/", "third_party_notes/")
OTHERS = (".png", ".html", "LICENSE")


def label(page, anchor):
    return re.sub(r"[^a-z0-9]+", "_", f"{page.removesuffix('.md')}_{anchor}".lower())


def anchor_of(heading, seen):
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
    anchor = re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")
    count = seen.get(anchor, 0)
    seen[anchor] = count + 1
    return anchor if count == 0 else f"{anchor}-{count}"


def link(page, match):
    text, target = match[1], match[2]
    if "://" in target:
        return match[0]
    path, _, anchor = target.partition("#")
    full = posixpath.normpath(posixpath.join(posixpath.dirname(page), path)) if path else page
    if full.endswith(".md") and full.startswith(PAGES):
        return f"[{text}](#{label(full, anchor)})" if anchor else match[0]
    if full.startswith(PAGES) and full.endswith(OTHERS) or full == "LICENSE":
        return f"[{text}]({posixpath.basename(full)})"
    return text


def filtered(page, text):
    lines, seen, fenced = [], {}, False
    for line in text.split("\n"):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        heading = None if fenced else re.fullmatch(r"(#{1,4}) (.*)", line)
        if not fenced:
            line = re.sub(r"(?<!!)\[((?:[^][]|\[[^]]*\])*)\]\(([^()\s]+)\)", lambda m: link(page, m), line)
            line = re.sub(r'<a id="([^"]+)"></a>', lambda m: f"@anchor {label(page, m[1])} ", line)
        if heading:
            line += f" {{#{label(page, anchor_of(heading[2], seen))}}}"
        lines.append(line)
    return code_spans("\n".join(lines))


def code_spans(text):
    """With two backticks: after one, Doxygen also ends code at an apostrophe."""
    parts = re.split(r"(^[ \t]*```.*?^[ \t]*```[^\n]*$)", text, flags=re.MULTILINE | re.DOTALL)
    for i in range(0, len(parts), 2):
        parts[i] = re.sub(r"(?<!`)`([^`]+)`(?!`)", r"``\1``", parts[i])
    return "".join(parts)


if __name__ == "__main__":
    path = Path(sys.argv[1]).resolve()
    root = Path(__file__).resolve().parent.parent
    sys.stdout.write(filtered(path.relative_to(root).as_posix(), path.read_text(encoding="utf-8")))
