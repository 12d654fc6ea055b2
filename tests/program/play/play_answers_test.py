# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""The window of `play` answers while it loads, compiles and draws: with an empty shader cache the driver compiles for seconds.
The bounds are ten times the time that the program promises, for machines under load. Needs Vulkan and Xvfb."""
import shutil
import signal
import time

from program_case import main
from window_case import WindowCase

ANSWER_S = 2.0


class PlayAnswers(WindowCase):
    def setUp(self):
        super().setUp()
        self.assertIsNotNone(shutil.which("Xvfb"), "Xvfb is not installed (package xvfb)")
        self.require_device()

    def start_cold(self, *arguments, script="", size="400x240"):
        """Starts it with no shader that is compiled already, and waits until it shows something."""
        shutil.rmtree(self.folder / "shaders", ignore_errors=True)
        run = self.start("builtin:shadows", "--size", size, "--dt", "0", *arguments, script=script, size=(800, 760),
                         env={"MESA_SHADER_CACHE_DIR": str(self.folder / "shaders")})
        run.wait_for("the window", run.display.find)
        run.window = run.display.find()
        run.wait_for("the loading screen", lambda: run.display.photograph(run.window).mean() > 1.0)
        return run

    def end_time(self, run):
        begin = time.monotonic()
        run.program.communicate(timeout=60)
        return time.monotonic() - begin

    # Hard case: program.answers_while_compiling
    def test_it_draws_while_pipelines_are_compiled(self):
        run = self.start_cold(script="say drawn\nwait 3\nclose\n")
        seen = set()
        while not (self.folder / "drawn").exists() and run.program.poll() is None:
            seen.add(run.display.photograph(run.window).rgb)
            time.sleep(0.05)
        self.assertEqual(run.end(), "")
        self.assertGreater(len(seen), 10, "the progress bar moves until the first picture")

    def test_it_follows_the_window_while_pipelines_are_compiled(self):
        run = self.start_cold(script="say drawn\nuntil end\nclose\n")
        run.display.resize(run.window, 320, 200)
        begin = time.monotonic()
        run.wait_for("a picture of the new size", lambda: run.display.photograph(run.window).pixel(318, 198) != (0, 0, 0))
        self.assertFalse((self.folder / "drawn").exists(), "the loading screen has followed, not the first picture")
        self.assertLess(time.monotonic() - begin, ANSWER_S)
        (self.folder / "end").touch()
        self.assertEqual(run.end(), "")

    def test_it_closes_while_pipelines_are_compiled(self):
        run = self.start_cold()
        time.sleep(0.5)
        run.display.close(run.window)
        self.assertLess(self.end_time(run), ANSWER_S)
        self.assertEqual(run.program.returncode, 0)

    def test_signals_end_it_at_every_stage(self):
        for wait_s in (0.0, 0.4, 1.0):
            for number in (signal.SIGINT, signal.SIGTERM):
                with self.subTest(wait_s=wait_s, signal=number.name):
                    run = self.start_cold()
                    time.sleep(wait_s)
                    run.program.send_signal(number)
                    self.assertLess(self.end_time(run), ANSWER_S)
                    self.assertEqual(run.program.returncode, 128 + number)

    # Hard case: program.knob_compiles_beside_frames
    def test_the_old_picture_stays_with_a_line_while_a_changed_knob_compiles(self):
        run = self.start_cold("--scale", "0.5", size="760x740", script="key tab\nwait 3\nclick_widget search\ntype shadows.mode\nwait 3\n"
                              "click_widget shadows.mode\nwait 3\nmove 700 20\nwait 2\nsay before\nuntil before.seen\n"
                              "click_widget shadows.mode monolithic\nmove 700 20\nsay changed\nwait 2\nsay after\nuntil after.seen\nclose\n")
        before = run.photograph_at("before")
        run.wait_said("changed")
        self.assertFalse((self.folder / "after").exists(), "the script waits until the picture has changed")
        titles, line = set(), 0
        while not (self.folder / "after").exists() and run.program.poll() is None:
            titles.add(run.display.title(run.window))
            shown = run.display.photograph(run.window)
            same = [shown.pixel(x, y) == before.pixel(x, y) for y in range(0, 640, 5) for x in range(490, 760, 5)]
            covered = [shown.pixel(x, y) != before.pixel(x, y) for y in range(700, 730, 3) for x in range(600, 740, 3)]
            line += all(same) and any(covered)
            time.sleep(0.02)
        after = run.photograph_at("after")
        self.assertEqual(run.end(), "")
        self.assertTrue(any(title.startswith("gloam: compiling ") for title in titles), titles)
        self.assertGreater(line, 0, "the line lies over the picture with the old value")
        self.assertGreater(before.differences(after)[1], 0.01)

    def test_a_signal_while_a_changed_knob_compiles_keeps_the_change(self):
        run = self.start_cold("--scale", "0.5", size="760x740", script="key tab\nwait 3\nclick_widget search\ntype shadows.mode\nwait 3\n"
                              "click_widget shadows.mode\nwait 3\nclick_widget shadows.mode off\nsay changed\n")
        run.wait_said("changed")
        run.program.send_signal(signal.SIGINT)
        self.assertLess(self.end_time(run), ANSWER_S)
        self.assertEqual(run.program.returncode, 130)
        self.assertTrue((self.folder / "out/shadows.unsaved.config.json").exists())


if __name__ == "__main__":
    main()
