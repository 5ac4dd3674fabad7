"""`run --mcap` and `convert ... .mcap`, read back by mcap, mcap-ros2-support and rosbags from PyPI."""

import base64
import json
import math
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import public_driver

public_driver.use("bag", "mcap_ros2")

import numpy as np  # noqa: E402
import websockets.sync.client as websockets  # noqa: E402
from mcap.exceptions import EndOfFile  # noqa: E402
from mcap.reader import make_reader  # noqa: E402
from mcap.records import Chunk, Message  # noqa: E402
from mcap.stream_reader import StreamReader  # noqa: E402
from mcap_ros2.decoder import DecoderFactory  # noqa: E402
from ports import free_port  # noqa: E402
from program import PROGRAM, ROOT, Emulator  # noqa: E402
from rosbags.highlevel import AnyReader  # noqa: E402

SHARED = ROOT.parent / "shared" / "data"
AHEAD = 4.0  # m, to the wall of the tank that it looks at
TANK = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2], rpy_deg: [0, 0, 90]}}
clock: %s
faults: [{device: bottom, kind: silence, from: 0.5}]
devices:
  - name: fan
    model: r2sonic-2024
    endpoints: ["udp-listen://127.0.0.1:%d", "udp://127.0.0.1:%d"]
    options: {projector: wide, range: 10, ping_rate: 5, image_height: 200}
  - name: head
    model: ping360
    endpoints: ["udp-listen://127.0.0.1:%d"]
%s  - {name: bottom, model: nmea-echosounder, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["udp://127.0.0.1:%d"]}
"""


def tank(clock, pings=""):
    return TANK % (clock, free_port(), free_port(), free_port(), pings, free_port())


def messages(file):
    """{topic: [message, ...]} and the summary, by the reader that checks all CRCs."""
    found = {}
    with open(file, "rb") as stream:
        reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for schema, channel, message, decoded in reader.iter_decoded_messages():
            found.setdefault(channel.topic, []).append((message, decoded))
        return found, reader.get_summary(), reader.get_header(), list(reader.iter_attachments())


def samples(image):
    """(bins, beams) of a marine_acoustic_msgs/SonarImageData."""
    kind = {0: np.uint8, 8: np.float32}[image.dtype]
    return np.frombuffer(bytes(image.data), kind).reshape(-1, image.beam_count)


def validate(case, file, count):
    """By the readers of MCAP's makers in another language, from the start and by the index."""
    modules = public_driver.node("@mcap/core")
    script = ROOT / "tests" / "drivers" / "node" / "validate.mjs"
    done = subprocess.run(["node", str(script), str(modules), str(file)], capture_output=True, text=True, timeout=60)
    case.assertEqual(done.returncode, 0, done.stdout + done.stderr)
    case.assertEqual(json.loads(done.stdout), {"done": True, "streamed": count, "indexed": count, "counted": count})


class Run(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="echoloop-bag-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, True)
        cls.file = cls.folder / "tank.mcap"
        scenario = cls.folder / "tank.yaml"
        free = tank("{mode: free, duration: 1.5}", "    pings: {interval: 0.1, count: 15}\n")
        scenario.write_text(free.replace("{scenes}", str(ROOT / "config" / "scenes")))
        done = subprocess.run([PROGRAM, "run", str(scenario), "--mcap", str(cls.file), "--json"], capture_output=True,
                              text=True, timeout=60)
        assert done.returncode == 0, done.stderr
        cls.ended = json.loads(done.stdout.splitlines()[-1])
        cls.found, cls.summary, cls.header, cls.attachments = messages(cls.file)

    def test_it_is_a_bag_of_ros_2_with_chunks_indexes_and_counts(self):
        self.assertEqual(self.header.profile, "ros2")
        count = sum(len(of) for of in self.found.values())
        self.assertEqual(self.summary.statistics.message_count, count)
        self.assertEqual(self.ended["bag"]["messages"], count)
        self.assertEqual(self.ended["bag"]["lost"], 0)
        self.assertEqual(self.ended["bag"]["bytes"], self.file.stat().st_size)
        self.assertTrue(self.summary.chunk_indexes)
        self.assertEqual({index.compression for index in self.summary.chunk_indexes}, {"zstd"})
        self.assertTrue(all(index.message_index_offsets for index in self.summary.chunk_indexes))
        for channel in self.summary.channels.values():
            self.assertEqual(channel.message_encoding, "cdr")
        with open(self.file, "rb") as stream:  # checks the CRC of the whole data section, too
            kinds = [type(record).__name__ for record in StreamReader(stream, validate_crcs=True).records]
        self.assertEqual(kinds[-1], "Footer")

    def test_the_scene_travels_as_an_attachment(self):
        scene = (ROOT / "config" / "scenes" / "tank.glb").read_bytes()
        self.assertEqual({a.name: a.data for a in self.attachments}["tank.glb"], scene)
        self.assertIn("tank.yaml", {a.name for a in self.attachments})

    def test_the_wall_is_at_its_range_in_the_image_in_points_and_in_truth(self):
        image = self.found["/fan/image"][-1][1]
        levels = samples(image.image)
        self.assertEqual(levels.shape, (len(image.ranges), len(image.beam_directions)))
        ahead = max(range(levels.shape[1]), key=lambda b: image.beam_directions[b].z)
        self.assertAlmostEqual(image.ranges[int(levels[:, ahead].argmax())], AHEAD, delta=0.15)
        port = image.beam_directions[0]
        self.assertLess(port.y, -0.3)  # the first beam looks to port, and y is starboard
        self.assertAlmostEqual(math.hypot(port.x, port.y, port.z), 1, places=5)
        cloud = self.found["/fan/points"][-1][1]
        points = np.frombuffer(bytes(cloud.data), np.float32).reshape(-1, 4)
        self.assertEqual([field.name for field in cloud.fields], ["x", "y", "z", "intensity"])
        self.assertEqual(len(points), cloud.width)
        near = points[np.abs(points[:, 1]) < 0.5]
        self.assertAlmostEqual(float(np.median(near[:, 0])), AHEAD, delta=0.2)
        ranges = self.found["/fan/truth/ranges"][-1][1]
        self.assertAlmostEqual(ranges.ranges[ahead], AHEAD, delta=0.1)
        truth = json.loads(self.found["/fan/truth"][-1][1].data)
        self.assertTrue(any("wall" in name for name in truth["names"].values()), truth["names"])

    def test_the_floor_is_at_its_depth_in_a_raw_image(self):
        raw = self.found["/bottom/raw"][-1][1]
        levels = samples(raw.image)[:, 0]
        metres = (np.arange(len(levels)) + raw.sample0 + 0.5) / raw.sample_rate * raw.ping_info.sound_speed / 2
        beyond = np.flatnonzero(metres > 0.5)
        loudest = beyond[levels[beyond].argmax()]
        self.assertAlmostEqual(metres[loudest], 2.0, delta=0.1)
        self.assertAlmostEqual(self.found["/bottom/truth/ranges"][-1][1].ranges[0], 2.0, delta=0.01)

    def test_poses_are_those_of_the_scenario(self):
        odometry = self.found["/odom"][-1][1]
        at = odometry.pose.pose
        self.assertEqual((at.position.x, at.position.y, at.position.z), (0, 0, -2))
        self.assertAlmostEqual(at.orientation.z, math.sin(math.pi / 4))
        names = {(t.header.frame_id, t.child_frame_id) for _, of in self.found["/tf"] for t in of.transforms}
        for pair in (("world", "base_link"), ("base_link", "fan"), ("fan", "fan_fan"), ("base_link", "head")):
            self.assertIn(pair, names)

    def test_what_the_wire_says_has_its_fields_and_its_picture(self):
        said = self.found["/bottom/wire"]
        values = [{v.key: v.value for v in m.status[0].values} for _, m in said]
        self.assertTrue(any(v["direction"] == "sent" and len(v) > 4 for v in values), values[:2])
        lists = [json.loads(v.value[: v.value.index("]") + 1]) for _, m in self.found["/fan/wire"] for v in m.status[0].values if v.value.startswith("[")]
        self.assertTrue(any(len(one) > 100 for one in lists), "a long list stands there whole, as JSON")
        image = self.found["/fan/said/AID0/picture"][-1][1]
        self.assertEqual((image.encoding, image.width, image.height, len(image.data)), ("rgb8", 480, 360, 480 * 360 * 3))
        self.assertGreater(sum(1 for byte in image.data if byte > 100), 1000)

    def test_faults_are_in_the_log(self):
        texts = [line.msg for _, line in self.found["/rosout"]]
        self.assertTrue(any("silence" in text for text in texts), texts)

    def test_rosbags_reads_the_same(self):
        with AnyReader([self.file]) as reader:
            count = 0
            for connection, stamp, raw in reader.messages():
                message = reader.deserialize(raw, connection.msgtype)
                count += 1
                if connection.topic == "/fan/image":
                    last = message
        self.assertEqual(count, self.summary.statistics.message_count)
        other = self.found["/fan/image"][-1][1]
        self.assertEqual(bytes(last.image.data), bytes(other.image.data))
        self.assertEqual(list(last.ranges), list(other.ranges))

    def test_the_readers_of_its_makers_in_another_language_find_it_valid(self):
        validate(self, self.file, self.summary.statistics.message_count)


class Demo(unittest.TestCase):
    """The demo as it is, but at places of its own."""

    def test_its_bag_opens_and_is_valid(self):
        with tempfile.TemporaryDirectory(prefix="echoloop-bag-") as folder:
            text = (ROOT / "config" / "demo.yaml").read_text()
            for here, there in (("scenes/", f"{ROOT}/config/scenes/"), ("/tmp/echoloop/", folder + "/"),
                                ("127.0.0.1:65500", f"127.0.0.1:{free_port(16)}"), ("127.0.0.1:65400", f"127.0.0.1:{free_port(8)}")):
                self.assertIn(here, text)
                text = text.replace(here, there)
            scenario, bag = Path(folder) / "demo.yaml", Path(folder) / "demo.mcap"
            scenario.write_text(text)
            done = subprocess.run([PROGRAM, "run", str(scenario), "--duration", "5", "--mcap", str(bag)], capture_output=True,
                                  text=True, timeout=100)
            self.assertEqual(done.returncode, 0, done.stderr)
            found, summary = messages(bag)[:2]
            validate(self, bag, summary.statistics.message_count)
            with AnyReader([bag]) as reader:
                self.assertEqual(reader.message_count, summary.statistics.message_count)
        for topic in ("image", "picture", "points", "truth", "said/AID0/image", "said/BTH0/detections", "wire"):
            self.assertGreater(len(found["/sonar/" + topic]), 3, topic)
        names = json.loads(found["/sonar/truth"][-1][1].data)["names"].values()
        self.assertTrue(any("manifold" in name for name in names), names)


class Moving(unittest.TestCase):
    def test_the_vehicles_velocity_is_told_in_its_own_frame(self):
        """It goes north at 0.5 m/s, looks west and sinks at 0.1 m/s: north is to its right, and y is to the left."""
        with tempfile.TemporaryDirectory() as folder:
            bag, scenario, way = (Path(folder) / name for name in ("moving.mcap", "moving.yaml", "way.csv"))
            way.write_text("t,x,y,z,qw,qx,qy,qz\n0,0,-1,-1,0,0,0,1\n4,0,1,-1.4,0,0,0,1\n")
            scenario.write_text(f"""
scene: {ROOT}/config/scenes/tank.glb
water: {{temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}}
vehicle: {{trajectory: way.csv}}
clock: {{mode: free, duration: 3}}
devices:
  - {{name: bottom, model: nmea-echosounder, mount: {{rpy_deg: [0, 90, 0]}}, endpoints: ["udp://127.0.0.1:{free_port()}"]}}
""")
            done = subprocess.run([PROGRAM, "run", str(scenario), "--mcap", str(bag)], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 0, done.stderr)
            found = messages(bag)[0]["/odom"]
        middle = found[len(found) // 2][1]
        linear = middle.twist.twist.linear
        for value, wanted in zip((linear.x, linear.y, linear.z), (0, -0.5, -0.1), strict=True):
            self.assertAlmostEqual(value, wanted, places=2)
        apart = found[-1][1].pose.pose.position.y - found[0][1].pose.pose.position.y
        seconds = (found[-1][0].log_time - found[0][0].log_time) / 1e9
        self.assertAlmostEqual(apart / seconds, 0.5, delta=0.02)


class Live(unittest.TestCase):
    def test_after_a_kill_9_all_that_was_flushed_can_be_recovered(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "killed.mcap"
            with Emulator(tank("{mode: real}"), "--mcap", str(file)) as emulator:
                end = time.monotonic() + 20
                sizes = set()  # it grows by whole chunks
                while len(sizes) < 8 and time.monotonic() < end:
                    sizes.add(file.stat().st_size)
                    time.sleep(0.05)
                emulator.process.send_signal(signal.SIGKILL)
                emulator.process.wait(10)
            topics = set()
            with open(file, "rb") as stream:
                reader = StreamReader(stream, validate_crcs=True)
                with self.assertRaises(EndOfFile):  # there is no footer
                    for record in reader.records:
                        if isinstance(record, Message):
                            topics.add(record.channel_id)
            self.assertGreater(len(topics), 5)


    def test_its_pictures_are_the_dots_of_the_page(self):
        if shutil.which("node") is None or shutil.which("esbuild") is None:
            self.skipTest("node and esbuild run the page's code")
        with tempfile.TemporaryDirectory() as folder:
            file, bundle, entry = (Path(folder) / name for name in ("seen.mcap", "page.cjs", "page.ts"))
            page = ROOT / "tools" / "view" / "page"
            entry.write_text("".join(f'export {{ {name} }} from "{page}/{of}";\n' for name, of in (
                ("Picture", "picture"), ("pingOf", "news"), ("paletteOf", "palette"))))
            subprocess.run(["esbuild", str(entry), "--bundle", "--platform=node", f"--outfile={bundle}", "--log-level=error"],
                           check=True, timeout=60)
            with Emulator(tank("{mode: real}"), "--mcap", str(file), "--view") as emulator:
                link = re.search(r"http://([0-9.:]+)/#([0-9a-f]+)", emulator.output)
                seen = {}
                with websockets.connect(f"ws://{link[1]}/news", subprotocols=["echoloop.view", link[2]], max_size=None) as viewer:
                    while len(seen) < 3:
                        message = viewer.recv(30)
                        if isinstance(message, bytes):
                            head = json.loads(message[4:4 + struct.unpack_from("<I", message)[0]])
                            if head["type"] == "ping" and head["device"] == "fan":
                                seen[round(head["t"] * 1e6)] = message
                self.assertEqual(emulator.stop()[0], 0, emulator.output)
            found = messages(file)[0]
            numbers = {round(json.loads(m.data)["t"] * 1e6): of.log_time for of, m in found["/fan/truth"]}
            tops, top = {}, -math.inf
            for of, image in found["/fan/image"]:
                loudest = np.float32(10) * np.log10(samples(image.image).max())
                floor = math.ceil(loudest) - 127
                top = max(top - 0.2, floor + min(int((loudest - floor) / 0.5), 254) * 0.5)
                tops[of.log_time] = top
            pictures = {of.log_time: image for of, image in found["/fan/picture"]}
            pairs = [(seen[t], numbers[t]) for t in sorted(seen) if t in numbers and numbers[t] in pictures]
            self.assertGreaterEqual(len(pairs), 1)
            lines = "".join(json.dumps({"message": base64.b64encode(m).decode(), "top": tops[t]}) + "\n" for m, t in pairs)
            script = ROOT / "tests" / "drivers" / "node" / "page_picture.mjs"
            drawn = subprocess.run(["node", str(script), str(bundle)], input=lines, capture_output=True, text=True, timeout=60)
            self.assertEqual(drawn.returncode, 0, drawn.stderr)
            for line, (_, t) in zip(drawn.stdout.splitlines(), pairs, strict=True):
                theirs = np.frombuffer(base64.b64decode(line), np.uint8).reshape(360, 480, 3)
                ours = np.frombuffer(bytes(pictures[t].data), np.uint8).reshape(360, 480, 3)
                self.assertGreater((ours > 0).any(axis=2).mean(), 0.05)
                other = (theirs != ours).any(axis=2).mean()  # sines of two libraries may differ in the last digit
                self.assertLess(other, 0.001)


class Convert(unittest.TestCase):
    def convert(self, name):
        file = SHARED / name
        if not file.exists():
            if os.environ.get("CI"):
                self.fail(f"{file} is missing")
            self.skipTest(f"{file} is not here")
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out.mcap"
            done = subprocess.run([PROGRAM, "convert", str(file), str(out)], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 0, done.stderr)
            return messages(out)[0]

    def test_an_r2sonics_soundings(self):
        found = self.convert("r2sonic/r2sonic_bth0_20.pcap")
        detections = next(of for topic, of in found.items() if topic.endswith("/said/BTH0/detections"))
        self.assertEqual(len(detections), 20)
        first = detections[0][1]
        self.assertEqual(len(first.two_way_travel_times), 256)
        self.assertAlmostEqual(first.two_way_travel_times[0], 8069 * 3.8296566e-06 * 1514.962 / 1500, delta=1e-4)
        self.assertAlmostEqual(first.rx_angles[0], -1.0740883, places=5)

    def test_an_oculus_image(self):
        found = self.convert("oculus/three_pings_8bit.raw")
        images = next(of for topic, of in found.items() if "/said/Result" in topic and topic.endswith("/image"))
        raw = (SHARED / "oculus/three_pings_8bit.raw").read_bytes()
        self.assertEqual(len(images), 3)
        self.assertEqual(samples(images[0][1].image).tobytes(), raw[2048:182016])


if __name__ == "__main__":
    unittest.main(verbosity=2)
