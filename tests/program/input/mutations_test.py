# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""The cases of ../shared/cases, changed in ways that leave their pictures as they are: other units, places, directions,
sides, alpha modes and cameras. By default a share of them is drawn; GLOAM_LONG_TESTS=1 draws all."""
import base64
import copy
import json
import math

from program_case import LONG, ProgramCase, main
from rgb_picture import Picture, read_png
from scene_file import scaled_keys, turned

# Cases that are one surface and one light, and those of whole scenes. Grass, the wind and lenses have metres.
SURFACES = ("double-sided-bent-normals/front_0/t40_front_0", "double-sided-bent-normals/front_1/t40_front_1",
            "double-sided-bent-normals/back_1/t40_back_1", "vertex-colours/u16/t55_u16", "vertex-colours/vcol/t55_vcol",
            "vertex-colours/tex/t55_tex")
LAMPS = ("casters-near-a-lamp/point_0.02/t54_point_0.02", "casters-near-a-lamp/spot_0.02/t54_spot_0.02",
         "casters-near-a-lamp/spot_0.06/t54_spot_0.06", "light-without-range/1cd/t53pic1", "light-without-range/2cd/t53pic2",
         "near_1e-9", "lamp-behind-rods/t09", "highlight-flicker/roughness-0.2/t14b_0.2")
DEFAULTS = ("scene-of-millimetres/scale-1/t07b_1", "scene-of-millimetres/scale-0.001/t07b_0.001")  # no camera, no light
LENSES = ("blend-in-depth-of-field/blend/t46_BLEND", "blend-in-depth-of-field/opaque/t46_OPAQUE", "near-blur-solid/t22_None")
CASES = SURFACES + LAMPS + LENSES + DEFAULTS


def lights_of(scene):
    return scene.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])


def add_root(scene, **members):
    """Puts all nodes of the scene under one."""
    scene["nodes"].append({"children": scene["scenes"][0]["nodes"], **members})
    scene["scenes"][0]["nodes"] = [len(scene["nodes"]) - 1]


def in_units(scene, factor):
    """All lengths times `factor`. gloam.scale says how large a unit is then, so candela and focus stay as they are."""
    add_root(scene, scale=[factor] * 3)
    scene["scenes"][0].setdefault("extras", {})["gloam.scale"] = 1 / factor
    for light in lights_of(scene):
        if "range" in light:
            light["range"] *= factor
    for node in scene["nodes"]:
        if "extras" in node:
            node["extras"] = scaled_keys(node["extras"], factor)
    for camera in scene.get("cameras", []):
        lens = camera[camera["type"]]
        for key in ("znear", "zfar", "xmag", "ymag"):
            if key in lens:
                lens[key] *= factor


def moved(scene, place):
    add_root(scene, translation=[place, -0.25 * place, 0.5 * place])


def turned_by(scene, degrees):
    add_root(scene, rotation=turned(1, math.radians(degrees)))


def mirrored(scene, _):
    """At the plane x = 0, by a node of negative scale. The camera is mirrored by hand: it has no handedness."""
    roots = scene["scenes"][0]["nodes"]
    cameras = [n for n in roots if "camera" in scene["nodes"][n]]
    scene["scenes"][0]["nodes"] = [n for n in roots if n not in cameras]
    add_root(scene, scale=[-1, 1, 1])
    scene["scenes"][0]["nodes"] += cameras
    for node in (scene["nodes"][n] for n in cameras):
        if "matrix" in node:  # by columns
            node["matrix"] = [-v if (i % 4 == 0) != (i < 4) else v for i, v in enumerate(node["matrix"])]
            continue
        x, y, z = node.get("translation", [0, 0, 0])
        a, b, c, d = node.get("rotation", [0, 0, 0, 1])
        node.update(translation=[-x, y, z], rotation=[a, -b, -c, d])


def as_mode(scene, mode):
    """Opaque surfaces have alpha 1, so all modes show the same."""
    for material in scene["materials"]:
        if material.get("alphaMode", "OPAQUE") == "OPAQUE":
            material["alphaMode"] = mode


def camera_in_a_scaled_node(scene, scale):
    """Each camera becomes the child of a scaled node, and has a scale of its own."""
    for node in list(scene["nodes"]):
        if "camera" in node:
            keys = {"camera": node.pop("camera"), "extras": node.pop("extras", {})}
            scene["nodes"].append({**keys, "scale": [2.0, 1 / scale, 1 / scale]})
            node["scale"] = [scale] * 3
            node["children"] = [*node.get("children", []), len(scene["nodes"]) - 1]


def nearer_plane(scene, factor):
    for camera in scene.get("cameras", []):
        if camera["type"] == "perspective":
            camera["perspective"]["znear"] *= factor


# Change, its numbers, the cases that it leaves as they are.
CHANGES = ((in_units, (0.001, 0.1, 1000), CASES), (moved, (10, 1e4), CASES),
           (turned_by, (90, 217), SURFACES + LAMPS), (mirrored, (0,), SURFACES + LAMPS), (as_mode, ("MASK",), CASES),
           (as_mode, ("BLEND",), SURFACES), (camera_in_a_scaled_node, (0.01, 40), CASES), (nearer_plane, (0.1,), CASES))


class Mutations(ProgramCase):
    shares_process = True

    def setUp(self):
        super().setUp()
        self.cases = self.source.parent / "shared" / "cases"
        if not self.cases.is_dir():
            self.skipTest("../shared/cases is absent")
        self.require_device()

    def load(self, case):
        path = self.cases / f"{case}.gltf"
        scene = json.loads(path.read_text())
        for item in [*scene.get("buffers", []), *scene.get("images", [])]:
            if "uri" in item and not item["uri"].startswith("data:"):
                kind = "image/png" if item["uri"].endswith(".png") else "application/octet-stream"
                item["uri"] = f"data:{kind};base64," + base64.b64encode((path.parent / item["uri"]).read_bytes()).decode()
        return scene

    def draw(self, scene):
        (self.folder / "scene.gltf").write_text(json.dumps(scene))
        self.expect(0, "render", "scene.gltf", "--size", "120x80", "--set", "lighting.dither=off", "--out", "scene.png")
        return read_png(self.folder / "scene.png")

    def flipped(self, picture):
        rows = bytearray()
        for y in range(picture.height):
            for x in reversed(range(picture.width)):
                rows += bytes(picture.pixel(x, y))
        return Picture(picture.width, picture.height, bytes(rows))

    def test_changes_that_leave_the_picture_as_it_is(self):
        every = [(case, change, number) for change, numbers, cases in CHANGES for number in numbers for case in cases]
        self.assertGreaterEqual(len(every), 100)
        chosen = every if LONG else every[::17]
        first = {}
        for case, change, number in chosen:
            with self.subTest(case=case, change=change.__name__, number=number):
                scene = self.load(case)
                if case not in first:
                    first[case] = self.draw(copy.deepcopy(scene))
                expected = self.flipped(first[case]) if change is mirrored else first[case]
                change(scene, number)
                found = self.draw(scene)
                most, mean = expected.differences(found)
                off = sum(max(abs(a - b) for a, b in zip(expected.rgb[i:i + 3], found.rgb[i:i + 3])) > 25
                          for i in range(0, len(found.rgb), 3)) / (found.width * found.height)
                # Turned and mirrored shadow maps have their texels elsewhere, which shows at the edges of shadows.
                # That of wide lamps behind several blockers is near only (docs/limits.md).
                wide = 1 if change not in (turned_by, mirrored) else 8 if case.startswith("lamp-behind-rods") else 2
                self.assertTrue(most <= 1 or (mean <= 0.5 * wide and off <= 0.006 * wide), f"mean {mean:.3f}, most {most}, {100 * off:.2f} % off by over 25")
        print(f"{len(chosen)} of {len(every)} changed cases drawn")


if __name__ == "__main__":
    main()
