# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Writes the reference of the headers with Doxygen and fails on its warnings. usage: doxygen.py ROOT OUTPUT

Exit status 77: Doxygen is not installed. Checks first that Doxygen finds faults that are planted into a header."""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77

PLANTED = """
/// Names a parameter that does not exist. @param colour of the lamp
int a(int color);
/// Leaves one out. @param color of the lamp
int b(int color, int width);
/// Refers to a thing that does not exist: \\ref lamp_of_nobody.
int c();
/// <b>Never closed.
int d();
/// Returns nothing. @return the width
void e();
"""
EXPECTED = ("'colour' of command @param is not found", "not documented:\n  parameter 'width'", "'lamp_of_nobody'", "</b>",
            "return type for e that does not return anything")


def warnings_of(root, output, *settings):
    """Runs Doxygen in `root` with the settings of docs/Doxyfile and more. Returns what it says."""
    output.mkdir(parents=True, exist_ok=True)
    configuration = (root / "docs/Doxyfile").read_text(encoding="utf-8")
    lines = (configuration, f'OUTPUT_DIRECTORY = "{output}"', *settings)
    # With WARN_AS_ERROR, Doxygen ends at some warnings before it has written all.
    run = subprocess.run(["doxygen", "-"], cwd=root, input="\n".join([*lines, "WARN_AS_ERROR = NO", ""]), check=True,
                         stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    return run.stderr


def self_test_faults(root):
    """Faults that are planted into a header and that Doxygen does not report."""
    with tempfile.TemporaryDirectory(prefix="gloam-doxygen-") as folder:
        header = Path(folder) / "planted.h"
        header.write_text(PLANTED, encoding="utf-8")
        found = warnings_of(root, Path(folder) / "html", f'INPUT = "{header}"')
        return [f"a planted fault is not found: {sentence}" for sentence in EXPECTED if sentence not in found]


def main(root, output):
    if shutil.which("doxygen") is None:
        print("SKIPPED: doxygen is not installed (scripts/packages-dev.txt)")
        sys.exit(SKIPPED)
    root = Path(root).resolve()
    faults = self_test_faults(root)
    found = warnings_of(root, Path(output).resolve())
    faults += sorted({line.replace(f"{root}/", "") for line in found.splitlines() if line.strip()})
    if not (Path(output) / "classgloam_1_1Renderer.html").is_file():
        faults.append("the reference lacks the page of gloam::Renderer")
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main(*sys.argv[1:])
