"""Two Doppler logs and a side-scan in lockstep with a simulator: the same bytes every time, and the velocity and the ranges of
the vehicle that the simulator moves."""

import hashlib
import math
import socket
import statistics
import struct
import time
import unittest

from ports import free_port
from program import Emulator
from stepper import Stepper
from test_teledyne import Ensembles

SCENARIO = """
scene: {scenes}/flat.glb
seed: 5
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1490}
effects: {cross_talk: false}
vehicle: {pose: {position: [0, 0, -12]}}
clock: {mode: stepped, input: "tcp-listen://127.0.0.1:%(steps)d"}
devices:
  - {name: pd0, model: dvl-pathfinder, mount: {rpy_deg: [0, 0, -45]}, endpoints: ["tcp-listen://127.0.0.1:%(pd0)d"],
     options: {speed_of_sound: 1490, heading_alignment: 4500, baud: 0, frame: ship}}
  - {name: nucleus, model: nortek-nucleus, endpoints: ["tcp-listen://127.0.0.1:%(nucleus_commands)d",
     "tcp-listen://127.0.0.1:%(nucleus)d"], options: {speed_of_sound: 1490, starts_at_once: true}}
  - {name: jsf, model: edgetech-2205, endpoints: ["tcp-listen://127.0.0.1:%(jsf_commands)d", "tcp-listen://127.0.0.1:%(jsf)d"],
     options: {start: high}}
"""
NAMES = ("pd0", "nucleus", "jsf")
ALTITUDE, SPEED, HEADING = 8, 0.8, 25  # m, of a vehicle 12 m down; m/s ahead; deg to port of east
STEPS, INTERVAL = 120, 0.05


def framed(data, sync, size_of):
    """Messages that begin with `sync`, one behind the other with nothing between."""
    while data:
        if data[:len(sync)] != sync:
            raise AssertionError(f"{data[:16].hex()} is no message")
        size = size_of(data)
        if len(data) < size:
            return  # the end of the run
        yield data[:size]
        data = data[size:]


class SteppedLogs(unittest.TestCase):
    def run_once(self):
        """{name: all bytes}. After each step all that was sent by then is there, and nothing comes before the next."""
        ports = {name: free_port() for name in ("steps", *NAMES, "nucleus_commands", "jsf_commands")}
        heard = {name: b"" for name in NAMES}
        with Emulator(SCENARIO % ports), Stepper(ports["steps"]) as simulator:
            hosts = {name: socket.create_connection(("127.0.0.1", ports[name])) for name in NAMES}
            for host in hosts.values():
                self.addCleanup(host.close)
                host.setblocking(False)
            for n in range(STEPS):
                way = SPEED * n * INTERVAL
                pose = {"position": [way * math.cos(math.radians(HEADING)), way * math.sin(math.radians(HEADING)), -12],
                        "rpy_deg": [0, 0, HEADING]}
                sent = simulator.step(round(n * INTERVAL, 6), **pose)["sent"]
                end = time.monotonic() + 30
                while any(len(heard[name]) < sent[name] for name in NAMES) and time.monotonic() < end:
                    self.take(hosts, heard)
                self.take(hosts, heard)
                self.assertEqual({name: len(heard[name]) for name in NAMES}, {name: sent[name] for name in NAMES}, f"step {n}")
        return heard

    @staticmethod
    def take(hosts, heard):
        for name, host in hosts.items():
            try:
                heard[name] += host.recv(1 << 20)
            except BlockingIOError:
                pass

    def test_every_byte_is_the_same_again(self):
        first, second = self.run_once(), self.run_once()
        for name in NAMES:
            self.assertGreater(len(first[name]), 2000, name)
            self.assertEqual(hashlib.sha256(first[name]).hexdigest(), hashlib.sha256(second[name]).hexdigest(), name)

    def test_they_tell_how_the_simulator_moves_the_vehicle(self):
        heard = self.run_once()
        pd0 = [Ensembles.parsed(block)
               for block in framed(heard["pd0"], b"\x7f\x7f", lambda d: struct.unpack_from("<H", d, 2)[0] + 2)]
        found = [one for one in pd0 if one["velocity"][0] != -32768][5:]
        self.assertGreater(len(found), 20)
        for i, wanted in enumerate((0, -SPEED)):  # to starboard and ahead; the bottom's
            self.assertAlmostEqual(statistics.mean(one["velocity"][i] for one in found) / 1000, wanted, delta=0.02)
        self.assertAlmostEqual(statistics.mean(sum(one["range"]) / 4 for one in found), ALTITUDE, delta=0.005 * ALTITUDE)

        frames = list(framed(heard["nucleus"], b"\xa5\x0a", lambda d: d[1] + struct.unpack_from("<H", d, 4)[0]))
        bottom = [frame for frame in frames if frame[2] == 0xB4][2:]
        self.assertGreater(len(bottom), 15, "four a second")
        velocities = [struct.unpack_from("<3f", frame, 10 + NUCLEUS_VELOCITY) for frame in bottom]
        for i, wanted in enumerate((SPEED, 0, 0)):
            self.assertAlmostEqual(statistics.mean(v[i] for v in velocities), wanted, delta=0.03)

        messages = list(framed(heard["jsf"], b"\x01\x16", lambda d: 16 + struct.unpack_from("<I", d, 12)[0]))
        sides = [message for message in messages if struct.unpack_from("<H", message, 4)[0] == 80]
        self.assertEqual([message[8] for message in sides[:6]], [0, 1] * 3, "port, then starboard")
        numbers = [struct.unpack_from("<I", message, 16 + 8)[0] for message in sides[::2]]
        self.assertEqual(numbers, list(range(numbers[0], numbers[0] + len(numbers))), "no ping is missing")
        # A ping takes 2R/c + 5 ms, 50 m.
        self.assertAlmostEqual(len(numbers), STEPS * INTERVAL / (2 * 50 / 1490 + 0.005), delta=2)


NUCLEUS_VELOCITY = 96  # of x, behind the header of ten bytes


if __name__ == "__main__":
    unittest.main()
