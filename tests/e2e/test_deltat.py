"""The Delta T's program end to end on loopback: the floor of the scene is where its 83P says, and EC changes it."""

import calendar
import math
import os
import socket
import statistics
import subprocess
import time
import unittest

from ports import free_port
from program import PROGRAM, Emulator

import deltat_wire as wire

SCENARIO = """
scene: %s
seed: 3
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: %s}
vehicle: {pose: {position: [0, 0, %s], rpy_deg: [%s, %s, 30]}}
devices:
  - name: deltat
    model: imagenex-deltat
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["udp://127.0.0.1:%s"]
    options: {%s}
"""
FLAT = "{scenes}/flat.glb"  # its floor is 20 m below the surface


class DeltaTCase(unittest.TestCase):
    def start(self, z=-12.0, roll=0, pitch=0, speed=1500, options="range: 20", scene=FLAT):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(self.socket.close)
        self.socket.bind(("127.0.0.1", free_port()))
        self.socket.settimeout(20)
        port = self.socket.getsockname()[1]
        self.emulator = Emulator(SCENARIO % (scene, speed, z, roll, pitch, port, options))
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.emulator.__enter__()

    def next(self):
        data, self.sender = self.socket.recvfrom(65536)
        self.assertLessEqual(len(data), 2176)
        return wire.read_83p(data)

    def first_with(self, wanted, **settings):
        """The first 83P that shows it; as hosts do, an EC answers each one."""
        end = time.monotonic() + 20
        while time.monotonic() < end:
            profile = self.next()
            if wanted(profile):
                return profile
            self.socket.sendto(wire.control(**settings), self.sender)
        self.fail(f"nothing of {settings} in 20 s")

    def check_depths(self, profile, depth, inside=60.0, within=0.005):
        """Each beam within that part of the depth, and all of them without a bias. A pulse of 0.09 m, as at a range of 20 m, is
        near the nadir all of the echo: speckle moves it by the length over sqrt 12, 2.6 cm or a third of a percent of 8 m."""
        errors = []
        for beam in range(profile.beams):
            angle = profile.angle(beam)
            if abs(angle) >= inside:
                continue
            found = profile.ranges[beam] * math.cos(math.radians(angle))
            self.assertGreater(found, 0, f"no bottom at {angle} deg")
            errors.append(found / depth - 1)
        self.assertLess(max(map(abs, errors)), within, f"{1000 * max(map(abs, errors)):.1f} permille")
        self.assertLess(abs(statistics.mean(errors)), within / 2)


class FlatFloor(DeltaTCase):
    def test_depth_and_header(self):
        self.start()
        first = self.next()
        profiles = [self.next() for _ in range(5)]
        for profile in profiles:
            self.check_depths(profile, 8.0)
            self.assertTrue(all(i > 0 for i in profile.intensities))
        self.assertEqual([p.number for p in profiles], list(range(first.number + 1, first.number + 6)))
        p = profiles[-1]
        self.assertEqual((p.beams, p.sector, p.range, p.sound_speed, p.frequency), (240, 120, 20, 1500.0, 260))
        now = time.time()
        then = time.strptime(p.time[:19], "%Y-%m-%dT%H:%M:%S")
        self.assertLess(abs(now - calendar.timegm(then)), 60)
        self.assertAlmostEqual(p.heading, 60, delta=2, msg="30 deg left of east")

    def test_external_control_changes_range_sector_and_beams(self):
        self.start()
        narrow = self.first_with(lambda p: p.sector == 60, range=30, sector=60, beams=120, beam_width=2, gain=6)
        self.assertEqual((narrow.range, narrow.beams, narrow.increment), (30, 120, 0.5))
        self.check_depths(narrow, 8.0, within=0.01)  # its pulse is 0.135 m long: 3.9 cm
        self.assertLess(max(abs(x) for x, _ in narrow.points()), 8 * math.tan(math.radians(30.3)))
        wide = self.first_with(lambda p: p.beams == 480, range=20, beams=480, beam_width=1)
        self.assertEqual(len(wide.ranges), 480)
        self.check_depths(wide, 8.0)
        near = self.first_with(lambda p: p.range == 10, range=10)
        edge = math.degrees(math.acos(8 / 10))
        beyond = [near.ranges[beam] for beam in range(near.beams) if abs(near.angle(beam)) > edge + 2]
        self.assertGreater(len(beyond), 70)
        # 32 staves that differ hear the nadir 21 dB down in every beam, and there is no other bottom.
        through_side_lobes = [r for r in beyond if r > 0]
        self.assertLessEqual(len(through_side_lobes), len(beyond) / 8)
        self.assertGreater(len(near.points()), 120)
        self.assertEqual(self.first_with(lambda p: p.range == 5, range=5).points(), [])
        gated = self.first_with(lambda p: p.range == 20 and not 0 < p.ranges[120] < 12, minimum_range=12)
        self.assertTrue(all(math.hypot(*point) >= 12 for point in gated.points()))
        self.assertGreater(len(gated.points()), 20)

    def test_the_pace_follows_range_and_averaging(self):
        self.start()
        for settings, seconds in (({"range": 20}, 0.05), ({"range": 200}, 0.277), ({"averaging": 5}, 0.25)):
            with self.subTest(settings):
                wanted = {"range": 20, **settings}
                self.first_with(lambda p: p.range == wanted["range"] and p.averaged == settings.get("averaging", 0),
                                **settings)  # fmt: skip
                began = time.monotonic()
                for _ in range(8):
                    self.next()
                self.assertAlmostEqual((time.monotonic() - began) / 8, seconds, delta=0.25 * seconds)

    def test_sound_speed_is_for_the_host_to_use(self):
        self.start(speed=1450)
        profile = self.next()
        self.assertEqual(profile.sound_speed, 1450.0)
        self.check_depths(profile, 8.0 * 1500 / 1450)
        told = self.first_with(lambda p: p.sound_speed == 1470.0, sound_speed=1470.0, little=True)
        self.check_depths(told, 8.0 * 1500 / 1450)

    def test_receive_only_hears_no_bottom(self):
        self.start()
        quiet = self.first_with(lambda p: not p.points(), receive_only=1)
        self.assertEqual(quiet.range, 20)
        self.check_depths(self.first_with(lambda p: p.points()), 8.0)


class Attitude(DeltaTCase):
    def test_points_and_attitude_together_are_the_level_floor(self):
        self.start(roll=8, pitch=-4)  # port side up by 8, bow up by 4 deg
        self.next()
        profile = self.next()
        self.assertAlmostEqual(profile.roll, 8, delta=0.4)
        self.assertAlmostEqual(profile.pitch, 4, delta=0.4)
        a = math.radians(profile.roll)
        depths = [z * math.cos(a) + x * math.sin(a) for x, z in profile.points() if abs(x) < z]
        self.assertGreater(len(depths), 100)
        for depth in depths:
            self.assertAlmostEqual(depth * math.cos(math.radians(profile.pitch)), 8, delta=0.08)

    def test_roll_compensation_levels_the_fan(self):
        self.start(roll=8)
        self.first_with(lambda p: abs(p.ranges[60] - p.ranges[180]) < 0.15 and p.points(), roll_compensation=1)
        self.check_depths(self.next(), 8.0, inside=50)


class Inspect(DeltaTCase):
    def test_inspect_reads_datagrams_as_a_file(self):
        self.start(options="beams: 120")
        file = self.emulator.folder / "dive.83P"
        raw = b"".join(self.socket.recvfrom(65536)[0] for _ in range(3)) + wire.control()
        file.write_bytes(raw)
        done = subprocess.run([PROGRAM, "inspect", str(file)], capture_output=True, text=True, timeout=60,
                              env={**os.environ, "NO_COLOR": "1"})  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("deltat 83P, 736 bytes"), 3, done.stdout[:400])
        self.assertEqual(done.stdout.count("deltat EC, 256 bytes"), 1)


if __name__ == "__main__":
    unittest.main()
