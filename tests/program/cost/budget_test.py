# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `render --budget`. Needs a Vulkan device. The budgets are so wide or so narrow that no machine decides otherwise."""
import json

from budget_ledger import make_ledger
from gltf_scene import GltfScene
from program_case import ProgramCase, main

RENDER = ("render", "builtin:plain", "--size", "64x36", "--frames", "40", "--out", "x.png", "--stats", "s.json")
LEAST = {"views.scale": "0.5", "shadows.mode": "off"}
SETTINGS = (({}, 16.0, 0.0), ({"shadows.filter": "hard"}, 8.0, 0.02), (LEAST, 2.0, 0.1), ({"views.scale": "0.7"}, 12.0, 0.05))


class Budget(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()
        make_ledger(self, "l", SETTINGS)

    def write_ledger(self, name, ledger):
        (self.folder / name).write_text(json.dumps(ledger))

    def budget(self, *arguments):
        run = self.expect(0, *RENDER, *arguments)
        return self.read_json("s.json"), run.stderr

    def test_a_wide_budget_draws_the_most_exact_point_and_a_narrow_one_the_fastest(self):
        wide, told = self.budget("--budget", "100000ms", "--ledger", "l")
        self.assertEqual({key: wide["budget"][key] for key in ("ms", "points", "point", "error", "settings")},
                         {"ms": 100000, "points": 3, "point": 2, "error": 0.0, "settings": {}}, "a beaten point is none")
        self.assertEqual((wide["budget"]["changes"], told), (0, ""))
        narrow, told = self.budget("--budget", "0.001", "--ledger", "l/ledger.json")
        self.assertEqual((narrow["budget"]["point"], narrow["budget"]["error"], narrow["budget"]["settings"]), (0, 0.1, LEAST))
        self.assertEqual((narrow["knobs"]["shadows.mode"], narrow["size"]), ("off", [32, 18]))
        self.assertEqual(told.count("cannot fit"), 1, "it is said once")
        self.assertNotIn("budget", self.stats())

    def stats(self):
        self.expect(0, *RENDER)
        return self.read_json("s.json")

    def test_the_ledger_is_found_beside_the_scene_and_in_the_cache(self):
        cache = ("--cache-dir", "cache")
        say = self.expect(2, *RENDER, "--budget", "9", *cache, says="gloam cost builtin:plain --quick --out DIR")
        self.assertNotIn("warning", say.stderr)
        self.expect(0, "cost", "builtin:plain", "--quick", "--size", "64x36", "--knobs", "views.scale", "--points", "3", "--out", "m", *cache)
        measured = len(self.read_json("m/ledger.json")["points"])
        stats, told = self.budget("--budget", "100000", *cache)
        self.assertEqual((stats["budget"]["error"], told), (0.0, ""))
        self.assertLessEqual(stats["budget"]["points"], measured)
        # Another scene takes what there is, with a warning, until a ledger lies beside it.
        scene = GltfScene()
        scene.node(mesh=scene.card(scene.material(), half=1.0))
        (self.folder / "card.gltf").write_text(scene.text())
        draw = ("render", "card.gltf", "--size", "64x36", "--out", "x.png", "--stats", "s.json", "--budget", "100000", *cache)
        self.assertIn("another scene builtin:plain", self.expect(0, *draw).stderr)
        self.write_ledger("card.ledger.json", self.read_json("l/ledger.json"))
        self.assertIn("card.ledger.json was measured", self.expect(0, *draw).stderr)
        self.assertEqual(self.read_json("s.json")["budget"]["points"], 3)

    def test_knobs_of_set_keep_their_values(self):
        stats, _ = self.budget("--budget", "0.001", "--ledger", "l", "--set", "shadows.mode=monolithic")
        self.assertEqual((stats["knobs"]["shadows.mode"], stats["knobs"]["views.scale"]), ("monolithic", "0.5"))

    def test_an_effect_keeps_within_its_own_time(self):
        ledger = self.read_json("l/ledger.json")
        row = ledger["rows"][0]
        ledger["rows"] = [row | {"knob": "shadows.filter", "value": value, "default": value == "chs", "no_effect": False,
                                 "module_ms": {"cpu": 0.0, "gpu": ms}, "whole_frame": row["whole_frame"] | {"flip": {"mean": error, "p99": error}}}
                          for value, ms, error in (("chs", 4.0, 0.01), ("hard", 1.0, 0.03))]
        self.write_ledger("rows.json", ledger)
        stats, _ = self.budget("--budget", "shadows=0.0001ms", "--ledger", "rows.json")
        self.assertEqual(stats["budget"], stats["effect_budgets"]["shadows"], "there is no other")
        self.assertEqual({key: stats["effect_budgets"]["shadows"][key] for key in ("ms", "points", "point", "settings")},
                         {"ms": 0.0001, "points": 2, "point": 0, "settings": {"shadows.filter": "hard"}})
        self.assertEqual((stats["knobs"]["shadows.filter"], stats["knobs"]["views.scale"]), ("hard", "1"))
        # The frames' own budget leaves the effect's knobs alone.
        stats, _ = self.budget("--budget", "100000ms", "--budget", "shadows=0.0001", "--ledger", "rows.json")
        self.assertEqual((stats["budget"]["error"], stats["knobs"]["shadows.filter"]), (0.0, "hard"))
        self.expect(3, *RENDER, "--budget", "fog=9", "--ledger", "rows.json", says="no rows of the knobs of fog")
        self.expect(2, *RENDER, "--budget", "shadow=9", "--ledger", "rows.json", says="did you mean shadows?")

    def test_a_ledger_of_other_things_is_used_with_a_warning(self):
        run = self.expect(0, "render", "builtin:lanterns", "--size", "64x36", "--out", "x.png", "--budget", "99999", "--ledger", "l")
        self.assertIn("another scene builtin:plain", run.stderr)

    def test_a_file_that_is_no_ledger_is_3(self):
        ledger = self.read_json("l/ledger.json")
        self.write_ledger("bare.json", ledger | {"points": []})
        self.write_ledger("strange.json", ledger | {"points": [ledger["points"][0] | {"settings": {"shadows.filtre": "hard"}}]})
        (self.folder / "text.json").write_text("{")
        for name, says in (("absent", "absent"), ("bare.json", "no combinations"), ("text.json", "is no ledger"),
                           ("strange.json", "strange.json: unknown knob shadows.filtre")):
            self.expect(3, *RENDER, "--budget", "9", "--ledger", name, says=says)


if __name__ == "__main__":
    main()
