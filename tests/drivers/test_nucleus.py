"""The maker's nucleus_driver of PyPI, unmodified: it logs in, sets the clock, reads the setup, starts, and gets the velocity of a
vehicle over a flat floor, by TCP and by a serial line."""

import math
import statistics
import time
import unittest

import public_driver

public_driver.use("nucleus", "nucleus_driver")
from nucleus_driver.nucleus_driver import NucleusDriver  # noqa: E402
from ports import free_port  # noqa: E402
from program import Emulator  # noqa: E402
from test_dvl import ALTITUDE, turned, way  # noqa: E402

SCENARIO = """
scene: {scenes}/flat.glb
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1490}
vehicle: {trajectory: way.csv}
clock: {mode: real}
devices:
  - name: nucleus
    model: nortek-nucleus
    endpoints: ["tcp-listen://127.0.0.1:%d", "tcp-listen://127.0.0.1:%d", "pty:{folder}/nucleus"]
    options: {speed_of_sound: 1490}
"""
BOTTOM_TRACK, ALTIMETER, ATTITUDE = 0xB4, 0xAA, 0xD2


class NucleusTest(unittest.TestCase):
    def test_by_tcp_and_by_a_serial_line(self):
        port = free_port()
        east, north = 0.9 * math.cos(math.radians(30)), 0.9 * math.sin(math.radians(30))
        rows = [(0, 0, 0, turned(30)), (200, 200 * east, 200 * north, turned(30))]
        with Emulator(SCENARIO % (port, free_port()), files={"way.csv": way(rows)}) as emulator:
            for kind in ("tcp", "serial"):
                with self.subTest(kind):
                    driver = NucleusDriver()
                    driver.connection.set_tcp_configuration(host="127.0.0.1", port=port)
                    driver.set_serial_configuration(port=str(emulator.folder / "nucleus"))
                    self.assertTrue(driver.connect(connection_type=kind))
                    self.addCleanup(driver.disconnect)
                    self.assertIn("Nucleus1000", driver.connection.nucleus_id)
                    self.assertEqual(driver.connection.firmware_version, '"4.0.0"')
                    self.assertEqual(driver.commands.set_trig(freq=8), [b"OK\r\n"])
                    self.assertEqual(driver.start_measurement(), [b"OK\r\n"])
                    try:
                        self.check(self.packets(driver))
                    finally:
                        self.assertEqual(driver.stop(), [b"OK\r\n"])
                    self.assertIsNone(driver.read_condition(), "a packet that it could not read")

    @staticmethod
    def packets(driver):
        found, end = [], time.monotonic() + 30
        while sum(p["id"] == BOTTOM_TRACK and p["status.xVelocityValid"] for p in found) < 25 and time.monotonic() < end:
            packet = driver.read_packet(timeout=5)
            if packet:
                found.append(packet)
        return found

    def check(self, packets):
        tracks = [p for p in packets if p["id"] == BOTTOM_TRACK and p["status.xVelocityValid"]]
        self.assertGreaterEqual(len(tracks), 25)
        for key, wanted in (("velocityX", 0.9), ("velocityY", 0), ("velocityZ", 0)):
            self.assertAlmostEqual(statistics.mean(p[key] for p in tracks), wanted, delta=0.02, msg=key)
        for beam in (1, 2, 3):
            self.assertAlmostEqual(statistics.mean(p[f"distanceBeam{beam}"] for p in tracks), ALTITUDE, delta=0.04)
        down = [p["altimeterDistance"] for p in packets if p["id"] == ALTIMETER and p["status.altimeterDistanceValid"]]
        self.assertAlmostEqual(statistics.mean(down), ALTITUDE, delta=0.005 * ALTITUDE)
        attitude = [p for p in packets if p["id"] == ATTITUDE][-1]
        self.assertAlmostEqual(attitude["ahrsData.heading"], 60, delta=1.5)
        self.assertAlmostEqual(attitude["depth"], 12, delta=0.1)


if __name__ == "__main__":
    unittest.main()
