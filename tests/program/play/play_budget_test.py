# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests the panel's section of budgets in a window: locks and the wipe. Needs Vulkan and Xvfb."""
import os
import shutil
from pathlib import Path

from budget_ledger import make_ledger
from program_case import main
from rgb_picture import read_png
from window_case import WindowCase

SCENE, WIDTH, HEIGHT = "builtin:shadows", 1000, 500
TALL = 940  # of a window whose panel shows a knob that was searched for
LEAST = {"views.scale": "0.5", "shadows.mode": "off"}
SETTINGS = (({}, 16.0, 0.0), ({"shadows.filter": "hard"}, 8.0, 0.02), (LEAST, 2.0, 0.1))
PANEL = 490  # columns that the panel covers


def stop(name):
    """The window is photographed here, with the pointer away from the panel's widgets."""
    return f"move 990 20\nwait 3\nsay {name}\nuntil {name}.seen\n"


class PlayBudget(WindowCase):
    def setUp(self):
        super().setUp()
        self.assertIsNotNone(shutil.which("Xvfb"), "Xvfb is not installed (package xvfb)")
        self.require_device()
        make_ledger(self, "l", SETTINGS)

    def play(self, script, scene=SCENE, dt="0", height=HEIGHT):
        """With a budget that no setting keeps, so that the fastest one is used."""
        return self.start(scene, "--size", f"{WIDTH}x{height}", "--dt", dt, "--budget", "0.001", "--ledger", "l", "--validate",
                          size=(1100, 960), script="key tab\n" + script)

    def photograph(self, run, name):
        """Keeps the picture in the folder $GLOAM_KEEP_PICTURES, if that is set."""
        picture = run.photograph_at(name)
        if folder := os.environ.get("GLOAM_KEEP_PICTURES"):
            picture.write(Path(folder) / f"play_budget_{name}.png")
        return picture

    def end(self, run):
        self.assertEqual([line for line in run.end().splitlines() if "was measured with another" not in line], [])

    def render(self, *settings):
        self.expect(0, "render", SCENE, "--size", f"{WIDTH}x{HEIGHT}", "--out", "x.png", *settings)
        return read_png(self.folder / "x.png")

    def config(self):
        return self.read_json("out/shadows.config.json")

    def mean_difference(self, a, b, first, last):
        """Of a channel, in these columns."""
        columns = [(x, y) for y in range(0, a.height, 3) for x in range(first, last, 3)]
        return sum(abs(p - q) for x, y in columns for p, q in zip(a.pixel(x, y), b.pixel(x, y))) / (3 * len(columns))

    def test_a_knob_that_is_locked_keeps_its_value(self):
        choose = ("click_widget search\ntype shadows.mode\nwait 2\nclick_widget shadows.mode\nwait 2\n"
                  "click_widget shadows.mode deferred\n")
        run = self.play(stop("begin") + choose + "wait 3\nclick_widget save config\n" + stop("locked") +
                        "wait 10\nclick_widget lock shadows.mode\nwait 3\nclick_widget save config\n" + stop("unlocked") + "close\n",
                        height=TALL)
        begin, locked = (self.photograph(run, name) for name in ("begin", "locked"))
        changed = self.config()
        unlocked = self.photograph(run, "unlocked")
        self.end(run)
        self.assertNotIn("shadows.mode", changed, "the user's value is the default, and the budget leaves it alone")
        self.assertEqual(changed["views.scale"], "0.5", "the budget still sets the other knob")
        self.assertEqual(self.config()["shadows.mode"], "off", "the budget sets it again")
        self.assertGreater(self.mean_difference(begin, locked, PANEL, WIDTH), 1.0, "shadows are drawn")
        self.assertLess(self.mean_difference(begin, unlocked, PANEL, WIDTH), 0.01)

    def test_the_wipe_shows_the_exact_picture_right_of_its_line(self):
        line = "widget wipe line\npress\nmove 400 20\nlift\nwait 5\n"
        run = self.play(stop("now") + "click_widget wipe\nwait 12\n" + line + stop("wipe") +
                        "click_widget wipe\nwait 5\nclick_widget save config\n" + stop("off") + "close\n")
        now, wipe, off = (self.photograph(run, name) for name in ("now", "wipe", "off"))
        self.end(run)
        middle = next(x for x in range(PANEL, WIDTH) if wipe.pixel(x, HEIGHT - 10) == (255, 255, 255))
        self.assertEqual(self.mean_difference(now, wipe, PANEL, middle - 2), 0.0, "left of the line is the picture now")
        exact = self.render()
        self.assertLess(self.mean_difference(exact, wipe, middle + 3, WIDTH), 0.05, "right of it is the exact one")
        self.assertGreater(self.mean_difference(now, wipe, middle + 3, WIDTH), 1.0)
        self.assertEqual(self.mean_difference(now, off, PANEL, WIDTH), 0.0, "nothing of the picture now has changed")
        self.assertEqual({name: self.config()[name] for name in LEAST}, LEAST)

    def test_the_wipe_pauses_the_scene_and_keeps_it_as_it_was(self):
        right = "widget wipe line\npress\nmove 460 20\nlift\n"
        run = self.play("wait 20\nclick_widget wipe\nwait 5\n" + right + stop("on") + "wait 10\n" + stop("paused") +
                        "click_widget wipe\n" + stop("runs") + "key space\n" + stop("begin") +
                        "click_widget wipe\nwait 8\nclick_widget wipe\n" + stop("end") + "close\n", "builtin:smoke", "0.1")
        on, paused, runs, begin, end = (self.photograph(run, name) for name in ("on", "paused", "runs", "begin", "end"))
        self.end(run)
        self.assertEqual(self.mean_difference(on, paused, PANEL, WIDTH), 0.0, "nothing moves")
        self.assertGreater(self.mean_difference(paused, runs, PANEL, WIDTH), 0.05, "the smoke goes on")
        self.assertEqual(self.mean_difference(begin, end, PANEL, WIDTH), 0.0, "a scene that was paused stays paused")


if __name__ == "__main__":
    main()
