# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Draws models as they are downloaded, without lights and cameras: the whole model is in the picture, fills most of it, and is
well exposed. Needs Vulkan."""
import json
import shutil
import struct
import subprocess
import sys
from pathlib import Path

from program_case import ProgramCase, main
from rgb_picture import read_png

WIDTH, HEIGHT = 320, 180
MODELS = Path("/usr/share/assimp/models/glTF2")  # package assimp-testmodels
SUN = "the scene has no light and no sky, so it gets a soft sky and a low sun"


def bare(scene):
    """Without lights and cameras."""
    for node in scene.get("nodes", []):
        node.pop("camera", None)
        node.get("extensions", {}).pop("KHR_lights_punctual", None)
    scene.pop("cameras", None)
    return scene


def glowing(scene):
    """All surfaces emit white light."""
    for material in scene.setdefault("materials", [{}]):
        material.pop("emissiveTexture", None)
        material |= {"emissiveFactor": [1, 1, 1], "doubleSided": True}
    for mesh in scene["meshes"]:
        for primitive in mesh["primitives"]:
            primitive.setdefault("material", 0)
    return scene


class FirstMinute(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()

    def helmet(self):
        """The helmet as a .gltf file with its buffer beside it."""
        subprocess.run([sys.executable, "-B", self.source / "tests/support/helmet.py", self.folder / "helmet.glb"], check=True)
        data = (self.folder / "helmet.glb").read_bytes()
        size = struct.unpack("<I", data[12:16])[0]
        scene = json.loads(data[20:20 + size])
        (self.folder / "helmet.bin").write_bytes(data[28 + size:])
        scene["buffers"][0]["uri"] = "helmet.bin"
        return scene

    def copy(self, path):
        """A copy of a model with the files around it."""
        if not path.exists():
            self.skipTest(f"{path} is absent")
        shutil.copytree(path.parent, self.folder, dirs_exist_ok=True)
        return bare(json.loads(path.read_text(encoding="utf-8")))

    def draw(self, name, scene, *options):
        (self.folder / f"{name}.gltf").write_text(json.dumps(scene), encoding="utf-8")
        run = self.expect(0, "render", f"{name}.gltf", "--size", f"{WIDTH}x{HEIGHT}", "--out", f"{name}.png", *options)
        return read_png(self.folder / f"{name}.png"), run.stderr.splitlines()

    def check(self, scene):
        lit, warnings = self.draw("lit", scene)
        self.assertEqual(sum(SUN in line for line in warnings), 1, warnings)
        self.assertIn(SUN, self.expect(0, "inspect", "lit.gltf").stdout)
        dark, warnings = self.draw("dark", scene, "--set", "scene.default_light=off")
        self.assertFalse(any(SUN in line for line in warnings), warnings)
        self.assertEqual(dark.mean(), 0.0)

        glow, _ = self.draw("glow", glowing(scene), "--set", "scene.default_light=off", "--set", "lighting.antialiasing=off")
        inside = [(x, y) for y in range(HEIGHT) for x in range(WIDTH) if glow.pixel(x, y)[0] > 8]
        (left, right), (top, bottom) = ((min(values), max(values) + 1) for values in zip(*inside))
        filled = max((right - left) / WIDTH, (bottom - top) / HEIGHT)
        self.assertGreater(filled, 0.86)
        self.assertLess(filled, 0.94)
        self.assertLess(abs(left + right - WIDTH) / WIDTH, 0.04, "in the middle")
        self.assertLess(abs(top + bottom - HEIGHT) / HEIGHT, 0.04, "in the middle")
        brightness = sorted(max(lit.pixel(x, y)) for x, y in inside)
        at = lambda share: brightness[int(share * (len(brightness) - 1))]
        self.assertGreater(at(0.5), 60, "not too dark")
        self.assertLess(at(0.5), 225, "not too bright")
        self.assertLess(at(0.93), 253, "little is white")

    def test_a_helmet(self):
        self.check(self.helmet())

    def test_a_white_and_a_black_model_show_their_shape(self):
        """The exposure is that of the model, not of what is behind it."""
        medians = {}
        for name, color in (("white", 1.0), ("grey", 0.3), ("black", 0.01)):
            scene = self.helmet()
            for material in scene["materials"]:
                for member in set(material) - {"name", "doubleSided"}:
                    material.pop(member)
                material["pbrMetallicRoughness"] = {"baseColorFactor": [color] * 3 + [1], "metallicFactor": 0, "roughnessFactor": 0.6}
            lit, _ = self.draw("lit", scene)
            glow, _ = self.draw("glow", glowing(scene), "--set", "scene.default_light=off", "--set", "lighting.antialiasing=off")
            inside = sorted(max(lit.pixel(x, y)) for y in range(HEIGHT) for x in range(WIDTH) if glow.pixel(x, y)[0] > 8)
            medians[name] = inside[len(inside) // 2]
            self.assertGreater(inside[len(inside) * 9 // 10] - inside[len(inside) // 10], 40, f"{name} is flat")
        self.assertGreater(medians["black"], 60, "the shape of a black model is seen")
        self.assertLess(medians["white"], 220, "a white model is not burnt out")
        self.assertLess(medians["black"], medians["grey"] - 20)
        self.assertLess(medians["grey"], medians["white"] - 20)

    def test_an_unlit_model_has_its_colours(self):
        scene = self.helmet()
        for material in scene["materials"]:
            material |= {"extensions": {"KHR_materials_unlit": {}}, "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.1, 0.1, 1]}}
        picture, _ = self.draw("unlit", scene | {"extensionsUsed": ["KHR_materials_unlit"]})
        red, green, blue = picture.pixel(WIDTH // 2, HEIGHT // 3)
        self.assertGreater(red, 180)
        self.assertLess(max(green, blue), 0.75 * red)

    def test_a_box(self):
        self.check(self.copy(MODELS / "BoxTextured-glTF/BoxTextured.gltf"))

    def test_a_skinned_character(self):
        self.check(self.copy(self.source.parent / "shared/scenes/avatar/avatar.gltf"))

    def test_a_castle(self):
        self.check(self.copy(self.source.parent / "shared/scenes/courtyard/level-dungeon.gltf"))


if __name__ == "__main__":
    main()
