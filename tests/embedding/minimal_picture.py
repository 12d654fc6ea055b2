# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Runs the smallest host and checks the picture that it writes. usage: minimal_picture.py HOST_BUILD

Exit status 77: there is no Vulkan device."""
import subprocess
import sys
from pathlib import Path

SKIPPED = 77
WIDTH, HEIGHT = 640, 360


def main(build):
    ran = subprocess.run([Path(build) / "minimal"], cwd=build, check=False).returncode
    if ran != 0:
        sys.exit(ran)
    picture = (Path(build) / "minimal.ppm").read_bytes()
    head = b"P6 %d %d 255\n" % (WIDTH, HEIGHT)
    if not picture.startswith(head) or len(picture) != len(head) + WIDTH * HEIGHT * 3:
        sys.exit(f"minimal.ppm is no picture of {WIDTH}x{HEIGHT} pixels")

    def red(x, y):
        return picture[len(head) + 3 * (WIDTH * y + x)]

    places = {"sky": red(600, 20), "pyramid": red(350, 260), "floor": red(560, 310), "shadow": red(220, 265)}
    print("red of", places)
    if not (places["sky"] < 110 and places["pyramid"] > 150 and places["floor"] > 150 and places["shadow"] < places["floor"] / 2):
        sys.exit("minimal.ppm does not show a lit pyramid on a lit floor, its shadow and a blue sky")


if __name__ == "__main__":
    main(*sys.argv[1:])
