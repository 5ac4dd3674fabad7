"""echoloop-pose-rosbridge between a test double of a rosbridge server and the running emulator."""

import time
import unittest

from poses_programs import FLOOR_Z, PosesCase, Process, program
from ports import free_port
from rosbridge_double import Double, message


class Rosbridge(PosesCase):
    def helper(self, server, *arguments):
        return Process(self, program("echoloop-pose-rosbridge"), "--server", server, *arguments)

    def test_every_shape_of_both_generations(self):
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        topic = "/pose"
        double = Double(self, [topic])
        helper = self.helper(double.url, "--topic", topic, "--to", f"udp://127.0.0.1:{port}")
        double.wait_for_subscriber(topic)
        kinds = ("Odometry", "PoseStamped", "PoseWithCovarianceStamped", "TransformStamped", "Pose")
        for number, (kind, generation) in enumerate((k, g) for k in kinds for g in (1, 2)):
            with self.subTest(kind, generation=generation):
                z = -5 - number
                depths.wait_for(z - FLOOR_Z, lambda: double.publish(
                    topic, message(kind, time.time_ns(), (1, 2, z), generation=generation)))
        status, output = helper.stop()
        self.assertEqual(status, 0, output)
        self.assertRegex(output, r"vehicle +[1-9]\d* poses from /pose\n$")

    def test_a_fix_of_a_satellite_receiver(self):
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        double = Double(self, ["/fix"])
        helper = self.helper(double.url, "--topic", "/fix", "--to", f"udp://127.0.0.1:{port}")
        double.wait_for_subscriber("/fix")
        for altitude in (-6, -9):
            depths.wait_for(altitude - FLOOR_Z, lambda: double.publish(
                "/fix", message("NavSatFix", time.time_ns(), (59.4001, 10.5001, altitude))))
        status, output = helper.stop()
        self.assertEqual(status, 0, output)
        self.assertRegex(output, r"vehicle +[1-9]\d* poses from /fix\n$")

    def test_tf_through_a_chain_of_frames(self):
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        double = Double(self, ["/tf", "/tf_static"])
        helper = self.helper(double.url, "--topic", "/tf#keel", "--to", f"udp://127.0.0.1:{port}")
        double.wait_for_subscriber("/tf")
        double.wait_for_subscriber("/tf_static")
        double.publish("/tf", {"transforms": []})
        helper.wait_for("there is no transform from 'map' to 'keel' yet")
        # base_link is upside down, so the 2 m up to the keel are 2 m down; the keel is turned upright again.
        double.publish("/tf_static", {"transforms": [
            message("TransformStamped", 0, (0, 0, 2), (0, 1, 0, 0), frame="base_link", child="keel")]})

        def publish():
            now = time.time_ns()
            double.publish("/tf", {"transforms": [
                message("TransformStamped", now, (0, 0, -4), frame="map", child="odom"),
                message("TransformStamped", now, (0, 0, -3), (0, 1, 0, 0), frame="odom", child="base_link")]})

        depths.wait_for(-4 - 3 - 2 - FLOOR_Z, publish)
        status, output = helper.stop()
        self.assertEqual(status, 0, output)
        self.assertNotIn("refused", output)

    def test_a_topic_that_comes_later_and_one_whose_type_is_told(self):
        double = Double(self)
        helper = self.helper(double.url, "--topic", "/late", "--object", "ball=/ball", "--type",
                             "/ball=nav_msgs/msg/Odometry", "--to", "udp://127.0.0.1:9")
        double.wait_for_subscriber("/ball")
        asked = [request for request in double.requests if request["topic"] == "/ball"]
        self.assertEqual(asked[0]["type"], "nav_msgs/msg/Odometry")
        double.topics.add("/late")
        double.wait_for_subscriber("/late")
        self.assertEqual(helper.stop()[0], 0)

    def test_hostile_text_is_refused_and_counted(self):
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        topic = "/pose"
        double = Double(self, [topic])
        helper = self.helper(double.url, "--topic", topic, "--to", f"udp://127.0.0.1:{port}")
        double.wait_for_subscriber(topic)
        good = message("Pose", 0, (0, 0, -4))
        for text in ("nonsense", "[" * 100_000, "\u0000", '{"op": "status", "level": "error", "msg": "no \u20ac"}'):
            double.send(topic, text)
        for wrong in ({}, {**good, "position": {"x": 0, "y": 0, "z": None}}, {**good, "orientation": {"w": 0}},
                      {"pose": 3, "header": {}}, {"pose": good, "header": {"stamp": {"sec": 1}}},
                      {"transforms": {"a": 1}}, message("Pose", 0, (0, 0, 1e300))):
            double.publish(topic, wrong)
        double.publish("/elsewhere", good)
        depths.wait_for(12, lambda: double.publish(topic, message("PoseStamped", time.time_ns(), (0, 0, -8))))
        double.send(topic, '"' + "x" * (5 << 20) + '"')
        helper.wait_for("a message of more than 4 MiB was refused; trying to connect again")
        depths.wait_for(15, lambda: double.publish(topic, message("PoseStamped", time.time_ns(), (0, 0, -5))))
        status, output = helper.stop()
        self.assertEqual(status, 0)
        self.assertEqual(output.count("a message was refused"), 1, output)
        self.assertRegex(output, r"refused +11 messages \(the last: /pose: the position is more than 1000 km")

    def test_a_server_that_comes_goes_and_comes_back(self):
        port, server = free_port(), free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        helper = self.helper(f"ws://127.0.0.1:{server}", "--topic", "/pose", "--to", f"udp://127.0.0.1:{port}")
        helper.wait_for("trying until a rosbridge server listens there")
        for z in (-4, -9):
            double = Double(self, ["/pose"], server)
            double.wait_for_subscriber("/pose")
            depths.wait_for(z - FLOOR_Z, lambda: double.publish("/pose", message("PoseStamped", time.time_ns(), (0, 0, z))))
            double.close()
            helper.wait_for("trying to connect again")
        status, output = helper.stop()
        self.assertEqual(status, 0)
        self.assertEqual(output.count("trying until"), 1, output)

    def test_addresses_that_are_none(self):
        for url, words in {"wss://127.0.0.1:9090": "forward the port by ssh", "127.0.0.1": "ws://127.0.0.1:9090"}.items():
            with self.subTest(url):
                helper = self.helper(url, "--topic", "/a")
                helper.wait_for(words)
                self.assertEqual(helper.process.wait(10), 64)


if __name__ == "__main__":
    unittest.main()
