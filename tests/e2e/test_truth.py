"""`echoloop run --truth`: the lines against the tank as config/README and tools/scenes/tank.py have it."""

import json
import math
import os
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from ports import free_port
from program import Emulator

# The tank's inner faces: x = +-6, y = +-4; the floor at z = -4. The sonar is in its middle, 2 m down.
WALLS = {"wall_east": (6, 0), "wall_west": (-6, 0), "wall_north": (0, 4), "wall_south": (0, -4)}
SCENARIO = """scene: {scenes}/tank.glb
water: {sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2], rpy_deg: [0, 0, %s]}}
devices:
  - {name: sonar, model: r2sonic-2024, endpoints: ['udp-listen://127.0.0.1:%d', 'udp://127.0.0.1:%d']}
"""


def scenario(yaw=0):
    port = free_port(8)
    return SCENARIO % (yaw, port, port + 1)


def wait_for_lines(file, count, seconds=60):
    """The header and the pings of a file that is being written, once there are `count` pings."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        lines = file.read_text().splitlines(keepends=True) if file.exists() else []
        whole = [json.loads(line) for line in lines if line.endswith("\n")]
        if len(whole) > count:
            return whole[0], whole[1:]
        time.sleep(0.05)
    raise AssertionError(f"{file} has not got {count} pings")


def wall_ahead(x, y):
    """Name and range of the wall that a level beam towards (x, y) meets."""
    ranges = {name: max(abs(wx), abs(wy)) / (x * (wx > 0) - x * (wx < 0) + y * (wy > 0) - y * (wy < 0))
              for name, (wx, wy) in WALLS.items()
              if x * wx + y * wy > 0}
    return min(ranges.items(), key=lambda item: item[1])


class Truth(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.file = Path(self.folder.name) / "truth.jsonl"

    def tearDown(self):
        self.folder.cleanup()

    def test_ranges_and_objects_of_the_tank(self):
        yaw = 25
        with Emulator(scenario(yaw), "--truth", str(self.file)) as emulator:
            wait_for_lines(self.file, 3)
            status, output = emulator.stop()
        self.assertEqual(status, 0, output)
        self.assertRegex(output, r"ground truth +\S+: \d+ lines, \d+ bytes\n")
        header, pings = wait_for_lines(self.file, 3)
        self.assertEqual(header["echoloop_truth"], 1)
        self.assertEqual(header["devices"][0]["model"], "r2sonic-2024")
        names = [None, *header["objects"]]
        self.assertTrue(set(WALLS) <= set(names))
        self.assertEqual([ping["ping"] for ping in pings], list(range(1, len(pings) + 1)))
        ping = pings[1]
        self.assertEqual(ping["world_from_sonar"]["position"], [0, 0, -2])
        self.assertEqual(ping["sound_speed"], 1500)
        shot = ping["shot"]
        bin_length = 1500 / 2 * shot["bin_interval"]
        walls = 0
        for bearing, axis, nearest, runs in zip(
            ping["beams"], ping["axis_range"], ping["nearest_range"], ping["objects"], strict=True
        ):
            course = math.radians(yaw) - bearing  # bearings are clockwise, yaw is not
            name, metres = wall_ahead(math.cos(course), math.sin(course))
            beside = [course - shot["beam_width"], course + shot["beam_width"]]
            if {wall_ahead(math.cos(side), math.sin(side))[0] for side in beside} != {name}:
                continue  # a corner of the tank, where a pixel shows one wall or the other
            if metres < axis + 0.1:  # nothing stands before it
                walls += 1
                beside_an_edge = nearest < metres - 0.5  # of something else in the beam: the pixel next to the axis counts
                half_pixel = shot["beam_width"] / 3
                off = max(abs(wall_ahead(math.cos(course + d), math.sin(course + d))[1] - metres)
                          for d in (-half_pixel, half_pixel))
                self.assertAlmostEqual(axis, metres, delta=max(bin_length, off) if beside_an_edge else bin_length)
            self.assertLess(nearest, metres + bin_length)
            objects = {b: names[number] for number, first, bins in runs for b in range(first, first + bins)}
            at = int((axis - 1500 / 2 * shot["first_bin_time"]) / bin_length)
            expected = [name] if metres < axis + 0.1 else ["grid", "ball", "post"]
            self.assertTrue({objects.get(at), objects.get(at + 1)} & set(expected), (bearing, axis, name, runs))
        self.assertGreater(walls, len(ping["beams"]) / 2)

    def test_names_the_faults_that_were_on(self):
        faults = "faults: [{device: sonar, kind: loss, rate: 0.5}]\n"
        with Emulator(scenario() + faults, "--truth", str(self.file)):
            _, pings = wait_for_lines(self.file, 2)
        self.assertEqual({tuple(ping["faults"]) for ping in pings}, {("loss 1",)})

    def test_a_recording_says_of_each_ping_where_the_sonar_was(self):
        capture = Path(self.folder.name) / "run.pcapng"
        asked = ("--truth", str(self.file), "--record", str(capture), "--record-truth")
        with Emulator(scenario(), *asked) as emulator:
            wait_for_lines(self.file, 3)
            emulator.stop()
        _, pings = wait_for_lines(self.file, 3)
        read = subprocess.run(["tshark", "-r", capture, "-Y", "frame.comment", "-T", "fields", "-e", "frame.comment"],
                              check=True, capture_output=True, text=True)
        comments = read.stdout.splitlines()
        self.assertGreaterEqual(len(comments), 3)
        for number, (comment, ping) in enumerate(zip(comments, pings), 1):
            self.assertRegex(comment, rf"^ping {number}: t [\d.]+ s, sonar at 0\.000 0\.000 -2\.000 m, orientation w 1\.0+ ")
            self.assertAlmostEqual(float(comment.split()[3]), ping["t"], delta=2e-6)

    def test_a_killed_run_loses_a_second_at_most(self):
        with Emulator(scenario(), "--truth", str(self.file)) as emulator:
            wait_for_lines(self.file, 10)
            time_before = time.time() - 1
            os.kill(emulator.process.pid, signal.SIGKILL)
            emulator.process.wait()
            emulator.process.stdout.close()
        _, pings = wait_for_lines(self.file, 10)
        self.assertGreater(pings[-1]["unix"], time_before - 0.2)

    def test_a_full_disk_is_said_once_and_ends_the_truth_only(self):
        with Emulator(scenario(), "--truth", "/dev/full") as emulator:
            emulator.read_until("the ground truth has stopped", 30)
            status, output = emulator.stop()
        self.assertEqual(status, 0, output)
        self.assertEqual(output.count("has stopped"), 1, output)
        self.assertRegex(output, "it stopped early")
        self.assertRegex(output, r"sonar +\d+ ping")


if __name__ == "__main__":
    unittest.main()
