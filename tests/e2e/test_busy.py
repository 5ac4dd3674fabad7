"""Twelve sonars at once, four multibeams at 10 Hz and eight scanning heads, each with a driver that gets what it asks for.

Whether pings come late is told and not judged here: that needs a machine with nothing else to do. busy.py judges it.
"""

import re
import unittest

from busy import Run

# Pings and late ones, of each sonar, then of all.
COUNTS = re.compile(r"^\w[\w ]* (\d+) pings, (\d+|none) late", re.MULTILINE)


class TwelveSonars(unittest.TestCase):
    def test_every_driver_is_served(self):
        run = Run(12)
        print(run.text())
        self.assertEqual(run.faults, {})
        for name, got in run.got.items():
            self.assertGreater(got / run.seconds, 2, f"{name}\n{run.text()}")
        sonars = [[int(count.replace("none", "0")) for count in each] for each in COUNTS.findall(run.output)]
        total = sonars.pop()
        self.assertEqual(len(sonars), 12, run.output)
        self.assertEqual(total, [sum(counts) for counts in zip(*sonars)], "the last line tells of all sonars together")


if __name__ == "__main__":
    unittest.main()
