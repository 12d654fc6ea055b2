# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Shaders are compiled once, not in every frame. Mesa's lavapipe compiles a compute shader anew whenever a branch or a
number of turns depends on a uniform block alone (shaders/common/runtime_value.glsl). The times of passes then contain
the time to read code from the driver's cache. Needs lavapipe and Linux's inotify."""
import ctypes
import os
import struct
from collections import Counter
from pathlib import Path

from program_case import CACHE, ProgramCase, main

FRAMES = 12
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


class ShaderCache(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()
        self.cache = Path(os.environ.get("MESA_SHADER_CACHE_DIR", Path(CACHE.name))) / "mesa_shader_cache"
        if not self.cache.is_dir():
            self.skipTest("the device is not Mesa's, or its shader cache is off")

    def render(self, frames, scene, *options):
        self.expect(0, "render", scene, "--size", "160x90", "--frames", frames, *options, "--out", "p.png")

    def check(self, scene, *options):
        self.render(2, scene, *options)
        opened = OpenCounts(self.cache)
        try:
            self.render(FRAMES, scene, *options)
            counts = opened.read()
        finally:
            opened.close()
        self.assertGreater(len(counts), 3, "no shader was read from the cache: the check sees nothing")
        repeated = {name: count for name, count in counts.items() if count >= FRAMES // 2}
        self.assertEqual(repeated, {}, f"{scene} {options}: shaders are compiled again in every frame")

    def test_reflections_and_fog(self):
        self.check("builtin:wet_street")

    def test_reflections_over_time(self):
        self.check("builtin:wet_street", "--set", "reflections.temporal=on")

    def test_mirrored_view(self):
        self.check("builtin:wet_street", "--set", "reflections.mode=planar")

    def test_grass_by_day(self):
        self.check("builtin:meadow_day")

    def test_lights_and_shadows(self):
        self.check("builtin:lanterns")

    def test_closeups(self):
        self.check("builtin:closeups")

    def test_many_lights(self):
        self.check("builtin:many_lights")


if __name__ == "__main__":
    main()
