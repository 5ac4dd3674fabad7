"""The maker's own Python package drives the Ping1D, and the floor and the wall of the tank are where they are."""

import math
import os
import subprocess
import sys
import unittest

import public_driver

public_driver.use("ping1d", "brping")

from brping import Ping1D, definitions, pingmessage  # noqa: E402
from ports import free_port  # noqa: E402
from program import Emulator  # noqa: E402

TANK = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, %s]}}
devices:
  - name: ping1d
    model: ping1d
    mount: {position: [0, 0, 0], rpy_deg: [0, %s, 0]}
    endpoints: ["%s"]
"""
DOWN, ASTERN = 90, 180


def stream(sonar, message, start=True):
    """continuous_start or continuous_stop: the package knows the messages, but has no function for them."""
    m = pingmessage.PingMessage(definitions.PING1D_CONTINUOUS_START if start else definitions.PING1D_CONTINUOUS_STOP)
    m.id = message
    m.pack_msg_data()
    sonar.write(m.msg_data)


PATIENCE = 20  # s, on a machine that compiles something else


class Echosounder(unittest.TestCase):
    def connected(self, height, pitch):
        port = free_port()
        emulator = Emulator(TANK % (height, pitch, f"udp-listen://127.0.0.1:{port}"))
        emulator.__enter__()
        self.addCleanup(emulator.__exit__, None, None, None)
        sonar = Ping1D()
        sonar.connect_udp("127.0.0.1", port)
        self.addCleanup(lambda: sonar.iodev.close())
        self.assertTrue(sonar.initialize())
        return sonar

    def manual(self, sonar, start, length):
        self.assertTrue(sonar.set_mode_auto(0))
        self.assertTrue(sonar.set_speed_of_sound(1500000))
        self.assertTrue(sonar.set_range(start, length))

    def next_profiles(self, sonar, start, length, count=10):
        """Profiles of pings with that range, as the device streams them."""
        stream(sonar, definitions.PING1D_PROFILE)
        found = []
        for _ in range(200):
            profile = sonar.wait_message([definitions.PING1D_PROFILE], PATIENCE)
            self.assertIsNotNone(profile)
            if (profile.scan_start, profile.scan_length) == (start, length):
                found.append(profile)
            if len(found) == count:
                break
        stream(sonar, definitions.PING1D_PROFILE, start=False)
        self.assertEqual(len(found), count)
        return found

    def check(self, height, pitch, length, truth):
        sonar = self.connected(height, pitch)
        self.manual(sonar, 0, length)
        for profile in self.next_profiles(sonar, 0, length):
            self.assertEqual(profile.profile_data_length, 200)
            # Leading edges: one point, and what half a beam changes in range.
            self.assertGreaterEqual(profile.distance, 1000 * truth - length / 200)
            self.assertLessEqual(profile.distance, 1000 * truth / math.cos(math.radians(12.5)) + length / 200)
            self.assertGreaterEqual(profile.confidence, 90)

    def test_floor_two_metres_below(self):
        self.check(-2, DOWN, 5000, 2.0)

    def test_floor_half_a_metre_below(self):
        self.check(-3.5, DOWN, 2000, 0.5)

    def test_wall_six_metres_behind(self):
        self.check(-2, ASTERN, 10000, 6.0)

    def test_no_bottom_within_the_range_is_not_trusted(self):
        sonar = self.connected(-2, DOWN)
        self.manual(sonar, 300, 1000)
        profiles = self.next_profiles(sonar, 300, 1000)
        self.assertLess(sum(p.confidence for p in profiles) / len(profiles), 30)

    def test_automatic_range_follows_the_floor(self):
        sonar = self.connected(-2, DOWN)
        self.assertTrue(sonar.set_mode_auto(1))
        self.assertFalse(sonar.set_range(0, 7000), "refused while it is automatic")
        stream(sonar, definitions.PING1D_DISTANCE_SIMPLE)
        readings = [sonar.wait_message([definitions.PING1D_DISTANCE_SIMPLE], PATIENCE) for _ in range(15)]
        self.assertAlmostEqual(readings[-1].distance, 2000, delta=100)
        self.assertGreaterEqual(readings[-1].confidence, 90)
        self.assertLessEqual(sonar.get_range()["scan_length"], 5000)

    def test_the_packages_own_test_program_passes(self):
        with Emulator(TANK % (-2, DOWN, "pty:{folder}/ping1d")) as emulator:
            output = subprocess.run(
                [sys.executable, "-m", "brping.ping1d", "--device", str(emulator.folder / "ping1d")],
                env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
                capture_output=True,
                text=True,
                timeout=60,
            ).stdout
            self.assertEqual(output.count("> > pass: True"), 23, output)
            self.assertNotIn("pass: False", output)


if __name__ == "__main__":
    unittest.main()
