"""The Ping1D over a floor at known depths, read by a rangefinder and by a reader written apart from the program."""

import base64
import json
import re
import socket
import struct
import tempfile
import time
import unittest
from pathlib import Path

from ports import free_port
from program import Emulator

import blping_host

FLOOR = 60.0  # m below the surface


def floor_scene():
    """A square of 300 m as glTF, whose y is up."""
    corners = [(-150, -FLOOR, -150), (-150, -FLOOR, 150), (150, -FLOOR, 150), (150, -FLOOR, -150)]
    data = b"".join(struct.pack("<3f", *c) for c in corners) + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    return json.dumps(
        {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "materials": [{"name": "sand"}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
            "accessors": [
                {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                 "min": [-150, -FLOOR, -150], "max": [150, -FLOOR, 150]},
                {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
            ],
            "bufferViews": [
                {"buffer": 0, "byteOffset": 0, "byteLength": 48},
                {"buffer": 0, "byteOffset": 48, "byteLength": 12},
            ],
            "buffers": [
                {"byteLength": 60, "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}
            ],
        }
    )  # fmt: skip


HEAD = """
scene: {scene}
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -5]}}
effects: {cross_talk: off}
devices:
"""
DEVICE = """
  - name: d%d
    model: ping1d
    mount: {position: [0, 0, %g], rpy_deg: [0, %g, 0]}
    endpoints: ["%s"]
    options: {%s}
"""
DOWN = 90


def device(number, depth, endpoint, options="", pitch=DOWN):
    """A sounder `depth` above the floor."""
    return DEVICE % (number, depth - FLOOR + 5, pitch, endpoint, options)


def frames(data):
    """(id, payload) of the whole frames in a byte string."""
    for match in re.finditer(rb"BR(..)(..)..", data, re.S):
        length, number = struct.unpack("<HH", match[1] + match[2])
        whole = data[match.start() : match.start() + length + 10]
        if len(whole) == length + 10 and struct.unpack("<H", whole[-2:])[0] == sum(whole[:-2]) & 0xFFFF:
            yield number, whole[8:-2]


class UdpHost:
    def __init__(self, port):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.connect(("127.0.0.1", port))
        self.socket.settimeout(20)

    def say(self, number, payload=b""):
        self.socket.send(blping_host.frame(number, payload))

    def wait(self, number):
        while True:
            for found, payload in frames(self.socket.recv(4096)):
                if found == number:
                    return payload

    def ask(self, number, payload, reply):
        self.say(number, payload)
        return self.wait(reply)

    def close(self):
        self.socket.close()


class Profile:
    """Message 1300."""

    def __init__(self, payload):
        (self.distance, self.confidence, self.pulse_us, self.ping, self.start, self.length, self.gain, count) = (
            struct.unpack("<IHHIIIIH", payload[:26])
        )
        self.points = payload[26:]
        assert len(self.points) == count

    def at(self, metres):
        return self.points[int((1000 * metres - self.start) * len(self.points) / self.length)]


class Ping1dCase(unittest.TestCase):
    def start(self, *devices):
        """The program over the floor."""
        folder = tempfile.TemporaryDirectory(prefix="echoloop-floor-")
        self.addCleanup(folder.cleanup)
        scene = Path(folder.name) / "floor.gltf"
        scene.write_text(floor_scene())
        emulator = Emulator(HEAD.replace("{scene}", str(scene)) + "".join(devices))
        self.addCleanup(emulator.__exit__, None, None, None)
        return emulator.__enter__()

    def udp(self, port):
        host = UdpHost(port)
        self.addCleanup(host.close)
        return host


class Depths(Ping1dCase):
    DEPTHS = [0.35, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0]

    def test_from_a_third_of_a_metre_to_fifty_metres(self):
        port = free_port(len(self.DEPTHS))
        self.start(
            *(
                device(i, depth, f"udp-listen://127.0.0.1:{port + i}", "ping_interval: 250")
                for i, depth in enumerate(self.DEPTHS)
            )
        )
        hosts = [self.udp(port + i) for i in range(len(self.DEPTHS))]
        for host in hosts:
            host.say(1400, struct.pack("<H", 1300))
        for depth, host in zip(self.DEPTHS, hosts):
            with self.subTest(depth=depth):
                self.check(depth, host)

    def check(self, depth, host):
        settled = time.monotonic() + 20
        profile = Profile(host.wait(1300))
        while not 0.2 < depth * 1000 / profile.length < 0.9 or profile.confidence < 90:  # the range follows
            self.assertLess(time.monotonic(), settled, (depth, profile.length, profile.distance, profile.confidence))
            profile = Profile(host.wait(1300))
        for _ in range(5):
            profile = Profile(host.wait(1300))
            bin_size = profile.length / 200
            self.assertGreaterEqual(profile.distance, 1000 * depth - bin_size)
            pulse = 0.75 * profile.pulse_us  # mm that it is long; speckle may hide its beginning
            self.assertLessEqual(profile.distance, 1000 * depth + 2 * bin_size + pulse)
            self.assertGreaterEqual(profile.confidence, 90)
            self.assertGreater(profile.at(0), 220, "the pulse clips the receiver at 190 dB, 234 counts with the gain of 1.8")
            self.assertLess(profile.at(0.32) if depth < 0.4 else profile.at(0.6 * depth), 100, "water")
            self.assertGreater(max(profile.points[-120:]), 60, "the floor")


class WithoutABottom(Ping1dCase):
    def test_nothing_is_trusted(self):
        """15 m to the floor, but it listens to 10 m."""
        port = free_port()
        self.start(device(0, 15, f"udp-listen://127.0.0.1:{port}", "mode_auto: false, ping_interval: 500"))
        host = self.udp(port)
        host.say(1400, struct.pack("<H", 1300))
        confidences = []
        for _ in range(12):
            profile = Profile(host.wait(1300))
            self.assertEqual(profile.length, 10000)
            self.assertGreater(profile.at(0), 250, "the ring-down is there")
            confidences.append(profile.confidence)
        self.assertLess(sum(confidences) / len(confidences), 10, confidences)

    def test_the_range_looks_further_and_further_out(self):
        """It looks up: one that looked level would hear the floor, 24 dB above the noise, through its side lobes."""
        port = free_port()
        self.start(
            device(0, 15, f"udp-listen://127.0.0.1:{port}", "scan_length: 1000, ping_interval: 400", pitch=-DOWN)
        )
        host = self.udp(port)
        host.say(1400, struct.pack("<H", 1300))
        lengths = [Profile(host.wait(1300)).length for _ in range(12)]
        self.assertEqual(lengths, sorted(lengths))
        self.assertGreater(lengths[-1], 10 * lengths[0])


class Settings(Ping1dCase):
    def test_gain_speed_and_points_change_the_picture(self):
        port = free_port()
        self.start(device(0, 4, f"udp-listen://127.0.0.1:{port}", "mode_auto: false"))
        host = self.udp(port)
        profile = Profile(host.ask(1300, b"", 1300))
        while profile.ping == 0:
            profile = Profile(host.ask(1300, b"", 1300))
        self.assertAlmostEqual(profile.distance, 4000, delta=100)
        self.assertEqual(profile.length, 10000)
        louder = self.after(host, 1005, b"\x05")
        self.assertEqual(louder.gain, 5)
        # 66.1 instead of 12.9: 14.2 dB of 60
        self.assertAlmostEqual(max(louder.points[40:]), min(255, max(profile.points[40:]) + 60), delta=25)
        slower = self.after(host, 1002, struct.pack("<I", 1400000))
        self.assertAlmostEqual(slower.distance, 4000 * 1400 / 1500, delta=100)
        finer = self.after(host, 1007, struct.pack("<HBB", 400, 0, 0))
        self.assertEqual(len(finer.points), 400)

    def after(self, host, number, payload):
        """A profile of a ping that began after the setting."""
        host.say(number, payload)
        self.assertEqual(host.wait(1), struct.pack("<H", number))
        last = Profile(host.ask(1300, b"", 1300)).ping
        while True:
            profile = Profile(host.ask(1300, b"", 1300))
            if profile.ping >= last + 2:
                return profile
            time.sleep(0.02)

    def test_the_open_firmware_streams_by_itself(self):
        port = free_port()
        options = (
            "firmware: 0.0.0, device_id: 0, device_type: 9, mode_auto: false, scan_length: 1000, gain: 6, "
            "ping_interval: 300, stream_at_start: true, ack_continuous: false, streamed: profile"
        )
        self.start(device(0, 0.5, f"tcp-listen://127.0.0.1:{port}", options))
        with socket.create_connection(("127.0.0.1", port), timeout=20) as line:
            data = b""
            while data.count(b"\x14\x05\x00\x00") < 3:
                data += line.recv(4096)
        profiles = [Profile(payload) for number, payload in frames(data) if number == 1300]
        self.assertGreaterEqual(len(profiles), 2)
        self.assertAlmostEqual(profiles[-1].distance, 500, delta=20)


class Rangefinder(Ping1dCase):
    """ArduPilot's exchange, wherever it comes from."""

    def check(self, endpoint, uri):
        emulator = self.start(device(0, 7, endpoint))
        line = blping_host.open_line(uri.replace("{folder}", str(emulator.folder)))
        self.addCleanup(line.close)
        host = blping_host.BlPing(line)
        found = host.readings(60, 20)
        self.assertEqual(len(found), 60)
        self.assertEqual(host.starts, 1, "it never had to ask again")
        for _, metres, confidence in found[-20:]:
            self.assertAlmostEqual(metres, 7.0, delta=0.15)
            self.assertGreaterEqual(confidence, 90)
        times = [t for t, _, _ in found[-40:]]
        self.assertAlmostEqual((times[-1] - times[0]) / 39, 0.05, delta=0.02)

    def test_over_a_serial_line(self):
        self.check("pty:{folder}/ping1d", "{folder}/ping1d")

    def test_over_tcp(self):
        port = free_port()
        self.check(f"tcp-listen://127.0.0.1:{port}", f"tcp://127.0.0.1:{port}")

    def test_over_udp(self):
        port = free_port()
        self.check(f"udp-listen://127.0.0.1:{port}", f"udp://127.0.0.1:{port}")

    def test_at_9600_baud_it_gets_as_many_as_the_line_carries(self):
        """15 bytes are 15.6 ms at 9600: 50 ms apart they fit, so the line does not slow it."""
        emulator = self.start(device(0, 7, "pty:{folder}/ping1d", "baud: 9600"))
        line = blping_host.open_line(str(emulator.folder / "ping1d"))
        self.addCleanup(line.close)
        self.assertEqual(len(blping_host.BlPing(line).readings(30, 20)), 30)


if __name__ == "__main__":
    unittest.main()
