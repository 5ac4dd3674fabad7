"""The ARIS sonars end to end over UDP and TCP on loopback, against a controller written apart from the C++."""

import math
import statistics
import sys
import time
import unittest

from ports import free_port
from program import ROOT, Emulator

import aris_wire as wire
from aris_host import EXAMPLES, Host

sys.path.insert(0, str(ROOT / "tools"))
from scenes import manifold, seabed  # noqa: E402

SCENARIO = """
scene: {scenes}/%(scene)s.glb
water: {temperature: 8, salinity: 35, ph: 8, sound_speed: 1482.5}
vehicle: {pose: {position: %(position)s}}
devices:
  - name: aris
    model: %(model)s
    mount: {rpy_deg: [0, %(tilt)g, 0]}
    endpoints: ["tcp-listen://127.0.0.1:%(commands)d", "udp://127.255.255.255:%(beacon)d"]
    options: {temperature: 8%(options)s}
"""
# 1.5 to 14.5 m.
LONG = {"mode": 3, "rate": 5.0, "samples": 1250, "delay": 2024, "cycle": 20000, "period": 14, "pulse": 20, "gain": 18.0}


class ArisCase(unittest.TestCase):
    def start(self, scene, position, tilt=0, model="aris-1800", options=""):
        commands, beacon = free_port(), free_port()
        self.host = host = Host(beacon, commands)
        self.addCleanup(host.close)
        values = {"scene": scene, "position": position, "tilt": tilt, "model": model, "options": options}
        emulator = Emulator(SCENARIO % {**values, "commands": commands, "beacon": beacon})
        self.addCleanup(emulator.__exit__, None, None, None)
        emulator.__enter__()
        self.assertEqual(host.wait_beacon()["state"], 0)
        host.connect()
        host.start()
        return host

    def front(self, frame, clockwise, beyond, drop=25):
        """Metres to where a beam first comes within `drop` steps of the strongest that it has `beyond` a range."""
        column = frame.column(frame.beam(clockwise))
        rows = [s for s in range(frame.samples) if frame.metres(s) > beyond]
        strongest = max(column[s] for s in rows)
        return next(frame.metres(s) for s in rows if column[s] > strongest - drop)

    def level(self, frame, clockwise, near, far):
        """Mean sample between two ranges over five beams."""
        beam = frame.beam(clockwise)
        rows = [s for s in range(frame.samples) if near < frame.metres(s) < far]
        return statistics.mean(frame.image[s * frame.beams + b] for s in rows for b in range(beam - 2, beam + 3))


class Manifold(ArisCase):
    """The scene of demo.yaml from 8.5 m: the sonar at (-8.5, 0, -6) looks 20 deg down at a manifold at the origin."""

    EYE, TILT, YAW = (-8.5, 0.0, -6.0), math.radians(20), 0.5

    def seen(self, x, y, z):
        """(degrees to starboard, range) of a point of the manifold, in its own frame."""
        ground = min(seabed.height(a, b) for a in (-3, 0, 3) for b in (-2, 0, 2))
        c, s = math.cos(self.YAW), math.sin(self.YAW)
        dx, dy, dz = c * x - s * y - self.EYE[0], s * x + c * y - self.EYE[1], ground + z - self.EYE[2]
        ahead = dx * math.cos(self.TILT) - dz * math.sin(self.TILT)
        return math.degrees(math.atan2(-dy, ahead)), math.sqrt(dx * dx + dy * dy + dz * dz)

    def test_manifold_stands_at_its_beam_and_range_in_either_order_of_samples(self):
        # The upper edge of the panel at the near end of the manifold.
        bearing, distance = self.seen(-manifold.LENGTH / 2 - 0.09, 0, 2.15)
        for order in ("device", "reordered"):
            with self.subTest(order):
                host = self.start("manifold", list(self.EYE), 20, options=f", sample_order: {order}")
                frame = host.next_with(host.acoustics(**LONG))
                self.assertEqual(frame.header["reordered"], order == "reordered")
                self.assertAlmostEqual(self.front(frame, bearing, 3), distance, delta=0.12)
                far_side = self.seen(manifold.LENGTH / 2, 0, 1)[1]
                self.assertGreater(self.level(frame, bearing, distance, distance + 1), self.level(frame, bearing, 2, 4) + 40)
                # In front of the manifold there is water, behind it a shadow.
                self.assertLess(self.level(frame, 0, far_side + 1, far_side + 3), self.level(frame, 0, distance, far_side) - 15)
                self.assertEqual(host.faults, [])


class Tank(ArisCase):
    """12 x 8 m: walls 6 m ahead and 4 m to either side; a post to starboard, a lattice ahead and to port."""

    def wall(self, frame, metres, beyond):
        """Over some beams to starboard, since single ones have speckle."""
        ranges = [self.front(frame, d, beyond, 40) * math.cos(math.radians(d)) for d in (2, 3, 4, 5, 6, 7, 8, 9, 10)]
        self.assertAlmostEqual(statistics.median(ranges), metres, delta=0.06)

    def test_what_the_controller_sets_changes_the_next_frame(self):
        host = self.start("tank", [1, 0, -2])
        first = host.next_with(host.acoustics(**EXAMPLES[0]))
        self.assertEqual((first.beams, first.samples, first.header["serial"]), (96, 1014, 1001))
        self.assertAlmostEqual(first.header["sound_speed"], 1482.5, delta=1)
        self.wall(first, 5, 4.4)
        # Fewer beams at the low frequency; another window.
        low = {**EXAMPLES[0], "mode": 1, "samples": 600, "delay": 5000, "period": 4}
        frame = host.next_with(host.acoustics(**low, high=False))
        self.assertEqual((frame.beams, frame.samples, frame.header["frequency"]), (48, 600, 0))
        self.assertAlmostEqual(frame.metres(0), 1482.5 / 2 * 5002e-6, delta=0.01)
        self.wall(frame, 5, 4.4)
        # Gain: 6 dB are 6 x 255 / 80 steps. Without transmission there is no wall.
        loud, soft = (host.next_with(host.acoustics(**{**LONG, "gain": gain})) for gain in (24.0, 18.0))
        middle = lambda frame: statistics.median(s for b in range(20, 40) for s in frame.column(b)[900:])
        self.assertAlmostEqual(middle(loud) - middle(soft), 6 * 255 / 80, delta=2)
        quiet = host.next_with(host.acoustics(**EXAMPLES[0], transmit=False))
        self.assertGreater(self.level(first, 6, 4.98, 5.1), self.level(quiet, 6, 4.98, 5.1) + 40)
        # Too long a pulse is made to fit, and said to be: its cookie is not that of settings that were applied.
        fitted = host.next_with(host.acoustics(**{**EXAMPLES[0], "pulse": 80}))
        self.assertEqual((fitted.header["constrained"], fitted.header["pulse"]), (host.cookie, 20))
        self.assertEqual(fitted.header["applied"], host.cookie - 1)
        host.next_with(host.acoustics(**EXAMPLES[0]))
        # What cannot be is named in the header and changes nothing.
        refused = host.acoustics(**{**EXAMPLES[0], "samples": 4096})
        frame = host.frame(10, lambda frame: frame.header["invalid"] == refused)
        self.assertEqual((frame.header["applied"], frame.samples), (refused - 1, 1014))
        # Another salinity, another speed of sound: the same time is another range.
        host.say(4, 6, 0)
        fresh = host.frame(10, lambda frame: frame.header["salinity"] == 0)
        self.assertAlmostEqual(fresh.header["sound_speed"], 1439.2, delta=0.3)
        self.assertEqual(host.faults, [])

    def test_the_post_is_to_starboard(self):
        # The post at (1.2, -2.6), 0.15 m thick, 8 deg to starboard of a sonar at (-3.5, -1.94).
        host = self.start("tank", [-3.5, -1.94, -2])
        frame = host.next_with(host.acoustics(**EXAMPLES[0]))
        bearing, distance = math.degrees(math.atan2(0.66, 4.7)), math.hypot(0.66, 4.7) - 0.15
        self.assertAlmostEqual(self.front(frame, bearing, 3), distance, delta=0.06)
        self.assertGreater(
            self.level(frame, bearing, distance, distance + 0.1), self.level(frame, -bearing, distance, distance + 0.1) + 40
        )

    def test_its_own_sensors_tell_depth_attitude_and_focus(self):
        host = self.start("tank", [1, 0, -2], tilt=20)
        frame = host.next_with(host.acoustics(**EXAMPLES[0]))
        self.assertAlmostEqual(frame.depth, 2, delta=0.06)
        h = frame.header
        self.assertAlmostEqual(h["heading"], 90, delta=2)  # the x axis is east
        self.assertAlmostEqual(h["pitch"], -20, delta=0.3)
        self.assertAlmostEqual(h["accel_x"], -math.sin(math.radians(20)), delta=0.01)
        self.assertAlmostEqual(h["accel_z"], -math.cos(math.radians(20)), delta=0.01)
        self.assertGreater(h["app_version"], 0)
        # start() focuses on 5 m; the lens is there within two seconds, and moves away for another range.
        near = host.frame(3, lambda frame: not frame.header["focus_moving"]).header
        self.assertEqual(near["focus_position"], near["focus"])
        host.say(wire.SET_FOCUS, 8, None, 1.2)
        moving = host.frame(2, lambda frame: frame.header["focus_position"] != near["focus_position"]).header
        self.assertLess(moving["focus"], near["focus"])
        self.assertEqual(host.faults, [])

    def test_the_aris_3000_sees_the_same_wall(self):
        host = self.start("tank", [2, 0, -2], model="aris-3000")
        for mode, beams in ((9, 128), (6, 64)):
            frame = host.next_with(host.acoustics(**{**EXAMPLES[1], "mode": mode}))
            self.assertEqual((frame.beams, frame.header["system_type"]), (beams, 1))
            self.wall(frame, 4, 3.5)
        self.assertEqual(host.faults, [])

    def test_the_aris_1200_sees_the_same_wall_farther_away(self):
        host = self.start("tank", [0, 0, -2], model="aris-1200")
        for high in (True, False):
            frame = host.next_with(host.acoustics(**EXAMPLES[2], high=high))
            self.assertEqual((frame.beams, frame.header["system_type"]), (48, 2))
            self.wall(frame, 6, 5.4)
        self.assertEqual(host.faults, [])


class Timing(ArisCase):
    def test_every_controller_gets_frames_from_one_on(self):
        host = self.start("flat", [0, 0, -12])
        for controller in range(2):
            first = host.next_with(host.acoustics(**EXAMPLES[0]))
            self.assertEqual((first.number, first.header["index"]), (1, 1))
            host.next_with(host.cookie)
            host.stream.close()
            host.wait_beacon(5, lambda beacon: beacon["state"] == 0)
            host.connect()
            host.start()

    def test_frames_come_at_their_rate_and_by_the_controllers_clock(self):
        host = self.start("flat", [0, 0, -12])
        for rate in (10.0, 4.0):
            cookie = host.acoustics(**{**EXAMPLES[0], "rate": rate})
            seen = [host.next_with(cookie) for _ in range(6)]
            steps = [(b.header["go_time"] - a.header["go_time"]) / 1e6 for a, b in zip(seen, seen[1:])]
            self.assertAlmostEqual(statistics.median(steps), 1 / rate, delta=0.1 / rate)
            self.assertEqual([b.number - a.number for a, b in zip(seen, seen[1:])], [1] * 5)
            steps = [(b.header["frame_time"] - a.header["frame_time"]) / 1e6 for a, b in zip(seen, seen[1:])]
            self.assertAlmostEqual(statistics.median(steps), 1 / rate, delta=0.1 / rate)
        for clock in ("frame_time", "sonar_time"):
            self.assertAlmostEqual(seen[-1].header[clock] / 1e6, time.time(), delta=3)
        self.assertEqual(host.wait_beacon(5, lambda beacon: beacon["state"] == 1)["serial"], 1001)
        self.assertEqual(host.faults, [])


if __name__ == "__main__":
    unittest.main()
