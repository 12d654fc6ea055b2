# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Renders at each vector width of lavapipe. All runs share one directory of Mesa's shader cache."""
import os
import tempfile

from program_case import NO_DEVICE, ProgramCase, main

SMALL = ("--size", "96x54")


class VectorWidths(ProgramCase):
    @classmethod
    def setUpClass(cls):
        cls.mesa_cache = tempfile.TemporaryDirectory(prefix="gloam-test-mesa-")
        cls.addClassCleanup(cls.mesa_cache.cleanup)

    def environment(self, width):
        return {"LP_NATIVE_VECTOR_WIDTH": width, "MESA_SHADER_CACHE_DIR": self.mesa_cache.name}

    def render(self, scene, width, *options, ending="png"):
        name = f"{scene}_{width}.{ending}"
        self.expect(0, "render", f"builtin:{scene}", *SMALL, "--device", "llvmpipe", "--out", name, *options,
                    env=self.environment(width))
        return (self.folder / name).read_bytes()

    def setUp(self):
        super().setUp()
        run = self.run_program("render", "builtin:plain", "--size", "16x16", "--device", "llvmpipe", "--out", "p.png")
        if run.returncode == NO_DEVICE:
            self.skipTest(run.stderr.strip())

    # Hard case: passes.vector_width, selftest.widths
    def test_scenes_look_the_same_at_128_as_at_256(self):
        for scene in ("many_lights", "shadows", "closeups"):
            # 256 first: its compiled shaders must not be taken for those of 128.
            self.assertEqual(self.render(scene, "256"), self.render(scene, "128"), scene)

    # Hard case: grass.subgroups
    def test_grass_that_wind_has_moved_has_the_same_bits_at_128_as_at_256(self):
        options = ("--camera", "near", "--frames", "8", "--set", "grass.density_scale=0.05")
        moved = self.render("meadow_day", "256", *options, ending="exr")
        self.assertEqual(moved, self.render("meadow_day", "128", *options, ending="exr"))

    def test_other_widths_are_refused_with_the_reason(self):
        for width in ("64", "512"):
            run = self.expect(NO_DEVICE, "render", "builtin:plain", *SMALL, "--device", "llvmpipe",
                              says="LP_NATIVE_VECTOR_WIDTH", env=self.environment(width))
            self.assertIn("depth tests", run.stderr)
            self.assertFalse(os.path.exists(self.folder / "out"))


if __name__ == "__main__":
    main()
