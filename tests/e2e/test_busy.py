"""Twelve sonars at once, four multibeams at 10 Hz and eight scanning heads, each with a driver that gets what it asks for.

Whether pings come late is printed and not judged: that depends on the machine.
"""

import json
import re
import time
import unittest

from program import ROOT, Emulator

from busy_drivers import fleet

# Pings and late ones, of each sonar, then of all.
COUNTS = re.compile(r"^\w[\w ]* (\d+) pings, (\d+|none) late", re.MULTILINE)


def with_endpoints(text, drivers):
    """config/busy.yaml with the drivers' own ports and lines, so that it can run beside other programs."""
    for driver in drivers:
        pattern = rf"(name: {driver.name}\n.*\n.*\n.*endpoints: )\[.*\]"
        text, found = re.subn(pattern, lambda m: m.group(1) + json.dumps(driver.endpoints()), text)
        assert found == 1, f"{driver.name} in config/busy.yaml"
    return text.replace("scenes/", "{scenes}/")


class TwelveSonars(unittest.TestCase):
    def test_every_driver_is_served(self):
        drivers, seconds = fleet(), 12
        scenario = with_endpoints((ROOT / "config" / "busy.yaml").read_text(), drivers)
        for driver in drivers:
            if hasattr(driver, "held"):
                driver.held.close()
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
