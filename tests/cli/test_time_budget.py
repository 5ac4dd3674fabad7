"""Where the time of a ping goes, as `echoloop check` tells it, against figures worked out by hand."""

import json
import os
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("ECHOLOOP", str(ROOT / "build" / "release" / "bin" / "echoloop"))
TURN = 2.4  # s, of a Ping360 (its documentation)


def ping_time(config):
    done = subprocess.run([PROGRAM, "check", str(ROOT / "config" / config), "--json"], capture_output=True, text=True,
                          timeout=60, check=True)
    return json.loads(done.stdout)["devices"][0]["ping_time"]


class TimeBudget(unittest.TestCase):
    def test_a_ping360_asked_for_1200_samples(self):
        budget = ping_time("ping360.yaml")
        self.assertEqual(budget["bytes"], 10 + 14 + 1200, "header, fields, samples")
        self.assertAlmostEqual(budget["wire"], 12240 / 115200, places=6)
        self.assertAlmostEqual(budget["listen"], 1200 * 88 * 25e-9, places=6)
        self.assertAlmostEqual(budget["transmit"], 11e-6, places=9)
        self.assertAlmostEqual(budget["motor"], TURN / 400, delta=1e-4, msg="one gradian of a turn")
        self.assertAlmostEqual(budget["work"], 0, places=6)

    def test_a_micron_that_steps_by_16_sixteenths(self):
        budget = ping_time("tank.yaml")
        self.assertEqual(budget["bytes"], 13 + 31 + 200 + 1, "header, fields, bins, line feed")
        self.assertAlmostEqual(budget["listen"], 200 * 52 * 640e-9, places=6)
        self.assertAlmostEqual(budget["motor"], 16 * 25 * 10e-6, delta=1e-6, msg="MoTime for each 1/16 gradian")
        self.assertAlmostEqual(budget["wire"], 2450 / 115200, places=6)

    def test_a_profiler_whose_pass_has_a_second_ping(self):
        budget = ping_time("profiler.yaml")
        self.assertAlmostEqual(budget["listen"], 200 * 100e-6, places=6, msg="ScanTime")
        self.assertAlmostEqual(budget["motor"], 16 * 25 * 10e-6, delta=1e-6, msg="MoTime for each 1/16 gradian")
        self.assertEqual(budget["bytes"], 51 + 2, "header, fields, one echo time, line feed")
        self.assertAlmostEqual(budget["wire"], 530 / 115200, places=6)

    def test_sonars_without_a_motor_have_no_such_share(self):
        for config in ("imagenex-852.yaml", "deltat.yaml"):
            budget = ping_time(config)
            self.assertIsNone(budget["motor"], config)
            self.assertIsNotNone(budget["work"], config)

    def test_an_881a_of_10_m(self):
        budget = ping_time("imagenex-881a.yaml")
        self.assertEqual(budget["bytes"], 265)
        self.assertAlmostEqual(budget["motor"], 0, delta=2e-4, msg="it turns while it listens, up to a step of 2.1 deg")
        self.assertAlmostEqual(budget["work"], 4.7e-3, delta=0.2e-3, msg="the maker's table of turns")

    def test_an_echosounder_of_100_m_at_4800_bit_per_second(self):
        budget = ping_time("echosounder.yaml")
        self.assertEqual(budget["line_rate"], 4800)
        self.assertIsNone(budget["motor"])
        self.assertAlmostEqual(budget["listen"], 2 * 100 / 1500, delta=2e-3)
        self.assertAlmostEqual(budget["wire"], budget["bytes"] * 10 / 4800, places=6)


if __name__ == "__main__":
    unittest.main()
