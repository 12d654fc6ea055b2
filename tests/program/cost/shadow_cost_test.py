# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `cost` for knobs of deferred shadows whose values draw the same picture, up to rounding. Needs Vulkan."""
from program_case import ProgramCase, main


class ShadowCost(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()

    def test_equal_methods_are_equally_far_from_traced_light(self):
        knobs = ("shadows.mode", "shadows.classify", "shadows.visibility_bits")
        self.expect(0, "cost", "builtin:shadows", "--size", "32x18", "--knobs", ",".join(knobs), "--out", "ledger",
                    "--set", "shadows.mode=deferred", "--set", "shadows.filter=hard", "--set", "shadows.atlas=1024", "--points", "0")
        rows = {(row["knob"], row["value"]): row for row in self.read_json("ledger/ledger.json")["rows"]}
        self.assertEqual(sorted(rows), sorted(
            [("shadows.mode", value) for value in ("off", "monolithic", "deferred")] +
            [("shadows.classify", value) for value in ("off", "on")] +
            [("shadows.visibility_bits", value) for value in ("4", "8", "exact")]))
        for key, row in rows.items():
            kind = "brute force" if key[0] == "shadows.classify" else "traced"
            self.assertEqual((row["wrong"], row["reference"]["kind"]), ("", kind), key)
        flip = {key: row["error"]["flip"]["mean"] for key, row in rows.items()}
        self.assertAlmostEqual(flip["shadows.mode", "monolithic"], flip["shadows.mode", "deferred"], delta=1e-4)
        self.assertGreater(flip["shadows.mode", "off"], flip["shadows.mode", "deferred"] + 0.01)
        self.assertEqual(flip["shadows.visibility_bits", "8"], flip["shadows.mode", "deferred"])
        self.assertAlmostEqual(flip["shadows.visibility_bits", "exact"], flip["shadows.visibility_bits", "8"], delta=1e-4)
        counted = {value: rows["shadows.classify", value]["error"]["counted"] for value in ("off", "on")}
        self.assertEqual(counted["off"]["unit"], "share of tile-light pairs asked pixel by pixel")
        self.assertLess(counted["on"]["value"], counted["off"]["value"])
        self.assertLess(flip["shadows.classify", "on"], 1e-4)
        self.assertEqual(flip["shadows.classify", "off"], 0.0)


if __name__ == "__main__":
    main()
