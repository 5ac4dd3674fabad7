"""Self-test of what compares the words of a run with those of a recording."""

import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import words


class Words(unittest.TestCase):
    def test_distances_of_known_histograms(self):
        self.assertEqual(words.distance([1, 2, 3], [3, 1, 2, 3, 2, 1]), 0)
        self.assertAlmostEqual(words.distance([0, 1], [2, 3]), 1)
        # Half of each in common: divergence 1/2 bit.
        self.assertAlmostEqual(words.distance([0, 1], [1, 2]), math.sqrt(0.5))
        # Endres and Schindelin's metric in bits for (1/4, 3/4) and (3/4, 1/4): 1 - H(1/4) = 0.1887.
        self.assertAlmostEqual(words.distance([0, 1, 1, 1], [0, 0, 0, 1]) ** 2, 0.1887, delta=1e-4)

    def test_many_different_words_are_put_into_classes(self):
        ours, theirs = list(range(0, 4000, 2)), list(range(1, 4000, 2))
        self.assertLess(words.distance(ours, theirs), 0.1)
        self.assertGreater(words.distance(ours, [64 * w for w in theirs]), 0.8, "36 dB apart")

    def test_summary(self):
        found = words.summary([0, 0, 5, 255], 0, 255)
        self.assertEqual((found["zero"], found["at highest"], found["mean"], found["distinct"]), (0.5, 0.25, 65, 3))
        self.assertEqual((found["50 %"], found["99 %"], found["25 %"]), (0, 255, 0))

    def test_a_field_that_is_not_there_names_those_that_are(self):
        with self.assertRaisesRegex(ValueError, "i1.intensity"):
            words.of_messages([{"i1.intensity": [1], "scale": 1}], "i2")
        self.assertEqual(words.of_messages([{"a": [1, 2, 3]}, {"a": [4, 5, 6]}], "a", 1, 3), [2, 3, 5, 6])


if __name__ == "__main__":
    unittest.main()
