# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `play` on a virtual display: it draws, follows a change of size, and closes; its picture is that of `render`. Needs
Vulkan and Xvfb."""
import math
import shutil
import signal
import sys

import virtual_display
from rgb_picture import Picture, read_png
from program_case import main
from window_case import WindowCase

PREFIX = (sys.executable, "-B", virtual_display.__file__, "800x600")


class Play(WindowCase):
    def setUp(self):
        super().setUp()
        self.assertIsNotNone(shutil.which("Xvfb"), "Xvfb is not installed (package xvfb)")
        self.require_device()

    def test_it_draws_some_frames_and_ends(self):
        self.expect(0, "play", "builtin:plain", "--size", "160x90", "--frames", "3", prefix=PREFIX)

    def test_the_dusk_is_the_default_and_leaves_stats(self):
        self.expect(0, "play", "--size", "160x90", "--frames", "3", "--dt", "0.1", "--stats", "stats.json", "--out", "last.png",
                    prefix=PREFIX)
        self.assertEqual(self.read_json("stats.json")["scene"], "builtin:dusk")
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
        run = self.start("builtin:plain", "--size", "160x90", "--frames", "60", "--stats", "s.json")
        run.wait_for("the window", run.display.find)
        run.display.resize(run.display.find(), 240, 200)
        run.end()
        self.assertEqual(self.read_json("s.json")["size"], [240, 200])

    def photograph(self, scene, scale):
        """The window at this scale, when its picture has settled."""
        name = scene.removeprefix("builtin:")
        run = self.start(scene, "--size", "192x108", "--scale", str(scale), "--dt", "0", "--time", "0.5", "--validate",
                         script=f"wait 3\nsay {name}\nuntil {name}.seen\nclose\n")
        picture = run.photograph_at(name)
        self.assertEqual(run.end(), "")
        return picture

    def rendered(self, scene, size):
        self.expect(0, "render", scene, "--size", size, "--time", "0.5", "--dt", "0", "--out", "r.png")
        return read_png(self.folder / "r.png")

    def test_at_scale_1_the_window_shows_what_render_draws(self):
        # The lanterns' exposure is metered, and both are antialiased.
        for scene in ("builtin:shadows", "builtin:lanterns"):
            most, _ = self.photograph(scene, 1).differences(self.rendered(scene, "192x108"))
            self.assertLessEqual(most, 1, f"{scene}: the shader and the hardware may round a code apart")

    def test_a_picture_at_rest_is_kept_below_the_panel(self):
        size = ("builtin:shadows", "--size", "160x90", "--scale", "0.5", "--dt", "0", "--validate")
        run = self.start(*size, script="pace 0.05\nwait 12\nsay rested\nuntil rested.seen\nkey tab\nwait 3\nsay panel\nuntil panel.seen\n"
                         "key tab\nwait 3\nsay without\nuntil without.seen\nhold w\nwait 6\nrelease w\nwait 3\nsay moved\nuntil moved.seen\n"
                         "key 1\nwait 3\nsay back\nuntil back.seen\nclose\n")
        names = ("rested", "panel", "without", "moved", "back")
        rested, panel, without, moved, back = (run.photograph_at(name) for name in names)
        self.assertEqual(run.end(), "")
        self.assertGreater(rested.differences(panel)[1], 5.0, "the panel is drawn over the kept picture")
        self.assertEqual(rested.rgb, without.rgb)
        self.assertGreater(rested.differences(moved)[1], 1.0, "a moving camera is followed")
        self.assertEqual(rested.rgb, back.rgb)
        run = self.start(*size, "--frames", "24", "--stats", "s.json", env={"GLOAM_PANEL": "1"})
        self.assertEqual(run.end(), "")
        self.assertEqual(self.read_json("s.json")["frame_ms"]["gpu"]["median"], 0, "the GPU draws no scene at rest")

    # Hard case: program.interrupted
    def test_signals_end_it_with_the_codes_of_the_shell(self):
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            with self.subTest(signal=number.name):
                run = self.start("builtin:plain", "--size", "160x90", script="wait 3\nsay drawn\nwait 100000\n")
                run.wait_said("drawn")
                run.program.send_signal(number)
                run.program.communicate(timeout=60)
                self.assertEqual(run.program.returncode, code)
                (self.folder / "drawn").unlink()

    def test_a_run_of_some_frames_tells_its_rate(self):
        run = self.expect(0, "play", "builtin:plain", "--size", "160x90", "--scale", "0.5", "--frames", "4", prefix=PREFIX)
        self.assertRegex(run.stdout, r"^4 frames; the last 2: [\d.]+ frames/s \(\d+ ms\), drawn at 80x45 \(50 %\); "
                                     r"first picture after [\d.]+ s\n$")

    def test_a_reduced_picture_is_enlarged_by_the_stated_filter(self):
        small = self.rendered("builtin:shadows", "96x54")
        most, mean = self.photograph("builtin:shadows", 0.5).differences(enlarged(small, 192, 108))
        self.assertLessEqual(most, 4)
        self.assertLess(mean, 0.6)


def kernel(x):
    """Lanczos-2 as the polynomial of upscale.frag."""
    x2 = min(x * x, 4.0)
    return (25 / 16 * (0.4 * x2 - 1) ** 2 - 9 / 16) * (0.25 * x2 - 1) ** 2


def enlarged_lines(lines, size):
    """Each line, a list of values, enlarged to this many values."""
    taps = []
    count = len(lines[0])
    for at in range(size):
        along = (at + 0.5) * count / size - 0.5
        first, part = math.floor(along), along - math.floor(along)
        weights = [kernel(1 + part), kernel(part), kernel(1 - part), kernel(2 - part)]
        taps.append(([min(max(first - 1 + i, 0), count - 1) for i in range(4)], [w / sum(weights) for w in weights]))
    result = []
    for line in lines:
        values = []
        for at, weights in taps:
            a, b, c, d = (line[i] for i in at)
            mixed = weights[0] * a + weights[1] * b + weights[2] * c + weights[3] * d
            values.append(min(max(mixed, min(b, c)), max(b, c)))
        result.append(values)
    return result


def enlarged(picture, width, height):
    """The twin of upscale.frag: along x, then along y."""
    channels = []
    for channel in range(3):
        lines = [[picture.rgb[3 * (y * picture.width + x) + channel] for x in range(picture.width)] for y in range(picture.height)]
        columns = enlarged_lines([list(column) for column in zip(*enlarged_lines(lines, width))], height)
        channels.append([value for line in zip(*columns) for value in line])
    return Picture(width, height, bytes(round(value) for pixel in zip(*channels) for value in pixel))


if __name__ == "__main__":
    main()
