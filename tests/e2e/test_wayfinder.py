"""The running program as a Teledyne Wayfinder, met by a host that speaks at the offsets of the maker's public driver."""

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
    model: dvl-wayfinder
    mount: {position: [0, 0, 0], rpy_deg: [0, 0, -45]}
    endpoints: ["tcp-listen://127.0.0.1:%d"]
    options: {speed_of_sound: 1490, baud: 0}
"""
STOP, START, TRIGGER, GET_TESTS, GET_SETUP, SET_SETUP = 0x0F, 0x10, 0x11, 0x19000001, 0x85000001, 0x87000002
RESPONSE, DATA = 4, 5


def packet(command, parameters=b""):
    inner = struct.pack("<BBHI", 2, 3, len(parameters) + 8, command) + parameters
    outer = b"\xaa\x10\x01" + struct.pack("<H", len(inner) + 7) + inner
    return outer + struct.pack("<H", sum(outer) & 0xFFFF)


class Host:
    """By TCP."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=60)
        self.rest = b""

    def next(self):
        """(kind, payload)"""
        while len(self.rest) < 5 or len(self.rest) < struct.unpack_from("<H", self.rest, 3)[0]:
            piece = self.socket.recv(65536)
            if not piece:
                raise RuntimeError("the DVL has hung up")
            self.rest += piece
        size = struct.unpack_from("<H", self.rest, 3)[0]
        one, self.rest = self.rest[:size], self.rest[size:]
        if one[:3] != b"\xaa\x10\x01" or sum(one[:-2]) & 0xFFFF != struct.unpack("<H", one[-2:])[0]:
            raise AssertionError(f"{one[:16].hex()} is no packet")
        return one[6], one[9:-2]

    def ask(self, command, parameters=b""):
        self.socket.sendall(packet(command, parameters))
        while True:
            kind, payload = self.next()
            if kind == RESPONSE and struct.unpack_from("<I", payload)[0] == command:
                return payload

    def data(self, count):
        found = []
        while len(found) < count:
            kind, payload = self.next()
            if kind == DATA:
                found.append({"velocity": struct.unpack_from("<4f", payload, 21), "range": struct.unpack_from("<4f", payload, 37),
                              "mean": struct.unpack_from("<f", payload, 53)[0], "speed": struct.unpack_from("<f", payload, 57)[0]})
        return found

    def valid(self, count):
        found = []
        while len(found) < count:
            found += [one for one in self.data(1) if not math.isnan(one["velocity"][0])]
        return found


class WayfinderTest(unittest.TestCase):
    def start(self, rows, rate):
        port = free_port()
        emulator = Emulator(SCENARIO % (rate, port), files={"way.csv": way(rows)})
        emulator.__enter__()
        self.addCleanup(emulator.__exit__, None, None, None)
        host = Host(port)
        self.addCleanup(host.socket.close)
        return host

    def test_a_vehicle_over_a_flat_floor(self):
        # It goes 0.9 m/s ahead; beam 3 looks 45 deg to starboard of that.
        east, north = 0.9 * math.cos(math.radians(30)), 0.9 * math.sin(math.radians(30))
        dvl = self.start([(0, 0, 0, turned(30)), (200, 200 * east, 200 * north, turned(30))], rate=4)
        dvl.valid(5)
        found = dvl.valid(60)
        along = 0.9 * math.sqrt(0.5)
        for i, wanted in enumerate((-along, along, 0)):
            self.assertAlmostEqual(statistics.mean(one["velocity"][i] for one in found), wanted, delta=0.02)
        self.assertAlmostEqual(statistics.mean(one["mean"] for one in found), ALTITUDE, delta=0.005 * ALTITUDE)
        self.assertLess(max(abs(one["velocity"][3]) for one in found if not math.isnan(one["velocity"][3])), 0.1)

    def test_its_host_stops_it_and_triggers_it(self):
        dvl = self.start([(0, 0, 0, turned(90)), (200, 0, 100, turned(90))], rate=2)
        dvl.valid(1)
        self.assertEqual(dvl.ask(GET_TESTS)[4], 7, "not while pinging")
        self.assertEqual(dvl.ask(STOP)[4], 1)
        self.assertEqual(dvl.ask(GET_TESTS)[12:], b"\x01" * 6)
        version, size, trigger, baud, speed, most, vertical = struct.unpack_from("<BIBBfff", dvl.ask(GET_SETUP), 7)
        self.assertEqual((version, size, trigger, baud, speed, most), (0x11, 20, 0, 7, 1490, 60))
        wanted = struct.pack("<BBIBBfff", 0x22, version, size, 1, baud, 1450, 20, vertical)
        self.assertEqual(dvl.ask(SET_SETUP, wanted)[4], 1)
        self.assertEqual(dvl.ask(START)[4], 1)
        dvl.rest = b""
        began = time.monotonic()
        found = []
        for _ in range(12):
            self.assertEqual(dvl.ask(TRIGGER)[4], 1)
            found += dvl.data(1)
        self.assertLess(time.monotonic() - began, 60)
        heard = [one for one in found if not math.isnan(one["mean"])]
        self.assertGreater(len(heard), 5)
        self.assertAlmostEqual(statistics.mean(one["mean"] for one in heard), ALTITUDE * 1450 / 1490, delta=0.01 * ALTITUDE)
        self.assertEqual({one["speed"] for one in found}, {1450})


if __name__ == "__main__":
    unittest.main()
