# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `cost`: rows, files, resuming. Needs a Vulkan device."""
import csv
import json
import os
import signal
import subprocess
import sys
import time

from gltf_scene import GltfScene
from program_case import ProgramCase, main

KNOB = "lights.culling"
# Without shadows, which only take time here.
QUICK = ("cost", "builtin:plain", "--quick", "--knobs", KNOB, "--set", "shadows.mode=off", "--points", "0")


class Cost(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()

    def finished_rows(self, folder):
        return sorted((self.folder / folder).glob("measurements/*.row"))

    def test_a_quick_run_writes_rows(self):
        run = self.expect(0, *QUICK, "--out", "ledger")
        self.assertIn("quick: 320x180, at most 40 frames a value, 64 reference samples", run.stdout)
        self.assertEqual(run.stderr, "")
        ledger = self.read_json("ledger/ledger.json")
        self.assertEqual((ledger["version"], ledger["size"], ledger["quick"], ledger["frames"]), (1, [320, 180], True, 40))
        self.assertEqual(ledger["scene"], "builtin:plain")
        self.assertRegex(ledger["scene_hash"], r"^[0-9a-f]{16}$")
        self.assertTrue(ledger["device"]["name"] and ledger["device"]["driver"])
        rows = {row["value"]: row for row in ledger["rows"]}
        self.assertEqual(set(rows), {"brute", "tiled"})
        for value, row in rows.items():
            self.assertEqual(row["knob"], KNOB)
            self.assertEqual(row["default"], value == "tiled")
            self.assertEqual(row["reference"]["kind"], "brute force")
            self.assertEqual(row["error"]["flip"], {"mean": 0.0, "p99": 0.0}, "light lists drop no light")
            self.assertEqual(row["error"]["rmse"], 0.0)
            self.assertTrue(0.0 < row["ms"]["p10"] <= row["ms"]["median"] <= row["ms"]["p90"])
            self.assertGreater(row["ratio"], 0.0)
            self.assertGreater(row["gpu_bytes"], 0)
        self.assertEqual(rows["tiled"]["ratio"], 1.0)
        # Both are exact: the cheaper one gets the star, if either is.
        alike = all(row["no_effect"] for row in rows.values())
        self.assertEqual([row["value"] for row in rows.values() if row["front"]],
                         [] if alike else [min(rows.values(), key=lambda row: row["ratio"])["value"]])
        for row in rows.values():
            self.assertLessEqual(row["ratio_interval"][0], row["ratio"])
            self.assertGreaterEqual(row["ratio_interval"][1], row["ratio"])
        with open(self.folder / "ledger/ledger.csv", encoding="utf-8", newline="") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual([(line["knob"], line["value"]) for line in lines],
                         [(row["knob"], row["value"]) for row in ledger["rows"]])
        for line, row in zip(lines, ledger["rows"]):
            self.assertEqual(float(line["median_ms"]), row["ms"]["median"])
            self.assertEqual(float(line["flip_mean"]), row["error"]["flip"]["mean"])

    def test_times_do_not_depend_on_what_else_the_machine_does(self):
        """Beside a process that keeps all cores busy: ratios keep, and a knob that changes nothing gets no star."""
        knobs = "lights.culling,fog.radius"  # without fog, its knobs change nothing
        common = ("cost", "builtin:plain", "--size", "160x90", "--quick", "--set", "shadows.mode=off", "--points", "0")

        def ratios(folder):
            self.expect(0, *common, "--knobs", knobs, "--out", folder)
            rows = self.read_json(f"{folder}/ledger.json")["rows"]
            for row in rows:
                # Chance may find a time of one value apart from the default's, but no star is given without that.
                self.assertFalse(row["front"] and row["no_effect"] and not row["default"], row)
            return {(row["knob"], row["value"]): row["ratio_interval"] for row in rows if not row["default"]}

        quiet = ratios("quiet")
        busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(os.cpu_count() or 1)]
        try:
            beside = ratios("beside")
        finally:
            for process in busy:
                process.kill()
                process.wait()
        for key, (low, high) in quiet.items():
            self.assertLessEqual(low, beside[key][1] * 1.05, (key, quiet[key], beside[key]))
            self.assertGreaterEqual(high, beside[key][0] / 1.05, (key, quiet[key], beside[key]))

    def test_points_are_whole_settings(self):
        """Combinations are measured, stored, and drawn the same by `render` with their settings."""
        points = ("cost", "builtin:plain", "--quick", "--size", "96x54", "--knobs", "lights.culling,views.scale", "--set",
                  "shadows.mode=off", "--points", "5", "--out", "ledger")
        run = self.expect(0, *points)
        self.assertIn("the exact setting", run.stdout)
        self.assertIn("measured / predicted over", run.stdout)
        ledger = self.read_json("ledger/ledger.json")
        found = ledger["points"]
        self.assertTrue(3 <= len(found) <= 5, found)
        self.assertEqual([point["exact"] for point in found].count(True), 1)
        self.assertEqual([point["default"] for point in found].count(True), 1)
        self.assertEqual([point["ms"]["median"] for point in found], sorted(point["ms"]["median"] for point in found))
        for point in found:
            if point["exact"]:
                self.assertEqual(point["whole_frame"]["flip"]["mean"], 0.0)
                self.assertNotIn("shadows.mode", point["settings"], "no value is exact: the default, not the user's off")
            else:
                self.assertEqual(point["settings"]["shadows.mode"], "off", "the user's setting is kept")
        for row in ledger["rows"]:
            self.assertIn("flip", row["whole_frame"])
        scaled = [point for point in found if "views.scale" in point["settings"]]
        self.assertTrue(scaled, "a smaller picture is cheaper")
        with open(self.folder / "ledger/points.csv", encoding="utf-8", newline="") as file:
            self.assertEqual([float(line["median_ms"]) for line in csv.DictReader(file)],
                             [point["ms"]["median"] for point in found])
        for point in found:
            (self.folder / "config.json").write_text(json.dumps({"lighting.antialiasing": "off", **point["settings"]}))
            self.expect(0, "render", "builtin:plain", "--size", "96x54", "--config", "config.json", "--out", "drawn.png")
            drawn = (self.folder / "drawn.png").read_bytes()
            self.assertEqual(drawn, (self.folder / f"ledger/pictures/{point['picture']}.png").read_bytes(), point["settings"])
        self.expect(0, *points)
        self.assertEqual(self.read_json("ledger/ledger.json"), ledger, "nothing is measured again")

    def test_a_second_run_measures_nothing_again(self):
        self.expect(0, *QUICK, "--out", "ledger")
        first = self.read_json("ledger/ledger.json")
        run = self.expect(0, *QUICK, "--out", "ledger")
        self.assertIn("2 of 2 rows were measured before", run.stdout)
        self.assertEqual(self.read_json("ledger/ledger.json"), first)
        # Rows of other conditions are not resumed.
        run = self.expect(0, *QUICK, "--out", "ledger", "--time", "0.5")
        self.assertNotIn("measured before", run.stdout)

    def test_damaged_rows_are_measured_again(self):
        self.expect(0, *QUICK, "--out", "ledger")
        damaged, _ = self.finished_rows("ledger")
        damaged.write_bytes(damaged.read_bytes()[:-7])
        self.assertIn("1 of 2 rows were measured before", self.expect(0, *QUICK, "--out", "ledger").stdout)

    def test_a_killed_run_is_resumed(self):
        for number in (signal.SIGINT, signal.SIGKILL):
            folder = f"ledger-{int(number)}"
            command = ("cost", "builtin:plain", "--size", "96x54", "--knobs", KNOB, "--set", "shadows.mode=off", "--points", "0", "--out",
                       folder)
            environment = dict(os.environ, XDG_CACHE_HOME=str(self.folder / "cache"))
            with subprocess.Popen([self.program, *command], cwd=self.folder, env=environment, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL) as run:
                give_up = time.monotonic() + 60.0
                while not self.finished_rows(folder) and run.poll() is None and time.monotonic() < give_up:
                    time.sleep(0.001)
                run.send_signal(number)
                run.wait(timeout=240)
            done = len(self.finished_rows(folder))
            self.assertGreaterEqual(done, 1)
            self.assertIn(f"{done} of 2 rows were measured before", self.expect(0, *command).stdout)
            self.assertEqual(len(self.read_json(f"{folder}/ledger.json")["rows"]), 2)

    def test_two_runs_at_once_share_a_folder(self):
        command = [self.program, *QUICK, "--size", "64x36", "--out", "shared"]
        environment = dict(os.environ, XDG_CACHE_HOME=str(self.folder / "cache"))
        runs = [subprocess.Popen(command, cwd=self.folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 text=True) for _ in range(2)]
        for run in runs:
            _, errors = run.communicate(timeout=240)
            self.assertEqual((run.returncode, errors), (0, ""))
        self.assertEqual([row["value"] for row in self.read_json("shared/ledger.json")["rows"]], ["brute", "tiled"])

    def test_a_scene_without_lights_on_one_core(self):
        scene = GltfScene()
        scene.node(mesh=scene.card(scene.material()))
        scene.camera(translation=[0, 0, 3])
        (self.folder / "dark.gltf").write_text(scene.text())
        cores = os.sched_getaffinity(0)
        os.sched_setaffinity(0, {min(cores)})
        try:
            run = self.expect(0, "cost", "dark.gltf", "--quick", "--size", "64x36", "--knobs", "lights.*,lighting.dither",
                              "--set", "scene.default_light=off", "--points", "0", "--out", "ledger")
        finally:
            os.sched_setaffinity(0, cores)
        self.assertIn("times: processor time of a frame\n", run.stdout)
        self.assertIn("lights.culling: no effect here", run.stdout)

    def test_other_knobs_stay_as_they_are_set(self):
        self.expect(0, *QUICK, "--out", "ledger")
        run = self.expect(0, *QUICK, "--out", "ledger", "--set", "lighting.tone_map=linear")
        self.assertNotIn("measured before", run.stdout)
        run = self.expect(0, *QUICK, "--out", "ledger", "--set", f"{KNOB}=brute")
        self.assertIn("2 of 2 rows were measured before", run.stdout)

    def test_knobs_of_effects_that_the_scene_does_not_call_for_are_skipped(self):
        # A lamp without shadows and a rough card call for lights and lighting only.
        scene = GltfScene()
        scene.node(mesh=scene.card(scene.material()))
        scene.light(light={"type": "point", "intensity": 12}, translation=[0, 1, 3], extras={"gloam.light.shadow": False})
        scene.camera(translation=[0, 0, 3])
        (self.folder / "card.gltf").write_text(scene.text())
        self.expect(0, "cost", "card.gltf", "--quick", "--points", "0", "--out", "ledger", "--quiet")
        ledger = self.read_json("ledger/ledger.json")
        measured = {row["knob"] for row in ledger["rows"]}
        skipped = {entry["knob"] for entry in ledger["skipped"]}
        self.assertIn(KNOB, measured)
        self.assertFalse(measured & skipped)
        self.assertLessEqual({"shadows.filter", "reflections.mode", "grass.masters", "particles.light", "dof.radius"}, skipped)
        for entry in ledger["skipped"]:
            self.assertTrue(entry["reason"])

    def test_knobs_of_effects_that_are_switched_off_are_skipped(self):
        scene = GltfScene()
        scene.node(mesh=scene.card(scene.material()))
        scene.light(light={"type": "point", "intensity": 12}, translation=[0, 1, 3])
        scene.camera(translation=[0, 0, 3])
        (self.folder / "card.gltf").write_text(scene.text())
        self.expect(0, "cost", "card.gltf", "--quick", "--size", "48x32", "--points", "0", "--out", "ledger", "--quiet",
                    "--set", "shadows.mode=off")
        ledger = self.read_json("ledger/ledger.json")
        self.assertEqual(ledger["size"], [48, 32], "--size is kept")
        self.assertEqual({row["knob"] for row in ledger["rows"] if row["knob"].startswith("shadows.")}, {"shadows.mode"})
        reasons = {entry["knob"]: entry["reason"] for entry in ledger["skipped"]}
        for knob in ("shadows.filter", "shadows.atlas", "shadows.bias"):
            self.assertEqual(reasons.get(knob), "shadows is switched off: shadows.mode=off", knob)

    def test_knobs_of_absent_effects_are_measured_if_they_are_named(self):
        named = "particles.lighting,closeups.filter,fog.radius"
        self.expect(0, "cost", "builtin:plain", "--quick", "--knobs", named, "--set", "shadows.mode=off", "--points", "0", "--out",
                    "ledger")
        self.assertEqual({row["knob"] for row in self.read_json("ledger/ledger.json")["rows"]}, set(named.split(",")))

    def test_a_wrong_value_is_2(self):
        self.expect(2, *QUICK, "--out", "ledger", "--set", f"{KNOB}=sideways", says="brute, tiled")

    def test_a_folder_that_cannot_be_written_is_1(self):
        (self.folder / "file").write_text("")
        self.expect(1, *QUICK, "--out", "file/ledger", says="file/ledger")


if __name__ == "__main__":
    main()
