# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Stars and ratios of `cost` are the same whenever it is run, also beside processes that keep all cores busy. Needs a Vulkan
device. In the short form two runs of three knobs; with GLOAM_LONG_TESTS five runs of six.

Ratios have 95 % intervals. Those of two runs of the same value overlap unless their difference is above 1.96 times the sum of
both half widths, which is 2.77 standard deviations of it if they are alike: 0.6 % of the comparisons by chance. The number of
intervals apart must be one that chance gives in 99.9 % of all tests; none may be apart by more than both widths."""
import itertools
import math
import os
import subprocess
import sys

from program_case import LONG, ProgramCase, main

APART = 0.0056  # 2 (1 - Phi(1.96 sqrt 2))
CHANCE = 0.001  # of a failure without a cause
RUNS = 5 if LONG else 2
# Without fog fog.radius changes nothing: both sides of its comparisons are the same frame.
SAME = "fog.radius"
KNOBS = (SAME, "shadows.filter", "lighting.antialiasing", *(("shadows.mode", "shadows.kernel", "lights.z_bins") if LONG else ()))


def most_by_chance(comparisons):
    """The least number that a binomial count exceeds with a probability of at most CHANCE."""
    left = 1.0
    for count in range(comparisons + 1):
        left -= math.comb(comparisons, count) * APART**count * (1 - APART)**(comparisons - count)
        if left <= CHANCE:
            return count
    return comparisons


def are_apart(a, b, share=0.0):
    """Whether two intervals have a gap of more than `share` of both widths."""
    gap = max(a[0], b[0]) - min(a[1], b[1])
    return gap > share * (a[1] - a[0] + b[1] - b[0])


class CostStars(ProgramCase):
    def setUp(self):
        super().setUp()
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
        print(f"{RUNS} runs, {len(timed)} values, {len(comparisons)} comparisons, {len(apart)} intervals apart, at most "
              f"{most_by_chance(len(comparisons))} by chance; greatest spread of a ratio {max(spread.values()):.3f} of "
              f"{max(spread, key=spread.get)}; stars {sorted(stars[0])}")
        for key, a, b in apart:
            print("apart:", key, a, b)
        for run in runs:
            for (knob, value), row in run.items():
                self.assertFalse(knob == SAME and row["front"] and not row["default"], (value, row))
        for other in stars[1:]:
            self.assertEqual(sorted(stars[0] ^ other), [], "stars that flipped")
        self.assertLessEqual(len(apart), most_by_chance(len(comparisons)), apart)
        self.assertEqual([case for case in apart if are_apart(*case[1:], share=1.0)], [])


if __name__ == "__main__":
    main()
