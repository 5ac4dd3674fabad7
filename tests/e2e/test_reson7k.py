"""The 7k multibeam end to end over TCP and UDP on loopback, against a host written apart from the C++."""

import bisect
import json
import math
import statistics
import struct
import subprocess
import time
import unittest
from xml.etree import ElementTree

from ports import free_port
from program import PROGRAM, Emulator

import reson_wire as wire
from reson_host import Host

SCENARIO = """
scene: {scenes}/%s.glb
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
vehicle: {pose: {position: %s}}
devices:
  - name: multibeam
    model: reson-7k
    mount: {rpy_deg: [0, %g, 0]}
    endpoints: ["tcp-listen://127.0.0.1:%d"]
    options: {range: 40, max_ping_rate: 10, swath: 130}
"""
C = 1500.0


class ResonCase(unittest.TestCase):
    def start(self, scene="flat", position=(0, 0, -12), pitch=90, udp=False):
        self.port = free_port()
        self.emulator = Emulator(SCENARIO % (scene, list(position), pitch, self.port))
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.emulator.__enter__()
        return self.connect(udp)

    def connect(self, udp=False):
        host = Host(("127.0.0.1", self.port), udp)
        self.addCleanup(host.close)
        return host


class FlatFloor(ResonCase):
    """The floor is 8 m below the head."""

    def check_floor(self, host):
        host.wait(wire.DETECTIONS)
        for _ in range(3):
            points = [p for p in host.wait(wire.DETECTIONS).points() if abs(p[2]) < math.radians(60)]
            self.assertGreater(len(points), 230)
            for beam, two_way, angle, *_ in points:
                depth = C / 2 * two_way * math.cos(angle)
                self.assertAlmostEqual(depth, 8, delta=0.04, msg=f"beam {beam} at {math.degrees(angle):.1f} deg")

    def test_depths_are_right_within_half_a_percent_over_tcp(self):
        host = self.start()
        self.assertEqual(host.subscribe(wire.SETTINGS, wire.DETECTIONS), 0)
        self.check_floor(host)

    def test_depths_are_right_over_udp_beside_a_host_on_tcp(self):
        host = self.start()
        self.assertEqual(host.subscribe(wire.SETTINGS), 0)
        other = self.connect(udp=True)
        self.assertEqual(other.subscribe(wire.DETECTIONS, wire.BEAMFORMED), 0)
        self.check_floor(other)
        self.assertEqual(other.wait(wire.BEAMFORMED).get("H", 14), 256)
        self.assertEqual(other.command(1052), 0)
        self.assertEqual(host.wait(wire.SETTINGS).device, 7125)

    def test_images_have_the_floor_where_it_is(self):
        host = self.start()
        host.subscribe(wire.IMAGE, wire.BEAMFORMED, wire.GEOMETRY)
        angles = host.wait(wire.GEOMETRY).get("256f", 12 + 4 * 256)
        beamformed = host.wait(wire.BEAMFORMED)
        off = []
        for beam in range(20, 236):
            column = beamformed.column(beam)
            front = next(i for i, a in enumerate(column) if a > 0.3 * max(column))
            off.append(abs(C / 2 * front / 34500 - 8 / math.cos(angles[beam])))
        self.assertLess(statistics.median(off), 0.1)
        self.assertLess(sorted(off)[len(off) * 19 // 20], 0.25, "but where speckle fades in the middle of the beam")
        image = host.wait(wire.IMAGE)
        rows = image.picture()
        middle = [row[127] for row in rows]
        metres = 40 / len(rows)
        self.assertAlmostEqual(middle.index(max(middle)) * metres, 8, delta=0.2)
        self.assertEqual(image.get("I", 6), 256)

    def test_settings_change_the_next_ping_and_its_timing(self):
        host = self.start()
        host.subscribe(wire.SETTINGS, wire.BEAMFORMED)
        for command, value, offset in ((1003, 20, 54), (1004, 4, 46), (1005, 200, 58), (1008, 45, 62)):
            self.assertEqual(host.set(command, value), 0)
            host.wait(wire.SETTINGS, 5, lambda r: abs(r.get("f", offset) - value) < 1e-4)
        self.assertEqual(host.wait(wire.BEAMFORMED).get("I", 16), math.ceil(2 * 20 / C * 34500))
        pings = [host.wait(wire.SETTINGS) for _ in range(6)]
        for before, after in zip(pings, pings[1:]):
            self.assertAlmostEqual((after.time - before.time).total_seconds(), 0.25, delta=0.05)
            self.assertEqual(after.ping, before.ping + 1)
        self.assertLess(abs(pings[-1].time.timestamp() - time.time()), 5)
        self.assertEqual(host.command(1101), 0)
        self.assertEqual(host.set(1003, 1e6), 0x7001)

    def test_more_gain_is_a_brighter_image_and_less_power_a_darker_one(self):
        host = self.start()
        host.subscribe(wire.SETTINGS, wire.BEAMFORMED)

        def level(command, value, offset):
            self.assertEqual(host.set(command, value), 0)
            ping = host.wait(wire.SETTINGS, 5, lambda r: abs(r.get("f", offset) - value) < 1e-4).ping
            record = host.wait(wire.BEAMFORMED, 5, lambda r: r.ping >= ping)
            return sum(max(record.column(beam)) for beam in range(110, 146))

        plain = level(1008, 20, 62)
        self.assertAlmostEqual(level(1008, 30, 62) / plain, 10**0.5, delta=0.8)
        level(1008, 20, 62)
        self.assertAlmostEqual(level(1005, 200, 58) / plain, 10**-0.5, delta=0.12)


class Tank(ResonCase):
    def test_walls_are_at_their_bearings(self):
        """12 x 8 m: looking along, the walls are 6 m ahead and 4 m to either side."""
        host = self.start("tank", (0, 0, -1.5), 0)
        host.set(1003, 12)
        host.subscribe(wire.DETECTIONS)
        host.wait(wire.DETECTIONS)
        points = [(C / 2 * t * math.cos(a), C / 2 * t * math.sin(a), a) for _, t, a, *_ in host.wait(wire.DETECTIONS).points()]
        ahead = [x for x, _, a in points if abs(a) < math.radians(20)]
        port = [y for _, y, a in points if a < math.radians(-50)]
        starboard = [y for _, y, a in points if math.radians(41) < a < math.radians(56)]
        self.assertAlmostEqual(statistics.median(ahead), 6, delta=0.03)
        self.assertAlmostEqual(statistics.median(port), -4, delta=0.02, msg="port is negative")
        self.assertAlmostEqual(statistics.median(starboard), 4, delta=0.02)


class RollingVessel(ResonCase):
    """What a host makes of soundings and the motion records beside them: a vessel that rolls by 5 deg within 4 s."""

    def test_soundings_reduced_with_its_motion_lie_on_the_floor_and_with_a_wrong_one_do_not(self):
        rows = ["t,x,y,z,qw,qx,qy,qz"]
        for i in range(1200):
            half, north = math.radians(5 * math.sin(2 * math.pi * 0.05 * i / 4)) / 2, math.sqrt(0.5)  # a yaw of 90 deg
            c, s = north * math.cos(half), north * math.sin(half)
            rows.append(f"{0.05 * i:.2f},0,0,-12,{c:.9f},{s:.9f},{s:.9f},{c:.9f}")
        self.port = free_port()
        scenario = (SCENARIO % ("flat", "", 90, self.port)).replace("{pose: {position: }}", "{trajectory: way.csv}")
        emulator = Emulator(scenario, files={"way.csv": "\n".join(rows) + "\n"})
        self.addCleanup(emulator.__exit__, None, None, None)
        emulator.__enter__()
        host = self.connect()
        self.assertEqual(host.subscribe(wire.DETECTIONS, wire.MOTION), 0)
        pings, motion = [], []
        while len(pings) < 30 or motion[-1][0] < pings[-1].time.timestamp() + 0.3:
            record = host.record()
            if record.kind == wire.MOTION:
                motion.append((record.time.timestamp(), *record.get("3f", 0)))
            elif record.kind == wire.DETECTIONS and len(pings) < 30 and motion and record.time.timestamp() > motion[0][0] + 0.3:
                pings.append(record)

        def roll_at(t):
            after = bisect.bisect(motion, (t,))
            (t0, r0, *_), (t1, r1, *_) = motion[after - 1 : after + 1]
            return r0 + (r1 - r0) * (t - t0) / (t1 - t0)

        def worst(sign, latency):
            """Of 95 % of a ping's depths. The receiver's array steers: its roll counts when the echo comes."""
            worst = 0
            for ping in pings:
                at, left = ping.time.timestamp() + latency, []
                for _, travel, angle, *_ in ping.points():
                    depth = C / 2 * travel * math.cos(angle - sign * roll_at(at + travel))  # port up; starboard positive
                    left.append(abs(depth / 8 - 1))
                worst = max(worst, sorted(left)[int(0.95 * len(left))])
            return worst

        self.assertLess(worst(1, 0), 0.005)
        self.assertGreater(worst(-1, 0), 0.05, "with a swapped sign")
        self.assertGreater(worst(1, 0.2), 0.02, "with a latency of 0.2 s")
        self.assertGreater(worst(1, -0.2), 0.02, "with a latency of -0.2 s")


class Files(ResonCase):
    def test_a_logged_file_is_read_again(self):
        host = self.start()
        host.command(1050, struct.pack("<I", wire.CONFIGURATION), 7000)
        log = [host.wait(wire.CONFIGURATION)]
        info = log[0].get("I", 12 + 76)
        sonar = ElementTree.fromstring(log[0].data[64 + 92 : 64 + 92 + info - 1])
        self.assertEqual(sonar[0].tag, "Name")
        self.assertEqual((sonar[0].get("deviceid"), sonar[0].get("enumerator")), ("7125", "0"))
        self.assertEqual(sonar.find("Frequency").get("center"), "400000")
        self.assertEqual((sonar.find("Range").get("min"), sonar.find("Range").get("max")), ("1", "500"))
        host.subscribe(wire.SETTINGS, wire.GEOMETRY, wire.DETECTIONS)
        log += [host.record() for _ in range(7)]
        file = self.emulator.folder / "pings.s7k"
        file.write_bytes(wire.file_of(log))
        shown = subprocess.run([PROGRAM, "inspect", file, "--json"], capture_output=True, text=True, timeout=60)
        names = [message["name"] for message in json.loads(shown.stdout)["messages"]]
        self.assertEqual(names[:2] + names[-1:], ["FileHeader", "Configuration", "FileCatalogue"])
        self.assertEqual(len(names), len(log) + 2)


if __name__ == "__main__":
    unittest.main()
