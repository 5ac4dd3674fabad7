"""Twelve sonars at once, four multibeams at 10 Hz and eight scanning heads, each with a driver that gets what it asks for.

Whether pings come late is printed and not judged: that depends on the machine.
"""

import re
import time
import unittest

from program import ROOT, Emulator

from busy_drivers import fleet, with_endpoints

# Pings and late ones, of each sonar, then of all.
COUNTS = re.compile(r"^\w[\w ]* (\d+) pings, (\d+|none) late", re.MULTILINE)


class TwelveSonars(unittest.TestCase):
    def test_every_driver_is_served(self):
        drivers, seconds = fleet(), 12
        scenario = with_endpoints((ROOT / "config" / "busy.yaml").read_text(), drivers)
        with Emulator(scenario) as emulator:
            for driver in drivers:
                driver.begin(emulator.folder)
            end = time.monotonic() + seconds
            while time.monotonic() < end and emulator.process.poll() is None:
                time.sleep(0.2)
            for driver in drivers:
                driver.end()
            output = emulator.stop()[1]
        print(output)
        self.assertEqual({driver.name: driver.fault for driver in drivers if driver.fault}, {})
        for driver in drivers:
            self.assertGreater(driver.got / seconds, 2, driver.name)
        sonars = [[int(count.replace("none", "0")) for count in each] for each in COUNTS.findall(output)]
        total = sonars.pop()
        self.assertEqual(len(sonars), 12, output)
        self.assertEqual(total, [sum(counts) for counts in zip(*sonars)], "the last line tells of all sonars together")


if __name__ == "__main__":
    unittest.main()
