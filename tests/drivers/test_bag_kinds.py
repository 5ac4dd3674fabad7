"""A sonar whose pictures are of several kinds has topics for each in a bag: R2Sonic's soundings, image, water column and TruePix, the
two frequencies of an EdgeTech. Read back by mcap from PyPI."""

import subprocess
import tempfile
import unittest
from pathlib import Path

from test_bag import PROGRAM, ROOT, free_port, messages, np, samples

SCENARIO = """
scene: %s/config/scenes/flat.glb
seed: 5
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -12]}}
clock: {mode: free, duration: 3}
devices:
  - {name: fan, model: r2sonic-2024, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["udp-listen://127.0.0.1:%d", "udp://127.0.0.1:%d"],
     options: {ping_rate: 5, range: 20, image_height: 400, water_column: magnitude, truepix: direction}}
  - {name: side, model: edgetech-2205, endpoints: ["tcp-listen://127.0.0.1:%d", "tcp-listen://127.0.0.1:%d"], options: {start: both}}
"""
DEPTH = 8.0  # m, of the floor below both


def lit_rows(image):
    """Rows of a side-scan's waterfall that hold something."""
    dots = np.frombuffer(bytes(image.data), np.uint8).reshape(image.height, image.width, 3)
    return int((dots.max(axis=2) > 60).any(axis=1).sum())


class Kinds(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory(prefix="echoloop-bag-") as folder:
            scenario, file = Path(folder) / "kinds.yaml", Path(folder) / "kinds.mcap"
            scenario.write_text(SCENARIO % (ROOT, *(free_port() for _ in range(4))))
            done = subprocess.run([PROGRAM, "run", str(scenario), "--mcap", str(file)], capture_output=True, text=True, timeout=100)
            assert done.returncode == 0, done.stderr
            cls.found = messages(file)[0]

    def test_each_message_of_an_r2sonic_has_its_own(self):
        shapes = {}
        for name in ("AID0", "WCD0"):
            topic = f"/fan/said/{name}"
            shapes[name] = {samples(image.image).shape for _, image in self.found[topic + "/image"]}
            self.assertEqual(len(shapes[name]), 1, "all of one kind")
            image = self.found[topic + "/image"][-1][1]
            ahead = max(range(len(image.beam_directions)), key=lambda b: image.beam_directions[b].z)
            self.assertAlmostEqual(image.ranges[int(samples(image.image)[:, ahead].argmax())], DEPTH, delta=0.2)
            self.assertGreater(len(self.found[topic + "/picture"]), 5)
        self.assertNotEqual(shapes["AID0"], shapes["WCD0"])
        sides = self.found["/fan/said/TPX0/raw"][-1][1]
        self.assertEqual(sides.image.beam_count, 2)
        waterfall = self.found["/fan/said/TPX0/picture"]
        self.assertEqual(lit_rows(waterfall[-1][1]), len(self.found["/fan/said/TPX0/raw"]), "a line for each ping")
        self.assertGreater(len(self.found["/fan/said/BTH0/detections"]), 10)
        self.assertFalse([topic for topic in self.found if topic.startswith("/fan/said/") and topic.count("/") < 4])

    def test_what_it_says_lies_where_it_was_heard(self):
        """Its axis, which looks down, is x; y is to port."""
        clouds = {}
        for topic in ("/fan/points", "/fan/said/BTH0/points"):
            cloud = self.found[topic][-1][1]
            self.assertEqual(cloud.header.frame_id, "fan")
            points = np.frombuffer(bytes(cloud.data), np.float32).reshape(-1, 4)
            clouds[topic] = points[np.abs(points[:, 1]) < 4]
        for topic, points in clouds.items():
            self.assertGreater(len(points), 50, topic)
            self.assertAlmostEqual(float(np.median(points[:, 0])), DEPTH, delta=0.2, msg=topic)
            self.assertLess(float(np.abs(points[:, 2]).max()), 0.5, topic)

    def test_each_frequency_of_an_edgetech_has_its_own(self):
        for heard, said, frequency in (("at_120_kHz", "SonarData_low", 120e3), ("at_410_kHz", "SonarData_high", 410e3)):
            raw = [image for _, image in self.found[f"/side/{heard}/raw"]]
            self.assertGreater(len(raw), 5)
            self.assertEqual({round(image.ping_info.frequency) for image in raw}, {frequency})
            pictures = self.found[f"/side/{heard}/picture"]
            self.assertEqual(lit_rows(pictures[-1][1]), len(pictures), "each ping goes on from those before of its frequency")
            whole = self.found[f"/side/said/{said}/raw"]
            self.assertGreater(len(whole), 5)
            self.assertEqual(lit_rows(self.found[f"/side/said/{said}/picture"][-1][1]), len(whole))
        self.assertNotIn("/side/raw", self.found)
        self.assertIn("/side/truth", self.found)


if __name__ == "__main__":
    unittest.main()
