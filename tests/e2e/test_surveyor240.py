"""The Surveyor 240-16 end to end on loopback: the bottom of the scene is where its points say."""

import base64
import json
import math
import struct
import unittest

from ports import free_port
from program import Emulator

import surveyor_wire as wire
from surveyor_host import Host

SCENARIO = """
scene: %s
seed: 3
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
vehicle: {%s}
devices:
  - name: surveyor
    model: surveyor240
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["%s"]
    options: {acknowledge: true, %s}
"""
FLAT = "{scenes}/flat.glb"
OWN = "{folder}/floor.gltf"


def gltf(quads):
    """A scene of sand from quadrilaterals of ENU corners, counter-clockwise from above."""
    corners = [(x, z, -y) for quad in quads for x, y, z in quad]
    indices = [4 * n + i for n in range(len(quads)) for i in (0, 1, 2, 0, 2, 3)]
    data = struct.pack(f"<{len(indices)}I", *indices)
    split = len(data)
    data += b"".join(struct.pack("<fff", *corner) for corner in corners)
    low, high = ([pick(c[i] for c in corners) for i in range(3)] for pick in (min, max))
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    views = [{"buffer": 0, "byteLength": split}, {"buffer": 0, "byteOffset": split, "byteLength": len(data) - split}]
    accessors = [
        {"bufferView": 0, "componentType": 5125, "count": len(indices), "type": "SCALAR"},
        {"bufferView": 1, "componentType": 5126, "count": len(corners), "type": "VEC3", "min": low, "max": high},
    ]
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"name": "floor", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0, "material": 0}]}],
        "materials": [{"name": "sand"}], "accessors": accessors, "bufferViews": views,
        "buffers": [{"uri": uri, "byteLength": len(data)}],
    })  # fmt: skip


def footprint(y, z):
    """How much of the depth the echo of one direction spans: 1 deg of angle, and a pulse of 1.5 steps."""
    angle = abs(math.atan2(y, -z))
    return abs(z) * math.tan(angle) * math.radians(1.0)


class SurveyorCase(unittest.TestCase):
    def start(self, scene=FLAT, z=-12.0, roll=0, pitch=0, vehicle="", options="", datagrams=False, utc=None, files=()):
        port = free_port() if datagrams else free_port()
        endpoint = f"{'udp' if datagrams else 'tcp'}-listen://127.0.0.1:{port}"
        vehicle = vehicle or f"pose: {{position: [0, 0, {z}], rpy_deg: [{roll}, {pitch}, 30]}}"
        emulator = Emulator(SCENARIO % (scene, vehicle, endpoint, options), files=files)
        self.addCleanup(emulator.__exit__, None, None, None)
        emulator.__enter__()
        host = Host(port, datagrams, utc)
        self.addCleanup(host.close)
        return host

    def check_depths(self, ping, depth):
        self.assertGreaterEqual(len(ping.points), 10)
        self.assertLessEqual(len(ping.points), 15)
        for y, z in ping.points:
            self.assertLess(abs(-z - depth), max(0.005 * depth, footprint(y, z)), f"{y:.2f} m to port")


class FlatFloor(SurveyorCase):
    def test_depth_over_tcp_and_the_hosts_sound_speed(self):
        host = self.start(options="temperature: 10.5")
        host.say(wire.request(wire.DEVICE_INFORMATION))
        self.assertEqual(host.next(wire.DEVICE_INFORMATION).payload[0], 198)
        host.set()
        pings = host.pings(6)
        for ping in pings:
            self.check_depths(ping, 8.0)
        middle = [-z for ping in pings for y, z in ping.points]
        self.assertLess(abs(sum(middle) / len(middle) - 8.0), 0.005 * 8, "without a bias")
        left, right = (max(sign * y for ping in pings for y, _ in ping.points) for sign in (1, -1))
        for reach in (left, right):
            self.assertGreater(reach, 8 * math.tan(math.radians(34)))
            self.assertLess(reach, 8 * math.tan(math.radians(41)))
        self.assertEqual([p.number for p in pings], list(range(pings[0].number, pings[0].number + 6)))
        self.check_depths(host.first_ping(sos_mps=1480.0), 8.0 * 1480 / 1500)
        yz = wire.read_yz(host.next(wire.YZ_POINTS).payload)
        self.check_depths(yz, 8.0 * 1480 / 1500)
        self.assertAlmostEqual(yz.header["start"], 0.75, places=4)
        self.assertAlmostEqual(yz.header["end"], 15.0, places=4)
        self.assertAlmostEqual(yz.header["degC"], 10.5, delta=0.3)
        self.assertEqual(yz.header["bar"], -1000)

    def test_depth_over_udp_with_fine_steps(self):
        host = self.start(datagrams=True)
        host.set(start_mm=5000, end_mm=12000, n_range_steps=800)
        for ping in host.pings(4):
            self.check_depths(ping, 8.0)

    def test_range_decides_what_is_seen(self):
        host = self.start()
        self.assertEqual(host.first_ping(end_mm=7000).points, [])
        ping = host.first_ping(end_mm=9000)
        self.assertGreaterEqual(len(ping.points), 5)
        # Close beyond the edge a direction may hear the last of the bottom in range through its own lobes: one unit of eight
        # does, 2.7 deg beyond. Farther on there is none, and no point is what staves that differ hear of the nadir there.
        edge = math.degrees(math.acos(8 / 9)) + 3
        outside = [p for p in ping.points if abs(math.degrees(math.atan2(p[0], -p[1]))) >= edge]
        self.assertEqual(outside, [])
        points = host.first_ping(start_mm=8500, end_mm=12000).points
        self.assertGreaterEqual(len(points), 5)
        for y, z in points:
            self.assertGreater(math.hypot(y, z), 8.5)
        host.set(enable_atof_data=False)
        ids = [host.next(wire.YZ_POINTS, wire.ATOF_POINTS).id for _ in range(6)]
        self.assertEqual(ids[2:], [wire.YZ_POINTS] * 4)

    def test_follows_the_bottom(self):
        host = self.start(z=-1.0)  # 19 m above the floor: beyond the first guess
        host.set(end_mm=0, msec_per_ping=0)
        pings = host.pings(8)
        self.assertEqual(pings[0].points, [])
        self.check_depths(pings[-1], 19.0)
        self.assertAlmostEqual(pings[-1].header["listening"] * 750, 1.25 * 19 / math.cos(math.radians(40)), delta=2)

    def test_the_pace_is_the_hosts_or_that_of_the_range(self):
        host = self.start()

        def period(**parameters):
            pings = [host.first_ping(**parameters), *host.pings(4)]
            return (pings[-1].header["pwr_up_msec"] - pings[0].header["pwr_up_msec"]) / 4

        self.assertAlmostEqual(period(msec_per_ping=200), 200, delta=30)
        self.assertAlmostEqual(period(end_mm=75000, msec_per_ping=10), 105, delta=30)

    def test_stopped_it_still_reports(self):
        host = self.start(utc=1700000000000)
        host.set()
        host.atof()
        host.set(ping_enable=False)
        host.next(wire.ATTITUDE)  # what was sent before it may still be on its way
        host.next(wire.ATTITUDE)
        for _ in range(5):
            frame = host.next(wire.ATTITUDE, wire.ATOF_POINTS, wire.YZ_POINTS)
            self.assertEqual(frame.id, wire.ATTITUDE)
        _, _, utc, _ = wire.read_attitude(frame.payload)
        self.assertLess(abs(utc - 1700000000000), 60000)


class Shapes(SurveyorCase):
    def test_a_slope_is_as_steep_as_it_is(self):
        slope = math.radians(12)
        far = 60.0

        def corner(x, port):
            # along the bow, and to port of a vehicle that heads 30 deg north of east
            c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
            return x * c - port * s, x * s + port * c, -10 + port * math.tan(slope)

        quad = [corner(-far, -20), corner(far, -20), corner(far, 20), corner(-far, 20)]
        host = self.start(OWN, z=-1.0, files={"floor.gltf": gltf([quad])})
        host.set(end_mm=20000)
        for ping in host.pings(4):
            self.assertGreaterEqual(len(ping.points), 10)
            for y, z in ping.points:
                true = -9 + y * math.tan(slope)
                incidence = math.atan2(y, -z) + slope
                spread = math.hypot(y, z) * abs(math.tan(incidence)) * math.radians(1.0)
                self.assertLess(abs(z - true), max(0.005 * 9, spread), f"{y:.2f} m to port")

    def test_a_step_is_at_its_place(self):
        far, edge = 60.0, 1.5

        def level(low, high, z):
            c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
            corners = [(-far, low), (far, low), (far, high), (-far, high)]
            return [(x * c - p * s, x * s + p * c, z) for x, p in corners]

        floor = gltf([level(-40, edge, -10), level(edge, 40, -8.5)])
        host = self.start(OWN, z=-2.0, files={"floor.gltf": floor})
        host.set()
        points = sorted(point for ping in host.pings(20) for point in ping.points)
        deep, shallow = ([p for p in points if abs(p[1] + d) < 0.1] for d in (8.0, 6.5))
        self.assertGreater(len(deep), 40)
        self.assertGreater(len(shallow), 40)
        self.assertGreater(len(deep) + len(shallow), 0.95 * len(points), "and hardly a point on neither")
        # One direction is a degree wide: 15 cm on the bottom.
        self.assertLess(max(y for y, _ in deep), edge + 0.15)
        self.assertGreater(min(y for y, _ in shallow), edge - 0.15)
        self.assertLess(min(y for y, _ in shallow) - max(y for y, _ in deep), 1.0, "no wide gap between them")


class Attitude(SurveyorCase):
    def test_points_and_attitude_together_are_the_level_floor(self):
        host = self.start(roll=9, pitch=-6)  # port side up by 9, bow up by 6 deg
        host.say(wire.request(wire.ATTITUDE))
        host.next(wire.ATTITUDE)
        for before in (True, False):
            with self.subTest("before a ping" if before else "after it"):
                roll, pitch, _, _ = wire.read_attitude(host.next(wire.ATTITUDE).payload)
                self.assertAlmostEqual(math.degrees(pitch), 6, delta=0.6)
                self.assertAlmostEqual(math.degrees(math.atan2(math.sin(roll), math.cos(roll))), 9, delta=0.6)
            host.set()
            ping = host.atof()
        self.assertGreaterEqual(len(ping.points), 10)
        for point in ping.points:
            along = 8.0 / math.cos(pitch)  # down in the head's tilted plane
            _, z = wire.levelled(point, roll)
            self.assertLess(abs(-z - along), max(0.005 * 8, footprint(*point) + 0.1), str(point))


class OnAMovingVehicle(SurveyorCase):
    def test_attitude_follows_with_frequent_rare_and_no_pings(self):
        rate = math.radians(2.0)  # of roll, for 20 s
        rows = ["t,x,y,z,qw,qx,qy,qz"]
        for second in range(0, 21):
            half = rate * second / 2
            rows.append(f"{second},0,0,-12,{math.cos(half):.9f},{math.sin(half):.9f},0,0")
        host = self.start(vehicle="trajectory: roll.csv", files={"roll.csv": "\n".join(rows)})
        for parameters in ({"ping_enable": False}, {"msec_per_ping": 100}, {"msec_per_ping": 2000}):
            with self.subTest(parameters):
                host.set(**parameters)
                host.next(wire.ATTITUDE)
                times = set()
                for _ in range(8):
                    roll, pitch, _, at = wire.read_attitude(host.next(wire.ATTITUDE).payload)
                    self.assertAlmostEqual(math.degrees(roll), 2.0 * at / 1000, delta=0.6)
                    self.assertAlmostEqual(pitch, 0, delta=1e-2)
                    times.add(at)
                self.assertGreater(len(times), 4, "not one and the same again and again")


class Gain(SurveyorCase):
    def test_too_little_gain_hides_a_far_bottom(self):
        floor = [[(-200, -200, -90), (200, -200, -90), (200, 200, -90), (-200, 200, -90)]]
        host = self.start(OWN, z=-15.0, files={"floor.gltf": gltf(floor)})
        host.set(end_mm=100000, msec_per_ping=0)
        self.check_depths(host.pings(4)[-1], 75.0)
        left = host.first_ping(end_mm=100000, msec_per_ping=0, gain_index=0).points
        # 16 elements make a beam's steps 12 dB finer than a converter's own: with those it were 8 points within 25 deg.
        self.assertLess(len(left), 20)
        for y, z in left:
            self.assertLess(abs(math.atan2(y, -z)), math.radians(40), "only the mirror-like middle is loud enough")
        self.check_depths(host.first_ping(end_mm=100000, msec_per_ping=0, gain_index=70), 75.0)


if __name__ == "__main__":
    unittest.main()
