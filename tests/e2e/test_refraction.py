"""Layered water end to end: what two multibeams say of a flat bottom below a thermocline, ray-traced by a host that was
written apart from the C++, with the true profile and with others."""

import base64
import json
import math
import socket
import statistics
import struct
import time
import unittest

from ports import free_port
from program import Emulator

import kmall_wire
from r2sonic_host import Host

BOTTOM, SONAR = 100.0, 2.0  # m below the surface
THERMOCLINE = [(0, 1515), (10, 1515), (20, 1485), (1000, 1485)]
WELL_MIXED = [(0, 1515), (1000, 1515)]

SCENARIO = """
scene: floor.gltf
seed: 5
water: {temperature: 10, salinity: 35, ph: 8, profile: [[0, 1515], [10, 1515], [20, 1485]]}
effects: {sensor_noise: off, ping_jitter: off, absorption: off, noise: off%s}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - name: multibeam
    model: %s
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: [%s]
    options: {%s}
"""


def floor(depth=BOTTOM, half=600.0):
    """A glTF file: a square of two triangles, facing up."""
    places = [(-half, -depth, half), (half, -depth, half), (half, -depth, -half), (-half, -depth, -half)]
    data = b"".join(struct.pack("<3f", *p) for p in places) + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "floor"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"name": "sand"}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
             "min": [-half, -depth, -half], "max": [half, -depth, half]},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]})


def speed(profile, depth):
    for (above, first), (below, last) in zip(profile, profile[1:]):
        if depth <= below:
            return first + (last - first) * (depth - above) / (below - above)
    return profile[-1][1]


def traced(profile, angle, time_s, head_speed, step=0.02):
    """(across, depth) in m where a ray is that leaves at `angle` rad from the vertical after `time_s` one way: small steps
    of depth with Snell's law, from what the head says that sound speed is at it."""
    constant, depth, across, spent = math.sin(angle) / head_speed, SONAR, 0.0, 0.0
    while True:
        c = speed(profile, depth + step / 2)
        sine = constant * c
        cosine = math.sqrt(1 - sine * sine)
        needed = step / (c * cosine)
        part = min(1.0, (time_s - spent) / needed)
        depth, across, spent = depth + part * step, across + part * step * sine / cosine, spent + needed
        if part < 1:
            return across, depth


class Soundings(unittest.TestCase):
    """Each multibeam's mean two-way times by angle, over a few pings."""

    def emulate(self, model, endpoints, options, off=""):
        text = SCENARIO % (off, model, ", ".join(f'"{uri}"' for uri in endpoints), options)
        emulator = Emulator(text, files={"floor.gltf": floor()})
        self.addCleanup(emulator.__exit__, None, None, None)
        emulator.__enter__()

    def r2sonic(self, off="", pings=4):
        gui = free_port(8)
        host = Host(("127.0.0.1", gui), None, None)
        self.addCleanup(host.close)
        head = free_port(8)
        self.emulate("r2sonic-2024", [f"udp-listen://127.0.0.1:{head}", f"udp://127.0.0.1:{gui}"],
                     "range: 300, frequency: 200e3, ping_rate: 2", off)
        host.head = ("127.0.0.1", head)
        host.send_commands({"SEW0": math.radians(136)})
        found, end = [], time.monotonic() + 60
        while len(found) < pings:
            self.assertLess(time.monotonic(), end)
            for event in host.poll(0.5):
                if event["event"] == "ping" and abs(event["ping"].angles[0]) > math.radians(66):
                    found.append(event["ping"])
        for ping in found:
            self.assertAlmostEqual(ping.header["sound_speed"], 1515, delta=0.01, msg="at the sonar's depth")
        return found[0].header["sound_speed"], self.means(
            [[(a, t) for a, t, q in zip(p.angles, p.times, p.quality) if q & 0xC] for p in found])

    def kmall(self, off="", pings=4):
        receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(receiver.close)
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(60)
        own = free_port(8)
        self.emulate("kongsberg-kmall", [f"udp-listen://127.0.0.1:{own}", f"udp://127.0.0.1:{receiver.getsockname()[1]}"],
                     "range: 300, frequency: 200e3, sector_width: 136", off)
        joiner, found = kmall_wire.Joiner(), []
        while len(found) < pings:
            whole = joiner.take(receiver.recv(65536))
            if whole and whole[0]["kind"] == "#MRZ":
                found.append(kmall_wire.read_mrz(whole[1]))
        self.assertAlmostEqual(found[0]["sound_speed"], 1515, delta=0.01)
        return found[0]["sound_speed"], self.means(
            [[(math.radians(-s["angle"]), s["time"]) for s in ping["soundings"] if s["type"] == 0] for ping in found])

    def means(self, pings):
        """[(angle, mean time)] of the beams that found the bottom in every ping, within 65 deg."""
        by_angle = {}
        for ping in pings:
            for angle, two_way in ping:
                if abs(angle) <= math.radians(65):
                    by_angle.setdefault(round(angle, 4), []).append(two_way)
        means = [(angle, statistics.fmean(times)) for angle, times in sorted(by_angle.items()) if len(times) == len(pings)]
        self.assertGreater(len(means), 150)
        return means

    def check_flat(self, head_speed, beams):
        for angle, two_way in beams:
            across, depth = traced(THERMOCLINE, abs(angle), two_way / 2, head_speed)
            truth = math.hypot(BOTTOM - SONAR, across)
            self.assertLess(abs(depth - BOTTOM), 0.002 * truth, f"at {math.degrees(angle):.1f} deg")
        # No smile and no frown is left: outer beams are as deep as inner ones.
        mean = lambda low, high: statistics.fmean(
            traced(THERMOCLINE, abs(a), t / 2, head_speed)[1] for a, t in beams if low <= abs(math.degrees(a)) < high)
        self.assertLess(abs(mean(55, 65) - mean(0, 20)), 0.12)

    def check_wrong_profiles(self, head_speed, beams):
        outer = [(a, t) for a, t in beams if 59.5 <= abs(math.degrees(a)) <= 60.5]
        self.assertGreater(len(outer), 1)
        wrong = lambda profile, some: statistics.fmean(traced(profile, abs(a), t / 2, head_speed)[1] for a, t in some) - BOTTOM
        inner = [(a, t) for a, t in beams if abs(math.degrees(a)) <= 5]
        # V35's table, read with the sound speed of the head throughout: nadir too deep, outer beams too shallow (they curl up).
        self.assertAlmostEqual(wrong(WELL_MIXED, inner), 1.7, delta=0.2)
        self.assertAlmostEqual(wrong(WELL_MIXED, outer), -2.98, delta=0.4)
        # A profile with twice the drop curls them down.
        steeper = [(0, 1515), (10, 1515), (20, 1455), (1000, 1455)]
        self.assertGreater(wrong(steeper, outer), wrong(steeper, inner) + 2)

    def test_an_r2sonic_s_soundings_are_flat_with_the_true_profile_and_curl_with_others(self):
        head_speed, beams = self.r2sonic()
        self.check_flat(head_speed, beams)
        self.check_wrong_profiles(head_speed, beams)

    def test_a_kmall_s_soundings_are_flat_with_the_true_profile_and_curl_with_others(self):
        head_speed, beams = self.kmall()
        self.check_flat(head_speed, beams)
        self.check_wrong_profiles(head_speed, beams)

    def test_with_the_effect_off_rays_are_straight(self):
        head_speed, beams = self.kmall(", refraction: off", pings=2)
        for angle, two_way in beams:
            depth = SONAR + two_way / 2 * head_speed * math.cos(angle)
            self.assertLess(abs(depth - BOTTOM), 0.006 * BOTTOM / math.cos(angle))


class Tracer(unittest.TestCase):
    def test_the_host_traces_the_published_rays(self):
        """V35: launch in deg, x in m, one-way time in ms."""
        for launch, across, ms in ((0, 0, 65.820), (30, 55.30, 75.574), (60, 159.00, 125.438), (70, 236.67, 172.022)):
            got = traced(THERMOCLINE, math.radians(launch), ms / 1e3, 1515)
            self.assertAlmostEqual(got[0], across, delta=0.02)
            self.assertAlmostEqual(got[1], 100, delta=0.02)


if __name__ == "__main__":
    unittest.main()
