# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""A scripted tour of `play` in a window: keys, mouse, panel, sizes, drop and close. Needs Vulkan and Xvfb."""
import base64
import json
import shutil
import struct

from program_case import main
from rgb_picture import read_png
from window_case import FileDrop, WindowCase

SIZE = ("--size", "240x135", "--scale", "1")


def write_scene(path):
    """A glTF file with one triangle that emits light, and its camera."""
    corners = struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0, 1, 0)
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 3]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "materials": [{"emissiveFactor": [1, 0.5, 0.1]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," + base64.b64encode(corners).decode()}],
    }), encoding="utf-8")


def stop(name):
    """The window is photographed here."""
    return f"wait 3\nsay {name}\nuntil {name}.seen\n"


class PlayTour(WindowCase):
    def setUp(self):
        super().setUp()
        self.assertIsNotNone(shutil.which("Xvfb"), "Xvfb is not installed (package xvfb)")
        self.require_device()

    def settings(self):
        with open(self.folder / "config/gloam/play.json", encoding="utf-8") as file:
            return json.load(file)

    def test_keys_move_the_camera_and_take_screenshots(self):
        run = self.start("builtin:shadows", *SIZE, "--dt", "0", "--validate",
                         script="pace 0.05\n" + stop("begin") + "hold w\nwait 6\nrelease w\n" + stop("forward") + "key 1\n" + stop("back") +
                         "key f12\nwait 2\nmove 120 60\npress\nmove 180 60\nlift\n" + stop("turned") + "key 1\n" +
                         "pad left_y -1\nwait 6\npad left_y 0\n" + stop("stick") + "key escape\n")
        begin = run.photograph_at("begin")
        forward = run.photograph_at("forward")
        back = run.photograph_at("back")
        turned = run.photograph_at("turned")
        stick = run.photograph_at("stick")
        self.assertEqual(run.end(), "")
        self.assertGreater(begin.differences(forward)[1], 1.0, "W flies forward")
        self.assertLessEqual(begin.differences(back)[0], 1, "1 returns to the scene's first camera")
        self.assertGreater(begin.differences(turned)[1], 1.0, "a drag turns the camera")
        self.assertGreater(begin.differences(stick)[1], 1.0, "the left stick of a gamepad flies forward")
        self.assertLess(forward.differences(stick)[1], 0.05, "the same way as W, and as far in as many frames")
        self.assertLessEqual(begin.differences(read_png(self.folder / "out/shadows-001.png"))[0], 1)

    def test_the_scene_pauses_and_steps(self):
        run = self.start("builtin:smoke", *SIZE, "--dt", "0.2",
                         script="wait 2\nkey space\n" + stop("paused") + "wait 3\n" + stop("still") + "key period\n" + stop("step") +
                         "close\n")
        paused, still, step = (run.photograph_at(name) for name in ("paused", "still", "step"))
        self.assertEqual(run.end(), "")
        self.assertLess(paused.differences(still)[1], 0.5, "nothing moves while paused")
        self.assertGreater(still.differences(step)[1], paused.differences(still)[1] + 0.05, "a step moves the smoke")

    def test_the_window_changes_size_and_is_minimised(self):
        run = self.start("builtin:plain", *SIZE, "--dt", "0", "--validate",
                         script="wait 2\nresize 320 200\n" + stop("wide") + "minimise\nwait 5\nrestore\n" + stop("again") +
                         "key f11\n" + stop("full") + "key f11\n" + stop("window") + "close\n")
        wide, again, full, window = (run.photograph_at(name) for name in ("wide", "again", "full", "window"))
        self.assertEqual(run.end(), "")
        self.assertEqual((wide.width, wide.height), (320, 200))
        self.assertEqual(wide.rgb, again.rgb, "a minimised window returns as it was")
        self.assertEqual((full.width, full.height), (800, 600))
        self.assertEqual((window.width, window.height), (320, 200))
        self.assertEqual([self.settings()[key] for key in ("width", "height")], [320, 200])

    def test_the_panel_opens_and_its_knobs_change_the_picture(self):
        run = self.start("builtin:shadows", "--size", "640x360", "--scale", "1", "--dt", "0", "--validate",
                         script=stop("closed") + "key tab\n" + stop("open") + "click_widget view\nwait 2\nclick_widget view albedo\n" +
                         stop("albedo") + "click_widget scale\nwait 2\nclick_widget scale 50 %\n" + stop("half") + "close\n")
        closed, opened, albedo, half = (run.photograph_at(name) for name in ("closed", "open", "albedo", "half"))
        self.assertEqual(run.end(), "")
        self.assertGreater(closed.differences(opened)[1], 10.0, "the panel covers most of the picture")
        self.assertNotEqual(opened.pixel(600, 300), albedo.pixel(600, 300), "the view changes beside the panel")
        self.assertLess(sum(abs(a - b) for a, b in zip(albedo.pixel(600, 300), half.pixel(600, 300))), 12)
        self.assertEqual(self.settings(), {"width": 640, "height": 360, "scale": 0.5, "panel": True})

    def test_escape_ends_what_is_open_and_asks_before_changes_are_lost(self):
        run = self.start("builtin:shadows", "--size", "760x740", "--scale", "0.5", "--dt", "0", "--validate", size=(800, 760),
                         script="key tab\nwait 2\nclick_widget view\nwait 2\nkey escape\nwait 2\n" + stop("list_closed") +
                         "click_widget search\ntype shadows.mode\nwait 2\nclick_widget shadows.mode\nwait 2\n"
                         "click_widget shadows.mode off\nwait 2\nmove 700 20\nkey escape\nwait 2\n" +
                         stop("asked") + "key escape\nwait 50\nsay too_late\n")
        run.photograph_at("list_closed")
        run.photograph_at("asked")
        self.assertTrue(self.settings()["panel"], "settings are kept while the program runs")
        self.assertEqual(run.end(), "")
        self.assertFalse((self.folder / "too_late").exists())
        config = json.loads((self.folder / "out/shadows.unsaved.config.json").read_text(encoding="utf-8"))
        self.assertEqual(config["shadows.mode"], "off")

    def test_a_picture_at_rest_is_refined_to_full_size(self):
        # More pixels than the first frames on a software device have.
        run = self.start("builtin:shadows", "--size", "480x320", "--dt", "0", "--validate",
                         script="hold w\nwait 3\nrelease w\nkey 1\nwait 40\nsay rested\nuntil rested.seen\n" +
                         "hold w\nwait 3\nsay moving\nrelease w\nuntil moving.seen\nkey 1\nwait 40\n" +
                         "say again\nuntil again.seen\nclose\n")
        rested, _, again = (run.photograph_at(name) for name in ("rested", "moving", "again"))
        self.assertEqual(run.end(), "")
        self.expect(0, "render", "builtin:shadows", "--size", "480x320", "--time", "0", "--dt", "0", "--out", "full.png")
        full = read_png(self.folder / "full.png")
        self.assertLessEqual(rested.differences(full)[0], 1, "what render draws")
        self.assertLessEqual(again.differences(full)[0], 1)

    def test_the_camera_orbits_approaches_and_looks_at_points(self):
        run = self.start("builtin:shadows", *SIZE, "--dt", "0", "--validate",
                         script=stop("begin") + "move 120 80\nscroll 4\n" + stop("near") + "scroll -4\n" + stop("back") +
                         "grab\nmove 180 80\nlet_go\n" + stop("around") + "move 40 100\nkey f\n" + stop("looked") + "close\n")
        begin, near, back, around, looked = (run.photograph_at(name) for name in ("begin", "near", "back", "around", "looked"))
        self.assertEqual(run.end(), "")
        self.assertGreater(begin.differences(near)[1], 1.0, "the wheel moves the camera")
        self.assertLess(begin.differences(back)[1], 0.2, "and back")
        self.assertGreater(back.differences(around)[1], 1.0, "the right button orbits")
        self.assertGreater(around.differences(looked)[1], 1.0, "F looks at the pointer's point")

    def test_the_panel_changes_lights_modules_and_the_lens(self):
        def wide(picture):
            """The picture beside the panel, without the cross at the clicked pixel."""
            places = ((x, y) for y in range(0, picture.height, 3) for x in range(480, picture.width))
            return [picture.pixel(x, y) for x, y in places if max(abs(x - 640), abs(y - 500)) > 16]

        def still(name):
            """Stops with the pointer away from the panel's widgets, so that no tooltip covers the picture."""
            return "move 700 20\n" + stop(name)

        run = self.start("builtin:shadows", "--size", "760x740", "--scale", "0.5", "--dt", "0", "--validate", size=(800, 760),
                         script="key tab\n" + still("open") + "click_widget lights\nwait 2\nclick_widget moon mute\n" + still("muted") +
                         "click_widget moon mute\nwait 2\nclick_widget lamp solo\n" + still("solo") +
                         "click_widget lamp solo\nclick_widget lights\nwait 2\nclick_widget keep A\nclick_widget search\n"
                         "type shadows.mode\nwait 2\nclick_widget shadows.mode\nwait 2\nclick_widget shadows.mode off\n" +
                         still("unshadowed") + "click_widget keep B\nclick_widget show A\n" + still("a") +
                         "click_widget show B\n" + still("b") + "click_widget save config\nclick_widget show A\n" + still("before_pick") +
                         "click 640 500\n" + still("picked") + "click_widget lens\nwait 2\nwidget lens f-number\npress\nmove 20 20\nlift\n" + still("blurred") + "close\n")
        names = ("open", "muted", "solo", "unshadowed", "a", "b", "before_pick", "picked", "blurred")
        opened, muted, solo, unshadowed, a, b, before_pick, picked, blurred = (run.photograph_at(name) for name in names)
        self.assertEqual(run.end(), "")
        self.assertNotEqual(wide(opened), wide(muted), "without the moon")
        self.assertNotEqual(wide(muted), wide(solo), "with the lamp alone")
        self.assertNotEqual(wide(opened), wide(unshadowed), "without the module of shadows")
        self.assertEqual(wide(opened), wide(a))
        self.assertEqual(wide(unshadowed), wide(b))
        self.assertEqual(wide(before_pick), wide(picked), "a click moves nothing")
        self.assertNotEqual(before_pick.rgb, picked.rgb, "the panel tells about the pixel")
        self.assertNotEqual(wide(picked), wide(blurred), "the module of depth of field runs")
        config = json.loads((self.folder / "out/shadows.config.json").read_text(encoding="utf-8"))
        self.assertEqual(config["shadows.mode"], "off")

    def test_a_wipe_compares_kept_settings_and_ends_with_escape(self):
        width, height = 760, 740

        def columns(picture, first, last):
            return [picture.pixel(x, y) for y in range(0, height, 5) for x in range(first, last, 5)]

        run = self.start("builtin:shadows", "--size", f"{width}x{height}", "--scale", "0.5", "--dt", "0", "--validate", size=(800, 760),
                         script=stop("a") + "key tab\nwait 3\nclick_widget keep A\nclick_widget search\ntype shadows.mode\nwait 2\n"
                         "click_widget shadows.mode\nwait 2\nclick_widget shadows.mode off\nmove 700 20\nkey tab\n" + stop("now") +
                         "key tab\nwait 2\nclick_widget wipe\nwait 6\nmove 700 20\nkey tab\n" + stop("wipe") +
                         "move 382 300\npress\nmove 300 320\nmove 202 300\nlift\nwait 2\n" + stop("dragged") +
                         "key escape\n" + stop("off") + "close\n")
        a, now, wipe, dragged, off = (run.photograph_at(name) for name in ("a", "now", "wipe", "dragged", "off"))
        run.end()
        self.assertNotEqual(columns(a, 0, width), columns(now, 0, width))
        for picture, line in ((wipe, 380), (dragged, 202)):
            self.assertEqual(columns(picture, 0, line - 4), columns(now, 0, line - 4), "left of the line are the settings of now")
            self.assertEqual(columns(picture, line + 4, width), columns(a, line + 4, width), "right of it are those of A")
            self.assertIn((255, 255, 255), [picture.pixel(x, 400) for x in range(line - 3, line + 4)], "the line")
        self.assertEqual(off.rgb, now.rgb, "Escape ends the wipe, not the program")

    def test_a_changed_shader_is_compiled_and_a_broken_one_is_shown(self):
        shutil.copytree(self.source / "shaders", self.folder / "tree/shaders")
        shader = self.folder / "tree/shaders/lighting/display/tone_map.frag.glsl"
        text = shader.read_text(encoding="utf-8")
        self.assertIn("exposure;", text)
        run = self.start("builtin:plain", *SIZE, "--dt", "0", "--set", "lighting.antialiasing=off", "--validate", "--shaders", "tree",
                         script=stop("begin") + "until end\nclose\n")
        begin = run.photograph_at("begin")
        picture = lambda: run.display.photograph(run.display.find())
        shader.write_text(text.replace("shown = after_curve(c.curve, shown);", "shown = vec3(0.2, 0.9, 0.1);"), encoding="utf-8")
        run.wait_for("the green picture", lambda: picture().pixel(120, 70)[1] > 200)
        green = picture().mean()
        shader.write_text(text.replace("shown = after_curve", "shown = no_such_function"), encoding="utf-8")
        run.wait_for("the panel", lambda: picture().mean() < 0.7 * green)
        shader.write_text(text, encoding="utf-8")
        run.wait_for("the first picture", lambda: picture().pixel(200, 130) == begin.pixel(200, 130))
        (self.folder / "end").touch()
        self.assertIn("no_such_function", run.end())

    def test_a_dropped_scene_is_shown_and_others_are_refused(self):
        """The scene is dropped as a file manager does; its path has a space, which an URI writes as %20."""
        write_scene(self.folder / "small scene.gltf")
        run = self.start("builtin:plain", *SIZE, "--dt", "0",
                         script="wait 2\ndrop none.gltf\nwait 2\ndrop script.txt\n" + stop("before") + "until dropped\nwait 5\n" + stop("after") +
                         "close\n")
        before = run.photograph_at("before")
        FileDrop(run.display, self.folder / "small scene.gltf").onto(run, run.display.find(), 100, 60)
        (self.folder / "dropped").touch()
        after = run.photograph_at("after")
        errors = run.end()
        self.assertIn("none.gltf", errors)
        self.assertIn("script.txt: is no scene", errors)
        self.assertGreater(before.differences(after)[1], 1.0)

    def test_it_closes_while_it_loads(self):
        run = self.start("builtin:meadow", *SIZE)
        run.wait_for("the window", run.display.find)
        run.display.close(run.display.find())
        self.assertEqual(run.end(), "")


if __name__ == "__main__":
    main()
