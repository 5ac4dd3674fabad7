"""echoloop-truth-rosbridge between the running emulator and a test double of a rosbridge server."""

import base64
import json
import os
import struct
import subprocess
import unittest

from poses_programs import FLOOR_Z, PosesCase, Process, program
from ports import free_port
from rosbridge_double import Double

HELPER = "echoloop-truth-rosbridge"


def line(device="sonar", beams=(0.0,), axis=(10.0,), objects=(((1, 400, 20),),), **more):
    """A line of the ground truth: bins of 25 mm, 1500 m/s."""
    ping = {"device": device, "ping": 0, "unix": 1700000000.25, "sound_speed": 1500,
            "world_from_sonar": {"position": [1, 2, -5], "orientation": [1, 0, 0, 0]},
            "shot": {"pan": 0, "tilt": 0, "beam_width": 0.02, "first_bin_time": 0, "bin_interval": 0.05 / 1500, "bins": 800},
            "beams": beams, "axis_range": axis, "objects": objects}
    ping.update(more)
    return json.dumps(ping)


def points(message):
    """[(x, y, z, object, beam)] of a PointCloud2, by its own fields."""
    codes = {7: "f", 4: "H"}
    data, step = base64.b64decode(message["data"]), message["point_step"]
    assert len(data) == message["row_step"] == step * message["width"]
    return [tuple(struct.unpack_from("<" + codes[f["datatype"]], data, start + f["offset"])[0] for f in message["fields"])
            for start in range(0, len(data), step)]


class Truth(PosesCase):
    def published(self, double, topic):
        double.wait_for(lambda: any(r["op"] == "publish" and r["topic"] == topic for r in double.requests),
                        f"nothing is published on {topic}")
        return next(r["msg"] for r in double.requests if r["op"] == "publish" and r["topic"] == topic)

    def fed(self, lines, *arguments):
        """(double, output) after the helper has read these lines."""
        double = Double(self)
        helper = subprocess.run([program(HELPER), "--server", double.url, *arguments], input="\n".join(lines) + "\n",
                                text=True, capture_output=True, timeout=60, check=False)
        self.assertEqual(helper.returncode, 0, helper.stderr)
        return double, helper.stdout + helper.stderr

    def test_a_sounder_over_a_floor_as_it_runs(self):
        double = Double(self)
        fifo = f"/tmp/echoloop-truth-{os.getpid()}"
        os.mkfifo(fifo)
        self.addCleanup(os.unlink, fifo)
        reader = os.open(fifo, os.O_RDWR)
        helper = subprocess.Popen([program(HELPER), "--server", double.url], stdin=reader, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT)
        os.close(reader)
        self.addCleanup(helper.communicate)
        self.addCleanup(helper.kill)
        scenario = """
scene: {scenes}/flat.glb
seed: 1
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500, depth: 12}
vehicle: {pose: {position: [3, 4, -8]}}
devices:
  - {name: "down-1", model: nmea-echosounder, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["udp://127.0.0.1:%d"]}
""" % free_port()
        self.emulator(scenario, "--truth", fifo)
        cloud = self.published(double, "/echoloop/down_1/truth_points")
        self.assertEqual([f["name"] for f in cloud["fields"]], ["x", "y", "z", "object", "beam"])
        [(x, y, z, number, beam)] = points(cloud)
        self.assertAlmostEqual(x, 3, delta=0.2)
        self.assertAlmostEqual(y, 4, delta=0.2)
        self.assertAlmostEqual(z, FLOOR_Z, delta=0.1)
        self.assertGreater(number, 0)
        self.assertEqual((beam, cloud["header"]["frame_id"]), (0, "map"))
        pose = self.published(double, "/echoloop/down_1/truth_pose")["pose"]
        self.assertEqual([round(pose["position"][k], 6) for k in "xyz"], [3, 4, -8])
        image = self.published(double, "/echoloop/down_1/truth_image")
        self.assertEqual((image["encoding"], image["width"], image["height"], image["step"]), ("rgb8", 400, 200, 1200))
        self.assertTrue(any(base64.b64decode(image["data"])))
        types = {r["topic"].split("/")[-1]: r["type"] for r in double.requests if r["op"] == "advertise"}
        self.assertEqual(types, {"truth_points": "sensor_msgs/msg/PointCloud2", "truth_image": "sensor_msgs/msg/Image",
                                 "truth_pose": "geometry_msgs/msg/PoseStamped"})

    def test_places_and_colours(self):
        """Beams to port and starboard, the vehicle turned to the north, the fan tilted 30 degrees down."""
        north = {"position": [1, 2, -5], "orientation": [2 ** -0.5, 0, 0, 2 ** -0.5]}
        shot = json.loads(line())["shot"] | {"pan": 0.5, "tilt": -0.5235987755982988}
        double, output = self.fed([
            '{"echoloop_truth": 1}',
            line(beams=[-0.5, 0.5], axis=[10, None], objects=[[[2, 390, 20]], []], world_from_sonar=north, shot=shot)])
        [(x, y, z, number, beam)] = points(self.published(double, "/echoloop/sonar/truth_points"))
        # In the fan's plane 0.5 rad to port of its axis, which looks 0.5 rad to starboard of north and 30 deg down.
        ahead, port, down = 10 * 0.8775825619 * 0.8660254038, 10 * 0.4794255386, 10 * 0.8775825619 / 2
        east = 1 + ahead * 0.4794255386 - port * 0.8775825619
        northing = 2 + ahead * 0.8775825619 + port * 0.4794255386
        for ours, wanted in zip((x, y, z), (east, northing, -5 - down)):
            self.assertAlmostEqual(ours, wanted, delta=1e-4)
        self.assertEqual((number, beam), (2, 0))
        self.assertRegex(output, r"pings +1\npictures +1\npoints +1\n")

    def test_a_picture_has_objects_where_they_are(self):
        double, _ = self.fed([line(beams=[-0.785398, 0.785398], axis=[10, 10],
                                   objects=[[[1, 380, 40]], [[2, 0, 40], [1, 380, 40]]],
                                   shot=json.loads(line())["shot"] | {"beam_width": 0.2})], "--width", "201")
        image = self.published(double, "/echoloop/sonar/truth_image")
        data, width = base64.b64decode(image["data"]), image["width"]

        def colour(right, up):  # m; 20 m are 100 pixels
            at = 3 * (round(100 - 5 * up) * width + round(100 + 5 * right))
            return tuple(data[at:at + 3])

        side = 10 * 0.70710678
        self.assertEqual(colour(-side, side), colour(side, side))
        self.assertNotEqual(colour(side, side), (0, 0, 0))
        self.assertNotEqual(colour(0.4, 0.4), colour(side, side))
        self.assertEqual((colour(0, 10), colour(-side / 2, side / 2)), ((0, 0, 0), (0, 0, 0)))

    def test_a_head_keeps_what_it_has_seen(self):
        turns = [line(shot=json.loads(line())["shot"] | {"pan": pan, "beam_width": 0.05}, unix=1700000000 + i)
                 for i, pan in enumerate((0, 1.5708, 3.1416, -1.5708))]
        double, _ = self.fed(turns, "--rate", "100", "--ros", "1")
        images = [r["msg"] for r in double.requests if r["op"] == "publish" and r["topic"].endswith("truth_image")]
        lit = [sum(map(bool, base64.b64decode(image["data"])[1::3])) for image in images]
        self.assertEqual(len(lit), 4)
        self.assertEqual([image["height"] for image in images], [200, 200, 400, 400])
        self.assertTrue(lit[0] < lit[1] < lit[2] < lit[3], lit)
        self.assertEqual(images[3]["header"]["stamp"], {"secs": 1700000003, "nsecs": 0})
        self.assertIn("sensor_msgs/Image", {r.get("type") for r in double.requests})

    def test_hostile_lines_are_refused_and_counted(self):
        bad = ["nonsense", "[]", "[" * 100_000, line(beams=[0.0] * 3), line(axis=[1e999]), line(beams=[]),
               line(objects=[[[1, 700, 700]]]), line(objects=[[[-1, 0, 1]]]), line(sound_speed=0),
               line(shot={"pan": 0}), '{"echoloop_truth": 2}', line(world_from_sonar={"position": [0], "orientation": []})]
        _, output = self.fed(bad + [line()])
        self.assertEqual(output.count("a line was refused"), 1, output)
        self.assertRegex(output, rf"pings +1\n.*\n.*\nrefused +{len(bad)} lines")

    def test_a_server_that_comes_later(self):
        port = free_port()
        helper = subprocess.Popen([program(HELPER), "--server", f"ws://127.0.0.1:{port}"], stdin=subprocess.PIPE,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(helper.communicate)
        self.addCleanup(helper.kill)
        self.assertIn("trying until a rosbridge server listens there", helper.stdout.readline())
        double = Double(self, port=port)
        self.assertIn("publishing to", helper.stdout.readline())
        helper.stdin.write(line() + "\n")
        helper.stdin.flush()
        self.published(double, "/echoloop/sonar/truth_points")
        double.close()
        self.assertIn("trying to connect again", helper.stdout.readline())

    def test_wrong_usage(self):
        for arguments, words in ((("--server", "wss://127.0.0.1"), "forward the port by ssh"), (("--ros", "3"), "--ros")):
            helper = Process(self, program(HELPER), *arguments)
            helper.wait_for(words)
            self.assertEqual(helper.process.wait(10), 64)


if __name__ == "__main__":
    unittest.main()
