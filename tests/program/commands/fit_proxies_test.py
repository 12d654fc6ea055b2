# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `bake --fit-proxies`: the nodes that it writes are a scene's proxies, and its report is reproducible."""
import base64
import json
import struct

from program_case import ProgramCase, main

# A wet floor of 12 m × 12 m around the origin, and a wall along each of two sides.
CORNERS = [[(-6, 0, -6), (-6, 0, 6), (6, 0, 6), (6, 0, -6)], [(-6, 0, -6), (6, 0, -6), (6, 4, -6), (-6, 4, -6)],
           [(-6, 0, 6), (-6, 0, -6), (-6, 3, -6), (-6, 3, 6)]]


def yard(extra_nodes=(), scale=1.0, offset=(0.0, 0.0, 0.0), key=True):
    """scale: units of a metre. offset: of the whole yard, units. key: with gloam.scale."""
    positions = b"".join(struct.pack("<3f", *(scale * c for c in quad[i])) for quad in CORNERS for i in (0, 1, 2, 0, 2, 3))
    mesh = [{"primitives": [{"attributes": {"POSITION": i}, "material": min(i, 1)}]} for i in range(3)]
    nodes = [{"mesh": i} for i in range(3)]
    nodes.append({"camera": 0, "name": "eye", "translation": [3 * scale, 1.7 * scale, 5 * scale], "rotation": [-0.17, 0, 0, 0.985]})
    for node in nodes:
        node["translation"] = [t + o for t, o in zip(node.get("translation", (0, 0, 0)), offset)]
    nodes.extend(extra_nodes)
    accessors = [{"bufferView": 0, "byteOffset": 72 * i, "componentType": 5126, "count": 6, "type": "VEC3",
                  "min": [-6 * scale, 0, -6 * scale], "max": [6 * scale, 4 * scale, 6 * scale]} for i in range(3)]
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes))), "extras": {"gloam.scale": 1.0 / scale} if key else {}}],
        "nodes": nodes,
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.1 * scale}}], "meshes": mesh,
        "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": r}} for r in (0.1, 0.9)],
        "accessors": accessors, "bufferViews": [{"buffer": 0, "byteLength": len(positions)}],
        "buffers": [{"byteLength": len(positions),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(positions).decode()}],
    }


def shares(report):
    """(fitted, existing) in percent for each viewer of the report."""
    rows = {}
    for line in report.splitlines():
        words = line.replace("%", "").split()
        if words and words[0] in ("camera", "eyes", "all") and words[-1] != "-":
            rows[" ".join(words[:-4])] = (float(words[-2]), float(words[-1]))
    return rows


class FitProxies(ProgramCase):
    def fit(self, scene, *arguments):
        (self.folder / "yard.gltf").write_text(json.dumps(scene))
        return self.expect(0, "bake", "yard.gltf", "--fit-proxies", "4", *arguments).stdout

    def test_the_written_nodes_catch_what_the_report_says(self):
        fitted = shares(self.fit(yard()))
        self.assertEqual(set(fitted), {"camera eye", "eyes", "all"})
        for viewer, (caught, existing) in fitted.items():
            self.assertGreater(caught, 85.0, viewer)
            self.assertEqual(existing, 0.0, viewer)
        nodes = self.read_json("out/yard.proxies.json")["nodes"]
        self.assertGreaterEqual(len(nodes), 2)
        self.assertLessEqual(len(nodes), 4)
        for viewer, (_, existing) in shares(self.fit(yard(nodes))).items():
            self.assertAlmostEqual(existing, fitted[viewer][0], delta=0.3, msg=viewer)

    def test_the_report_is_the_same_again_and_with_other_threads(self):
        first = self.fit(yard(), "--out", "a.json")
        self.assertEqual(self.fit(yard(), "--out", "b.json", "--threads", "1").replace("b.json", "a.json"), first)
        self.assertEqual(self.read_json("a.json"), self.read_json("b.json"))

    def test_units_and_places_do_not_matter(self):
        expected = shares(self.fit(yard()))
        nodes = self.read_json("out/yard.proxies.json")["nodes"]
        cases = [(scale, (0.0, 0.0, 0.0), True) for scale in (0.001, 0.01, 100.0, 1000.0)]
        cases += [(1.0, (1e6, 2e5, -5e5), True), (100.0, (1e8, 0.0, 0.0), True)]
        cases += [(scale, (0.0, 0.0, 0.0), False) for scale in (0.01, 100.0)]
        for scale, offset, key in cases:
            with self.subTest(scale=scale, offset=offset, key=key):
                found = shares(self.fit(yard(scale=scale, offset=offset, key=key)))
                own = self.read_json("out/yard.proxies.json")["nodes"]
                self.assertEqual(len(own), len(nodes))
                for node, other in zip(own, nodes):
                    self.assertNear([(t - o) / scale for t, o in zip(node["translation"], offset)], other["translation"], 0.002)
                    self.assertNear([s / scale for s in node["extras"]["gloam.ibr_proxy.size"]], other["extras"]["gloam.ibr_proxy.size"], 0.002)
                    self.assertNear(node["rotation"], other["rotation"], 1e-5)
                for viewer, (caught, _) in found.items():
                    self.assertAlmostEqual(caught, expected[viewer][0], delta=0.3, msg=viewer)
                again = shares(self.fit(yard(own, scale=scale, offset=offset, key=key)))
                for viewer, (_, existing) in again.items():
                    self.assertAlmostEqual(existing, expected[viewer][0], delta=0.3, msg=viewer)

    def assertNear(self, found, expected, delta):
        for a, b in zip(found, expected):
            self.assertAlmostEqual(a, b, delta=delta)

    def test_a_scene_that_reflects_nothing_gets_its_largest_quads(self):
        scene = yard()
        scene["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 1
        self.assertIn("the largest quads were taken", self.fit(scene))
        self.assertTrue(self.read_json("out/yard.proxies.json")["nodes"])

    def test_bad_input_is_refused(self):
        self.expect(3, "bake", "absent.gltf", "--fit-proxies", "4")
        self.expect(2, "bake", "builtin:lanterns", "--fit-proxies", "some")


if __name__ == "__main__":
    main()
