"""A manifold, an AUV and a seabed described as SDF go through `echoloop import` and `echoloop run` to the Ping360's own
Python package, which finds the manifold, and the AUV where a scenario puts it."""

import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import public_driver

public_driver.use("ping360", "brping")
sys.path.insert(0, str(public_driver.ROOT / "tests" / "tools" / "import"))

from brping import Ping360  # noqa: E402
from program import PROGRAM, Emulator  # noqa: E402
from worlds import needs_worlds  # noqa: E402

WORLDS = public_driver.ROOT / "tests" / "data" / "worlds"
SAMPLES, PERIOD = 1200, 444  # 10 m
BIN = PERIOD * 25e-9 * 1500 / 2

SCENARIO = """
scene: %s
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [-9, 0, -7.5]}}
objects: [{node: target_auv, pose: {position: [-4, -3, -7.5]}}]
effects: {beam_pattern: off, side_lobes: off, speckle: off, multipath: off, second_time_around: off}
devices:
  - {name: ping360, model: ping360, endpoints: ["pty:{folder}/ping360"], options: {ring_down: true}}
"""


class ImportedWorld(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="echoloop-imported-")
        self.addCleanup(folder.cleanup)
        self.scene = pathlib.Path(folder.name) / "manifold.glb"
        needs_worlds(self)

    def edge(self, sonar, angle):
        """Range (m) of the first strong echo beyond the ring-down; 200 gradians is ahead, more is to starboard."""
        for _ in range(5):
            if reply := sonar.transmitAngle(angle):
                data = bytes(reply.data)
                return next((i * BIN for i in range(int(1 / BIN), len(data)) if data[i] >= 80), math.inf)
        self.fail(f"no answer at {angle} gradians")

    def test_the_driver_finds_the_manifold_and_the_auv(self):
        done = subprocess.run([PROGRAM, "import", WORLDS / "manifold.world", "--out", self.scene, "--model-path",
                               WORLDS / "models", "--keep", "target_auv"], capture_output=True, text=True, timeout=120,
                              check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for line in ("left out: rexrov: the robot itself, by a sensor custom", "left out: sea_surface::link::surface: water",
                     'steel      surface_props "steel"', "can move (objects: of a scenario): target_auv\n"):
            self.assertIn(line, done.stdout)
        with Emulator(SCENARIO % self.scene) as emulator:
            sonar = Ping360()
            sonar.connect_serial(str(emulator.folder / "ping360"), 115200)
            self.addCleanup(lambda: sonar.iodev.close())
            self.assertTrue(sonar.initialize())
            sonar.set_transmit_frequency(750)
            sonar.set_sample_period(PERIOD)
            sonar.set_number_of_samples(SAMPLES)
            sonar.set_transmit_duration(53)
            sonar.set_gain_setting(0)
            # The roof's edge from (-3.59, 0.32) to (-1.67, -3.19) crosses the bow's line at x = -3.42; a degree to port
            # it is 4 cm nearer.
            self.assertAlmostEqual(self.edge(sonar, 200), 5.58, delta=0.1)
            # The AUV's side, 2.73 m to starboard, 36 deg off the bow: between 35 and 37 deg.
            edge = self.edge(sonar, 240)
            self.assertGreater(edge, 2.73 / math.sin(math.radians(37)) - 0.1)
            self.assertLess(edge, 2.73 / math.sin(math.radians(35)) + 0.05)


if __name__ == "__main__":
    unittest.main()
