# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Shaders are compiled once, not in every frame, at any size and for any knob. Mesa's lavapipe would compile a shader anew
whenever uniforms that decide its branches make it half as long (engine/gpu/spirv/runtime_conditions.h). The times of passes
then contain the time to read code from the driver's cache. Needs lavapipe and Linux's inotify.

In the short form each built-in scene has one of twelve sizes, and the choices of a module's knobs are tried together in one
scene. With GLOAM_LONG_TESTS each scene has all sizes, and each value of each knob, also the bounds of numbers, is tried alone."""
import ctypes
import json
import os
import shutil
import struct
import tempfile
from collections import Counter
from pathlib import Path

from program_case import CACHE, LONG, ProgramCase, main

FRAMES = 16
MORE_FRAMES = 40  # more than pipelines that share a shader: each opens its file once
SIZES = ("1x1", "7x5", "33x31", "96x54", "127x71", "200x112", "320x180", "400x225", "480x270", "512x288", "853x480", "1280x720")
SHORT_SIZES = ("1x1", "7x5", "33x31", "96x54", "127x71", "100x56", "113x64", "120x67", "53x30", "107x60", "93x52", "80x45")
IN_OPEN = 0x20


class OpenCounts:
    """Counts how often each file below a folder is opened while the object exists."""

    def __init__(self, folder):
        self.libc = ctypes.CDLL(None, use_errno=True)
        self.descriptor = self.libc.inotify_init1(os.O_NONBLOCK)
        self.folders = {}
        for path in [folder, *(p for p in folder.rglob("*") if p.is_dir())]:
            watch = self.libc.inotify_add_watch(self.descriptor, str(path).encode(), IN_OPEN)
            self.folders[watch] = path

    def read(self):
        counts = Counter()
        while True:
            try:
                events = os.read(self.descriptor, 1 << 16)
            except BlockingIOError:
                return counts
            at = 0
            while at < len(events):
                watch, _, _, length = struct.unpack_from("iIII", events, at)
                name = events[at + 16:at + 16 + length].rstrip(b"\0").decode()
                at += 16 + length
                if name and not (self.folders[watch] / name).is_dir():
                    counts[str(self.folders[watch] / name)] += 1

    def close(self):
        os.close(self.descriptor)


def link_or_copy(source, target):
    """Shaders are linked, because Mesa replaces their files as a whole. The index is written in place."""
    try:
        (shutil.copy2 if Path(source).name == "index" else os.link)(source, target)
    except FileNotFoundError:
        pass  # another test's Mesa has renamed or removed it


class ShaderCache(ProgramCase):
    shares_process = True

    def setUp(self):
        super().setUp()
        self.require_device()
        shared = Path(os.environ.get("MESA_SHADER_CACHE_DIR", Path(CACHE.name)))
        if not (shared / "mesa_shader_cache").is_dir():
            self.skipTest("the device is not Mesa's, or its shader cache is off")
        # Folders of their own: tests that run beside this one open files of the shared cache, too.
        own = tempfile.TemporaryDirectory(prefix="shader-cache-", dir=shared.parent)
        self.addCleanup(own.cleanup)
        self.cache = Path(own.name) / "mesa_shader_cache"
        shutil.copytree(shared / "mesa_shader_cache", self.cache, copy_function=link_or_copy)

    def repeated(self, scene, *options, frames=FRAMES):
        """Files of the driver's cache that about every frame of a run opens."""
        opened = OpenCounts(self.cache)
        try:
            self.expect(0, "render", scene, "--frames", frames, *options, "--out", "p.png", "--quiet",
                        env={"MESA_SHADER_CACHE_DIR": str(self.cache.parent)})
            counts = opened.read()
        finally:
            opened.close()
        self.seen += len(counts)
        return {name: count for name, count in counts.items() if count >= frames - 2}

    def check(self, cases):
        self.seen = 0
        for scene, *options in cases:
            with self.subTest(scene=scene, options=options):
                repeated = self.repeated(scene, *options)
                if repeated:  # by pipelines or by frames?
                    repeated = self.repeated(scene, *options, frames=MORE_FRAMES)
                self.assertEqual(repeated, {}, "shaders are compiled again in every frame")
        self.assertGreater(self.seen, 3, "no shader was read from the cache: the check sees nothing")

    def scenes(self):
        return [line.split()[0] for line in self.expect(0, "scenes").stdout.splitlines()
                if line.startswith("builtin:")]

    def test_every_scene_and_size(self):
        scenes = self.scenes()
        self.assertGreater(len(scenes), 8)
        pairs = [(scene, size) for scene in scenes for size in SIZES] if LONG else \
            [(scene, SHORT_SIZES[i % len(SHORT_SIZES)]) for i, scene in enumerate(scenes)] + [("builtin:shadows", "400x225")]
        self.check([(scene, "--size", size) for scene, size in pairs])

    def test_every_value_of_every_knob(self):
        shows = {"lights": "many_lights", "closeups": "closeups", "reflections": "wet_street", "grass": "meadow_day",
                 "particles": "smoke"}
        knobs = json.loads(self.expect(0, "knobs", "--json").stdout)["knobs"]
        choices = {k["name"]: [v for v in k["values"] if v != k["default"]] for k in knobs if "values" in k and "check" not in k["name"]}
        bounds = {k["name"]: [k["min"], k["max"]] for k in knobs if "min" in k}
        module_of = {k["name"]: k["module"] for k in knobs}
        cases = []
        if LONG:
            for name, values in (choices | bounds).items():
                scene = "builtin:" + shows.get(module_of[name], "shadows")
                cases += [(scene, "--size", "96x54", "--set", f"{name}={value}") for value in values]
        else:
            for module in sorted(set(module_of.values())):
                own = {name: values for name, values in choices.items() if module_of[name] == module}
                for turn in range(max(map(len, own.values()), default=0)):
                    # Without "off": the other values would have nothing to act on.
                    chosen = [f"{n}={v[turn]}" for n, v in own.items() if turn < len(v) and v[turn] != "off"]
                    sets = [word for choice in chosen for word in ("--set", choice)]
                    cases.append(("builtin:" + shows.get(module, "shadows"), "--size", "64x36", *sets))
        self.check(cases)


if __name__ == "__main__":
    main()
