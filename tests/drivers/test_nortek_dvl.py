"""pynmea2 of PyPI, unmodified, reads the lines of a Nortek DVL: velocity and ranges of a vehicle over a flat floor, by a serial line
and by TCP, with and without a bottom."""

import datetime
import math
import os
import socket
import statistics
import unittest

import public_driver

public_driver.use("nmea", "pynmea2")
import pynmea2  # noqa: E402
from ports import free_port  # noqa: E402
from program import Emulator  # noqa: E402
from test_dvl import ALTITUDE, turned, way  # noqa: E402

SCENARIO = """
scene: {scenes}/flat.glb
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1490}
vehicle: {trajectory: way.csv}
effects: {cross_talk: false}
clock: {mode: real}
devices:
  - {name: one, model: nortek-dvl1000, endpoints: ["pty:{folder}/dvl"], options: {speed_of_sound: 1490, rate: 8, bottom_format: bt7}}
  - {name: two, model: nortek-dvl500, mount: {position: [0.3, 0, 0]},
     endpoints: ["tcp-listen://127.0.0.1:%(commands)d", "tcp-listen://127.0.0.1:%(data)d", "tcp-listen://127.0.0.1:%(text)d"],
     options: {speed_of_sound: 1490, rate: 8, bottom_format: bt9, water_track: true, water_format: wt7}}
"""


def sentences(line, wanted, count):
    """Until there are so many of that kind with a velocity."""
    found = []
    for text in line:
        if text.startswith("$"):
            sentence = pynmea2.parse(text, check=True)
            if isinstance(sentence, wanted) and sentence.vx != -32.768:
                found.append(sentence)
        if len(found) == count:
            return found


class NortekDvlTest(unittest.TestCase):
    def check(self, found, ranges=True):
        for key, wanted in (("vx", 0.9), ("vy", 0), ("vz", 0)):
            noise = statistics.mean(one.fom for one in found) / math.sqrt(len(found))
            self.assertAlmostEqual(statistics.mean(getattr(one, key) for one in found), wanted, delta=3 * noise + 0.008, msg=key)
        if ranges:
            for key in ("d1", "d2", "d3", "d4"):
                self.assertAlmostEqual(statistics.mean(getattr(one, key) for one in found), ALTITUDE, delta=0.04)
            altitude = statistics.mean(statistics.mean((one.d1, one.d2, one.d3, one.d4)) for one in found)
            self.assertAlmostEqual(altitude, ALTITUDE, delta=0.005 * ALTITUDE)
        for one in found:
            self.assertGreater(one.dt1, 0)
            self.assertLess(one.dt2, 0, "the echo was before the line")

    def test_a_vehicle_over_a_flat_floor(self):
        ports = {name: free_port() for name in ("commands", "data", "text")}
        east, north = 0.9 * math.cos(math.radians(30)), 0.9 * math.sin(math.radians(30))
        rows = [(0, 0, 0, turned(30)), (200, 200 * east, 200 * north, turned(30))]
        with Emulator(SCENARIO % ports, files={"way.csv": way(rows)}) as emulator:
            with open(os.open(emulator.folder / "dvl", os.O_RDWR | os.O_NOCTTY), encoding="ascii", newline="\r\n") as line:
                found = sentences(line, pynmea2.nor.NORBT7, 40)
            self.check(found)
            age = datetime.datetime.now(datetime.timezone.utc).replace(tzinfo=None) - found[-1].timestamp
            self.assertLess(abs(age.total_seconds()), 30, "Unix time")
            with socket.create_connection(("127.0.0.1", ports["text"])) as host:
                found = sentences(host.makefile(encoding="ascii", newline="\r\n"), pynmea2.nor.NORBT9, 40)
                self.check(found)
                self.assertEqual(found[-1].sound_speed, 1490)
                self.assertAlmostEqual(found[-1].temp, 10, delta=0.2)
                self.assertAlmostEqual(found[-1].pressure, 1.2, delta=0.11, msg="bar, 12 m down")
                self.assertEqual(found[-1].stat, "0x100FFFFF")
                water = sentences(host.makefile(encoding="ascii", newline="\r\n"), pynmea2.nor.NORWT7, 40)
                self.check(water, ranges=False)


if __name__ == "__main__":
    unittest.main()
