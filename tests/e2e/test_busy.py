"""Twelve sonars at once, four multibeams at 10 Hz and eight scanning heads, each with a driver that gets what it asks for.

Whether pings come late is told and not judged here: that needs a machine with nothing else to do. busy.py judges it.
"""

import unittest

from busy import Run


class TwelveSonars(unittest.TestCase):
    def test_every_driver_is_served(self):
        run = Run(12)
        print(run.text())
        self.assertEqual(run.faults, {})
        for name, got in run.got.items():
            self.assertGreater(got / run.seconds, 2, f"{name}\n{run.text()}")


if __name__ == "__main__":
    unittest.main()
