# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `selftest`: what it prints and writes, and that it fails when something is wrong."""
import shutil
from pathlib import Path

from program_case import LONG, NO_DEVICE, ProgramCase, main

NO_DRIVERS = {"VK_ICD_FILENAMES": "/nonexistent", "VK_DRIVER_FILES": "/nonexistent"}

# Knobs that make a kernel worse than it should be, and the check that must catch it.
WORSE = {
    "grazing_light": ("shadows.bias=hardware", "shadows.bias_units=0", "shadows.receiver_plane=off"),
    "traced.lamp": ("shadows.filter=hard",),
    "double.blades": ("grass.iterations=1",),
    "traced.puddle": ("reflections.tiers=cube",),
    "accumulated.lens": ("dof.radius=3",),
}


# Mutations of kernels: what is wrong, the check that must catch it, the file below shaders, and what replaces what.
MUTATIONS = (
    ("a dropped light", "lists.missing_lights", "lights/lists/find_lights_approx.comp.glsl",
     "? mask_tiles[parent + 1u + word] : 0u", "? mask_tiles[parent + 1u + word] & ~4u : 0u"),
    ("a wrong tone curve", "double.tone_curve", "lighting/display/tone_curve.glsl",
     "return clamp(shown, vec3(0.0), vec3(1.0));", "return clamp(shown * 1.03, vec3(0.0), vec3(1.0));"),
    ("a wrong bias", "grazing_light", "shadows/filter/space.glsl", "p.depth + (toward ? bias + rounding : -bias)",
     "0.9 * p.depth"),
    ("not a number", "finite", "lighting/opaque/deferred.glsl", "out_light = vec4(min(light, vec3(65504.0)), 1.0);",
     "out_light = vec4(light * uintBitsToFloat(0x7FC00000u), 1.0);"),
    ("a lens that leaves half of the picture sharp", "accumulated.lens", "depth_of_field/compose/compose.comp.glsl",
     "(circle * circle - 0.25) * whole", "(0.1 * circle * circle - 0.25) * whole"),
    ("missed hits", "traced.puddle", "reflections/passes/screen_space_march.glsl",
     "return met ? vec2(before, reached) : kNoHit;", "return kNoHit;"),
    ("too much scattered light", "traced.smoke", "particles/lighting/scattered_light.glsl",
     "(1.0 + dot(p.normal, to_light))", "(3.0 + dot(p.normal, to_light))"),
    ("blades that skip a step", "equal.blade_groups", "grass/simulation/simulate_blades.comp.glsl",
     "turn < own_steps);", "turn + 1u < own_steps);"),
    ("dropped proxies", "equal.proxy_tiles_naive", "reflections/passes/proxy_blending.comp.glsl",
     "bits = proxy_masks[tile * tiles.words + word]", "bits = proxy_masks[tile * tiles.words + word] & 0x55555555u"),
    ("lit tiles that are called unlit", "equal.classified_filtered", "shadows/final_lists/classify_tile.glsl",
     "return all_harmless(f, looks, most_turns) ? kLit : kUnknown;", "return all_harmless(f, looks, most_turns) ? kUnlit : kUnknown;"),
    ("lost visibilities", "equal.deferred_monolithic", "shadows/final_lists/generate.glsl",
     "return (steps < kMostSteps ? kSomeSeeLess : 0u) | (steps > 0u ? kSomeSeeAny : 0u);", "return kSomeSeeAny;"),    ("a swapped sort", "kernel.radix_sort", "render/sort/scatter_runs.comp.glsl",
     "kImpliedValues != 0u ? at + j :", "kImpliedValues != 0u ? (at + j) ^ 1u :"),
    ("a lost joint", "kernel.skinned_positions", "render/deform.comp.glsl",
     "for (int i = 0; i < 4; ++i) {", "for (int i = 0; i < 3; ++i) {"),
    ("normals that mirrors turn inside out", "kernel.skinned_normals", "render/deform.comp.glsl",
     "dot(row0.xyz, c0) < 0.0 ? -1.0 : 1.0", "1.0"),
    ("another exponent of sRGB", "kernel.srgb", "common/math.glsl", "vec3(1.0 / 2.4)", "vec3(1.0 / 2.3)"),
    ("narrower penumbrae", "kernel.shadow_filter", "shadows/filter/blocker_search.glsl",
     "return clamp(p.scale * (blocker - p.depth)", "return clamp(0.7 * p.scale * (blocker - p.depth)"),
    ("a bias in place of the plane", "kernel.shadow_filter", "shadows/filter/space.glsl",
     "p.depth + (toward ? bias + rounding : -bias)", "0.9 * p.depth"),
    ("planes with flatter slopes", "kernel.planes", "shadows/maps/planes.comp.glsl", "moments / 336.0", "moments / 337.0"),
    ("a pattern that repeats in all rows", "kernel.dither", "lighting/dither_api.glsl",
     "pixel.y * 2447445414u", "pixel.x * 2447445414u"),
    ("a dilation that ends a texel early", "kernel.dilation", "reflections/passes/dilate_tiles.comp.glsl",
     "roughness > 0.0 && offset <= widest_reach", "roughness > 0.0 && offset < widest_reach"),
    ("a Gaussian of another width", "kernel.glossy_blur", "reflections/passes/blur_width.glsl",
     "-0.72134752 / max(sigma", "-0.8 / max(sigma"),
    ("distances that are rounded down", "kernel.hit_distances", "reflections/hit_distance_api.glsl",
     "kMostHitCentimetres) + 0.5)", "kMostHitCentimetres))"),
    ("halved gravity", "kernel.blades", "grass/simulation/solver.glsl", "vec3(0.0, -9.81, 0.0)", "vec3(0.0, -4.905, 0.0)"),
    ("turbulence of another order", "kernel.particles", "particles/simulation/motion_api.glsl",
     "half_per_step = 0.5 / e.swirl_step_s", "half_per_step = 1.0 / e.swirl_step_s"),
    ("a wider disc", "kernel.lens_blur", "depth_of_field/kernel_api.glsl", "clamp(radius + 0.5 - distance",
     "clamp(radius + 0.8 - distance"),
    ("a lens that loses light", "kernel.bokeh_energy", "depth_of_field/kernel_api.glsl", "? 3.14159265 : 3.46410162",
     "? 3.3 : 3.6"),
    ("a hexagon with unequal sides", "kernel.bokeh_shape", "depth_of_field/kernel_api.glsl",
     "0.5 * a.x + kInnerRadius * a.y", "0.5 * a.x + a.y"),
    ("glare that loses pixels between cells", "kernel.glare_energy", "glare/collect.comp.glsl",
     "first_pixel(start + 1.0)", "first_pixel(start + 0.5)"),
    ("glare that moves by a texel of each level", "kernel.glare_place", "glare/reduce.comp.glsl",
     "+ 1 + GLOAM_GLARE_MARGIN", "+ 2 + GLOAM_GLARE_MARGIN"),
    ("glare of equal levels", "kernel.glare_spread", "glare/spread.comp.glsl", "0.25 * c.weight", "0.25 / 6.0"),
)

# Mutations that each test run tries; the others compile many shaders, or draw many pictures.
COSTLY_KERNELS = ("kernel.srgb", "kernel.shadow_filter")
CHEAP = {what for what, name, *_ in MUTATIONS if name.startswith("kernel.") and name not in COSTLY_KERNELS} | {
    what for what, *_ in MUTATIONS[:2]}

# lavapipe rounds numbers beyond half floats to the greatest one, SwiftShader to infinity.
BEYOND_HALVES = ("finite.glare", "lighting/opaque/deferred.glsl",
                 "out_light = vec4(min(light, vec3(65504.0)), 1.0);", "out_light = vec4(light, 1.0);")
SECOND_DRIVER = Path("/usr/lib/chromium/vk_swiftshader_icd.json")
ON_SECOND = {"env": {"VK_ADD_DRIVER_FILES": str(SECOND_DRIVER)}}


class Selftest(ProgramCase):
    def test_checks_are_listed_once_each(self):
        listed = [line.split(":")[0] for line in self.expect(0, "selftest", "--list").stdout.splitlines()]
        self.assertEqual(len(listed), len(set(listed)))
        quick = [line.split(":")[0] for line in self.expect(0, "selftest", "--list", "--quick").stdout.splitlines()]
        self.assertLess(set(quick), set(listed))
        for name in ("lists.missing_lights", "traced.lamp", "equal.twice", "moved.lawn", "scaled.fog", "exposure", "finite"):
            self.assertIn(name, listed)

    # Hard case: selftest.validity
    def test_the_page_of_limits_has_the_promised_ranges(self):
        table = self.expect(0, "selftest", "--list", "--markdown").stdout
        self.assertIn("| `moved.lamp` |", table)
        self.assertIn(table, (self.source.resolve() / "docs/limits.md").read_text(),
                      "put the output of gloam selftest --list --markdown into docs/limits.md")

    def test_a_pattern_that_matches_nothing_is_a_usage_error(self):
        self.assertIn("matches no check", self.expect(2, "selftest", "--only", "nothing").stderr)

    def test_without_a_device_there_is_a_sentence(self):
        self.expect(NO_DEVICE, "selftest", "--only", "exposure", env=NO_DRIVERS)

    # Hard case: selftest.light_lists, selftest.filter, selftest.blades, selftest.tone_curve, selftest.slope
    # Hard case: selftest.exposure, selftest.finite
    def test_the_quick_test_holds_and_writes_both_files(self):
        self.require_device()
        said = self.expect(0, "selftest", "--quick", "--out", "report").stdout
        report = self.read_json("report/selftest.json")
        self.assertEqual(report["failed"], 0)
        self.assertTrue(report["quick"])
        self.assertEqual(set(report["device"]), {"name", "driver", "type", "subgroup_size"})
        self.assertGreater(len(report["checks"]), 15)
        self.assertIn(f"{len(report['checks'])} of {len(report['checks'])} checks hold", said)
        for check in report["checks"]:
            self.assertIn(check["id"], said)
            self.assertLessEqual(check["worst"], check["bound"])
            if check["kind"] == "curve":
                self.assertGreater(len(check["points"]), 1)
        page = (self.folder / "report/selftest.html").read_text()
        self.assertIn("Everything holds", page)
        self.assertNotIn("http", page)

    # Hard case: program.selftest_fails
    def test_the_quick_test_holds_on_a_second_device(self):
        # Its rasterizer has a coarser grid, its compiler walks all paths: other reasons for faults than on lavapipe.
        if not LONG:
            self.skipTest("GLOAM_LONG_TESTS is not set")
        if not SECOND_DRIVER.is_file():
            self.skipTest("there is no SwiftShader")
        self.expect(0, "selftest", "--quick", "--device", "swiftshader", **ON_SECOND)

    def test_what_is_worse_is_caught_by_name(self):
        self.require_device()
        for name, settings in WORSE.items():
            with self.subTest(check=name):
                options = [part for setting in settings for part in ("--set", setting)]
                ran = self.expect(1, "selftest", "--only", name, "--out", "worse", *options)
                self.assertIn("1 of 1 checks failed", ran.stderr)
                self.assertIn("FAILED", ran.stdout)
                check = self.read_json("worse/selftest.json")["checks"][0]
                self.assertEqual((check["id"], check["holds"]), (name, False))
                self.assertTrue(check["advice"])

    # Hard case: program.selftest_fails, selftest.finite
    def test_mutated_kernels_are_caught_by_name(self):
        self.require_device()
        for index, (what, name, file, old, new) in enumerate(MUTATIONS):
            if not LONG and what not in CHEAP:
                continue
            with self.subTest(mutation=what):
                tree = self.mutated(f"tree{index}", file, old, new)
                ran = self.expect(1, "selftest", "--only", name, "--shaders", tree)
                self.assertIn("FAILED", ran.stdout)
                self.assertIn(name, ran.stdout)

    def mutated(self, name, file, old, new):
        """A tree of shaders with one change."""
        tree = self.folder / name
        shutil.copytree(self.source.resolve() / "shaders", tree / "shaders")
        path = tree / "shaders" / file
        text = path.read_text()
        self.assertEqual(text.count(old), 1, f"{file} has changed: mutate it in another way")
        path.write_text(text.replace(old, new))
        return tree

    def test_light_beyond_half_floats_is_caught(self):
        if not SECOND_DRIVER.is_file():
            self.skipTest("there is no SwiftShader")
        name, file, old, new = BEYOND_HALVES
        options = ("selftest", "--device", "swiftshader", "--only", name)
        self.expect(0, *options, **ON_SECOND)
        tree = self.mutated("halves", file, old, new)
        self.assertIn("FAILED", self.expect(1, *options, "--shaders", tree, **ON_SECOND).stdout)

    def test_an_unchanged_tree_of_shaders_changes_nothing(self):
        self.require_device()
        self.expect(0, "selftest", "--only", "double.tone_curve", "--shaders", self.source.resolve())
        self.assertIn("no folder shaders", self.expect(2, "selftest", "--shaders", "nowhere").stderr)

    def test_the_whole_test_holds(self):
        if not LONG:
            self.skipTest("GLOAM_LONG_TESTS is not set")
        self.require_device()
        self.expect(0, "selftest")


if __name__ == "__main__":
    main()
