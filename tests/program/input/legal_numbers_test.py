# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Draws scenes with legal but unusual numbers and surfaces. Each gives the right picture, or one sentence."""
import base64
import itertools
import math

from gltf_scene import FLOAT, UNSIGNED_SHORT, GltfScene, turn_x, turn_y
from program_case import ProgramCase, main
from rgb_picture import Picture, read_png

ALL_KEYS = {"gloam.closeup": True, "gloam.ibr_proxy.size": [1, 1], "gloam.ibr_room.size": [4, 4, 4],
            "gloam.cube_probe.size": [4, 4, 4], "gloam.collider": "sphere", "gloam.collider.radius": 1,
            "gloam.wind.velocity": [1, 0, 0], "gloam.particles": "smoke"}
SUN = {"type": "directional", "intensity": 2}
FROM_ABOVE = {"rotation": turn_x(-64), "name": "sun"}  # shines down, and a little to -Z


def png(rgb):
    """A PNG of one pixel, as a data URI."""
    return "data:image/png;base64," + base64.b64encode(Picture(1, 1, bytes(rgb)).png()).decode()


def lit_card(**camera):
    """A white card at the origin, lit by a lamp, and the camera `eye`."""
    scene = GltfScene()
    scene.node(mesh=scene.card(scene.material(), half=0.8))
    scene.light(light={"type": "point", "intensity": 12}, translation=[0.3, 1, 3])
    scene.camera(name="eye", translation=[0.2, 0.1, 3], **camera)
    return scene


class LegalNumbers(ProgramCase):
    shares_process = True

    def setUp(self):
        super().setUp()
        self.require_device()
        self.drawn = 0

    def render(self, scene, *options, code=0, says="", size="48x32", out=None):
        """The picture with a linear tone curve, or None if the program ends with another code than 0."""
        self.drawn += 1
        name = f"{self.drawn}.gltf"
        (self.folder / name).write_text(scene.text() if isinstance(scene, GltfScene) else scene)
        run = self.expect(code, "render", name, "--size", size, "--set", "lighting.tone_map=linear", "--set",
                          "lighting.dither=off", "--out", out or f"{self.drawn}.png", *options, says=says)
        self.said = run.stderr
        return read_png(self.folder / f"{self.drawn}.png") if code == 0 and not out else None

    def assert_same(self, a, b, most=1, says=""):
        """No channel of the pictures differs by more than `most` steps."""
        self.assertLessEqual(max(abs(x - y) for x, y in zip(a.rgb, b.rgb)), most, says)

    def mean(self, picture):
        return sum(picture.rgb) / len(picture.rgb)

    def middle(self, picture):
        return picture.rgb[3 * (picture.height // 2 * picture.width + picture.width // 2)]

    # Cameras

    def test_a_camera_without_a_direction_is_refused_by_name(self):
        zero, line = [0, 0, 0], [0, 0, 1]
        for scale in (zero, line, [1, 0, 0]):
            self.render(lit_card(scale=scale), code=3, says='camera "eye" has no direction')
        parent = lit_card()
        parent.json["scenes"][0]["nodes"].remove(2)
        parent.node(scale=zero, children=[2])
        self.render(parent, code=3, says="has no direction")
        flat = lit_card()
        del flat.json["nodes"][2]["translation"]
        flat.json["nodes"][2].update(matrix=[1, 2, 3, 0, 2, 4, 6, 0, -1, -2, -3, 0, 0, 0, 0, 1])
        self.render(flat, code=3, says="has no direction")
        moved = lit_card()
        moved.animate(2, "scale", [0, 1], [0, 0, 0, 1, 1, 1])
        self.render(moved, code=3, says="has no direction")
        self.render(moved, "--time", "0.5")

    def test_the_scale_of_a_camera_changes_nothing(self):
        plain = self.render(lit_card())
        self.assertGreater(self.mean(plain), 20)
        for scale in ([1, 1, 0], [1, 0, 1], [0, 1, 1], [1e-30] * 3, [1e30] * 3, [1e-300, 1e-300, 1e-300], [-1, 1, 1]):
            self.assert_same(plain, self.render(lit_card(scale=scale)), says=str(scale))

    def test_a_camera_that_passes_through_zero_keeps_its_last_direction(self):
        scene = lit_card()
        scene.animate(2, "scale", [0, 1, 2, 4], [1, 1, 1, 0, 0, 0, 0, 0, 0, -1, -1, -1])
        self.render(scene, "--frames", "4", "--dt", "1", out="f_%04d.png")
        frames = [read_png(self.folder / f"f_{i:04d}.png") for i in range(3)]
        self.assertGreater(self.mean(frames[0]), 20)
        self.assert_same(frames[0], frames[1])
        self.assert_same(frames[0], frames[2])

    def test_singular_and_extreme_nodes_never_crash(self):
        def everything(scale):
            scene = lit_card()
            top = scene.node(scale=scale)
            for light in ({"type": "point", "intensity": 5, "range": 4}, {"type": "spot", "intensity": 5, "spot": {}},
                          {"type": "directional", "intensity": 1}):
                scene.light(top, light)
            for key in ("gloam.ibr_proxy.size", "gloam.ibr_room.size", "gloam.cube_probe.size", "gloam.particles"):
                scene.node(top, extras={key: ALL_KEYS[key]})
            collider = ("gloam.collider", "gloam.collider.radius")
            scene.node(top, extras={key: ALL_KEYS[key] for key in collider})
            scene.node(top, mesh=scene.card(scene.material(doubleSided=True)), extras={"gloam.closeup": True})
            ground = scene.card(scene.material(), half=0.3)
            scene.node(scene.node(top, rotation=turn_x(-90)), mesh=ground, extras={"gloam.grass.density": 100})
            scene.node(top, mesh=scene.card(scene.material(emissiveFactor=[1, 1, 1]), half=0.01))
            joints = scene.numbers("VEC4", [0, 0, 0, 0] * 4, UNSIGNED_SHORT)
            weights = scene.numbers("VEC4", [1, 0, 0, 0] * 4)
            skinned = scene.card(scene.material(), more={"JOINTS_0": joints, "WEIGHTS_0": weights})
            scene.add("skins", {"joints": [scene.node(top)]})
            scene.node(mesh=skinned, skin=0)
            return scene

        for scale in ([0, 0, 0], [1, 0, 0], [0, 1, 1], [-1, -1, -1], [1e-30] * 3, [1e-38, 1, 1], [1e18] * 3, [1e37] * 3):
            (self.folder / "all.gltf").write_text(everything(scale).text())
            run = self.run_program("render", "all.gltf", "--size", "32x32", "--frames", "2", "--out", "all.png")
            self.assertIn(run.returncode, (0, 3), f"{scale}: {run.stderr}")

    # Sides of surfaces

    def bent_card(self, double_sided, from_behind=False, scale=(1, 1, 1), normal=(0, 0.9, -0.436), **material):
        scene = GltfScene()
        card = scene.card(scene.material(doubleSided=double_sided, **material), normal=normal)
        scene.node(mesh=card, scale=list(scale))
        scene.light(light=SUN, **FROM_ABOVE)
        scene.camera(translation=[0.1, 0.2, -3 if from_behind else 3], rotation=turn_y(180 if from_behind else 0))
        return scene

    def test_normals_that_lean_to_the_back_do_not_swap_the_sides(self):
        for scale, alpha in itertools.product(((1, 1, 1), (-1, 1, 1), (1, -1, 1), (1, 1, -1)), ("OPAQUE", "MASK", "BLEND")):
            turned = scale[1] < 0
            normal = (0, -0.9 if turned else 0.9, -0.436 if scale[2] > 0 else 0.436)
            says = f"{scale} {alpha}"
            one, both = (self.bent_card(double, False, scale, normal, alphaMode=alpha) for double in (False, True))
            front = self.render(both)
            if scale[2] > 0:
                self.assertGreater(self.middle(front), 100, says)
                self.assert_same(self.render(one), front, says=says)
                self.assertEqual(self.mean(self.render(self.bent_card(True, True, scale, normal, alphaMode=alpha))), 0, says)
            else:
                self.assertEqual(self.mean(self.render(one)), 0, says)

    def test_a_normal_map_that_leans_to_the_back_does_not_swap_the_sides(self):
        pictures = []
        for double, behind in ((False, False), (True, False), (True, True)):
            scene = GltfScene()
            scene.add("images", {"uri": png((128, 242, 74))})  # leans up and to the back
            scene.add("textures", {"source": 0})
            uv = {"TEXCOORD_0": scene.numbers("VEC2", [0, 1, 1, 1, 1, 0, 0, 0]),
                  "TANGENT": scene.numbers("VEC4", [1, 0, 0, 1] * 4)}
            material = scene.material(doubleSided=double, normalTexture={"index": 0})
            scene.node(mesh=scene.card(material, more=uv))
            scene.light(light=SUN, **FROM_ABOVE)
            scene.camera(translation=[0, 0, -3 if behind else 3], rotation=turn_y(180 if behind else 0))
            pictures.append(self.render(scene))
        self.assertGreater(self.middle(pictures[0]), 60)
        self.assert_same(pictures[0], pictures[1])
        self.assertEqual(self.mean(pictures[2]), 0)

    def test_the_back_is_shaded_as_a_card_with_reversed_normals(self):
        both = self.bent_card(True, True, normal=(0, -0.9, 0.436))
        reversed_card = GltfScene()
        card = reversed_card.card(reversed_card.material(), normal=(0, 0.9, -0.436), reversed_winding=True)
        reversed_card.node(mesh=card)
        reversed_card.light(light=SUN, rotation=turn_x(-116))
        reversed_card.camera(translation=[0.1, 0.2, -3], rotation=turn_y(180))
        both.json["nodes"][1]["rotation"] = turn_x(-116)  # onto the back
        back = self.render(both)
        self.assertGreater(self.middle(back), 100)
        self.assert_same(self.render(reversed_card), back)

    # Lights

    def lamp_picture(self, distance, exposure, **light):
        scene = GltfScene(exposure=exposure)
        scene.node(mesh=scene.card(scene.material((0.5, 0.5, 0.5, 1)), half=distance))
        scene.light(light={"type": "point", "intensity": 1, **light}, translation=[0, 0, distance])
        scene.camera(translation=[0, 0, 2])
        return self.render(scene, "--set", "shadows.mode=off")

    # Hard case: shadows.without_range
    def test_a_lamp_without_a_range_has_no_end_that_can_be_seen(self):
        for distance in (12.4, 100.0):
            self.assertGreater(self.mean(self.lamp_picture(distance, None)), 10, distance)
            lux = 1 / distance**2
            shown = (self.middle(self.lamp_picture(distance, math.log2(lux) - 2)) / 255 + 0.055) / 1.055
            self.assertAlmostEqual(shown**2.4, 0.5 / math.pi * 4 / 1.2, delta=0.02)

    # Hard case: selftest.range
    def test_the_window_of_a_range_is_that_of_the_extension(self):
        for share in (0.3, 0.7, 0.9, 0.99):
            window = 1 - share**4
            shown = (self.middle(self.lamp_picture(4.0, math.log2(window / 16) - 2, range=4 / share)) / 255 + 0.055) / 1.055
            self.assertAlmostEqual(shown**2.4, 0.5 / math.pi * 4 / 1.2, delta=0.02, msg=share)

    # Hard case: scene.largest_range, selftest.range, further.denormals
    def test_any_range_that_is_a_float_is_drawn(self):
        endless = self.lamp_picture(4.0, -4)
        for range_m in (3.4e38, 3.4028234663852886e38, 1e20):
            self.assert_same(endless, self.lamp_picture(4.0, -4, range=range_m))
        for range_m in (1e-30, 1e-45):
            self.assertEqual(self.mean(self.lamp_picture(4.0, -4, range=range_m)), 0)
        scene = lit_card()
        for refused in (0, -1, 1e39):
            scene.json["extensions"]["KHR_lights_punctual"]["lights"][0]["range"] = refused
            self.render(scene, code=3, says="range must be a number above 0")

    def test_a_spot_without_a_spot_object_has_the_default_cone(self):
        def spot(**cone):
            scene = GltfScene()
            scene.node(mesh=scene.card(scene.material(), half=4))
            scene.light(light={"type": "spot", "intensity": 9, **cone}, translation=[0, 0, 2])
            scene.camera(translation=[0, 0, 6])
            return self.render(scene)

        plain = spot()
        self.assert_same(plain, spot(spot={"innerConeAngle": 0, "outerConeAngle": math.pi / 4}))
        self.assertGreater(self.middle(plain), 100)
        self.assertEqual(plain.rgb[0], 0)

    # Hard case: scene.sky_zero
    def test_a_sky_of_zero_is_black(self):
        scene = GltfScene(exposure=3)
        scene.node(mesh=scene.card(scene.material()))
        scene.camera(translation=[0, 0, 3])
        self.assertEqual(self.mean(self.render(scene)), 0)
        for part in ("zenith", "horizon", "ground"):
            del scene.json["scenes"][0]["extras"][f"gloam.sky.{part}"]
        self.assertGreater(self.mean(self.render(scene)), 50)
        self.assertIn("no light and no sky", self.said)

    # Numbers of cameras and meshes

    def test_zfar_of_a_perspective_camera_is_said_to_be_ignored(self):
        lens = {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}
        scene = lit_card(lens=lens)
        plain = self.render(scene)
        self.assertNotIn("zfar", self.said)
        for far, cuts in ((1, True), (2.9, True), (3.1, False), (100, False), (1e300, False)):
            scene.json["cameras"][0]["perspective"]["zfar"] = far
            self.assert_same(plain, self.render(scene), most=0)
            self.assertEqual(self.said.count("zfar is ignored"), int(cuts), self.said)

    def gradient(self, kind):
        """A strip whose brightness rises from 0 to 0.02 over 257 columns."""
        scene = GltfScene(exposure=math.log2(0.02 / math.pi / 1.2))
        columns, half = 257, 2.0
        xs = [half * (2 * i / (columns - 1) - 1) for i in range(columns)]
        values = [0.02 * i / (columns - 1) for i in range(columns) for _ in range(2)]
        attributes = {"POSITION": scene.numbers("VEC3", [n for x in xs for y in (-1.0, 1.0) for n in (x, y, 0.0)]),
                      "NORMAL": scene.numbers("VEC3", [0, 0, 1] * (2 * columns))}
        if kind == FLOAT:
            attributes["COLOR_0"] = scene.numbers("VEC3", [v for v in values for _ in range(3)])
        else:
            attributes["COLOR_0"] = scene.numbers("VEC4", [n for v in values for n in (*[round(65535 * v)] * 3, 65535)],
                                                  UNSIGNED_SHORT, normalized=True)
        order = [n for i in range(0, 2 * columns - 2, 2) for n in (i, i + 2, i + 1, i + 1, i + 2, i + 3)]
        primitive = {"attributes": attributes, "indices": scene.numbers("SCALAR", order, 5125), "material": scene.material()}
        scene.node(mesh=scene.add("meshes", {"primitives": [primitive]}))
        scene.light(light={"type": "directional", "intensity": 1})
        lens = {"type": "orthographic", "orthographic": {"xmag": half, "ymag": half / 16, "znear": 0.1, "zfar": 9}}
        scene.camera(translation=[0, 0, 3], lens=lens)
        return self.render(scene, size="256x16")

    def test_dark_vertex_colours_are_smooth(self):
        for kind in (FLOAT, UNSIGNED_SHORT):
            picture = self.gradient(kind)
            row = picture.rgb[3 * 8 * 256:3 * 9 * 256:3]
            linear = [(v / 255 / 12.92 if v < 11 else ((v / 255 + 0.055) / 1.055)**2.4) for v in row]
            steps = [b - a for a, b in zip(linear, linear[1:])]
            self.assertGreater(linear[-1], 0.9, "the gradient ends at white")
            self.assertLessEqual(max(steps), 0.06 + 0.01, kind)
            self.assertGreaterEqual(min(steps), 0, kind)

    def test_a_morphed_card_without_normals_is_shaded_as_it_is_drawn(self):
        def card(normal, morphed, double=False):
            scene = GltfScene()
            targets = [{"POSITION": scene.numbers("VEC3", [0, 0, 0, 0, 0, 0, 0, 0, -2, 0, 0, -2])}]
            mesh = scene.card(scene.material(doubleSided=double), normal=normal, targets=targets if morphed else None)
            if morphed:
                scene.json["meshes"][mesh]["weights"] = [1]
                scene.node(mesh=mesh)
            else:  # the same plane: turned back by 45 degrees about the lower edge, and longer
                scene.node(mesh=mesh, translation=[0, 0, -1], rotation=turn_x(-45), scale=[1, math.sqrt(2), 1])
            scene.light(light=SUN, rotation=turn_x(-80))
            scene.camera(translation=[0, 0.2, 3])
            return self.render(scene)

        expected = card((0, 0, 1), False)
        self.assertGreater(self.middle(expected), 60)
        for double in (False, True):
            self.assert_same(expected, card(None, True, double), most=2)


if __name__ == "__main__":
    main()
