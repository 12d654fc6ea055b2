# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Lights of the panel in a window: the gizmo moves one, undo takes changes of all panels back, and `--lights` loads what was
saved. Needs Vulkan and Xvfb."""
import base64
import json
import math
import shutil
import struct

from program_case import main
from rgb_picture import read_png
from window_case import WindowCase

WIDTH, HEIGHT, PANEL = 760, 740, 480  # PANEL: columns that the panel covers
DISTANCE_M, FOV_Y = 4.0, 0.8  # of the camera from the plane of the lamp
LAMP = (1.0, 0.2, 0.0)
# Of the gizmo (sandbox/play/input/light_gizmo.cpp): an axis in relation to the distance of its light.
AXIS_M = 0.15 * math.dist(LAMP, (0.0, 0.0, DISTANCE_M))
PIXELS_PER_M = HEIGHT / (2.0 * math.tan(0.5 * FOV_Y) * DISTANCE_M)  # in the plane of the lamp


def write_scene(path):
    """A wall behind a lamp, and a camera that looks along -Z."""
    wall = struct.pack("<12f", -4, -4, -1, 4, -4, -1, 4, 4, -1, -4, 4, -1) + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2], "extras": {"gloam.exposure": 4}}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 60, "range": 20}]}},
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, DISTANCE_M]},
                  {"name": "lamp", "translation": LAMP, "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": FOV_Y, "znear": 0.1}}],
        "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-4, -4, -1], "max": [4, 4, -1]},
                      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "buffers": [{"byteLength": len(wall), "uri": "data:application/octet-stream;base64," + base64.b64encode(wall).decode()}],
    }), encoding="utf-8")


def stop(name):
    """The window is photographed here, with the pointer away from the panel and the gizmo."""
    return f"move {WIDTH - 10} 20\nwait 3\nsay {name}\nuntil {name}.seen\n"


class PlayLights(WindowCase):
    def setUp(self):
        super().setUp()
        self.assertIsNotNone(shutil.which("Xvfb"), "Xvfb is not installed (package xvfb)")
        self.require_device()
        write_scene(self.folder / "s.gltf")

    def beside_panel(self, picture):
        """Pixels beside the panel, away from the gizmo of the lamp before and after its drag."""
        x, y = WIDTH / 2 + LAMP[0] * PIXELS_PER_M, HEIGHT / 2 - LAMP[1] * PIXELS_PER_M
        places = ((a, b) for b in range(0, HEIGHT, 7) for a in range(PANEL + 8, WIDTH, 7))
        return [picture.pixel(a, b) for a, b in places if not (abs(a - x) < 170 and abs(b - y) < 170)]

    def difference(self, a, b):
        pairs = [abs(p - q) for one, other in zip(self.beside_panel(a), self.beside_panel(b)) for p, q in zip(one, other)]
        return max(pairs), sum(pairs) / len(pairs)

    def test_a_light_is_moved_saved_loaded_and_everything_is_undone(self):
        # From the middle of the X axis, 60 pixels to the left.
        x = WIDTH / 2 + (LAMP[0] + 0.6 * AXIS_M) * PIXELS_PER_M
        y = HEIGHT / 2 - LAMP[1] * PIXELS_PER_M
        drag = f"move {x} {y}\npress\nmove {x - 20} {y + 5}\nmove {x - 60} {y}\nlift\nwait 2\n"
        undo = "hold left_control\nkey z\nwait 1\nrelease left_control\nwait 2\n"
        again = "hold left_control\nkey y\nwait 1\nrelease left_control\nwait 2\n"
        script = ("key tab\nwait 3\nclick_widget lights\nwait 2\nclick_widget lamp\nwait 2\n" + stop("begin") + drag +
                  "click_widget save lights\n" + stop("moved") + "click_widget exposure auto\nwait 3\n" +
                  "click_widget search\ntype tone_map\nwait 2\nclick_widget lighting.tone_map\nwait 2\n" +
                  "click_widget lighting.tone_map linear\nwait 3\nclick_widget save config\n" +
                  stop("three_changes") + undo + undo + stop("moved_only") + undo + "click_widget save config\nwait 2\n" +
                  stop("undone") + again + stop("again") + "close\n")
        run = self.start("s.gltf", "--size", f"{WIDTH}x{HEIGHT}", "--scale", "1", "--dt", "0", "--validate", script=script, size=(800, 760))
        begin, moved, changed = (run.photograph_at(name) for name in ("begin", "moved", "three_changes"))
        tone_map = self.read_json("out/s.config.json").get("lighting.tone_map")
        moved_only, undone, again = (run.photograph_at(name) for name in ("moved_only", "undone", "again"))
        run.end()
        lights = self.read_json("out/s.lights.json")["lights"]
        self.assertEqual(list(lights), ["lamp"])
        place = lights["lamp"]["translation"]
        self.assertAlmostEqual(place[0], LAMP[0] - 60 / PIXELS_PER_M, 2, "the X axis follows the pointer")
        self.assertEqual(place[1:], list(LAMP[1:]), "and nothing else changes")
        self.assertEqual(tone_map, "linear")
        self.assertNotIn("lighting.tone_map", self.read_json("out/s.config.json"), "the knob is undone")
        self.assertGreater(self.difference(begin, moved)[1], 1.0)
        self.assertGreater(self.difference(moved, changed)[1], 1.0)
        self.assertLessEqual(self.difference(moved, moved_only)[0], 1, "knob and exposure are undone, the light is not")
        self.assertLessEqual(self.difference(begin, undone)[0], 1)
        self.assertLessEqual(self.difference(moved, again)[0], 1, "and made again")
        self.expect(0, "render", "s.gltf", "--size", f"{WIDTH}x{HEIGHT}", "--lights", "out/s.lights.json", "--out", "m.png")
        self.assertLessEqual(self.difference(moved, read_png(self.folder / "m.png"))[0], 1, "--lights draws what was saved")

    def test_a_bad_file_of_lights_is_wrong_usage(self):
        bad = self.folder / "bad.json"
        for text in ("", "{}", '{"version": 2, "lights": {}}', '{"version": 1, "lights": {"lamp": {"intensity": -1}}}',
                     '{"version": 1, "lights": {"sun": {}}}', '{"version": 1, "lights": {"lamp": {"colour": [1, 1, 1]}}}'):
            with self.subTest(text=text):
                bad.write_text(text, encoding="utf-8")
                self.expect(2, "render", "s.gltf", "--size", "64x36", "--lights", "bad.json", "--out", "x.png",
                            says="sun" if "sun" in text else "bad.json")
        self.expect(2, "render", "s.gltf", "--lights", "none.json", says="none.json")
        run = self.start("s.gltf", "--size", "160x90", "--lights", "bad.json")
        output, errors = run.program.communicate(timeout=60)
        self.assertEqual(run.program.returncode, 2, output + errors)
        self.assertEqual(len(errors.splitlines()), 1, errors)
        self.assertTrue(errors.startswith("gloam: error: "), errors)


if __name__ == "__main__":
    main()
