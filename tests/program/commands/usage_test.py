# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests exit codes and error lines of all commands that need no device."""
import json
import os
import re
import subprocess

from program_case import NO_DEVICE, ProgramCase, main

NO_VULKAN = {"VK_ICD_FILENAMES": "/nonexistent", "VK_DRIVER_FILES": "/nonexistent"}


class Usage(ProgramCase):
    # Hard case: program.alone
    def test_alone_it_prints_its_help_and_leaves_with_2(self):
        run = self.expect(2)
        for command in ("play", "render", "inspect", "bake", "cost", "bench", "selftest", "compare", "scenes", "knobs"):
            self.assertIn(command, run.stdout)

    def test_help_and_version_are_results(self):
        self.assertIn("render", self.expect(0, "--help").stdout)
        self.assertIn("--stats", self.expect(0, "render", "--help").stdout)
        self.assertRegex(self.expect(0, "--version").stdout, r"^gloam \d+\.\d+\.\d+\n$")

    # Hard case: program.wrong_usage
    def test_wrong_usage_is_2(self):
        for arguments in (["dance"], ["render"], ["--no-such"], ["render", "builtin:plain", "--no-such"],
                          ["render", "builtin:nothing"], ["inspect", "builtin:nothing"],
                          ["inspect", "builtin:plain", "--camera", "nobody"],
                          ["inspect", "builtin:plain", "--animation", "walk"],
                          ["render", "builtin:plain", "--size", "0x0"], ["render", "builtin:plain", "--frames", "0"],
                          ["render", "builtin:plain", "--out", "a.txt"], ["render", "builtin:plain", "--set", "x"],
                          ["render", "builtin:plain", "--pick", "1280,0"],
                          ["render", "builtin:plain", "--in-flight", "3"], ["inspect", "builtin:plain", "--in-flight", "2"], ["bench"], ["bench", "nothing"],
                          ["cost", "builtin:plain"]):
            self.expect(2, *arguments)

    def test_an_unknown_knob_lists_the_valid_ones(self):
        run = self.expect(2, "cost", "builtin:plain", "--out", "ledger", "--knobs", "lights.culling,nope", env=NO_VULKAN)
        self.assertRegex(run.stderr, "unknown knob 'nope'; there are .*lights.culling")

    def test_a_misspelt_name_is_answered_with_the_nearest_one(self):
        for status, meant, arguments in (
                (2, "render", ["rendr", "builtin:plain"]),
                (2, "plain", ["inspect", "builtin:plian"]),
                (2, "lights.culling", ["cost", "builtin:plain", "--out", "ledger", "--knobs", "light.culling"]),
                (2, "ecs", ["bench", "esc"]),
                (3, "builtin:lanterns", ["inspect", "lanterns"]),
                (3, "builtin:lanterns", ["inspect", "bultin:lantern"])):
            run = self.expect(status, *arguments, env=NO_VULKAN)
            self.assertIn(f"did you mean {meant}?", run.stderr)

    # Hard case: program.bad_scene
    def test_a_bad_scene_is_3(self):
        (self.folder / "broken.gltf").write_text("{ this is no scene")
        (self.folder / "empty.glb").write_bytes(b"")
        for scene in ("absent.gltf", "broken.gltf", "empty.glb", "."):
            self.expect(3, "inspect", scene, says=scene)
        self.expect(3, "render", "absent.gltf", says="absent.gltf")

    def test_bake_needs_something_to_capture_and_a_place_for_it(self):
        self.expect(2, "bake", "builtin:plain", "--beside", says="needs a scene file", env=NO_VULKAN)
        self.assertIn("nothing to capture", self.expect(0, "bake", "builtin:plain").stdout)
        self.expect(3, "bake", "absent.gltf", says="absent.gltf", env=NO_VULKAN)

    def test_a_ledger_needs_a_budget(self):
        self.expect(2, "render", "builtin:plain", "--ledger", "8", says="--ledger needs --budget", env=NO_VULKAN)

    # Hard case: program.no_device
    def test_without_vulkan_only_drawing_fails(self):
        self.expect(NO_DEVICE, "render", "builtin:plain", env=NO_VULKAN)
        self.expect(NO_DEVICE, "cost", "builtin:plain", "--out", "ledger", env=NO_VULKAN)
        self.expect(0, "inspect", "builtin:plain", env=NO_VULKAN)
        self.expect(0, "scenes", env=NO_VULKAN)
        self.expect(0, "knobs", env=NO_VULKAN)
        self.expect(0, "bench", "--list", env=NO_VULKAN)
        self.expect(0, "bench", "jobs.fork_join", env=NO_VULKAN)

    # Hard case: program.no_display
    def test_play_without_a_display_is_1(self):
        self.expect(1, "play", env={"DISPLAY": "", "WAYLAND_DISPLAY": ""}, says="display")

    def test_knobs_are_listed_with_values_unit_and_sentence(self):
        text = self.expect(0, "knobs").stdout
        self.assertIn("dof.radius=15  (3 … 31 pixels)\n      limit of the radius", text)
        knobs = json.loads(self.expect(0, "knobs", "--json", "--set", "dof.radius=7").stdout)["knobs"]
        radius = next(knob for knob in knobs if knob["name"] == "dof.radius")
        self.assertEqual((radius["value"], radius["default"], radius["unit"]), ("7", "15", "pixels"))
        for knob in knobs:
            self.assertTrue(knob["meaning"], knob["name"])
            self.assertTrue("values" in knob or "min" in knob, knob["name"])
        self.expect(2, "knobs", "--set", "no.such=1")

    def test_the_page_of_knobs_shows_all_knobs_as_they_are(self):
        page = (self.source / "docs/knobs.md").read_text(encoding="utf-8")
        self.assertEqual(page, self.expect(0, "knobs", "--markdown", env=NO_VULKAN).stdout,
                         "write docs/knobs.md with: gloam knobs --markdown >docs/knobs.md")
        for knob in json.loads(self.expect(0, "knobs", "--json").stdout)["knobs"]:
            self.assertRegex(page, r"\n\| `%s` \| .*%s" % (re.escape(knob["name"]), re.escape(knob["meaning"].replace("|", "\\|"))))
        self.expect(2, "knobs", "--markdown", "--json", env=NO_VULKAN)

    def test_scenes_are_one_a_line(self):
        lines = self.expect(0, "scenes").stdout.splitlines()
        names = ["dusk", "plain", "lanterns", "many_lights", "penumbra", "shadows", "shadow_grid", "closeups", "wet_street",
                 "meadow", "meadow_day", "smoke", "lens", "backlight"]
        self.assertEqual([line.split()[0] for line in lines], ["builtin:" + name for name in names])
        for line in lines:
            self.assertGreater(len(line.split()), 3)

    # Hard case: program.full_disk
    def test_a_full_disk_is_1(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("there is no /dev/full")
        with open("/dev/full", "w", encoding="utf-8") as full:
            run = subprocess.run([self.program, "scenes"], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, r"^gloam: error: [^\n]+\n$")

    # Hard case: program.closed_stream
    def test_it_runs_with_all_streams_closed(self):
        run = subprocess.run(["sh", "-c", '"$0" inspect builtin:plain <&- 2>&- | grep -c ^cameras', self.program],
                             stdout=subprocess.PIPE, text=True, check=False)
        self.assertEqual(run.stdout.strip(), "1")


if __name__ == "__main__":
    main()
