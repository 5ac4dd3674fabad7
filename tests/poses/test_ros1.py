"""echoloop-pose-ros1 between Debian's ROS 1 (rosmaster, rospy) and the running emulator."""

import time
import unittest

import ros1_system as ros
from poses_programs import FLOOR_Z, PosesCase, Process, program
from ports import free_port
from ros1_system import Master


class Ros1(PosesCase):
    def helper(self, *arguments):
        return Process(self, program("echoloop-pose-ros1"), *arguments, env=Master.get().env)

    def test_every_type_of_pose(self):
        master = Master.get().start()
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        kinds = {"odom": ros.Odometry, "pose": ros.PoseStamped, "cov": ros.PoseWithCovarianceStamped,
                 "transform": ros.TransformStamped}
        for number, (topic, kind) in enumerate(kinds.items()):
            with self.subTest(topic):
                helper = self.helper("--topic", f"/{topic}", "--to", f"udp://127.0.0.1:{port}")
                helper.wait_for("Ctrl-C")
                self.assertIn(master.uri, helper.output)
                z = -5 - 2 * number
                out = ros.publisher(f"/{topic}", kind)
                depths.wait_for(z - FLOOR_Z, lambda: out.publish(ros.stamped(kind, time.time_ns(), (1, 2, z))))
                status, output = helper.stop()
                self.assertEqual(status, 0, output)
                self.assertRegex(output, rf"vehicle +[1-9]\d* poses from /{topic}\n$")

    def test_a_fix_of_a_satellite_receiver(self):
        Master.get().start()
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        helper = self.helper("--topic", "/fix", "--to", f"udp://127.0.0.1:{port}")
        out = ros.publisher("/fix", ros.NavSatFix)
        depths.wait_for(-7 - FLOOR_Z, lambda: out.publish(
            ros.stamped(ros.NavSatFix, time.time_ns(), (59.4001, 10.5001, -7))))
        self.assertEqual(helper.stop()[0], 0)

    def test_tf_through_a_chain_of_frames(self):
        Master.get().start()
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        helper = self.helper("--topic", "/tf#keel", "--world", "map", "--to", f"udp://127.0.0.1:{port}")
        fixed = ros.publisher("/tf_static", ros.TFMessage)
        moving = ros.publisher("/tf", ros.TFMessage)

        def publish():
            now = time.time_ns()
            moving.publish(ros.TFMessage([
                ros.stamped(ros.TransformStamped, now, (0, 0, -4), frame="map", child="odom"),
                ros.stamped(ros.TransformStamped, now, (0, 0, -3), (0, 1, 0, 0), frame="odom", child="base_link")]))

        # base_link is upside down, so the 2 m up to the keel are 2 m down; the keel is turned upright again.
        fixed.publish(ros.TFMessage([ros.stamped(ros.TransformStamped, 0, (0, 0, 2), (0, 1, 0, 0), frame="base_link",
                                                 child="keel")]))
        depths.wait_for(-4 - 3 - 2 - FLOOR_Z, publish)
        status, output = helper.stop()
        self.assertEqual(status, 0, output)
        self.assertNotIn("refused", output)

    def test_north_east_down(self):
        Master.get().start()
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        helper = self.helper("--topic", "/ned", "--frame", "ned", "--to", f"udp://127.0.0.1:{port}")
        out = ros.publisher("/ned", ros.PoseStamped)
        depths.wait_for(12, lambda: out.publish(ros.stamped(ros.PoseStamped, time.time_ns(), (0, 0, 8))))
        self.assertEqual(helper.stop()[0], 0)

    def test_what_cannot_be_is_refused_and_counted(self):
        Master.get().start()
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        helper = self.helper("--topic", "/bad", "--object", "ball=/clock", "--to", f"udp://127.0.0.1:{port}")
        out = ros.publisher("/bad", ros.PoseStamped)
        other = ros.publisher("/clock", ros.Clock)
        for position, orientation in (((0, 0, -4), (0, 0, 0, 0)), ((0, 0, float("nan")), (1, 0, 0, 0)),
                                      ((0, 0, 2e6), (1, 0, 0, 0)), ((0, 0, -4), (2, 0, 0, 0))):
            out.publish(ros.stamped(ros.PoseStamped, time.time_ns(), position, orientation))
        helper.wait_for("has not filled it in")
        depths.wait_for(14, lambda: out.publish(ros.stamped(ros.PoseStamped, time.time_ns(), (0, 0, -6))))
        other.publish(ros.Clock(ros.rospy.Time(5)))
        other.publish(ros.Clock(ros.rospy.Time(6)))
        out.publish(ros.stamped(ros.PoseStamped, time.time_ns(), (0, 0, -7)))
        depths.wait_for(13)
        status, output = helper.stop()
        self.assertEqual(status, 0)
        self.assertEqual(output.count("a message was refused"), 1, output)
        self.assertRegex(output, r"refused +6 messages \(the last: /clock: its type rosgraph_msgs/Clock tells no pose")

    def test_without_a_master_or_an_emulator_it_waits_and_says_so_once(self):
        port = free_port()
        alone = Process(self, program("echoloop-pose-ros1"), "--topic", "/odom",
                        env={**Master.get().env, "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}"})
        alone.wait_for("no ROS master at http://127.0.0.1:")
        Master.get().start()
        helper = self.helper("--topic", "/late", "--to", f"tcp://127.0.0.1:{port}")
        out = ros.publisher("/late", ros.PoseStamped)
        out.publish(ros.stamped(ros.PoseStamped, time.time_ns(), (0, 0, -6)))
        helper.wait_for("trying until an emulator listens there")
        _, depths = self.sounder(f"tcp-listen://127.0.0.1:{port}")
        depths.wait_for(14, lambda: out.publish(ros.stamped(ros.PoseStamped, time.time_ns(), (0, 0, -6))))
        status, output = helper.stop()
        self.assertEqual(status, 0)
        self.assertEqual(output.count("trying until"), 1, output)
        self.assertRegex(output, r"lost +[1-9]\d* poses that nobody took")
        status, output = alone.stop()
        self.assertEqual(status, 0)
        self.assertEqual(output.count("no ROS master"), 1, output)

    def test_a_command_line_that_is_wrong(self):
        cases = {(): "which topic?", ("--topic", "/a", "--to", "pty:/tmp/x"): "write udp:// or tcp://",
                 ("--topic", "#b"): "the topic is missing", ("--object", "ball"): "write it as in ball=/ball/pose",
                 ("--topic", "/a", "--frame", "up"): "--help", ("--topic", "/a", "--clock", "/c"): "give --step as well"}
        for arguments, words in cases.items():
            with self.subTest(arguments):
                helper = self.helper(*arguments)
                helper.wait_for(words)
                helper.process.wait(10)
                self.assertEqual(helper.process.returncode, 64)


if __name__ == "__main__":
    unittest.main()
