"""A vehicle that moves: trajectories from files, poses over UDP and TCP in two dialects, and what is refused."""

import json
import math
import re
import socket
import subprocess
import threading
import time
import unittest

from ports import free_port
from program import Emulator

FLOOR_Z = -20.0  # of the scene flat.glb
SOUNDER = """
scene: {scenes}/flat.glb
seed: 1
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500, depth: 12}
vehicle: %s
devices:
  - name: sounder
    model: nmea-echosounder
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["udp://127.0.0.1:%d"]
    options: {rate: 10, sentences: DBT}
"""
TOLERANCE = 0.15  # m: a pulse, and what the vehicle does during a tenth of a second


class Depths:
    """Reads the depth in metres from DBT sentences."""

    def __init__(self, test):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(30)
        test.addCleanup(self.socket.close)
        self.port = self.socket.getsockname()[1]

    def next(self):
        while True:
            match = re.search(rb"DBT,[\d.]*,f,([\d.]+),M", self.socket.recv(4096))
            if match:
                return float(match[1])

    def wait_for(self, depth, seconds=20):
        """Waits for that depth; what came last otherwise."""
        end, last = time.monotonic() + seconds, None
        while time.monotonic() < end:
            last = self.next()
            if abs(last - depth) < TOLERANCE:
                return last
        raise AssertionError(f"depth {depth} did not come, the last was {last}")


class PoseCase(unittest.TestCase):
    def start(self, vehicle, depths, files=(), stdin=subprocess.DEVNULL):
        emulator = Emulator(SOUNDER % (vehicle, depths.port), files=files, stdin=stdin)
        self.addCleanup(emulator.__exit__, None, None, None)
        return emulator.__enter__()


class Pose(PoseCase):
    def test_a_trajectory_from_a_file(self):
        depths = Depths(self)
        rows = ["t,x,y,z,qw,qx,qy,qz"] + [f"{t},0,0,{-10 - t},1,0,0,0" for t in range(4)]  # sinks 1 m/s for 3 s
        self.start("{trajectory: dive.csv}", depths, files={"dive.csv": "\n".join(rows)})
        seen = [depths.next() for _ in range(45)]
        self.assertLess(abs(seen[0] - 10), 0.4)
        falls = [a - b for a, b in zip(seen[2:26], seen[4:28])]  # in a fifth of a second each
        self.assertAlmostEqual(sum(falls) / len(falls), 0.2, delta=0.03)
        self.assertAlmostEqual(seen[-1], 7, delta=TOLERANCE)
        self.assertTrue(all(abs(depth - 7) < TOLERANCE for depth in seen[-8:]), seen)

    def test_lines_of_json_over_udp_then_silence(self):
        depths, port = Depths(self), free_port(8)
        emulator = self.start("{pose: {position: [0, 0, -4]}, input: 'udp-listen://127.0.0.1:%d'}" % port, depths)
        self.assertAlmostEqual(depths.next(), 16, delta=TOLERANCE)  # until somebody speaks
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as pilot:
            for z in (-8, -15):
                pilot.sendto(json.dumps({"position": [0, 0, z]}).encode(), ("127.0.0.1", port))
                depths.wait_for(z - FLOOR_Z)
            for bad in (b"nonsense", b"{}", b'{"position": [1, 2]}', b"\xff\xfe", b"", b"[" * 60000):
                pilot.sendto(bad, ("127.0.0.1", port))
            emulator.read_until("no pose for more than a second", 20)
            depths.wait_for(5)
        status, output = emulator.stop()
        self.assertEqual(status, 0)
        self.assertRegex(output, r"vehicle +2 poses from udp-listen://\S+, 5 refused \(the last: [^)]+\)")
        self.assertRegex(output, r"[1-9]\d* pings? with a stale pose(?!: nobody)")
        self.assertEqual(output.count("a pose was refused"), 1)

    def test_lines_of_json_on_standard_input(self):
        depths = Depths(self)
        emulator = self.start("{pose: {position: [0, 0, -4]}, input: stdin}", depths, stdin=subprocess.PIPE)
        depths.wait_for(16)
        pilot = emulator.process.stdin
        self.addCleanup(pilot.close)
        pilot.write(b'{"position": [0, 0, -8]}\nnonsense\n{"position": [0, ')
        pilot.flush()
        depths.wait_for(12)
        pilot.write(b'0, -15]}')  # the last line need not end
        pilot.close()
        depths.wait_for(5)
        emulator.process.stdin = None
        status, output = emulator.stop()
        self.assertEqual(status, 0)
        self.assertRegex(output, r"vehicle +2 poses from stdin, 1 refused \(the last: no JSON\)")
        self.assertIn("stdin: the input has ended", output)

    def test_both_dialects_over_tcp_mean_the_same_place(self):
        depths, port = Depths(self), free_port()
        self.start("{input: 'tcp-listen://127.0.0.1:%d'}" % port, depths)
        with socket.create_connection(("127.0.0.1", port), timeout=20) as pilot:
            own = {"t": 1.0, "position": [3, 4, -13], "rpy_deg": [0, 0, 90]}
            text = json.dumps(own).encode() + b"\n"
            for i in range(0, len(text), 7):  # a line in pieces is one line
                pilot.sendall(text[i:i + 7])
            depths.wait_for(7)
        with socket.create_connection(("127.0.0.1", port), timeout=20) as pilot:
            ned = {"timestamp": 2.0, "position": [4, 3, 9], "attitude": [0, 0, 0], "imu": {"gyro": [0, 0, 0]}}
            pilot.sendall(json.dumps(ned).encode() + b"\n")
            depths.wait_for(11)
            # Rolled by 30 deg the beam meets the floor further out: 11 m / cos 30 deg.
            ned.update(timestamp=3.0, attitude=[math.radians(30), 0, 0])
            pilot.sendall(json.dumps(ned).encode() + b"\n")
            end = time.monotonic() + 20
            while depths.next() < 11.4:  # the wide beam hears the near side of its footprint first
                self.assertLess(time.monotonic(), end)

    def test_the_pose_is_that_of_the_ping_and_not_of_the_last_message(self):
        depths, port = Depths(self), free_port(8)
        self.start("{input: 'udp-listen://127.0.0.1:%d'}" % port, depths)
        stop = threading.Event()

        def sink():  # 1 m/s from -5 m, told four times a second only
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as pilot:
                start = time.monotonic()
                while not stop.is_set():
                    t = time.monotonic() - start
                    pilot.sendto(json.dumps({"t": t, "position": [0, 0, -5 - t]}).encode(), ("127.0.0.1", port))
                    stop.wait(0.25)

        pilot = threading.Thread(target=sink)
        pilot.start()
        self.addCleanup(pilot.join)
        self.addCleanup(stop.set)
        depths.wait_for(14)
        seen = [depths.next() for _ in range(40)]
        steps = [a - b for a, b in zip(seen, seen[1:])]
        # Held poses would stand still for a ping or two and then leap.
        self.assertGreater(min(steps), 0.02, steps)
        self.assertLess(max(steps), 3 * sum(steps) / len(steps), steps)

    def test_two_programs_cannot_take_the_same_poses(self):
        depths, port = Depths(self), free_port(8)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
            taken.bind(("127.0.0.1", port))
            with self.assertRaisesRegex(RuntimeError, "already in use"):
                self.start("{input: 'udp-listen://127.0.0.1:%d'}" % port, depths)


if __name__ == "__main__":
    unittest.main()
