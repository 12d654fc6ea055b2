# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Prints FLIP of drawn reflections against traced ones, by camera and tiers:

    python3 -B tests/program/support/reflection_flip.py PROGRAM SCENE [--cameras front,low] [--size 640x360]
        [--tiers cube,all] [--set knob=value ...] [--keep FOLDER]

Traced pictures are cut off above the legend, and so are the drawn ones. --set applies to the drawn pictures."""
import argparse
import json
import re
import subprocess
import tempfile
from pathlib import Path

from rgb_picture import Picture, read_png

LEGEND_ROWS = 24  # at the lower edge of a view's picture


def cameras_of(scene):
    nodes = json.loads(Path(scene).read_text(encoding="utf-8")).get("nodes", [])
    return [node["name"] for node in nodes if "camera" in node and "name" in node]


def cut(path):
    picture = read_png(path)
    height = picture.height - LEGEND_ROWS
    Picture(picture.width, height, picture.rgb[:3 * picture.width * height]).write(path)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--cameras", default="")
    parser.add_argument("--size", default="640x360")
    parser.add_argument("--tiers", default="cube,all")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--keep", default="")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="gloam-flip-") as folder:
        folder = Path(options.keep or folder)
        folder.mkdir(parents=True, exist_ok=True)

        def render(name, camera, *more):
            out = folder / f"{camera}-{name}.png"
            subprocess.run([options.program, "render", options.scene, "--camera", camera, "--size", options.size, "--out", out,
                            "--quiet", *more], check=True, stdout=subprocess.DEVNULL)
            cut(out)
            return out

        knobs = [word for knob in options.set for word in ("--set", knob)]
        for camera in [c for c in options.cameras.split(",") if c] or cameras_of(options.scene):
            traced = render("traced", camera, "--view", "reflection_reference")
            for tiers in options.tiers.split(","):
                drawn = render(tiers, camera, "--set", f"reflections.tiers={tiers}", *knobs)
                said = subprocess.run([options.program, "compare", drawn, traced], check=True, capture_output=True, text=True)
                flip, mean = re.search(r"FLIP ([\d.]+), root mean square ([\d.]+)", said.stdout).groups()
                print(f"{camera:12} {tiers:10} FLIP {flip}, root mean square {mean} of 255", flush=True)


if __name__ == "__main__":
    main()
