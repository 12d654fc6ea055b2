# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests sweeps: `cost --list`, shards under GNU parallel, and `cost --merge`. Needs a Vulkan device."""
import csv
import json
import os
import shutil
import signal
import subprocess
import time

from gltf_scene import GltfScene
from program_case import CACHE, ProgramCase, main

KNOB = "lights.culling"
TINY = ("--quick", "--size", "64x36", "--knobs", KNOB, "--set", "shadows.mode=off", "--quiet")
LIST = """# scenes of the test
builtin:plain
cards/near.gltf  --camera "the near one"   # a comment

cards/near.gltf --size 32x18
cards/dark.gltf
"""
NO_VULKAN = {"VK_ICD_FILENAMES": "/nonexistent", "VK_DRIVER_FILES": "/nonexistent"}


class SweepCase(ProgramCase):
    def write_list(self, text=LIST):
        """The list and its scenes in a folder of their own: paths in a list are relative to it."""
        cards = self.folder / "lists" / "cards"
        cards.mkdir(parents=True, exist_ok=True)
        for name, lights in (("near", True), ("dark", False)):
            scene = GltfScene()
            scene.node(mesh=scene.card(scene.material()))
            if lights:
                scene.light(light={"type": "point", "intensity": 12}, translation=[0, 1, 3])
            scene.camera(translation=[0, 0, 3], name="the near one")
            (cards / f"{name}.gltf").write_text(scene.text())
        (self.folder / "lists" / "scenes.txt").write_text(text)

    def sweep(self, *arguments, code=0, **options):
        return self.expect(code, "cost", "--list", "lists/scenes.txt", *TINY, *arguments, **options)

    def summary(self, folder, shard):
        path, = (self.folder / folder / "shards").glob(f"*-{shard.replace('/', '-of-')}.json")
        return json.loads(path.read_text())

    def errors(self, merged):
        """The errors and pictures of every row, by ledger, knob and value."""
        return {(ledger["name"], row["knob"], row["value"]): (row["error"], row["picture"], row["reference"])
                for group in merged["groups"] for ledger in group["ledgers"] for row in ledger["ledger"]["rows"]}


class Sweep(SweepCase):
    def setUp(self):
        super().setUp()
        self.require_device()

    def test_shards_under_parallel_are_resumed_and_merged_as_an_unsharded_sweep(self):
        if shutil.which("parallel") is None:
            self.skipTest("GNU parallel is not installed")
        self.write_list()
        self.sweep("--out", "whole")
        environment = dict(os.environ, XDG_CACHE_HOME=CACHE.name)
        shard = [self.program, "cost", "--list", "lists/scenes.txt", *TINY, "--out", "sharded", "--shard"]
        # Shard 1 of 2 is killed after its first row.
        with subprocess.Popen([*shard, "1/2"], cwd=self.folder, env=environment, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL) as killed:
            rows = lambda: sorted((self.folder / "sharded").glob("*/measurements/*.row"))
            give_up = time.monotonic() + 60.0
            while not rows() and killed.poll() is None and time.monotonic() < give_up:
                time.sleep(0.001)
            killed.send_signal(signal.SIGKILL)
            self.assertEqual(killed.wait(timeout=60), -signal.SIGKILL)
        kept = {path: path.stat().st_mtime_ns for path in rows()}
        self.assertTrue(kept)
        self.assertEqual({entry["state"] for entry in self.summary("sharded", "1/2")["entries"]}, {"waiting"})
        run = subprocess.run(["parallel", "--will-cite", "-j2", "-q", *shard, "{}/2", ":::", "1", "2"], cwd=self.folder, env=environment,
                             capture_output=True, text=True, timeout=240, check=False)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual({path: path.stat().st_mtime_ns for path in kept}, kept, "finished rows are not measured again")
        for number in (1, 2):
            states = [entry["state"] for entry in self.summary("sharded", f"{number}/2")["entries"]]
            self.assertEqual(states, ["done" if index % 2 == number - 1 else "waiting" for index in range(4)])

        for folder in ("whole", "sharded"):
            run = self.expect(0, "cost", "--merge", folder, "--out", f"all/{folder}")
            self.assertEqual(run.stderr, "")
            self.assertIn("4 ledgers in 1 group ", run.stdout)
        whole, sharded = (self.read_json(f"all/{folder}/sweep.json") for folder in ("whole", "sharded"))
        self.assertEqual(self.errors(sharded), self.errors(whole))
        self.assertEqual(len(self.errors(whole)), 8)
        self.assertTrue(sharded["complete"])
        with open(self.folder / "all/sharded/sweep.csv", encoding="utf-8", newline="") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual({(line["name"], line["knob"], line["value"]) for line in lines}, set(self.errors(whole)))
        page = (self.folder / "all/sharded/index.html").read_text()
        for ledger in sharded["groups"][0]["ledgers"]:
            self.assertIn(f'href="../../sharded/{ledger["name"]}/report.html"', page)
            self.assertTrue((self.folder / "sharded" / ledger["name"] / "report.html").exists())
        cameras = [ledger["ledger"]["camera"] for ledger in sharded["groups"][0]["ledgers"]]
        self.assertEqual(sorted(cameras), ["", "", "", "the near one"])
        sizes = [tuple(ledger["ledger"]["size"]) for ledger in sharded["groups"][0]["ledgers"]]
        self.assertEqual(sorted(sizes), [(32, 18), (64, 36), (64, 36), (64, 36)], "options of a line win over the sweep's")

    def test_a_merge_names_what_is_missing_and_what_is_there_twice(self):
        self.write_list("builtin:plain\ncards/dark.gltf\ncards/absent.gltf\n")
        run = self.sweep("--shard", "1/3", "--out", "one")
        shutil.copytree(self.folder / "one", self.folder / "copy")
        # A failing entry does not stop its shard.
        self.sweep("--shard", "1/1", "--out", "all", code=3, says="1 of 3 entries failed; the first: lists/scenes.txt:3: lists/cards/absent.gltf")
        self.assertEqual([entry["state"] for entry in self.summary("all", "1/1")["entries"]], ["done", "done", "failed"])
        run = self.expect(0, "cost", "--merge", "one", "copy", "one/", "--out", "merged")
        for says in ("missing: shard 2/3 of lists/scenes.txt", "missing: shard 3/3", "missing: entry 'cards/dark.gltf' of lists/scenes.txt, in shard 2/3",
                     "missing: entry 'cards/absent.gltf'", "duplicate: copy/plain-"):
            self.assertIn(says, run.stderr)
        self.assertEqual(run.stderr.count("duplicate"), 1, "a folder that is named twice counts once")
        merged = self.read_json("merged/sweep.json")
        self.assertFalse(merged["complete"])
        self.assertEqual(len(merged["groups"][0]["ledgers"]), 1)
        self.assertIn("in shard 1/1, which failed: ", self.expect(0, "cost", "--merge", "all", "--out", "merged").stderr)

    def test_times_of_another_host_device_or_build_are_grouped_apart(self):
        self.write_list("builtin:plain\n")
        self.sweep("--out", "here")
        path, = (self.folder / "here").glob("plain-*/ledger.json")
        for folder, change in (("host", lambda ledger: ledger.update(host="another")),
                               ("device", lambda ledger: ledger["device"].update(name="another")),
                               ("build", lambda ledger: ledger["gloam"].update(build="0123456789abcdef"))):
            ledger = json.loads(path.read_text())
            change(ledger)
            there = self.folder / folder / path.parent.name
            there.mkdir(parents=True)
            (there / "ledger.json").write_text(json.dumps(ledger))
        run = self.expect(0, "cost", "--merge", "here", "host", "device", "build", "here/" + path.parent.name, "--out", "all")
        self.assertIn("4 ledgers in 4 groups", run.stdout)
        self.assertEqual(run.stderr.count("duplicate: "), 1)
        page = (self.folder / "all/index.html").read_text()
        self.assertIn("not comparable", page)
        self.assertEqual(page.count("<caption>Values over the scenes</caption>"), 4)

    def test_what_cannot_be_merged_is_3(self):
        self.write_list("builtin:plain\n")
        self.sweep("--out", "good")
        path, = (self.folder / "good").glob("plain-*/ledger.json")
        text = path.read_text()
        (self.folder / "empty").mkdir()
        for folder, says in (("empty", "empty has no ledgers"), ("absent", "absent is no folder")):
            self.expect(3, "cost", "--merge", "good", folder, "--out", "all", says=says)
        for damaged, says in ((text[:-20], "ledger.json is no ledger"), ("", "ledger.json is no ledger"), ("[]", "ledger.json is no ledger"),
                              (text.replace('"version": 1', '"version": 2', 1), "is a ledger of another version; this program reads version 1")):
            path.write_text(damaged)
            self.expect(3, "cost", "--merge", "good", "--out", "all", says=says)
        path.write_text(text)
        summary, = (self.folder / "good/shards").iterdir()
        for damaged, says in (("{", "is no summary of a shard"), ('{"version": 2}', "of another version")):
            summary.write_text(damaged)
            self.expect(3, "cost", "--merge", "good", "--out", "all", says=says)
        self.assertFalse((self.folder / "all").exists())


class BadSweeps(SweepCase):
    def test_bad_shards_and_mixed_sources_are_2(self):
        self.write_list()
        for shard in ("0/3", "4/3", "x", "1/0", "1", "1/3/4", "-1/3", ""):
            self.sweep("--out", "o", "--shard", shard, code=2, says="--shard wants I/N with I in 1…N", env=NO_VULKAN)
        for arguments in (["builtin:plain", "--shard", "1/2"], ["builtin:plain", "--list", "lists/scenes.txt"], [],
                          ["builtin:plain", "--merge", "a"], ["--list", "lists/scenes.txt", "--merge", "a"]):
            self.expect(2, "cost", "--out", "o", *arguments, env=NO_VULKAN)
        self.expect(2, "cost", "--list", "lists/scenes.txt", says="cost needs --out DIR", env=NO_VULKAN)

    def test_a_bad_list_is_3_and_names_the_line(self):
        for text, says in (("", "no line names a scene"), ("# nothing\n\n", "no line names a scene"),
                           ("builtin:plain\n\nbuiltin:plain  # again\n", "scenes.txt:3: repeats line 1"),
                           ("builtin:plain --siz 3x3\n", "scenes.txt:1: "), ("builtin:plain --size 0x3\n", "scenes.txt:1: --size wants"),
                           ("builtin:plain --camera 'a\n", "scenes.txt:1: a quote is not closed"),
                           ("--size 3x3 builtin:plain\n", "scenes.txt:1: begins with --size"),
                           ("builtin:plain --out=x\n", "scenes.txt:1: --out is no option of one scene"),
                           ("builtin:plain other.gltf\n", "scenes.txt:1: "), ("builtin:plain --help", "scenes.txt:1: --help")):
            self.write_list(text)
            self.sweep("--out", "o", code=3, says=says, env=NO_VULKAN)
            self.assertFalse((self.folder / "o").exists())
        self.expect(3, "cost", "--list", "absent.txt", "--out", "o", says="absent.txt", env=NO_VULKAN)

    def test_without_a_device_a_sweep_is_4(self):
        self.write_list()
        self.sweep("--out", "o", code=4, env=NO_VULKAN)


if __name__ == "__main__":
    main()
