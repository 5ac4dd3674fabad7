"""Mounts that move on their vehicle: by a law, by lines; read from the ground truth and from what the sonar says."""

import json
import math
import socket
import tempfile
import unittest
from pathlib import Path

from ports import free_port
from program import Emulator
from test_truth import wait_for_lines

SCENARIO = """scene: {scenes}/flat.glb
water: {sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -10]}}
devices:
  - name: sounder
    model: nmea-echosounder
    mount: {rpy_deg: [0, 90, 0], %s}
    endpoints: ["udp://127.0.0.1:%d"]
    options: {rate: 10, range: 30, sentences: DBT}
"""


def axis_of(pose):
    """The x axis of an orientation w x y z in the world."""
    w, x, y, z = pose["orientation"]
    return 1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)


class MovingMount(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.truth = Path(folder.name) / "truth.jsonl"

    def start(self, motion):
        emulator = Emulator(SCENARIO % (motion, free_port()), "--truth", str(self.truth))
        self.addCleanup(emulator.__exit__, None, None, None)
        return emulator.__enter__()

    def test_a_swing_follows_its_law_and_the_vehicle_stays(self):
        self.start("swing: {axis: pitch, angle_deg: 30, period: 2}")
        _, pings = wait_for_lines(self.truth, 25)
        tilts = []
        for ping in pings[:25]:
            self.assertEqual([round(v, 9) for v in ping["world_from_body"]["position"]], [0, 0, -10])
            x, y, z = axis_of(ping["world_from_sonar"])
            angle = 30 * math.sin(2 * math.pi * ping["t"] / 2)  # beyond straight down it looks astern
            self.assertAlmostEqual(math.degrees(math.atan2(-x, -z)), angle, delta=0.1)
            tilts.append(angle)
            turning = math.radians(30) * math.pi * math.cos(2 * math.pi * ping["t"] / 2)
            for found, expected in zip(ping["sonar_turning"], (0, turning, 0)):
                self.assertAlmostEqual(found, expected, delta=1e-6)
            self.assertEqual(ping["sonar_velocity"], [0, 0, 0])
        self.assertGreater(max(tilts) - min(tilts), 40)

    def test_lines_move_it(self):
        port = free_port()
        self.start(f"input: 'udp-listen://127.0.0.1:{port}'")
        wait_for_lines(self.truth, 2)
        half = math.radians(60) / 2
        line = json.dumps({"position": [1, 0, 0], "orientation": [math.cos(half), 0, math.sin(half), 0],
                           "velocity": [0.2, 0, -0.1], "angular_velocity": [0, 0.3, 0]})
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as told:
            for count in range(3, 60):
                told.sendto(line.encode() + b"\n", ("127.0.0.1", port))
                _, pings = wait_for_lines(self.truth, count)
                if abs(pings[-1]["world_from_sonar"]["position"][0] - 1) < 1e-6:
                    break
        x, _, z = axis_of(pings[-1]["world_from_sonar"])
        self.assertAlmostEqual(math.degrees(math.atan2(-z, x)), 60, delta=0.1)
        self.assertEqual(pings[-1]["sonar_velocity"], [0.2, 0, -0.1])
        self.assertEqual(pings[-1]["sonar_turning"], [0, 0.3, 0])


if __name__ == "__main__":
    unittest.main()
