# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `cost` for the knobs of light culling, whose error is a measure (a count). Needs a Vulkan device."""
import csv

from program_case import ProgramCase, main


class LightCost(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()

    def test_light_lists_are_judged_by_false_positives(self):
        knobs = ("lights.culling", "lights.tile_bound", "lights.z_bins")
        run = self.expect(0, "cost", "builtin:lanterns", "--size", "64x36", "--knobs", ",".join(knobs), "--out", "ledger",
                          "--set", "shadows.mode=off", "--points", "0")
        self.assertIn("counted: false positives a tile", run.stdout)
        rows = {(row["knob"], row["value"]): row for row in self.read_json("ledger/ledger.json")["rows"]}
        counted = {}
        for key, row in rows.items():
            self.assertEqual(row["wrong"], "", key)
            self.assertEqual(row["reference"]["kind"], "brute force", key)
            self.assertEqual(row["error"]["counted"]["unit"], "false positives a tile")
            self.assertEqual(row["error"]["flip"], {"mean": 0.0, "p99": 0.0}, f"{key} draws what brute force draws")
            self.assertEqual(row["error"]["rmse"], 0.0, key)
            counted[key] = row["error"]["counted"]["value"]
            if key != ("lights.culling", "brute"):
                self.assertGreater(row["module_ms"]["cpu"], 0.0, key)
                self.assertGreater(row["module_ms"]["gpu"], 0.0, key)
        self.assertEqual({knob for knob, _ in rows}, set(knobs))
        self.assertEqual(counted["lights.culling", "tiled"], 0.0)
        self.assertGreater(counted["lights.culling", "brute"], 100.0)
        bounds = [counted["lights.tile_bound", bound] for bound in ("rect", "row_interval", "cone")]
        self.assertEqual(bounds, sorted(bounds, reverse=True), "each bound is tighter than the one before")
        bins = [counted["lights.z_bins", count] for count in ("256", "512", "1024", "2048", "4096")]
        self.assertGreaterEqual(bins[0], bins[-1])
        self.assertTrue(all(0.0 < value < 256.0 for value in bounds + bins))
        with open(self.folder / "ledger/ledger.csv", encoding="utf-8", newline="") as file:
            for line in csv.DictReader(file):
                self.assertEqual(float(line["counted"]), counted[line["knob"], line["value"]])
                self.assertEqual((line["counted_unit"], line["wrong"]), ("false positives a tile", ""))


if __name__ == "__main__":
    main()
