# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Draws scenes of every effect under conditions at the end of what is legal: lenses, suns, seeds, times, sizes and numbers that
are nearly 0. Each picture is compared with one that is known, or with that of an easier scene."""
import json
import math

from gltf_scene import GltfScene
from program_case import ProgramCase, main
from rgb_picture import Picture, read_png
from scale_test import closeup, fog, glass, lamp, lawn, lens, puddle, room, smoke, spot, sun, turned_about
from scene_file import turned

EFFECTS = {"lamp": lamp, "spot": spot, "sun": sun, "closeup": closeup, "fog": fog, "lens": lens, "puddle": puddle, "room": room,
           "glass": glass, "smoke": smoke, "lawn": lawn, "lawn in the sun": lambda: lawn(sun=True)}
PLAIN = ("--set", "lighting.tone_map=linear", "--set", "lighting.dither=off", "--set", "lighting.antialiasing=off",
         "--set", "glare.lines=off")
DAYS_30 = 30 * 86400
RED, GREEN = (255, 0, 0), (0, 255, 0)
TINY = 1e-40  # a denormal float


def shining(color):
    return {"color": (0, 0, 0, 1), "emissiveFactor": [c / 255 for c in color]}


class HardScenes(ProgramCase):
    shares_process = True

    def setUp(self):
        super().setUp()
        self.require_device()
        self.drawn = 0

    def draw(self, scene, *options, size="96x64", change=None):
        """The picture. All its numbers must be finite. change: of the file. self.counters: of its last frame."""
        self.drawn += 1
        name = str(self.drawn)
        path = self.folder / f"{name}.gltf"
        if isinstance(scene, GltfScene):
            path.write_text(scene.text())
        else:
            scene.write(path)
        if change:
            file = json.loads(path.read_text())
            change(file)
            path.write_text(json.dumps(file))
        self.expect(0, "render", f"{name}.gltf", "--size", size, "--out", f"{name}.png", "--stats", f"{name}.json", *PLAIN, *options)
        self.counters = self.read_json(f"{name}.json")["counters"]
        self.assertEqual(self.counters["nan_pixels"], 0, options)
        return read_png(self.folder / f"{name}.png")

    def assert_near(self, one, other, mean=0.5):
        self.assertLessEqual(one.differences(other)[1], mean)

    # Lenses

    def card_before_camera(self, yfov, distance, half):
        """A red card on the camera's axis, and a green sky."""
        scene = GltfScene(sky=(0, 1, 0))
        scene.node(mesh=scene.card(scene.material(**shining(RED)), half=half))
        scene.camera(translation=[0, 0, distance], lens={"type": "perspective", "perspective": {"yfov": yfov, "znear": 0.01}})
        return scene

    # Hard case: selftest.fov, further.fov_widest, further.fov_narrowest
    def test_a_card_covers_the_pixels_that_its_angle_says(self):
        for degrees, distance in ((179.9, 0.5), (0.01, 1000.0)):
            yfov = math.radians(degrees)
            # Half of the width and height; a little more, so that no edge is at a pixel's centre.
            picture = self.draw(self.card_before_camera(yfov, distance, 0.505 * distance * math.tan(0.5 * yfov)), size="64x64")
            shown = {(x, y) for x in range(64) for y in range(64) if picture.pixel(x, y)[0] == 255}
            self.assertEqual(shown, {(x, y) for x in range(16, 48) for y in range(16, 48)}, f"{degrees} degrees")

    # Hard case: selftest.fov, further.fov_widest, further.fov_narrowest
    def test_every_effect_through_the_widest_and_the_narrowest_lens(self):
        for name, make in EFFECTS.items():
            with self.subTest(effect=name):
                narrow = make()
                narrow.cameras[0]["perspective"]["yfov"] = math.radians(0.01)
                usual = make()
                usual.cameras[0]["perspective"]["yfov"] = math.radians(0.04)
                options = ("--time", "3") if name == "smoke" else ()
                shown = self.draw(narrow, *options)
                if "lawn" not in name:  # there blades are as wide as what either lens sees
                    self.assertAlmostEqual(shown.mean(), self.draw(usual, *options).mean(), delta=3, msg="both see nearly one point")
                wide = make()
                wide.cameras[0]["perspective"]["yfov"] = math.radians(179.9)
                self.draw(wide, *options)

    # Suns

    def sun_from(self, make, elevation):
        """The scene with its sun so many degrees above the horizon; None: without it."""
        scene = make()
        if elevation is None:
            scene.lights[0]["intensity"] = 0.0
        scene.nodes[next(i for i, node in enumerate(scene.nodes) if "extensions" in node)]["rotation"] = turned(0, -math.radians(elevation or 0))
        return scene

    # Hard case: further.sun_zenith, further.sun_nadir, further.sun_horizon
    def test_suns_straight_above_straight_below_and_at_the_horizon(self):
        for name, make in (("things", sun), ("lawn", lambda: lawn(sun=True)), ("smoke", self.smoke_in_the_sun)):
            with self.subTest(scene=name):
                options = ("--time", "3") if name == "smoke" else ()
                dark, zenith, nadir, horizon = (self.draw(self.sun_from(make, at), *options) for at in (None, 90, -90, 0))
                self.assertGreater(zenith.mean(), dark.mean() + 10)
                self.assert_near(zenith, self.draw(self.sun_from(make, 89.99), *options))
                self.assert_near(horizon, self.draw(self.sun_from(make, 0.01), *options))
                if name == "things":
                    self.assertEqual(nadir.differences(dark), (0, 0), "the floor hides the sun below it")
                    self.assertGreater(horizon.mean(), dark.mean() + 0.5, "the sides of things are lit")

    def smoke_in_the_sun(self):
        scene = smoke()
        scene.lights[0] = {"type": "directional", "name": "key", "intensity": 30}
        return scene

    # Directions

    # Hard case: selftest.turned
    def test_a_quarter_of_a_turn_changes_nothing(self):
        for name in ("lamp", "spot", "sun", "closeup", "fog", "puddle", "glass"):
            for axis in ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)) if name != "puddle" else ((0.0, 1.0, 0.0),):  # mirrors of screen space lie level
                with self.subTest(effect=name, axis=axis):
                    usual = self.draw(EFFECTS[name]())
                    self.assert_near(usual, self.draw(EFFECTS[name](), change=turned_about(axis, 0.5 * math.pi)))

    # Hard case: selftest.mirrored
    def test_a_mirrored_scene_gives_the_mirrored_picture(self):
        def mirror(file):
            """At x = 0, by a node of negative scale. The camera only looks down, so its rotation stays."""
            camera = next(i for i, node in enumerate(file["nodes"]) if "camera" in node)
            file["nodes"][camera]["translation"][0] *= -1
            file["nodes"].append({"scale": [-1, 1, 1], "children": [n for n in file["scenes"][0]["nodes"] if n != camera]})
            file["scenes"][0]["nodes"] = [camera, len(file["nodes"]) - 1]

        for name in ("lamp", "spot", "sun", "closeup", "fog", "puddle", "glass"):
            with self.subTest(effect=name):
                usual, found = self.draw(EFFECTS[name]()), self.draw(EFFECTS[name](), change=mirror)
                back = b"".join(bytes(found.pixel(x, y)) for y in range(found.height) for x in reversed(range(found.width)))
                self.assert_near(usual, Picture(found.width, found.height, back))

    # Seeds

    # Hard case: further.seed_limits
    def test_seeds_of_grass_at_their_limits(self):
        pictures, blades = [], set()
        for seed in (0, 1, 4294967295):
            scene = lawn()
            scene.nodes[0]["extras"]["gloam.grass.seed"] = seed
            pictures.append(self.draw(scene))
            blades.add(self.counters["grass.blades"])
        self.assertEqual(len(blades), 1, "as many blades")
        for i in range(3):
            self.assertGreater(pictures[i].differences(pictures[i - 1])[1], 1, "other places")
            self.assertAlmostEqual(pictures[i].mean(), pictures[i - 1].mean(), delta=0.05 * pictures[i].mean())
        for seed in (-1, 4294967296, 0.5):
            scene = lawn()
            scene.nodes[0]["extras"]["gloam.grass.seed"] = seed
            scene.write(self.folder / "bad.gltf")
            self.expect(3, "render", "bad.gltf", says="gloam.grass.seed")

    # Hard case: further.seed_limits
    def test_the_seed_of_a_run_seeds_nothing_as_its_help_says(self):
        self.assertIn("pictures do not depend on it", " ".join(self.expect(0, "render", "--help").stdout.split()))
        for make, options in ((lawn, ("--frames", "3")), (smoke, ("--time", "3"))):
            first = self.draw(make(), *options)
            for seed in ("0", "18446744073709551615"):
                self.assertEqual(self.draw(make(), *options, "--seed", seed).rgb, first.rgb)
        self.expect(0, "render", "builtin:plain", "--size", "16x16", "--seed", "3", says="--seed changes nothing")
        self.expect(2, "render", "builtin:plain", "--seed", "-1", says="--seed")

    # Time

    def swinging_card(self):
        """A card that moves to and fro in 4 s."""
        scene = GltfScene(sky=(0, 1, 0))
        card = scene.node(mesh=scene.card(scene.material(**shining(RED)), half=0.3))
        scene.animate(card, "translation", [0, 1, 3, 4], [0, 0, 0, 1, 0.5, 0, -1, -0.5, 0, 0, 0, 0])
        scene.camera(translation=[0, 0, 4])
        return scene

    # Hard case: further.thirty_days
    def test_animations_go_on_for_thirty_days(self):
        for time in (0.0, 1.3, 3.6):
            early = self.draw(self.swinging_card(), "--time", time)
            self.assertEqual(self.draw(self.swinging_card(), "--time", DAYS_30 + time).rgb, early.rgb, time)

    # Hard case: selftest.running_time, further.thirty_days
    def test_a_lawn_begins_after_thirty_days_as_at_once(self):
        frames = ("--frames", "12")
        self.assertEqual(self.draw(lawn(), *frames, "--time", DAYS_30).rgb, self.draw(lawn(), *frames).rgb)

    # Hard case: selftest.running_time, further.thirty_days, further.time_negative
    def test_smoke_is_as_dense_after_thirty_days_and_before_the_start(self):
        # Particles come and go, so a mean over some moments is compared.
        def moments(time):
            light = [self.draw(smoke(), "--time", time + 0.7 * i).mean() for i in range(4)]
            self.assertAlmostEqual(self.counters["particles.alive"], 75, delta=1, msg="30 a second for 2.5 s")
            return sum(light) / 4

        usual = moments(3)
        for time in (DAYS_30, -DAYS_30, -7):
            self.assertAlmostEqual(moments(time), usual, delta=0.05 * usual, msg=str(time))

    # Hard case: selftest.frame_time, further.dt_0, further.dt_10
    def test_frames_that_stand_or_jump_show_their_own_time(self):
        for make in (smoke, self.swinging_card):
            for dt, frames, time in (("0", "3", "2.5"), ("10", "3", "2.5")):
                end = float(time) + float(dt) * (int(frames) - 1)
                steps = self.draw(make(), "--time", time, "--dt", dt, "--frames", frames)
                self.assertEqual(steps.rgb, self.draw(make(), "--time", end).rgb, f"dt {dt}")
        self.assertEqual(self.draw(lawn(), "--dt", "0", "--frames", "4").rgb, self.draw(lawn(), "--dt", "0").rgb, "blades stand")
        # Ten seconds are no more steps than a frame may take, and the wind bends the blades as much.
        usual = self.draw(lawn(), "--frames", "30").mean()
        self.assertAlmostEqual(self.draw(lawn(), "--dt", "10", "--frames", "30").mean(), usual, delta=0.05 * usual)
        self.expect(2, "render", "builtin:plain", "--dt", "-0.1", says="--dt")

    # Numbers that are nearly 0

    # Hard case: further.denormals
    def test_denormal_numbers_are_as_good_as_zero(self):
        def lit(change):
            scene = lamp()
            scene.light("spot", at=(0.4, 2.4, 0.4), intensity=100, cone=0.8, range=8.0)
            scene.light("directional", rotation=turned(0, -0.9), intensity=3)
            change(scene)
            return scene

        def intensities(value):
            return lambda scene: [light.update(intensity=value) for light in scene.lights[1:]]

        def width(value):
            return lambda scene: [node["extras"].update({"gloam.light.width": value}) for node in scene.nodes if "extensions" in node][:1]

        def colour(value):
            return lambda scene: scene.materials[0]["pbrMetallicRoughness"].update(baseColorFactor=[value, 0.5, value, 1])

        def surface(value):
            return lambda scene: scene.materials[1]["pbrMetallicRoughness"].update(roughnessFactor=value, metallicFactor=value)

        def emission(value):
            return lambda scene: scene.materials[1].update(emissiveFactor=[value, 0, value])

        def places(value):
            return lambda scene: [node.update(translation=[t or value for t in node["translation"]]) for node in scene.nodes]

        def turns(value):
            return lambda scene: [node.update(rotation=[r or value for r in node["rotation"]]) for node in scene.nodes[:3]]

        def sky(value):
            return lambda scene: scene.extras.update({f"gloam.sky.{part}": [value] * 3 for part in ("zenith", "horizon", "ground")})

        def density(value):
            return lambda scene: scene.nodes[0]["extras"].update({"gloam.fog.density": value, "gloam.fog.color": [1.0, value, 2.0]})

        usual = self.draw(lit(lambda scene: None))
        self.assertGreater(usual.mean(), 10)
        for change in (intensities, width, colour, surface, emission, places, turns, sky, density):
            with self.subTest(change=change.__name__):
                self.assertLessEqual(self.draw(lit(change(TINY))).differences(self.draw(lit(change(0.0))))[0], 1)

    # Hard case: further.denormals
    def test_denormal_corners_are_one_point(self):
        def card_of(half):
            scene = lamp()
            scene.quad(half, scene.material((0.9, 0.1, 0.1)), at=(0.1, 0.4, 0.8))
            return scene
        self.assertEqual(self.draw(card_of(TINY)).rgb, self.draw(card_of(0.0)).rgb)

    # Sizes

    # Hard case: selftest.picture_size, further.size_1x1, further.size_7x5
    def test_the_least_pictures_have_the_pixels_of_larger_ones(self):
        # The pixel in the middle of each square of 15×15 pixels looks the same way as the one of the small picture.
        for name in ("lamp", "spot", "sun", "closeup", "glass"):  # others depend on neighbouring pixels
            for width, height in ((7, 5), (1, 1)):
                with self.subTest(effect=name, size=f"{width}x{height}"):
                    small = self.draw(EFFECTS[name](), size=f"{width}x{height}")
                    large = self.draw(EFFECTS[name](), size=f"{15 * width}x{15 * height}")
                    off = [max(abs(a - b) for a, b in zip(small.pixel(x, y), large.pixel(15 * x + 7, 15 * y + 7)))
                           for x in range(width) for y in range(height)]
                    self.assertLessEqual(sum(step > 3 for step in off), 0.1 * len(off), sorted(off))

    # Hard case: further.size_1x1, further.size_7x5, further.size_largest
    def test_every_effect_in_the_least_and_the_longest_pictures(self):
        for name, make in EFFECTS.items():
            for size in ("1x1", "7x5", "16384x1", "1x16384"):
                with self.subTest(effect=name, size=size):
                    self.draw(make(), size=size)

    # Hard case: further.size_largest
    def test_the_largest_picture_is_drawn_or_finds_no_memory(self):
        limited = ("sh", "-c", 'ulimit -v 8000000; exec "$@"', "sh")  # KiB; a software device needs 13 GB for it
        run = self.run_program("render", "builtin:plain", "--size", "16384x16384", "--out", "large.png", prefix=limited)
        self.assertIn(run.returncode, (0, 1), run.stderr)
        self.assertEqual("No memory for" in run.stderr, run.returncode == 1, run.stderr)

    # Hard case: selftest.picture_size, further.size_largest
    def test_a_card_covers_half_of_the_longest_picture(self):
        for size in ("16384x1", "1x16384"):
            width, height = (int(n) for n in size.split("x"))
            slope = 1.0 / max(width / height, 1.0)  # so that the longer side sees 45 degrees to each side
            picture = self.draw(self.card_before_camera(2 * math.atan(slope), 2.0, 1.0001), size=size)
            shown = [max(width, height) == width and picture.pixel(i, 0)[0] == 255 or height > 1 and picture.pixel(0, i)[0] == 255
                     for i in range(16384)]
            self.assertEqual(shown, [4096 <= i < 12288 for i in range(16384)], size)


if __name__ == "__main__":
    main()
