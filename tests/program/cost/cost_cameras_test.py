# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `cost --cameras` and `cost --path`. Needs a Vulkan device."""
import csv

from gltf_scene import GltfScene
from program_case import ProgramCase, main

KNOBS = "lighting.tone_map,shadows.filter"
TINY = ("--quick", "--size", "48x27", "--knobs", KNOBS)


class CostCameras(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()
        # Camera `lit` sees a lit card with a shadow on it; `dark` looks away from everything.
        scene = GltfScene()
        scene.node(mesh=scene.card(scene.material(), half=3.0))
        scene.node(mesh=scene.card(scene.material(), half=0.4), translation=[0, 0, 1])
        scene.light(light={"type": "point", "intensity": 60}, translation=[0.5, 0.5, 3])
        scene.camera(translation=[0, 0, 5], name="lit")
        moving = scene.camera(translation=[0, 0, 5], name="dark", rotation=[0, 1, 0, 0])
        (self.folder / "two.gltf").write_text(scene.text())
        scene.animate(moving, "rotation", [0, 1, 2], [0, 0, 0, 1, 0, 0.7071068, 0, 0.7071068, 0, 1, 0, 0])
        (self.folder / "moving.gltf").write_text(scene.text())

    def rows(self, rows):
        return {(row["knob"], row["value"]): row for row in rows}

    def check_worst(self, ledger):
        worst = self.rows(ledger["rows"])
        cameras = [self.rows(camera["rows"]) for camera in ledger["cameras"]]
        for key, row in worst.items():
            own = [rows[key] for rows in cameras]
            self.assertEqual(row["ratio"], max(one["ratio"] for one in own), key)
            self.assertEqual(row["ms"]["median"], max(one["ms"]["median"] for one in own), key)
            self.assertEqual(row["gpu_bytes"], max(one["gpu_bytes"] for one in own), key)
            self.assertEqual(row["no_effect"], all(one["no_effect"] for one in own), key)
            if "flip" in row["error"]:
                self.assertEqual(row["error"]["flip"]["mean"], max(one["error"]["flip"]["mean"] for one in own), key)
        return worst, cameras

    def test_the_ledger_is_the_worst_of_its_cameras_and_has_each(self):
        run = self.expect(0, "cost", "two.gltf", *TINY, "--cameras", "dark,lit", "--points", "0", "--out", "both")
        self.assertIn("worst of 2 cameras", run.stdout)
        self.assertNotIn("combinations", run.stdout)
        ledger = self.read_json("both/ledger.json")
        self.assertEqual((ledger["camera"], [camera["camera"] for camera in ledger["cameras"]]), ("dark,lit", ["dark", "lit"]))
        worst, (dark, lit) = self.check_worst(ledger)
        key = ("shadows.filter", "hard")
        self.assertGreater(lit[key]["error"]["flip"]["mean"], dark[key]["error"]["flip"]["mean"])
        self.assertEqual(worst[key]["picture"], lit[key]["picture"], "the worst error's picture is of its camera")
        with open(self.folder / "both/ledger.csv", encoding="utf-8", newline="") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual([line["camera"] for line in lines], [name for name in ("dark,lit", "dark", "lit") for _ in worst])
        page = (self.folder / "both/report.html").read_text()
        self.assertIn('<a href="#cameras">', page)
        self.assertIn("Camera dark at 0 s", page)
        self.assertIn("the worst of 2 cameras", page)

        # Each camera's rows are those of a run with that camera alone, and resume each other.
        run = self.expect(0, "cost", "two.gltf", *TINY, "--points", "0", "--camera", "lit", "--out", "both")
        self.assertIn(f"{len(lit)} of {len(lit)} rows were measured before", run.stdout)
        alone = self.read_json("both/ledger.json")
        self.assertEqual(self.rows(alone["rows"]), lit)
        self.assertNotIn("cameras", alone)
        self.assertNotIn('id="cameras"', (self.folder / "both/report.html").read_text())

    def test_combinations_are_measured_in_all_cameras(self):
        self.expect(0, "cost", "two.gltf", *TINY, "--cameras", "dark,lit", "--points", "4", "--out", "points")
        ledger = self.read_json("points/ledger.json")
        self.assertGreaterEqual(len(ledger["points"]), 2)
        standard, = (point for point in ledger["points"] if point["default"])
        shown = max((0, 1), key=lambda camera: standard["cameras"][camera]["whole_frame"]["flip"]["mean"])
        for point in ledger["points"]:
            dark, lit = point["cameras"]
            self.assertEqual(point["ms"]["median"], max(dark["ms"]["median"], lit["ms"]["median"]))
            self.assertAlmostEqual(point["ratio"], point["ms"]["median"] / standard["ms"]["median"], places=6)
            self.assertEqual(point["whole_frame"]["flip"]["mean"], max(dark["whole_frame"]["flip"]["mean"], lit["whole_frame"]["flip"]["mean"]))
            self.assertEqual(dark["whole_frame"]["flip"]["mean"], 0.0, "nothing is in sight")
            self.assertEqual(point["picture"], point["cameras"][shown]["picture"], "where the user's settings are least right")
        with open(self.folder / "points/points.csv", encoding="utf-8", newline="") as file:
            cameras = [line["camera"] for line in csv.DictReader(file)]
        self.assertEqual(cameras, [name for name in ("dark,lit", "dark", "lit") for _ in ledger["points"]])
        self.assertIn("The user's own settings", (self.folder / "points/report.html").read_text())

    def test_a_path_is_five_times_of_the_animation(self):
        self.expect(0, "cost", "moving.gltf", "--quick", "--size", "48x27", "--knobs", "lighting.tone_map", "--camera", "dark",
                    "--path", "--points", "0", "--out", "path")
        ledger = self.read_json("path/ledger.json")
        self.assertEqual([round(camera["time_s"], 6) for camera in ledger["cameras"]], [0.0, 0.4, 0.8, 1.2, 1.6])
        _, cameras = self.check_worst(ledger)
        pictures = {rows[("lighting.tone_map", "linear")]["picture"] for rows in cameras}
        self.assertGreater(len(pictures), 2, "the camera turns")
        self.expect(2, "cost", "two.gltf", *TINY, "--path", "--camera", "lit", "--out", "path",
                    says="--path needs a scene with an animation, or two cameras to lead through")

    def test_a_path_without_an_animation_leads_through_the_cameras(self):
        self.expect(0, "cost", "two.gltf", "--quick", "--size", "48x27", "--knobs", "lighting.tone_map", "--path", "--points", "0",
                    "--out", "way")
        ledger = self.read_json("way/ledger.json")
        names = [camera["camera"] for camera in ledger["cameras"]]
        self.assertEqual(names, ["lit", "lit to dark, 0.25 of the way", "lit to dark, 0.5 of the way",
                                 "lit to dark, 0.75 of the way", "dark"])
        self.assertEqual({camera["time_s"] for camera in ledger["cameras"]}, {0.0})
        _, cameras = self.check_worst(ledger)
        pictures = [rows[("lighting.tone_map", "linear")]["picture"] for rows in cameras]
        self.assertNotIn(pictures[1], (pictures[0], pictures[4]), "half of the way, the camera sees the card askew")
        # The other way, with its ends at the same places.
        self.expect(0, "cost", "two.gltf", "--quick", "--size", "48x27", "--knobs", "lighting.tone_map", "--path",
                    "--cameras", "dark,lit", "--points", "0", "--out", "way")
        back = self.read_json("way/ledger.json")["cameras"]
        self.assertEqual([back[i]["rows"][0]["picture"] for i in (0, 4)],
                         [ledger["cameras"][i]["rows"][0]["picture"] for i in (4, 0)])

    def test_wrong_names_are_2_before_anything_is_measured(self):
        for names, says in (("lit,nobody", "no camera is named \"nobody\"; there are lit, dark"), ("lit,", "names with commas"),
                            ("lit,lit", "names 'lit' twice")):
            self.expect(2, "cost", "two.gltf", *TINY, "--cameras", names, "--out", "none", says=says)
        self.assertFalse(list(self.folder.glob("none/measurements/*")))
        self.expect(2, "cost", "two.gltf", *TINY, "--cameras", "lit", "--camera", "lit", "--out", "none", says="not both")


if __name__ == "__main__":
    main()
