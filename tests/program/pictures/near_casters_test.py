# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Plates close before a lamp cast the shadow that geometry says, at every distance, in pictures and in their reference."""
import math

from program_case import ProgramCase, main
from rgb_picture import read_png
from scene_file import DOWN, SceneFile, turned

WIDTH, HEIGHT, YFOV = 120, 80, 0.8
LAMP, EYE, TILT = (0.0, 1.5, 0.0), (0.0, 1.2, 2.2), -0.5
HALF_SHADOW = 0.5  # half side of the shadow on the floor


def scene_with_plate(distance, kind="spot", cone=1.0, **options):
    """A floor and a plate before the lamp, whose shadow on the floor has one size at every distance."""
    scene = SceneFile()
    gray = scene.material()
    scene.quad(4.0, gray)
    scene.quad(HALF_SHADOW * distance / LAMP[1], gray, at=(0, LAMP[1] - distance, 0), **options.pop("plate", {}))
    scene.light(kind, at=LAMP, rotation=DOWN, cone=cone, intensity=100, **options)
    scene.camera(EYE, turned(0, TILT), YFOV)
    return scene


def shadowed_on_the_floor(width=WIDTH, height=HEIGHT):
    """Pixels whose centre sees the floor, with the truth there: is the plate before the lamp? Pixels near the edge are left out."""
    truth, half = {}, math.tan(0.5 * YFOV)
    for y in range(height):
        for x in range(width):
            u, v = (2 * (x + 0.5) / width - 1) * half * width / height, (1 - 2 * (y + 0.5) / height) * half
            dy, dz = v * math.cos(TILT) + math.sin(TILT), v * math.sin(TILT) - math.cos(TILT)
            if dy > -1e-3:
                continue
            t = EYE[1] / -dy
            at = (EYE[0] + t * u, EYE[2] + t * dz)
            outermost = max(abs(at[0]), abs(at[1]))
            if outermost < 0.75 and abs(outermost - HALF_SHADOW) > 0.04:
                truth[x, y] = outermost < HALF_SHADOW
    return truth


class NearCasters(ProgramCase):
    shares_process = True

    def setUp(self):
        super().setUp()
        self.require_device()

    def wrong_share(self, name, scene, *options, scale=1.0, size=(WIDTH, HEIGHT), rows=HEIGHT):
        """Share of pixels on the floor, in the first rows, that are bright where the lamp is hidden or dark where it is not."""
        scene.write(self.folder / (name + ".gltf"), scale)
        self.expect(0, "render", name + ".gltf", "--size", "{}x{}".format(*size), "--out", name + ".png", *options)
        picture = read_png(self.folder / (name + ".png"))
        truth = {at: dark for at, dark in shadowed_on_the_floor(*size).items() if at[1] < rows}
        self.assertGreater(sum(truth.values()), 400)
        lit = max(sum(picture.pixel(*at)) for at, dark in truth.items())
        return sum((sum(picture.pixel(*at)) < 0.3 * lit) != dark for at, dark in truth.items()) / len(truth)

    def test_spots_points_and_wide_spots(self):
        for kind, cone in (("spot", 1.0), ("spot", 1.4), ("point", 0.0)):
            for distance in (0.0005, 0.02, 0.045, 0.3):
                with self.subTest(kind=kind, cone=cone, distance=distance):
                    self.assertLess(self.wrong_share("plate", scene_with_plate(distance, kind, cone)), 0.01)

    def test_the_reference_has_no_near_plane_either(self):
        for kind in ("spot", "point"):
            for distance in (0.0005, 0.01, 0.045, 0.3):
                with self.subTest(kind=kind, distance=distance):
                    scene = scene_with_plate(distance, kind)
                    self.assertLess(self.wrong_share("rays", scene, "--view", "shadow_reference:key", size=(480, 320), rows=280), 0.01)

    def test_all_filters_depths_biases_and_modes(self):
        for setting in ("shadows.filter=hard", "shadows.filter=pcf", "shadows.filter=pcss", "shadows.depth=d16",
                        "shadows.bias=hardware", "shadows.mode=monolithic", "shadows.classify=off"):
            with self.subTest(setting=setting):
                scene = scene_with_plate(0.004, "spot", extras={"gloam.light.shadow_resolution": 1024})
                self.assertLess(self.wrong_share("set", scene, "--set", setting), 0.01)

    def test_wide_emitters(self):
        # An emitter of 2 mm, seen through the edge of a plate: the edge is soft, the middle and the outside are not.
        for kind in ("spot", "point"):
            for distance in (0.01, 0.04):
                with self.subTest(kind=kind, distance=distance):
                    width = 0.02 * distance
                    scene = scene_with_plate(distance, kind, extras={"gloam.light.width": width})
                    self.assertLess(self.wrong_share("wide", scene), 0.02)

    # Hard case: selftest.range
    def test_short_ranges(self):
        for scale in (0.01, 0.001):  # the whole scene fits into the 5 cm before a lamp
            with self.subTest(scale=scale):
                self.assertLess(self.wrong_share("small", scene_with_plate(0.3, "spot"), scale=scale), 0.01)

    def test_closeup_subjects(self):
        for distance in (0.004, 0.02, 0.3):
            with self.subTest(distance=distance):
                scene = scene_with_plate(distance, "spot", plate={"gloam.closeup": True})
                self.assertLess(self.wrong_share("closeup", scene), 0.01)


if __name__ == "__main__":
    main()
