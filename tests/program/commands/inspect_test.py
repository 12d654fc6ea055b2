# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests the output of `inspect` for built-in scenes and for a file."""
import copy
import json
import math

from gltf_scene import TRIANGLE
from program_case import ProgramCase, main
from scene_file import SceneFile, turned

COUNTS = ("nodes", "meshes", "triangles", "instances", "drawn_triangles", "materials", "textures", "images", "lights", "skins")
class Inspect(ProgramCase):
    def inspect(self, scene):
        return json.loads(self.expect(0, "inspect", scene, "--json").stdout)

    def test_json_holds_every_field(self):
        told = self.inspect("builtin:lanterns")
        self.assertEqual(told["version"], 1)
        self.assertEqual(told["scene"], "builtin:lanterns")
        for count in COUNTS:
            self.assertIsInstance(told[count], int, count)
        self.assertEqual(told["cameras"], ["main", "steps"])
        self.assertEqual(told["animations"], [])
        self.assertEqual(told["lights"], 256)
        self.assertGreater(told["drawn_triangles"], told["triangles"])
        for module in told["modules"]:
            self.assertEqual(set(module), {"name", "built", "demanded", "reason"})

    def test_modules_say_whether_and_why(self):
        modules = {module["name"]: module for module in self.inspect("builtin:lanterns")["modules"]}
        self.assertTrue(modules["lights"]["demanded"])
        self.assertTrue(all(module["built"] is True for module in modules.values()))
        self.assertFalse(modules["grass"]["demanded"])
        for module in modules.values():
            self.assertTrue(module["reason"], module["name"])

    def test_text_says_which_modules_are_called_for(self):
        lines = self.expect(0, "inspect", "builtin:lanterns").stdout.splitlines()
        for module in self.inspect("builtin:lanterns")["modules"]:
            words = next(line.split() for line in lines if line.startswith("  " + module["name"] + " "))
            verdict = "called for" if module["demanded"] else "not called for"
            self.assertEqual(" ".join(words[1:]), verdict + ": " + module["reason"])

    def test_the_meadows_call_for_grass_and_have_no_warnings(self):
        for scene, lights in (("builtin:meadow", 6), ("builtin:meadow_day", 1)):
            told = self.inspect(scene)
            self.assertEqual(told["warnings"], [])
            self.assertEqual(told["cameras"], ["near", "far", "ground", "lanterns", "above", "walk"])
            self.assertEqual(told["lights"], lights)
            self.assertIn("walker", told["animations"])
            self.assertTrue(next(module for module in told["modules"] if module["name"] == "grass")["demanded"])

    def test_the_smoke_calls_for_particles_and_has_no_warnings(self):
        told = self.inspect("builtin:smoke")
        self.assertEqual(told["warnings"], [])
        self.assertEqual(told["cameras"], ["near", "far", "fire", "beam", "inside", "away"])
        self.assertEqual(told["lights"], 4)
        particles = next(module for module in told["modules"] if module["name"] == "particles")
        self.assertTrue(particles["demanded"])
        self.assertEqual(particles["reason"], "5 emitters")

    def test_proxies_and_probes_that_no_surface_can_show_are_named(self):
        def told(**floor):
            scene = SceneFile()
            scene.quad(3.0, scene.material(**floor))
            up, down = [0, 0, 0, 1], turned(0, math.pi / 2)
            for name, at, rotation, keys in (("wall", (0, 1, -3), up, {"gloam.ibr_proxy.size": [2, 2]}),
                                             ("behind", (0, 1, 4), up, {"gloam.ibr_proxy.size": [2, 2]}),
                                             ("cellar", (0, -2, 0), down, {"gloam.ibr_proxy.size": [2, 2]}),
                                             ("hall", (0, 1, 0), up, {"gloam.cube_probe.size": [4, 4, 4]}),
                                             ("yard", (9, 1, 0), up, {"gloam.cube_probe.size": [4, 4, 4]})):
                scene.nodes.append({"name": name, "translation": list(at), "rotation": list(rotation), "extras": keys})
            scene.write(self.folder / "hall.gltf")
            json_warnings, text = self.inspect("hall.gltf")["warnings"], self.expect(0, "inspect", "hall.gltf").stdout
            for warning in json_warnings:
                self.assertIn("warning: " + warning + "\n", text)
            return json_warnings
        far = "no surface shows 1 probe: yard, because no reflective surface reaches into its box"
        mirror = told(roughness=0.0, **{"gloam.reflectivity": 0.9})
        self.assertEqual(mirror, ["no surface shows 2 reflection proxies: behind, cellar, because it faces away from or lies below "
                                  "every smooth surface that faces up", far])
        rough = told(roughness=1.0, **{"gloam.reflectivity": 0.9})
        self.assertEqual(rough, ["no surface shows 3 reflection proxies: wall, behind, cellar, because the scene has no smooth "
                                 "material", far])
        none = told(**{"gloam.reflectivity": 0.0})
        self.assertEqual(none[1:], ["no surface shows 2 probes: hall, yard, because the scene has no reflective material"])

    def test_a_file_is_told_like_a_built_in_scene(self):
        (self.folder / "leaf.gltf").write_text(json.dumps(TRIANGLE))
        told = self.inspect("leaf.gltf")
        self.assertEqual(told["triangles"], 1)
        self.assertEqual(told["nodes"], 2)
        self.assertEqual(told["cameras"], ["eye"])
        self.assertEqual(told["lights"], 0)
        self.assertIn("eye", self.expect(0, "inspect", "leaf.gltf").stdout)
        self.expect(2, "inspect", "leaf.gltf", "--camera", "leaf")

    def test_a_missing_or_malformed_file_of_blade_types_is_3(self):
        good = "fescue 1 1 1 0.5 0.1 0,0 0.1,0.6 0.3,1\n"
        files = (("good.txt", good, ""),
                 ("absent.txt", None, "absent.txt\n"),
                 ("malformed.txt", good + "sedge 1 1 1 0.5 0.1 0,0 0.1,tall\n", "malformed.txt line 2: "),
                 ("empty.txt", "", "empty.txt: "))
        for name, content, says in files:
            scene = copy.deepcopy(TRIANGLE)
            scene["nodes"][0]["extras"] = {"gloam.grass.density": 100, "gloam.grass.types": name}
            (self.folder / "lawn.gltf").write_text(json.dumps(scene))
            if content is not None:
                (self.folder / name).write_text(content)
            if content == good:
                self.assertEqual(self.inspect("lawn.gltf")["warnings"], [])
                continue
            self.expect(3, "inspect", "lawn.gltf", says=says)

    def test_a_missing_or_broken_image_of_blades_is_3(self):
        for name, content, says in (("absent.png", None, "absent.png\n"),
                                    ("broken.png", "no picture", "broken.png: is not a PNG, JPEG or WebP image")):
            scene = copy.deepcopy(TRIANGLE)
            scene["nodes"][0]["extras"] = {"gloam.grass.density": 100, "gloam.grass.texture": name}
            (self.folder / "lawn.gltf").write_text(json.dumps(scene))
            if content is not None:
                (self.folder / name).write_text(content)
            self.expect(3, "inspect", "lawn.gltf", says=says)


if __name__ == "__main__":
    main()
