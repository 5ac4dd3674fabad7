"""PyPI's adcpreader, unmodified, reads what a Pathfinder and a Navigator say: velocities in every frame, ranges, attitude and a
water profile."""

import math
import socket
import tempfile
import unittest
from pathlib import Path

import public_driver

public_driver.use("pd0", "adcpreader")
import numpy as np  # noqa: E402
from adcpreader.rdi_reader import PD0  # noqa: E402
from ports import free_port  # noqa: E402
from program import Emulator  # noqa: E402
from test_dvl import turned, way  # noqa: E402

SCENARIO = """
scene: {scenes}/flat.glb
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1490}
vehicle: {trajectory: way.csv}
clock: {mode: scaled, rate: 4}
devices:
"""
DEVICE = """
  - name: %s
    model: %s
    mount: {position: [0, 0, 0], rpy_deg: [0, 0, -45]}
    endpoints: ["tcp-listen://127.0.0.1:%d"]
    options: {speed_of_sound: 1490, heading_alignment: 4500, baud: 0, frame: %s, profile_pings: 1, profile_cells: 20}
"""
FRAMES = {"earth": "Earth", "ship": "Ship", "instrument": "Instrument", "beam": "Beam"}
SPEED, HEADING, ALTITUDE = 0.9, 60, 8
WANTED = {"earth": (-SPEED * math.sin(math.radians(HEADING)), -SPEED * math.cos(math.radians(HEADING)), 0),
          "ship": (0, -SPEED, 0),
          "instrument": (SPEED * math.sin(math.radians(45)), -SPEED * math.cos(math.radians(45)), 0),
          "beam": (SPEED * math.sin(math.radians(45)) / 2, -SPEED * math.sin(math.radians(45)) / 2,
                   SPEED * math.sin(math.radians(45)) / 2)}


def said(port, size):
    with socket.create_connection(("127.0.0.1", port), timeout=60) as line:
        data = b""
        while len(data) < size:
            data += line.recv(65536)
        return data


class Pd0Test(unittest.TestCase):
    def test_velocities_ranges_and_attitude_in_every_frame(self):
        ports = {frame: free_port() for frame in FRAMES}
        scenario = SCENARIO + "".join(
            DEVICE % (frame, "dvl-navigator" if frame == "ship" else "dvl-pathfinder", port, frame)
            for frame, port in ports.items()) + "effects: {cross_talk: false}\n"
        east, north = -WANTED["earth"][0], -WANTED["earth"][1]
        rows = [(0, 0, 0, turned(30)), (200, 200 * east, 200 * north, turned(30))]
        with Emulator(scenario, files={"way.csv": way(rows)}), tempfile.TemporaryDirectory() as folder:
            for frame, port in ports.items():
                with self.subTest(frame):
                    file = Path(folder) / frame
                    file.write_bytes(said(port, 40000))
                    self.check(frame, [e for e in PD0().ensemble_generator(str(file))
                                       if e["bottom_track"]["BTVel1"] > -30])

    def check(self, frame, ensembles):
        self.assertGreater(len(ensembles), 30)
        leader = ensembles[0]["fixed_leader"]
        self.assertEqual((leader["CoordXfrm"], leader["Beam_Angle"], leader["Sys_Freq"]), (FRAMES[frame], "30 Degree", "600 kHz"))
        track = np.array([[e["bottom_track"][f"BTVel{i}"] for i in (1, 2, 3)] for e in ensembles])
        ranges = np.array([[e["bottom_track"][f"Range{i}"] for i in (1, 2, 3, 4)] for e in ensembles])
        np.testing.assert_allclose(track.mean(axis=0), WANTED[frame], atol=0.02)
        self.assertAlmostEqual(ranges.mean(), ALTITUDE, delta=0.005 * ALTITUDE)
        self.assertAlmostEqual(ensembles[0]["variable_leader"]["Heading"], HEADING, delta=1.5)
        water = np.array([e["velocity"]["Velocity1"][1] for e in ensembles])
        water = water[water > -30]
        self.assertGreater(len(water), 10)
        self.assertAlmostEqual(water.mean(), WANTED[frame][0], delta=0.02)


if __name__ == "__main__":
    unittest.main()
