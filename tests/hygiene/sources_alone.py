# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Fails on a source that does not compile alone. usage: sources_alone.py ROOT BUILD [FOLDER]

The build compiles sources in groups, and a source of a group may lean on the includes of those before it. Here each source of the
build tree is compiled alone, without optimisation and without an object, with the flags of its target. FOLDER, a name or a pattern
of names, limits the check to the sources below it. Sources that passed before with the same text, includes and flags are not
compiled again (BUILD/hygiene/sources_alone.json)."""
import concurrent.futures
import re
import subprocess
import sys
from pathlib import Path

import headers_alone
import source_text


def fault_of(build, source):
    command = build.commands[source] + ["-fsyntax-only", str(build.root / source)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=build.build, check=False)
    if done.returncode == 0:
        return None
    errors = [line for line in done.stderr.split("\n") if re.search(r"\b(error|fatal)\b", line)]
    return f"{source}: does not compile alone: {(errors or [done.stderr.strip()])[0]}"


def check(root, build, share=""):
    build = headers_alone.Build(Path(root).resolve(), Path(build).resolve())
    sources = sorted(source for source in build.commands if headers_alone.in_share(source, share))

    def faults_of(todo):
        with concurrent.futures.ThreadPoolExecutor(headers_alone.PARALLEL) as pool:
            return list(pool.map(lambda source: fault_of(build, source), todo))

    memory = f"sources_alone{re.sub('[^a-z]', '_', share)}.json"
    return headers_alone.check_once(build, memory, sources, set(), faults_of), len(sources)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit("usage: sources_alone.py ROOT BUILD [FOLDER]")
    sys.exit(source_text.report("sources_alone", *check(*sys.argv[1:])))
