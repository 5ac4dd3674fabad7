"""The running program as Teledyne's Doppler logs, met by a host that reads PD0 at the offsets of the makers' guide."""

import math
import socket
import statistics
import struct
import time
import unittest

from ports import free_port
from program import Emulator
from test_dvl import ALTITUDE, turned, way

SCENARIO = """
scene: {scenes}/flat.glb
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1490}
vehicle: {trajectory: way.csv}
clock: {mode: scaled, rate: %g}
devices:
  - name: dvl
    model: dvl-pathfinder
    mount: {position: [0, 0, 0], rpy_deg: [0, 0, -45]}
    endpoints: ["tcp-listen://127.0.0.1:%d"]
    options: {speed_of_sound: 1490, heading_alignment: 4500, baud: 0}
"""


class Ensembles:
    """PD0 by TCP."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=60)
        self.rest = b""

    def next(self):
        while True:
            at = self.rest.find(b"\x7f\x7f")
            if at >= 0 and len(self.rest) >= at + 4:
                size = struct.unpack_from("<H", self.rest, at + 2)[0]
                if len(self.rest) >= at + size + 2:
                    block, self.rest = self.rest[at:at + size + 2], self.rest[at + size + 2:]
                    if sum(block[:-2]) & 0xFFFF == struct.unpack("<H", block[-2:])[0]:
                        return self.parsed(block)
                    continue
            piece = self.socket.recv(65536)
            if not piece:
                raise RuntimeError("the DVL has hung up")
            self.rest += piece

    @staticmethod
    def parsed(block):
        offsets = struct.unpack_from(f"<{block[5]}H", block, 6)
        sections = {struct.unpack_from("<H", block, at)[0]: at for at in offsets}
        leader, bottom = sections[0x80], sections[0x600]
        return {"number": struct.unpack_from("<H", block, leader + 2)[0],
                "hms": block[leader + 7:leader + 11],
                "heading": struct.unpack_from("<H", block, leader + 18)[0] / 100,
                "range": [r / 100 for r in struct.unpack_from("<4H", block, bottom + 16)],
                "velocity": struct.unpack_from("<4h", block, bottom + 24)}

    def valid(self, count):
        found = []
        while len(found) < count:
            one = self.next()
            if one["velocity"][0] != -32768:
                found.append(one)
        return found


class TeledyneTest(unittest.TestCase):
    def start(self, rows, rate):
        self.port = free_port()
        emulator = Emulator(SCENARIO % (rate, self.port), files={"way.csv": way(rows)})
        emulator.__enter__()
        self.addCleanup(emulator.__exit__, None, None, None)
        host = Ensembles(self.port)
        self.addCleanup(host.socket.close)
        return host

    def test_a_vehicle_over_a_flat_floor(self):
        # Turned by 30 deg to port of east it goes 0.9 m/s ahead.
        east, north = 0.9 * math.cos(math.radians(30)), 0.9 * math.sin(math.radians(30))
        dvl = self.start([(0, 0, 0, turned(30)), (200, 200 * east, 200 * north, turned(30))], rate=4)
        dvl.valid(5)
        found = dvl.valid(60)
        means = [statistics.mean(one["velocity"][i] for one in found) / 1000 for i in range(3)]
        # The compass drifts by 0.4 deg (standard deviation).
        for got, wanted in zip(means, (-east, -north, 0)):
            self.assertAlmostEqual(got, wanted, delta=0.02)
        self.assertAlmostEqual(found[0]["heading"], 60, delta=1.5)
        altitude = statistics.mean(sum(one["range"]) / 4 for one in found)
        self.assertAlmostEqual(altitude, ALTITUDE, delta=0.005 * ALTITUDE)

    def test_its_host_stops_it_and_sets_it_up(self):
        dvl = self.start([(0, 0, 0, turned(90)), (200, 0, 100, turned(90))], rate=2)
        dvl.valid(1)
        heard, end = b"", time.monotonic() + 30
        for words, answer in ((b"===", b"Firmware Version: 67.01\r\n\r\n>"), (b"EX10111\r", b"EX10111\r\n>"),
                              (b"NO\r", b"NO ERR: Bad command parameters!\r\n>"), (b"CS\r", b"CS\r\n")):
            dvl.socket.sendall(words)
            while answer not in heard and time.monotonic() < end:
                heard += dvl.socket.recv(65536)
            self.assertIn(answer, heard)
            heard = heard.split(answer, 1)[1]
        dvl.rest = heard
        found = dvl.valid(20)
        self.assertAlmostEqual(statistics.mean(one["velocity"][1] for one in found) / 1000, -0.5, delta=0.02,
                               msg="ship: ahead")


if __name__ == "__main__":
    unittest.main()
