# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""The same scene at another scale, or at another place, gives the same picture. With GLOAM_LONG_TESTS every scene is tried
at every scale and place."""
import json
import math

from program_case import LONG, ProgramCase, main
from rgb_picture import read_png
from scene_file import SceneFile, turned

SCALES = (0.001, 0.01, 100.0, 1000.0) if LONG else (0.001, 1000.0)
PLACES = (10.0, 1e3, 1e5, 1e6) if LONG else (1e5, 1e6)  # metres from the origin


def with_things(**keys):
    """A floor with a slab, a thin pole and a sheet close above the floor, and a camera that sees it from above."""
    scene = SceneFile(**keys)
    gray, red = scene.material(), scene.material((0.6, 0.3, 0.2), 0.5)
    scene.quad(6.0, gray)
    scene.box((0.4, 0.5, 0.3), red, at=(-0.7, 0.5, 0.1), rotation=turned(1, 0.4))
    scene.box((0.03, 0.8, 0.03), red, at=(0.6, 0.8, -0.4))
    scene.box((0.3, 0.002, 0.2), gray, at=(0.8, 0.05, 0.7))
    scene.camera((0.3, 1.6, 3.2), turned(0, -0.4))
    return scene


def lamp():
    scene = with_things()
    scene.light("point", at=(0.2, 2.1, 0.9), intensity=60, range=9.0, extras={"gloam.light.width": 0.15})
    return scene


def lamp_without_range():
    scene = with_things()
    scene.light("point", at=(0.2, 2.1, 0.9), intensity=60)
    return scene


def spot():
    scene = with_things(exposure=5.0)
    scene.light("spot", at=(0.4, 2.4, 0.4), intensity=300, cone=0.8, range=8.0, extras={"gloam.light.width": 0.1})
    return scene


def sun():
    scene = with_things(sky=(0.2, 0.3, 0.4), exposure=4.0)
    scene.light("directional", rotation=turned(0, -0.9), intensity=30)
    return scene


def closeup():
    scene = spot()
    scene.nodes[1]["extras"]["gloam.closeup"] = True
    scene.light("directional", rotation=turned(0, -0.9), intensity=10, name="moon")
    return scene


def fog():
    """With a part of the sky."""
    scene = lamp()
    scene.nodes[0]["extras"] |= {"gloam.fog.density": 0.15, "gloam.fog.color": [1.0, 1.5, 2.0]}
    return scene


def lens():
    scene = lamp()
    scene.nodes[4]["extras"] |= {"gloam.dof.focus": 2.6, "gloam.dof.f_number": 1.0}
    return scene


def puddle():
    scene = with_things(sky=(0.3, 0.4, 0.6), exposure=4.0)
    wet = scene.material((0.1, 0.1, 0.1), 0.05, **{"gloam.reflectivity": 0.8})
    scene.quad(1.5, wet, at=(0.0, 0.002, 0.5))
    scene.light("point", at=(0.2, 2.1, 0.9), intensity=60, range=9.0)
    return scene


def glass():
    """A blended sheet before the things, and one that lies on the floor."""
    scene = lamp()
    for alpha, at, rotation in ((0.4, (0.2, 0.7, 1.2), turned(0, math.pi / 2)), (0.6, (-0.3, 0.01, 0.9), turned(1, 0.3))):
        sheet = scene.material((0.2, 0.5, 0.7), 0.3)
        scene.materials[sheet] |= {"alphaMode": "BLEND", "doubleSided": True}
        scene.materials[sheet]["pbrMetallicRoughness"]["baseColorFactor"][3] = alpha
        scene.quad(0.5, sheet, at=at, rotation=rotation)
    return scene


def room():
    """A mirror floor whose reflections come from a proxy and from a probe."""
    scene = puddle()
    wall = scene.material((0.7, 0.2, 0.1))
    scene.box((1.5, 0.8, 0.02), wall, at=(0.0, 0.8, -2.0))
    extras = ({"gloam.ibr_proxy.size": [3.0, 1.6]}, {"gloam.ibr_room.size": [8.0, 4.0, 8.0]},
              {"gloam.cube_probe.size": [8.0, 4.0, 8.0], "gloam.cube_probe.resolution": 32})
    for at, keys in zip(((0.0, 0.8, -1.975), (0.0, 1.0, 0.0), (0.0, 1.0, 0.5)), extras):
        scene.nodes.append({"translation": list(at), "rotation": [0, 0, 0, 1], "extras": keys})
    return scene


def smoke():
    scene = with_things(sky=(0.4, 0.5, 0.7), exposure=3.0)
    scene.light("point", at=(0.2, 2.1, 0.9), intensity=60, range=9.0)
    scene.nodes.append({"translation": [0.2, 0.1, 0.6], "rotation": [0, 0, 0, 1], "extras": {
        "gloam.particles": "smoke", "gloam.particles.rate": 30, "gloam.particles.lifetime": 2.5, "gloam.particles.size": 0.25,
        "gloam.particles.speed": 0.4, "gloam.particles.box": [0.3, 0.05, 0.3]}})
    return scene


def lawn(sun=False):
    """Blades in the wind, shadows of blades, and colliders that lay them flat. They are in metres: gloam.scale."""
    scene = SceneFile(sky=(0.3, 0.4, 0.6), exposure=3.0)
    scene.quad(0.7, scene.material((0.3, 0.25, 0.2)), **{"gloam.grass.density": 700, "gloam.grass.height": [0.35, 0.05],
                                                          "gloam.grass.width": 0.01, "gloam.grass.max_distance": 9.0})
    if sun:
        scene.light("directional", rotation=turned(0, -0.9), intensity=30)
    else:
        scene.light("point", at=(0.4, 1.4, 0.5), intensity=30, range=6.0)
    scene.camera((0.2, 0.8, 1.5), turned(0, -0.4))
    for at, keys in (((2.0, 1.0, -1.0), {"gloam.wind.velocity": [6.0, 0.0, 2.0], "gloam.wind.gust": 0.6}),
                     ((-0.35, 0.1, 0.0), {"gloam.collider": "sphere", "gloam.collider.radius": 0.25}),
                     ((0.4, 0.0, 0.1), {"gloam.collider": "box", "gloam.collider.size": [0.3, 0.5, 0.4]}),
                     ((0.1, 0.0, -0.4), {"gloam.collider": "capsule", "gloam.collider.radius": 0.12, "gloam.collider.height": 0.6})):
        scene.nodes.append({"translation": list(at), "rotation": [0, 0, 0, 1], "extras": keys})
    return scene


def turned_about(axis, angle):
    """Turns the whole scene of a file."""
    def change(file):
        file["nodes"].append({"children": list(file["scenes"][0]["nodes"]),
                              "rotation": [*(c * math.sin(0.5 * angle) for c in axis), math.cos(0.5 * angle)]})
        file["scenes"][0]["nodes"] = [len(file["nodes"]) - 1]
    return change


def hall(named=True, metal=False):
    """A mirror floor with posts and panels of light, before a wall with a proxy, in a room with a probe. named: the floor's
    roughness."""
    scene = SceneFile(sky=(0.3, 0.4, 0.6), exposure=1.5)
    mirror = scene.material((0.9, 0.7, 0.3) if metal else (0.03, 0.03, 0.03), 0.0, 1.0 if metal else 0.0, **{"gloam.reflectivity": 1.0})
    if not named:
        del scene.materials[mirror]["pbrMetallicRoughness"]["roughnessFactor"]
    wall, gray = scene.material((0.7, 0.3, 0.2)), scene.material()
    scene.quad(4.0, mirror)
    scene.box((3.0, 1.5, 0.05), wall, at=(0.0, 1.5, -3.0))
    for i, x in enumerate((-1.5, -0.5, 0.5, 1.5)):
        scene.box((0.06, 0.8, 0.06), gray, at=(x, 0.8, -1.0 - 0.3 * i))
    for i, color in enumerate(((1.0, 0.2, 0.1), (0.1, 1.0, 0.2), (0.2, 0.4, 1.0))):
        panel = scene.material((0.0, 0.0, 0.0))
        scene.materials[panel]["emissiveFactor"] = list(color)
        scene.box((0.4, 0.25, 0.03), panel, at=(-1.8 + 1.8 * i, 1.2 + 0.3 * i, -2.5))
    scene.light("point", at=(0.2, 2.6, 0.9), intensity=60, range=12.0)
    extras = ({"gloam.ibr_proxy.size": [6.0, 3.0]}, {"gloam.ibr_room.size": [9.0, 5.0, 9.0]},
              {"gloam.cube_probe.size": [9.0, 5.0, 9.0], "gloam.cube_probe.resolution": 64})
    for at, keys in zip(((0.0, 1.5, -2.9), (0.0, 2.4, 0.0), (0.0, 1.4, 0.3)), extras):
        scene.nodes.append({"translation": list(at), "rotation": [0, 0, 0, 1], "extras": keys})
    scene.camera((0.3, 1.3, 3.2), turned(0, -0.3))
    return scene


def hall_with(half, at):
    """And a cube far away."""
    scene = hall()
    scene.box((half, half, half), 1, at=at)
    return scene


class Scale(ProgramCase):
    shares_process = True

    def setUp(self):
        super().setUp()
        self.require_device()

    def picture(self, name, scene, *options, **how):
        scene.write(self.folder / (name + ".gltf"), **how)
        self.expect(0, "render", name + ".gltf", "--size", "160x108", "--out", name + ".png", *options)
        return read_png(self.folder / (name + ".png"))

    def same(self, make, *options, scales=SCALES, places=PLACES, physics=False):
        first = self.picture("first", make(), *options)
        self.assertGreater(first.mean(), 8)
        for scale in scales:
            with self.subTest(scale=scale):
                most, mean = first.differences(self.picture("scaled", make(), *options, scale=scale, physics=physics))
                self.assertLessEqual(mean, 0.5, f"most {most}")
        for place in places:
            with self.subTest(place=place):
                other = self.picture("moved", make(), *options, offset=(place, 0.25 * place, -0.5 * place))
                pixels = [max(abs(a - b) for a, b in zip(first.rgb[i:i + 3], other.rgb[i:i + 3])) for i in range(0, len(first.rgb), 3)]
                self.assertLessEqual(sum(step > 25 for step in pixels) / len(pixels), 0.001, f"mean {sum(pixels) / len(pixels)}")

    # Hard case: selftest.moved, selftest.scaled, further.at_100_km, further.at_1000_km
    def test_lamp(self):
        self.same(lamp)

    # Hard case: selftest.moved, further.at_100_km, further.at_1000_km
    def test_lamp_without_range(self):
        self.same(lamp_without_range)

    # Hard case: selftest.moved, selftest.scaled, further.at_100_km, further.at_1000_km
    def test_spot(self):
        self.same(spot)

    # Hard case: selftest.moved, selftest.scaled, further.at_100_km, further.at_1000_km
    def test_sun(self):
        self.same(sun)

    # Hard case: selftest.moved, selftest.scaled, further.at_100_km, further.at_1000_km
    def test_closeups(self):
        self.same(closeup)

    # Hard case: selftest.moved, selftest.scaled, further.at_100_km, further.at_1000_km
    def test_physics(self):
        # Fog, lenses and candela are physics: gloam.scale says how large a unit is, and their keys stay as they are.
        for make in (fog, lens):
            self.same(make, physics=True)

    # Hard case: selftest.moved, selftest.scaled, further.at_100_km, further.at_1000_km
    def test_mirrors(self):
        self.same(puddle)

    # Hard case: selftest.moved, further.at_100_km, further.at_1000_km
    def test_planar_mirrors(self):
        self.same(puddle, "--set", "reflections.mode=planar", physics=True)

    # Hard case: selftest.moved, selftest.scaled, further.at_100_km, further.at_1000_km
    def test_proxies_and_probes(self):
        self.same(room, "--set", "reflections.tiers=ibr+cube", physics=True)

    # Hard case: reflections.scaled
    def test_mirrors_with_all_tiers_without_the_key_of_scale(self):
        first = self.picture("first", hall())
        for name, scene, how in (*((f"scaled{scale}", hall(), {"scale": scale}) for scale in (0.001, 0.01, 100.0)),
                                 ("moved", hall(), {"offset": (5e3, 1.25e3, -2.5e3)}), ("tiny", hall_with(1e-4, (50.0, 9.0, 90.0)), {}),
                                 ("huge", hall_with(1e4, (0.0, 0.0, 1e5)), {}), ("small", hall_with(1e-4, (50.0, 9.0, 90.0)), {"scale": 0.01})):
            with self.subTest(name):
                most, mean = first.differences(self.picture(name, scene, **how))
                self.assertLessEqual(most, 2)
                self.assertLessEqual(mean, 0.02)

    # Hard case: reflections.no_roughness
    def test_a_mirror_that_does_not_name_its_roughness_is_one_of_roughness_0(self):
        for metal in (False, True):
            with self.subTest(metal=metal):
                first = self.picture("first", hall(metal=metal))
                other = self.picture("unnamed", hall(named=False, metal=metal))
                self.assertEqual(first.differences(other), (0, 0))
                rough = hall(metal=metal)
                rough.materials[0]["pbrMetallicRoughness"]["roughnessFactor"] = 1.0
                self.assertGreater(first.differences(self.picture("rough", rough))[1], 2.0)

    # Hard case: selftest.moved, further.at_100_km, further.at_1000_km
    def test_blended_surfaces(self):
        self.same(glass)

    # Hard case: selftest.moved, selftest.scaled, further.at_100_km, further.at_1000_km
    def test_particles(self):
        self.same(smoke, "--time", "3", physics=True)

    # Hard case: selftest.moved, selftest.scaled, further.at_100_km, further.at_1000_km
    def test_grass(self):
        self.same(lawn, "--frames", "20", physics=True)

    def test_grass_in_the_sun(self):
        self.same(lambda: lawn(sun=True), "--frames", "20", "--dt", "0.05", physics=True, scales=SCALES if LONG else (1000.0,), places=())

    def test_grass_of_an_orthographic_camera(self):
        def flat():
            scene = lawn()
            scene.cameras[0] = {"type": "orthographic", "orthographic": {"xmag": 0.9, "ymag": 0.6, "znear": 0.05, "zfar": 9.0}}
            return scene
        self.same(flat, "--frames", "12", physics=True, scales=SCALES if LONG else (0.001,), places=())

    def test_bias_of_rasterisers_and_other_filters(self):
        for setting in ("shadows.bias=hardware", "shadows.filter=pcss", "shadows.depth=d16"):
            self.same(lamp, "--set", setting, scales=(0.001, 1000.0) if LONG else (0.001,), places=())

    def test_the_reference_of_shadows(self):
        self.same(lamp, "--view", "shadow_reference:key", scales=(0.001, 1000.0))

    # Hard case: further.huge_triangle
    def test_the_sun_over_ground_of_any_width(self):
        first, rows = self.picture("first", sun()), 60  # the ground of all fills the last rows
        for half in (50.0, 1e3, 5e3, 1e5, 1e7, 1e9) if LONG else (1e3, 5e3, 1e9):
            with self.subTest(half=half):
                scene = sun()
                scene.meshes[0] = ([(x * half / 6.0, y, z * half / 6.0) for x, y, z in scene.meshes[0][0]], *scene.meshes[0][1:])
                other = self.picture("wide", scene)
                steps = [abs(a - b) for a, b in zip(first.rgb[-3 * 160 * rows:], other.rgb[-3 * 160 * rows:])]
                self.assertLessEqual(sum(steps) / len(steps), 0.5)

    def test_the_sun_over_a_ground_with_many_other_triangles(self):
        # The ground and 5,000 small triangles, below it, are one mesh.
        def town(half):
            scene = sun()
            positions, normals, indices, material = scene.meshes[0]
            small = [(0.01 * (i % 71) + dx, -1.0, 0.01 * (i // 71) + dz) for i in range(5000) for dx, dz in ((0, 0), (0, 0.01), (0.01, 0))]
            scene.meshes[0] = ([(x * half / 6.0, y, z * half / 6.0) for x, y, z in positions] + small, normals + [normals[0]] * len(small),
                               indices + list(range(4, 4 + len(small))), material)
            return scene
        first, rows = self.picture("first", town(6.0)), 60
        for half in (1e5, 1e9) if LONG else (1e9,):
            with self.subTest(half=half):
                other = self.picture("wide", town(half))
                steps = [abs(a - b) for a, b in zip(first.rgb[-3 * 160 * rows:], other.rgb[-3 * 160 * rows:])]
                self.assertLessEqual(sum(steps) / len(steps), 0.5)

    def picture_of_ground(self, name, scene, half, *options, change=None):
        """The scene with a ground of another width. change: of the file."""
        scene.meshes[0] = ([(x * half / 6.0, y, z * half / 6.0) for x, y, z in scene.meshes[0][0]], *scene.meshes[0][1:])
        path = self.folder / (name + ".gltf")
        scene.write(path)
        if change:
            file = json.loads(path.read_text())
            change(file)
            path.write_text(json.dumps(file))
        self.expect(0, "render", path.name, "--size", "160x108", "--out", name + ".png", *options)
        return read_png(self.folder / (name + ".png"))

    def same_ground(self, first, other):
        rows = 60  # the ground of all fills the last rows
        steps = [abs(a - b) for a, b in zip(first.rgb[-3 * 160 * rows:], other.rgb[-3 * 160 * rows:])]
        self.assertLessEqual(sum(steps) / len(steps), 0.5)

    def test_the_reference_over_a_slanted_ground_of_any_width(self):
        shown = ("--view", "shadow_reference:key")
        first = self.picture_of_ground("first", sun(), 6.0, *shown, change=turned_about((0.36, 0.48, 0.8), 0.7))
        for half in (1e4, 1e6, 1e9) if LONG else (1e4, 1e9):
            with self.subTest(half=half):
                self.same_ground(first, self.picture_of_ground("wide", sun(), half, *shown, change=turned_about((0.36, 0.48, 0.8), 0.7)))

    def test_shadows_over_a_slanted_ground_of_any_width(self):
        for axis, angle in (((0.0, 0.0, 1.0), math.atan(1 / 3)), ((0.36, 0.48, 0.8), 0.7)):
            first = self.picture_of_ground("first", sun(), 6.0, change=turned_about(axis, angle))
            for half in (1e3, 1e4, 1e5, 1e7) if LONG else (1e4, 1e7):
                with self.subTest(angle=angle, half=half):
                    self.same_ground(first, self.picture_of_ground("wide", sun(), half, change=turned_about(axis, angle)))

    # Hard case: selftest.depth_range
    def test_near_planes(self):
        for kind in ("perspective", "orthographic"):
            def with_near(near, kind=kind):
                scene = lamp()
                if kind == "perspective":
                    scene.cameras[0]["perspective"]["znear"] = near
                else:
                    scene.cameras[0] = {"type": kind, kind: {"xmag": 3.0, "ymag": 2.0, "znear": near, "zfar": 50.0}}
                return scene
            first = self.picture("first", with_near(0.05))
            for near in (1e-3, 1e-6, 1e-9, 1e-12, 1e-18) if LONG else (1e-6, 1e-18):
                with self.subTest(kind=kind, near=near):
                    self.assertLessEqual(first.differences(self.picture("near", with_near(near)))[1], 0.5)
        scene = lamp()
        scene.cameras[0]["perspective"]["znear"] = 1e-24
        scene.write(self.folder / "least.gltf")
        self.expect(3, "render", "least.gltf", says="znear must be at least 1e-20")


if __name__ == "__main__":
    main()
