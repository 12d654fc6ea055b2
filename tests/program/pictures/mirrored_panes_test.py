# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Blended surfaces appear in mirror floors: as opaque ones where they are opaque, and as a mirrored camera sees them."""
import math

from program_case import ProgramCase, main
from rgb_picture import read_png
from scene_file import SceneFile, turned

WIDTH, HEIGHT, YFOV = 192, 128, 0.8
EYE, TILT = (0.0, 1.2, 3.0), -0.25
RED, BLUE = (0.8, 0.2, 0.1), (0.1, 0.2, 0.8)


class Pane:
    """An upright plate over the floor, parallel to the picture. alpha None: opaque."""

    def __init__(self, z, color=RED, alpha=None, half=(0.8, 0.6), middle=0.8):
        self.z, self.color, self.alpha, self.half, self.middle = z, color, alpha, half, middle

    def is_met(self, at, along, margin=0.15):
        """Whether a ray meets the front well inside the plate's border."""
        t = (self.z - at[2]) / along[2]
        x, y = at[0] + t * along[0], at[1] + t * along[1]
        return abs(x) < self.half[0] - margin and abs(y - self.middle) < self.half[1] - margin


def scene_with(*panes):
    scene = SceneFile(sky=(0.2, 0.3, 0.5), exposure=0.0)
    scene.quad(6.0, scene.material((0.9, 0.9, 0.9), roughness=0.0, metallic=1.0))
    scene.box((4.0, 1.5, 0.1), scene.material((0.2, 0.6, 0.2)), at=(0, 1.5, -4.0))
    for pane in panes:
        material = scene.material(pane.color)
        if pane.alpha is not None:
            scene.materials[material]["alphaMode"] = "BLEND"
            scene.materials[material]["pbrMetallicRoughness"]["baseColorFactor"][3] = pane.alpha
        scene.box((*pane.half, 0.005), material, at=(0, pane.middle, pane.z - 0.005))
    scene.light("directional", rotation=turned(0, -0.7), intensity=3.0)
    scene.camera(EYE, turned(0, TILT), YFOV)
    return scene


def mirrored_rays():
    """Pixels that show the floor, with the origin and the direction of the mirrored ray."""
    half = math.tan(0.5 * YFOV)
    for y in range(HEIGHT):
        for x in range(WIDTH):
            u, v = (2 * (x + 0.5) / WIDTH - 1) * half * WIDTH / HEIGHT, (1 - 2 * (y + 0.5) / HEIGHT) * half
            along = (u, v * math.cos(TILT) + math.sin(TILT), v * math.sin(TILT) - math.cos(TILT))
            if along[1] < -1e-3:
                t = EYE[1] / -along[1]
                at = (EYE[0] + t * along[0], 0.0, EYE[2] + t * along[2])
                yield (x, y), at, (along[0], -along[1], along[2])


class MirroredPanes(ProgramCase):
    shares_process = True

    def setUp(self):
        super().setUp()
        self.require_device()

    def picture(self, name, *panes, mode="tiers", settings=()):
        scene_with(*panes).write(self.folder / (name + ".gltf"))
        options = [o for s in (f"reflections.mode={mode}", *settings) for o in ("--set", s)]
        self.expect(0, "render", name + ".gltf", "--size", f"{WIDTH}x{HEIGHT}", "--out", name + ".png", *options)
        return read_png(self.folder / (name + ".png"))

    def mirrored(self, panes):
        """Pixels of the floor before all panes in whose mirrored ray all panes are."""
        nearest = max(pane.z for pane in panes)
        pixels = [pixel for pixel, at, along in mirrored_rays()
                  if at[2] > nearest and all(pane.is_met(at, along) for pane in panes)]
        self.assertGreater(len(pixels), 150)
        return pixels

    def difference(self, a, b, pixels):
        """Mean difference of two pictures, of 255."""
        return sum(abs(p - q) for at in pixels for p, q in zip(a.pixel(*at), b.pixel(*at))) / (3 * len(pixels))

    def test_an_opaque_blended_pane_is_mirrored_as_an_opaque_one(self):
        pixels = self.mirrored([Pane(-1.0)])
        for settings in ((), ("ssr.march=hierarchical",), ("ssr.resolution=full",)):
            for mode in ("tiers", "planar"):
                with self.subTest(settings=settings, mode=mode):
                    opaque = self.picture("opaque", Pane(-1.0), mode=mode, settings=settings)
                    blended = self.picture("blended", Pane(-1.0, alpha=1.0), mode=mode, settings=settings)
                    self.assertLess(self.difference(opaque, blended, pixels), 2.0)

    def test_panes_are_mirrored_as_a_mirrored_camera_sees_them(self):
        without, without_right = self.picture("without"), self.picture("without_right", mode="planar")
        for name, panes in (("clear", [Pane(-1.0, alpha=0.2)]), ("half", [Pane(-1.0, alpha=0.5)]),
                            ("red before blue", [Pane(-0.8, RED, 0.5), Pane(-1.2, BLUE, 0.5)]),
                            ("blue before red", [Pane(-0.8, BLUE, 0.5), Pane(-1.2, RED, 0.5)])):
            with self.subTest(panes=name):
                # Where rays of screen space reach what is behind the panes.
                pixels = [at for at in self.mirrored(panes) if self.difference(without, without_right, [at]) < 3.0]
                self.assertGreater(len(pixels), 100)
                right = self.picture("right", *panes, mode="planar")
                self.assertLess(self.difference(self.picture("drawn", *panes), right, pixels), 3.0)
                self.assertGreater(self.difference(without, right, pixels), 8.0)

    def test_a_clearer_pane_hides_less(self):
        pixels = self.mirrored([Pane(-1.0)])
        without = self.picture("without")
        hidden = [self.difference(self.picture("pane", Pane(-1.0, alpha=a)), without, pixels) for a in (0.0, 0.25, 0.5, 1.0)]
        self.assertLess(hidden[0], 0.5)
        self.assertEqual(hidden, sorted(hidden))
        self.assertGreater(hidden[1], 5.0)
        self.assertLess(hidden[2], 0.9 * hidden[3])


if __name__ == "__main__":
    main()
