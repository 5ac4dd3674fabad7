"""A Sonic 2026 beside 20 real pings of one, under the settings that these tell, above as deep a floor and on a rolling
vessel: what varies there varies here, what is constant there is constant here, units and scales are the same, and the
histograms of words overlap."""

import math
import socket
import struct
import tempfile
import unittest
from pathlib import Path

from ports import free_port
from program import Emulator

import words
from shared_data import needs_data

SCENARIO = """
scene: "{scenes}/flat.glb"
seed: 1
water: {temperature: 18, salinity: 35, ph: 8, sound_speed: 1514.962}
vehicle: {trajectory: roll.csv}
devices:
  - name: multibeam
    model: r2sonic-2026
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["udp-listen://127.0.0.1:%d", "udp://127.0.0.1:%d"]
    options: {range: 31.948, power: 206, pulse: 35e-6, gain: 11, spreading: 15, absorption: 81, sector_width: 125,
              bottom_mode: equi-distant, intensity: true, discovery_reply: none, serial: 100996-2026}
"""
DEPTH = 10.75  # m below the head, in the middle of the real pings
ROLL, PERIOD = 0.06, 6.0  # rad, s: about as real ones
SETTINGS = {"ROS0": 1, "DGO0": 0x1E03}  # roll stabilised; gates of 30 % about the last depth, with its slope
# Where and when it was.
PLACE = {"h0.serial", "h0.ping_seconds", "h0.ping_nanoseconds", "h0.ping_number", "h0.ping_period"}


def rolling(seconds, step=0.05):
    lines = ["t,x,y,z,qw,qx,qy,qz"]
    for n in range(int(seconds / step)):
        half = ROLL / 2 * math.sin(2 * math.pi * n * step / PERIOD)
        lines.append(f"{n * step:.2f},0,0,{DEPTH - 20:.3f},{math.cos(half):.6f},{math.sin(half):.6f},0,0")
    return "\n".join(lines) + "\n"


class Recorded(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.real = words.messages(needs_data("r2sonic/r2sonic_bth0_20.pcap"), "BTH0")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        capture = str(Path(folder.name) / "run.pcapng")
        head = free_port(8)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as host:
            host.bind(("127.0.0.1", 0))
            host.settimeout(20)
            scenario = SCENARIO % (head, host.getsockname()[1])
            with Emulator(scenario, "--record", capture, files={"roll.csv": rolling(60)}) as emulator:
                command = b"CMD0" + b"".join(name.encode() + struct.pack(">I", v) for name, v in SETTINGS.items())
                host.sendto(command, ("127.0.0.1", head + 2))
                for _ in range(80):
                    host.recv(65536)
                emulator.stop()
        cls.ours = words.messages(capture, "BTH0")[8:]  # those before know no bottom yet

    def values(self, name):
        """Of both, as sets of what stands in each ping."""
        return tuple({str(m.get(name)) for m in pings} for pings in (self.ours, self.real))

    def test_what_varies_there_varies_here(self):
        self.assertEqual(set(self.ours[0]), set(self.real[0]), "the same sections")
        for name in set(self.real[0]) - PLACE:
            ours, real = self.values(name)
            self.assertEqual(len(ours) > 1, len(real) > 1, f"{name}: {sorted(ours)[:4]} here, {sorted(real)[:4]} there")

    def test_what_is_constant_is_the_same(self):
        for name, real in self.real[0].items():
            if name in PLACE or len(self.values(name)[1]) > 1 or isinstance(real, list):
                continue
            if isinstance(real, str):
                self.assertEqual(self.ours[0][name], real, name)
            else:
                self.assertAlmostEqual(self.ours[0][name], real, delta=2e-6 * abs(real), msg=name)

    def test_the_largest_step_of_angles_is_the_real_ones(self):
        for pings in (self.ours, self.real):
            for ping in pings:
                self.assertTrue(20859 <= max(ping["A2.step"]) <= 20861, max(ping["A2.step"]))

    def test_histograms_overlap(self):
        for name in ("i1.intensity", "r0.r", "A2.step"):
            apart = words.distance(words.of_messages(self.ours, name), words.of_messages(self.real, name))
            print(f"{name}: distance {apart:.3f}")
            self.assertLess(apart, 0.25, name)

    def test_levels_fall_off_as_there(self):
        """From the nadir to the edges, within 4 dB in the mean of 16 points; the real bottom is brighter at the nadir than
        Lambert's law has it."""
        for first in range(0, 256, 16):
            ours, real = (words.of_messages(pings, "i1.intensity", first, first + 16) for pings in (self.ours, self.real))
            apart = 20 * math.log10((sum(ours) / len(ours)) / (sum(real) / len(real)))
            self.assertLess(abs(apart), 4, f"{apart:.1f} dB at points {first} to {first + 15}")


if __name__ == "__main__":
    unittest.main()
