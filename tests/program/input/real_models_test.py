# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Draws the models that real_models.txt names, as they are, and checks what their files say of the picture. Needs Vulkan and
Debian's package assimp-testmodels."""
from pathlib import Path

from program_case import ProgramCase, main
from rgb_picture import read_png

MODELS = Path("/usr/share/assimp/models/glTF2")
WIDTH, HEIGHT = 160, 90
CAPTION_ROWS = 14  # at the lower end of a visualizer's picture
QUANTISED = 1.5  # mean difference of 255 of a model whose positions Draco has rounded to 14 bits


def table():
    """Name, least share, colours, kind of likeness ("" or "about"), and the model that is like it or None."""
    text = Path(__file__).with_name("real_models.txt").read_text(encoding="utf-8")
    for line in text.splitlines():
        if line.startswith("#"):
            continue
        words = line.split()
        colors = [tuple(map(int, word.split(","))) for word in words[2:] if "," in word]
        rest = words[2 + len(colors):]
        yield words[0], float(words[1]), colors, " ".join(rest[:-1]), None if rest[-1] == "-" else rest[-1]


class RealModels(ProgramCase):
    shares_process = True

    def setUp(self):
        super().setUp()
        self.require_device()
        if not MODELS.exists():
            self.skipTest(f"{MODELS} is absent (package assimp-testmodels)")

    def draw(self, name, *options):
        self.expect(0, "render", MODELS / name, "--size", f"{WIDTH}x{HEIGHT}", "--out", "model.png", "--stats", "model.json", *options)
        self.assertEqual(self.read_json("model.json")["counters"]["nan_pixels"], 0, name)
        return read_png(self.folder / "model.png")

    # Hard case: scene.real_models
    def test_each_is_drawn_with_the_colours_of_its_file(self):
        rows = list(table())
        self.assertGreaterEqual(len(rows), 20)
        pictures = {}
        for name, share, colors, likeness, other in rows:
            with self.subTest(name):
                picture = self.draw(name, "--validate")
                self.assertGreater(len({picture.pixel(x, y) for y in range(HEIGHT) for x in range(WIDTH)}), 8, "a uniform picture")
                pictures[name] = picture
                albedo = self.draw(name, "--view", "albedo")
                pixels = [albedo.pixel(x, y) for y in range(HEIGHT - CAPTION_ROWS) for x in range(WIDTH)]
                covered = sum(max(pixel) > 2 for pixel in pixels) / len(pixels)
                self.assertGreater(covered, share)
                for color in colors:
                    seen = sum(max(abs(a - b) for a, b in zip(pixel, color)) <= 3 for pixel in pixels)
                    self.assertGreater(seen, 20, f"{color} is not seen")
                if other:
                    mean = picture.differences(pictures[other])[1]
                    self.assertLessEqual(mean, QUANTISED if likeness == "about" else 0.0, f"it differs from {other}")

    # Hard case: scene.without_nodes
    def test_a_scene_without_nodes_is_drawn_black_and_says_why(self):
        run = self.expect(0, "render", MODELS / "TestNoRootNode/SceneWithoutNodes.gltf", "--size", "32x32", "--out", "black.png")
        self.assertEqual(run.stderr.strip(),
                         "gloam: warning: SceneWithoutNodes.gltf: scene 0 has no nodes, so there is nothing to draw")
        self.assertEqual(read_png(self.folder / "black.png").mean(), 0.0)


if __name__ == "__main__":
    main()
