# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Stars of values whose times differ clearly are the same whenever `cost` is run, also beside processes that keep all cores
busy. Needs a Vulkan device. Five runs of five knobs, with GLOAM_LONG_TESTS only: they keep all cores busy for minutes.

Ratios have 95 % intervals. For two sides that are the same frame they must hold 1 as often as they say. For others the test
prints how many pairs of runs disagree: a virtual processor's speed at different kinds of work changes from run to run, and
no interval of one run can know that (docs/measurements.md)."""
import itertools
import math
import os
import subprocess
import sys

from program_case import LONG, ProgramCase, main

MISSED = 0.05  # of intervals that do not hold the true ratio
CHANCE = 0.001  # of a failure without a cause
RUNS = 5
# The lights' maps have their largest size in any case: both sides of its comparison are the same frame.
SAME = ("shadows.texels_per_pixel", "4")
# Not lighting.antialiasing: smaa and taa differ by a few percent, and smaa has a star only if it is the faster one.
KNOBS = (SAME[0], "shadows.filter", "shadows.mode", "shadows.kernel", "lights.z_bins")


def most_by_chance(comparisons):
    """The least number that a binomial count exceeds with a probability of at most CHANCE."""
    left = 1.0
    for count in range(comparisons + 1):
        left -= math.comb(comparisons, count) * MISSED**count * (1 - MISSED)**(comparisons - count)
        if left <= CHANCE:
            return count
    return comparisons


def are_apart(a, b):
    return max(a[0], b[0]) > min(a[1], b[1])


class CostStars(ProgramCase):
    def setUp(self):
        super().setUp()
        if not LONG:
            self.skipTest("GLOAM_LONG_TESTS is not set")
        self.require_device()

    def rows(self, number):
        self.expect(0, "cost", "builtin:shadows", "--size", "160x90", "--quick", "--points", "0", "--knobs", ",".join(KNOBS), "--out",
                    f"run{number}", timeout=1500)
        return {(row["knob"], row["value"]): row for row in self.read_json(f"run{number}/ledger.json")["rows"]}

    def test_stars_do_not_flip_beside_busy_processes(self):
        busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(os.cpu_count() or 1)]
        try:
            runs = [self.rows(number) for number in range(RUNS)]
        finally:
            for process in busy:
                process.kill()
                process.wait()
        self.assertEqual(len({tuple(sorted(run)) for run in runs}), 1, "every run has the same rows")
        self.assertTrue(any(row["front"] for row in runs[0].values()))
        stars = [{key for key, row in run.items() if row["front"]} for run in runs]
        timed = [key for key in runs[0] if not runs[0][key]["default"] and all("ratio_interval" in run[key] for run in runs)]
        comparisons = [(key, a[key]["ratio_interval"], b[key]["ratio_interval"])
                       for key in timed for a, b in itertools.combinations(runs, 2)]
        apart = [case for case in comparisons if are_apart(*case[1:])]
        spread = {key: max(run[key]["ratio"] for run in runs) / min(run[key]["ratio"] for run in runs) for key in timed}
        print(f"{RUNS} runs, {len(timed)} values, {len(comparisons)} comparisons, {len(apart)} intervals apart; greatest spread of "
              f"a ratio {max(spread.values()):.3f} of {max(spread, key=spread.get)}; stars {sorted(stars[0])}")
        # Values of SAME's knob save about as much as the noise: whether that is significant is a matter of chance.
        for other in stars[1:]:
            self.assertEqual(sorted(key for key in stars[0] ^ other if key[0] != SAME[0]), [], "stars that flipped")
        same = [run[SAME] for run in runs]
        for row in same:
            self.assertGreater(row["pairs"], 0)
            self.assertEqual(row["picture"], runs[0]["shadows.texels_per_pixel", "3"]["picture"])
            self.assertFalse(row["front"], row)
        missed = [row["ratio_interval"] for row in same if not row["ratio_interval"][0] <= 1 <= row["ratio_interval"][1]]
        self.assertLessEqual(len(missed), most_by_chance(len(same)), missed)


if __name__ == "__main__":
    main()
