# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Hard cases of `cost`: changing scenes, full disks, interrupted runs, foreign rows, memory. Needs a Vulkan device."""
import json
import os
import signal
import subprocess
import time

from gltf_scene import GltfScene
from program_case import CACHE, LONG, ProgramCase, main

KNOB = "lights.culling"
COST = ("cost", "builtin:plain", "--quick", "--size", "64x36", "--knobs", KNOB, "--points", "0", "--set",
        "shadows.mode=off")


class CostHard(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()

    def start(self, *arguments):
        environment = dict(os.environ, XDG_CACHE_HOME=CACHE.name)
        return subprocess.Popen([self.program, *arguments], cwd=self.folder, env=environment, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True)

    def rows(self, folder):
        return sorted((self.folder / folder).glob("measurements/*.row"))

    def wait_for_rows(self, run, folder, count=1):
        give_up = time.monotonic() + 120.0
        while len(self.rows(folder)) < count and run.poll() is None and time.monotonic() < give_up:
            time.sleep(0.001)
        self.assertIsNone(run.poll(), "the run ended before the test could disturb it")

    def card(self, color=(1, 1, 1, 1)):
        scene = GltfScene()
        scene.node(mesh=scene.card(scene.material(color)))
        scene.light(light={"type": "point", "intensity": 12}, translation=[0, 1, 3], extras={"gloam.light.shadow": False})
        scene.camera(translation=[0, 0, 3])
        return scene

    def test_a_scene_that_changes_while_it_is_measured_is_3(self):
        scene = self.card()
        outside = dict(scene.json, buffers=[{"byteLength": len(scene.data), "uri": "card%20data.bin"}])
        text = scene.text()
        (self.folder / "card data.bin").write_bytes(bytes(scene.data))
        (self.folder / "inside.gltf").write_text(text)
        (self.folder / "outside.gltf").write_text(json.dumps({name: value for name, value in outside.items() if value != []}))
        for name, changed in (("inside.gltf", "inside.gltf"), ("outside.gltf", "card data.bin")):
            common = ("cost", name, "--quick", "--size", "64x36", "--knobs", "lights.*", "--out", "out-" + name)
            with self.start(*common) as run:
                self.wait_for_rows(run, "out-" + name)
                path = self.folder / changed
                path.write_bytes(path.read_bytes() + (b"\n" if changed.endswith("gltf") else b"\0"))
                output, errors = run.communicate(timeout=240)
            self.assertEqual(run.returncode, 3, (output, errors))
            self.assertIn(f"gloam: error: {name} changed while it was measured", errors)
            self.assertFalse((self.folder / f"out-{name}/ledger.json").exists())
            self.expect(0, *common)

    def test_an_interrupted_run_leaves_whole_files_and_resumes(self):
        command = ("cost", "builtin:plain", "--quick", "--size", "64x36", "--knobs", "lights.*", "--points", "0",
                   "--set", "shadows.mode=off", "--out", "cut")
        with self.start(*command) as run:
            self.wait_for_rows(run, "cut", 2)
            run.send_signal(signal.SIGINT)
            run.communicate(timeout=60)
        self.assertNotEqual(run.returncode, 0)
        rows = self.rows("cut")
        self.assertFalse((self.folder / "cut/ledger.json").exists())
        self.assertIn(f"{len(rows)} of ", self.expect(0, *command).stdout, "every file that is there is whole")

    def test_a_full_disk_is_1_and_the_run_resumes(self):
        mount = ("unshare", "-m", "sh", "-c", 'mkdir -p full && mount -t tmpfs -o size=440k none full && "$@"; code=$?; '
                 'cp -r full kept; exit $code', "sh")
        probe = subprocess.run([*mount, "true"], cwd=self.folder, capture_output=True, check=False)
        if probe.returncode != 0:
            self.skipTest("a file system of a few bytes needs the right to mount")
        subprocess.run(["rm", "-r", self.folder / "kept"], check=True)
        command = ("cost", "builtin:plain", "--quick", "--size", "160x90", "--knobs", "lights.*,lighting.*", "--points", "0",
                   "--set", "shadows.mode=off")
        self.expect(1, *command, "--out", "full", prefix=mount, says="full/")
        self.assertFalse((self.folder / "kept/ledger.json").exists())
        self.assertFalse(list((self.folder / "kept").rglob("*.tmp*")), "no half file is left")
        rows = self.rows("kept")
        self.assertGreater(len(rows), 0, "the disk was full in the middle")
        self.expect(0, *command, "--out", "kept", says=" rows were measured before")

    def test_rows_of_another_scene_or_damaged_ones_are_measured_again(self):
        self.expect(0, *COST, "--out", "rows")
        first, second = self.rows("rows")
        content = [path.read_bytes() for path in (first, second)]
        # A file in another row's place, as if the names collided.
        first.write_bytes(content[1])
        second.write_bytes(content[0])
        self.assertNotIn("measured before", self.expect(0, *COST, "--out", "rows").stdout)
        for damaged in (b"", content[0][:-1], content[0][:40], b"\0" * len(content[0]), content[0].replace(b"brute", b"tiled")):
            self.rows("rows")[0].write_bytes(damaged)
            run = self.expect(0, *COST, "--out", "rows")
            self.assertIn("1 of 2 rows were measured before", run.stdout)
        other = (COST[0], "builtin:shadows", *COST[2:])
        self.assertNotIn("measured before", self.expect(0, *other, "--out", "rows").stdout)

    def test_progress_tells_the_time_left_on_a_pipe(self):
        run = self.expect(0, "cost", "builtin:plain", "--size", "160x90", "--knobs", "lights.z_bins,lights.tile_bound", "--set",
                          "shadows.mode=off", "--out", "lines")
        # Without a lamp in view, the values are not timed.
        lines = [line for line in run.stdout.splitlines() if line.startswith("lights.") and "the default's picture, not timed" in line]
        self.assertGreater(len(lines), 3)
        self.assertRegex(lines[0], r", about \d+ (s|min) left$")
        self.assertNotIn(" left", lines[-1])

    def test_the_default_takes_the_same_memory_whatever_was_drawn_before(self):
        """Each knob measured alone, so that no row's memory is taken from another's."""
        memory = {}
        knobs_of_runs = ("lighting.tone_map", "shadows.atlas", "lights.culling", "shadows.mode,shadows.atlas")
        for knobs in knobs_of_runs + (("shadows.filter", "shadows.mode") if LONG else ()):
            self.expect(0, "cost", "builtin:shadows", "--quick", "--size", "64x36", "--knobs", knobs, "--out", knobs, "--quiet")
            rows = self.read_json(knobs + "/ledger.json")["rows"]
            memory[knobs] = {row["gpu_bytes"] for row in rows if row["default"]}
        self.assertEqual(len(set.union(*memory.values())), 1, memory)


if __name__ == "__main__":
    main()
