# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""A scripted tour of `play` in a window: keys, mouse, panel, sizes, drop and close. Needs Vulkan and Xvfb."""
import base64
import json
import shutil
import struct

from program_case import main
from window_case import WindowCase, read_png

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
                         script=stop("begin") + "hold w\nwait 6\nrelease w\n" + stop("forward") + "key 1\n" + stop("back") +
                         "key f12\nwait 2\nmove 120 60\npress\nmove 180 60\nlift\n" + stop("turned") + "key escape\n")
        begin = run.photograph_at("begin")
        forward = run.photograph_at("forward")
        back = run.photograph_at("back")
        turned = run.photograph_at("turned")
        self.assertEqual(run.end(), "")
        self.assertGreater(begin.differences(forward)[1], 1.0, "W flies forward")
        self.assertLessEqual(begin.differences(back)[0], 1, "1 returns to the scene's first camera")
        self.assertGreater(begin.differences(turned)[1], 1.0, "a drag turns the camera")
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

    def test_a_dropped_scene_is_shown_and_others_are_refused(self):
        write_scene(self.folder / "small scene.gltf")
        run = self.start("builtin:plain", *SIZE, "--dt", "0",
                         script="wait 2\ndrop none.gltf\nwait 2\ndrop script.txt\n" + stop("before") + "drop small scene.gltf\n" + stop("after") +
                         "close\n")
        before, after = run.photograph_at("before"), run.photograph_at("after")
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
