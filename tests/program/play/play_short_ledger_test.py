# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `play --budget` of a scene that has no ledger: a short one is measured, used and kept. Needs Vulkan and Xvfb."""
import shutil
import sys

import virtual_display
from program_case import ProgramCase, main

PREFIX = (sys.executable, "-B", virtual_display.__file__, "800x600")


class PlayShortLedger(ProgramCase):
    def setUp(self):
        super().setUp()
        self.assertIsNotNone(shutil.which("Xvfb"), "Xvfb is not installed (package xvfb)")
        self.require_device()

    def play(self, *arguments):
        run = self.expect(0, "play", "builtin:plain", "--size", "96x54", "--frames", "3", "--stats", "s.json", *arguments, prefix=PREFIX)
        return self.read_json("s.json"), run.stderr

    def test_it_is_measured_once(self):
        wide, told = self.play("--budget", "1000000ms", "--cache-dir", "cache", "--set", "shadows.filter=pcf")
        self.assertEqual((wide["budget"]["error"], wide["knobs"]["views.scale"], told), (0.0, "1", ""), "its own settings are the best")
        self.assertGreaterEqual(wide["budget"]["points"], 2)
        ledger, = (self.folder / "cache" / "ledgers").glob("*/*.json")
        points = self.read_json(ledger)["points"]
        self.assertGreaterEqual(len(points), 6, "some seconds are enough for a small picture")
        self.assertEqual({point["settings"]["shadows.filter"] for point in points}, {"pcf"}, "a knob of --set keeps its value")
        self.assertNotIn("views.range", {knob for point in points for knob in point["settings"]}, "it is a look")
        written = ledger.stat().st_mtime_ns
        narrow, _ = self.play("--budget", "0.001ms", "--cache-dir", "cache")
        fastest = min(points, key=lambda point: point["ms"]["median"])  # which one that is, the clock says
        scale = fastest["settings"].get("views.scale", "1")
        self.assertEqual((narrow["budget"]["point"], narrow["knobs"]["views.scale"]), (0, scale))
        self.assertEqual(ledger.stat().st_mtime_ns, written, "the second start finds it")

    def test_budgets_of_effects_need_a_whole_ledger(self):
        self.expect(2, "play", "builtin:plain", "--size", "96x54", "--frames", "3", "--budget", "shadows=5ms", "--cache-dir", "cache",
                    says="gloam cost builtin:plain --quick --out DIR", prefix=PREFIX)


if __name__ == "__main__":
    main()
