# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Pins the yield of classification: of the tile lights whose pixels all see the whole light, or none of it, the share
that is found without filtering. Soundness tests pass when nothing is found, and pictures stay the same. Needs Vulkan."""
from program_case import ProgramCase, main


class ClassificationYield(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()

    def shared_scene(self, name):
        path = self.source.parent / "shared" / "scenes" / name
        if not path.exists():
            self.skipTest(f"{path} is absent")
        return path

    def check_yield(self, scene, least, *more):
        self.expect(0, "render", scene, *more, "--size", "640x360", "--set", "closeups.max_pairs=0", "--out", "p.png",
                    "--stats", "stats.json")
        counters = self.read_json("stats.json")["counters"]
        found, filtered = (sum(counters[f"shadows.tile_lights_{name}"] for name in names)
                           for names in (("lit", "unlit"), ("filtered_lit", "filtered_unlit")))
        share = found / (found + filtered)
        print(f"{scene}: {share:.3f} of {found + filtered:.0f} uniform tile lights are found at once")
        self.assertGreater(found + filtered, 900, scene)
        self.assertGreaterEqual(share, least, scene)

    def test_shadow_grid(self):
        self.check_yield("builtin:shadow_grid", 0.58)

    def test_lanterns(self):
        self.check_yield("builtin:lanterns", 0.69)

    def test_courtyard(self):
        self.check_yield(self.shared_scene("courtyard/courtyard.gltf"), 0.82, "--camera", "court")

    def test_lamp_under_a_shade(self):
        self.check_yield(self.shared_scene("lamp-hood/hood_point.gltf"), 0.17)


if __name__ == "__main__":
    main()
