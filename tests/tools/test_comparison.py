#!/usr/bin/env python3
"""docs/comparison.md: its table is what tools/compare_simulators finds, and the formulas do what their sources say."""
import math
import pathlib
import random
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from comparison import formulas, page, statistics  # noqa: E402

ROWS, BEAMS = 60, 40


def grid():
    return formulas.Grid(ROWS, 0.1, BEAMS, math.radians(60), math.radians(2))


def wall(cosine, distance=3.05):
    """Four pixels in each beam, all in one row."""
    return [(distance, math.radians(60) * (b / (BEAMS - 1) - 0.5), cosine) for b in range(BEAMS) for _ in range(4)]


def far_row(name, pixels=()):
    return formulas.ALL[name](pixels, grid(), random.Random(1))[-1]


class Formulas(unittest.TestCase):
    def test_the_papers_sigmoid_is_half_at_two_thirds_and_whole_at_right_angles(self):
        self.assertEqual(formulas.cerqueira(wall(2 / 3), grid(), None)[30], [127.0] * BEAMS)
        self.assertGreaterEqual(min(formulas.cerqueira(wall(1), grid(), None)[30]), 253)
        self.assertEqual(formulas.cerqueira(wall(1), grid(), None)[29], [0.0] * BEAMS)

    def test_stonefish_clamps_half_of_its_noise_to_zero(self):
        words = [w for n in range(20) for w in formulas.stonefish([], grid(), random.Random(n))[-1]]
        self.assertAlmostEqual(sum(w == 0 for w in words) / len(words), 0.58, delta=0.05)  # words below 1 of 255, too
        self.assertAlmostEqual(statistics.mean(formulas.stonefish(wall(1), grid(), random.Random(2))[30]), 252, delta=3)

    def test_rayleigh_noise_grows_with_the_range_squared(self):
        for name in ("HoloOcean", "OceanSim"):
            image = formulas.ALL[name]([], grid(), random.Random(3))
            half, whole = (statistics.mean(sum(image[r - 4:r], [])[::2]) for r in (ROWS // 2, ROWS))
            self.assertAlmostEqual(half / whole, 0.25, delta=0.07, msg=name)

    def test_oceansim_scales_each_row_to_its_greatest(self):
        near, far = wall(0.9, 1.05), wall(0.2, 3.05)
        image = formulas.oceansim(near + far, grid(), random.Random(4))
        self.assertAlmostEqual(statistics.mean(image[10]) / statistics.mean(image[30]), 1, delta=0.15)

    def test_uuv_simulator_subtracts_ten_decibels_a_metre(self):
        image = formulas.uuv_simulator(wall(1, 1.05) + wall(0, 5.05), grid(), random.Random(5))
        ratio = statistics.mean(image[50]) / statistics.mean(image[10])
        self.assertAlmostEqual(ratio, (170 - 50.5) / (270 - 10.5), delta=0.04)

    def test_dave_has_rayleigh_speckle_and_silent_water(self):
        rows = [formulas.dave(wall(0.8), grid(), random.Random(n))[30] for n in range(40)]
        self.assertAlmostEqual(statistics.deviation(sum(rows, [])) / statistics.mean(sum(rows, [])), 0.523, delta=0.08)
        self.assertEqual(far_row("DAVE", wall(0.8)), [0.0] * BEAMS)


class Statistics(unittest.TestCase):
    def test_of_an_image_that_is_smoothed_across_but_not_down(self):
        rng = random.Random(6)
        raw = [[rng.gauss(100, 10) for _ in range(81)] for _ in range(80)]
        image = [[(row[c] + row[c + 1]) / 2 for c in range(80)] for row in raw]
        self.assertAlmostEqual(statistics.likeness(image, 0, 1), 0.5, delta=0.04)
        self.assertAlmostEqual(statistics.likeness(image, 1, 0), 0, delta=0.04)
        self.assertAlmostEqual(statistics.variation(image), 0.0707, delta=0.004)


class Page(unittest.TestCase):
    def test_the_nearest_is_bold_and_a_bound_is_met_by_anything_beyond(self):
        one = ("x", 0.5, {name: 0.9 for name in page.NAMES} | {"DAVE": 0.45, "OceanSim": None})
        self.assertEqual(page.nearest(one), ["DAVE"])
        self.assertIn("| **0.45** |", page.table([one]))
        self.assertIn("| none |", page.table([one]))
        self.assertEqual(page.error(page.AtLeast(12.8), 20.0), 0)

    def test_the_committed_table_is_what_the_script_finds(self):
        done = subprocess.run([sys.executable, "-B", ROOT / "tools" / "compare_simulators", "--check"], capture_output=True,
                              text=True, timeout=300, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
