# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `play` on a virtual display: it draws, follows a change of size, and closes. Needs Vulkan and xvfb-run."""
import ctypes
import ctypes.util
import os
import shutil
import subprocess
import time

from program_case import ProgramCase, main

PREFIX = ("xvfb-run", "-a", "-s", "-screen 0 800x600x24")


class Display:
    """The Xlib calls that find and resize windows."""

    def __init__(self, name):
        self.x11 = ctypes.CDLL(ctypes.util.find_library("X11") or "libX11.so.6")
        self.x11.XOpenDisplay.restype = ctypes.c_void_p
        self.handle = ctypes.c_void_p(self.x11.XOpenDisplay(name.encode()))
        self.x11.XDefaultRootWindow.restype = ctypes.c_ulong
        self.root = self.x11.XDefaultRootWindow(self.handle)

    def windows(self):
        root, parent, count = ctypes.c_ulong(), ctypes.c_ulong(), ctypes.c_uint()
        children = ctypes.POINTER(ctypes.c_ulong)()
        self.x11.XQueryTree(self.handle, ctypes.c_ulong(self.root), ctypes.byref(root), ctypes.byref(parent),
                            ctypes.byref(children), ctypes.byref(count))
        return [children[i] for i in range(count.value)]

    def title(self, window):
        text = ctypes.c_char_p()
        self.x11.XFetchName(self.handle, ctypes.c_ulong(window), ctypes.byref(text))
        return (text.value or b"").decode()

    def resize(self, window, width, height):
        self.x11.XResizeWindow(self.handle, ctypes.c_ulong(window), width, height)
        self.x11.XFlush(self.handle)


class Play(ProgramCase):
    def setUp(self):
        super().setUp()
        self.assertIsNotNone(shutil.which("xvfb-run"), "xvfb-run is not installed (package xvfb)")
        self.require_device()

    def test_it_draws_some_frames_and_ends(self):
        self.expect(0, "play", "builtin:plain", "--size", "160x90", "--frames", "3", prefix=PREFIX)

    def test_the_lanterns_are_the_default_and_leave_stats(self):
        self.expect(0, "play", "--size", "160x90", "--frames", "3", "--dt", "0.1", "--stats", "stats.json", "--out", "last.png",
                    prefix=PREFIX)
        self.assertEqual(self.read_json("stats.json")["scene"], "builtin:lanterns")
        self.assertTrue((self.folder / "last.png").exists())

    def test_the_panel_is_drawn_over_the_picture_in_a_pass_of_its_own(self):
        panel = {"GLOAM_PANEL": "1"}
        self.expect(0, "play", "builtin:plain", "--size", "320x200", "--frames", "3", "--stats", "shown.json", "--validate",
                    prefix=PREFIX, env=panel)
        self.expect(0, "play", "builtin:plain", "--size", "320x200", "--frames", "3", "--stats", "hidden.json", prefix=PREFIX)
        passes = [[one["name"] for one in self.read_json(name)["passes"]] for name in ("shown.json", "hidden.json")]
        self.assertIn("panel", passes[0])
        self.assertNotIn("panel", passes[1])

    def test_it_follows_the_window(self):
        server = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "800x600x24", "-nolisten", "tcp"],
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(server.wait)
        self.addCleanup(server.terminate)
        self.addCleanup(server.stdout.close)
        name = ":" + server.stdout.readline().strip()
        program = subprocess.Popen([self.program, "play", "builtin:plain", "--size", "160x90", "--frames", "60", "--stats", "s.json"],
                                   cwd=self.folder, env=dict(os.environ, DISPLAY=name, WAYLAND_DISPLAY=""),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        display = Display(name)
        until = time.monotonic() + 240  # generous: only a hang may reach it, not a slow machine
        resized = False
        while program.poll() is None and time.monotonic() < until:
            for window in display.windows():
                if not resized and display.title(window).startswith("gloam"):
                    display.resize(window, 240, 200)
                    resized = True
            time.sleep(0.02)
        output, errors = program.communicate(timeout=40)
        self.assertEqual(program.returncode, 0, output + errors)
        self.assertTrue(resized, "the window never appeared")
        self.assertEqual(self.read_json("s.json")["size"], [240, 200])


if __name__ == "__main__":
    main()
