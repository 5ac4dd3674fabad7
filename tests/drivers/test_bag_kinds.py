"""A sonar whose pictures are of several kinds has topics for each in a bag: R2Sonic's soundings, image, water column, snippets and TruePix, the
two frequencies of an EdgeTech. Read back by mcap from PyPI."""

import struct
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
     options: {ping_rate: 5, range: 20, image_height: 400, water_column: magnitude, truepix: direction, snippets: true}}
  - {name: side, model: edgetech-2205, endpoints: ["tcp-listen://127.0.0.1:%d", "tcp-listen://127.0.0.1:%d"], options: {start: both}}
  - {name: log, model: dvl-pathfinder, mount: {rpy_deg: [0, 0, -45]}, endpoints: ["tcp-listen://127.0.0.1:%d"],
     options: {speed_of_sound: 1500, baud: 0, profile_pings: 1, profile_cells: 20, cell_size: 50}}
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
            scenario.write_text(SCENARIO % (ROOT, *(free_port() for _ in range(5))))
            done = subprocess.run([PROGRAM, "run", str(scenario), "--mcap", str(file)], capture_output=True, text=True, timeout=100)
            assert done.returncode == 0, done.stderr
            cls.found = messages(file)[0]

    def test_each_message_of_an_r2sonic_has_its_own(self):
        shapes = {}
        for name in ("AID0", "WCD0", "SNI0"):
            topic = f"/fan/said/{name}"
            shapes[name] = {samples(image.image).shape for _, image in self.found[topic + "/image"]}
            if name != "SNI0":  # has a beam for each sounding
                self.assertEqual(len(shapes[name]), 1, "all of one kind")
            image = self.found[topic + "/image"][-1][1]
            ahead = max(range(len(image.beam_directions)), key=lambda b: image.beam_directions[b].z)
            self.assertAlmostEqual(image.ranges[int(samples(image.image)[:, ahead].argmax())], DEPTH, delta=0.2)
            self.assertGreater(len(self.found[topic + "/picture"]), 5)
        self.assertNotEqual(shapes["AID0"], shapes["WCD0"])
        image = self.found["/fan/said/SNI0/image"][-1][1]
        self.assertLess(float((samples(image.image) > 0).mean()), 0.3, "water has no snippet")
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

    def test_the_cells_of_a_doppler_log_stand_beside_its_ranges(self):
        raw = self.found["/log/said/Ensemble_intensity/raw"][-1][1]
        self.assertEqual(samples(raw.image).shape, (20, 4))
        self.assertEqual(set(raw.rx_angles), {0}, "messages tell no angles of beams")
        metres = (samples(raw.image).argmax(axis=0) + raw.sample0 + 0.5) / raw.sample_rate * raw.ping_info.sound_speed / 2
        for one in metres:
            self.assertAlmostEqual(one, DEPTH, delta=0.5)
        for topic in ("Ensemble/soundings", "Ensemble_intensity/picture"):
            self.assertGreater(len(self.found["/log/said/" + topic]), 3, topic)

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


class OlderFiles(unittest.TestCase):
    """A .jsf file of messages of type 82, whose layout the specification notes on side-scans have."""

    def test_an_old_side_scan_has_a_waterfall(self):
        pings, count, first = 30, 1000, 20
        bytes_of = []
        for ping in range(pings):
            for channel in (0, 1):
                loud = 600 if channel else 300  # sample of a wall: to starboard farther
                trace = [4000 if abs(i - loud) < 3 else 16 for i in range(count)]
                head = struct.pack("<HHIHHIIIhHHHHHHH", 20, channel, ping, 1, 0, count, 40000, first, 2, 0, 0, 300, 0, 0, 0, 0)
                head += struct.pack("<IhHHHHhhhhhIh10x", ping * 100, 2010, 200, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0)
                self.assertEqual(len(head), 80)
                body = head + struct.pack(f"<{count}H", *trace)
                bytes_of.append(struct.pack("<HBBHBBBBHI", 0x1601, 13, 0, 82, 0, 20, channel, 0, 0, len(body)) + body)
        with tempfile.TemporaryDirectory(prefix="echoloop-bag-") as folder:
            file, out = Path(folder) / "old.jsf", Path(folder) / "old.mcap"
            file.write_bytes(b"".join(bytes_of))
            done = subprocess.run([PROGRAM, "convert", str(file), str(out)], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 0, done.stderr)
            found = messages(out)[0]
        raws = next(of for topic, of in found.items() if topic.endswith("/said/OldSideScan_low/raw"))
        self.assertEqual(len(raws), pings)
        raw = raws[-1][1]
        self.assertEqual(raw.image.beam_count, 2)
        levels = samples(raw.image)
        self.assertEqual([int(levels[:, side].argmax()) // 10 for side in (0, 1)], [29, 59])
        self.assertEqual(raw.sample0, first)
        self.assertAlmostEqual(raw.sample_rate, 25000, delta=1)
        pictures = next(of for topic, of in found.items() if topic.endswith("/said/OldSideScan_low/picture"))
        self.assertGreaterEqual(lit_rows(pictures[-1][1]), 1)


if __name__ == "__main__":
    unittest.main()
