# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Runs gloam_soak, and for each of its checkpoints a fresh process that brings itself to the same state: the pictures must be
equal, byte for byte. gloam_soak fails by itself if live bytes grow or the validation layer says something.

usage: soak.py GLOAM_SOAK FOLDER [options of gloam_soak]
FOLDER gets memory.csv, and state_N.ppm and fresh_N.ppm of the checkpoints."""
import re
import subprocess
import sys
from pathlib import Path

SKIPPED = 77


def main():
    program, folder, options = sys.argv[1], Path(sys.argv[2]), sys.argv[3:]
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.ppm"):
        old.unlink()
    soak = subprocess.Popen([program, folder, *options], stdout=subprocess.PIPE, text=True)
    differing, checked = [], 0
    # Fresh processes run beside the soak.
    for line in soak.stdout:
        print(line, end="", flush=True)
        found = re.match(r"checkpoint (\d+):", line)
        if not found:
            continue
        number = found[1]
        fresh = subprocess.run([program, folder, *options, "--state", number], check=False)
        checked += 1
        expected, picture = folder / f"fresh_{number}.ppm", folder / f"state_{number}.ppm"
        if fresh.returncode != 0 or expected.read_bytes() != picture.read_bytes():
            differing.append(number)
            print(f"soak: the pictures {expected} and {picture} differ", file=sys.stderr)
    code = soak.wait()
    if code == SKIPPED:
        print("there is no usable Vulkan device on this machine")
        sys.exit(SKIPPED)
    print(f"soak: {checked} checkpoints, {len(differing)} differ; exit status {code}; memory in {folder / 'memory.csv'}")
    sys.exit(1 if code != 0 or differing or checked == 0 else 0)


if __name__ == "__main__":
    main()
