"""echoloop-pose-gz between Debian's ignition-transport and the running emulator."""

import json
import os
import socket
import subprocess
import time
import unittest
from pathlib import Path

from gz_system import ENV, Publisher
from poses_programs import FLOOR_Z, PosesCase, Process, need, program
from ports import free_port

TOPIC_TOOL = "/usr/libexec/ignition/transport11/ign-transport-topic"


class Gazebo(PosesCase):
    def helper(self, *arguments):
        helper = Process(self, program("echoloop-pose-gz"), *arguments, env=ENV)
        helper.wait_for("Ctrl-C")
        return helper

    def test_both_generations_of_names(self):
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        helper = self.helper("--topic", "/model/rov/pose", "--to", f"udp://127.0.0.1:{port}")
        self.assertIn(ENV["IGN_PARTITION"], helper.output)
        kinds = [generation + kind for generation in ("ignition.msgs.", "gz.msgs.") for kind in ("Pose", "Odometry")]
        for number, kind in enumerate(kinds):
            with self.subTest(kind):
                z = -5 - 2 * number
                out = Publisher(self, "/model/rov/pose", kind)
                depths.wait_for(z - FLOOR_Z, lambda: out.publish(time.time_ns(), (1, 2, z)))
                out.stop()
        status, output = helper.stop()
        self.assertEqual(status, 0, output)
        self.assertRegex(output, r"vehicle +[1-9]\d* poses from /model/rov/pose\n$")

    def test_a_fix_of_a_satellite_receiver(self):
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        helper = self.helper("--topic", "/navsat", "--to", f"udp://127.0.0.1:{port}")
        out = Publisher(self, "/navsat", "gz.msgs.NavSat")
        depths.wait_for(-7 - FLOOR_Z, lambda: out.publish(time.time_ns(), (59.4001, 10.5001, -7)))
        self.assertEqual(helper.stop()[0], 0)

    def test_one_of_many_poses(self):
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        topic = "/world/sea/dynamic_pose/info"
        helper = self.helper("--topic", f"{topic}#rov", "--to", f"udp://127.0.0.1:{port}")
        nameless = self.helper("--topic", topic, "--to", f"udp://127.0.0.1:{port}")
        out = Publisher(self, topic, "gz.msgs.Pose_V", "sun", "ground", "rov")
        depths.wait_for(8, lambda: out.publish(time.time_ns(), (0, 0, -12)))
        other = Publisher(self, topic, "gz.msgs.Pose_V", "sun")
        helper.wait_for("nothing in it is called 'rov', but: sun", publish=lambda: other.publish(1, (0, 0, 0)))
        status, output = helper.stop()
        self.assertEqual(status, 0, output)
        self.assertRegex(nameless.stop()[1], r"several poses; name one of them as in \S+#NAME: sun, ground, rov")

    def test_vehicle_and_objects_of_one_message(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as emulator:
            emulator.bind(("127.0.0.1", 0))
            emulator.settimeout(30)
            helper = self.helper("--topic", "/poses#rov", "--object", "the ball=/poses#ball", "--to",
                                 f"udp://127.0.0.1:{emulator.getsockname()[1]}")
            out = Publisher(self, "/poses", "gz.msgs.Pose_V", "ball", "rov")
            out.prove_connection(helper)
            out.publish(1_500_000_000, (1, 2, 3), (0, 0, 1, 0))
            lines = [json.loads(emulator.recv(4096)) for _ in range(2)]
        self.assertEqual(lines[0], {"t": 1.5, "position": [1, 2, 3], "orientation": [0, 0, 1, 0]})
        self.assertEqual(lines[1], {"t": 1.5, "object": "the ball", "position": [1, 2, 100],
                                    "orientation": [0, 0, 1, 0]})
        self.assertRegex(helper.stop()[1], r"vehicle +1 poses from /poses\nthe ball +1 poses from /poses\n")

    def test_what_cannot_be_is_refused_and_counted(self):
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        helper = self.helper("--topic", "/pose", "--to", f"udp://127.0.0.1:{port}")
        clock = Publisher(self, "/pose", "gz.msgs.Clock")
        helper.wait_for("its type gz.msgs.Clock tells no pose", publish=lambda: clock.publish(1, (0, 0, 0)))
        out = Publisher(self, "/pose", "ignition.msgs.Pose")
        depths.wait_for(14, lambda: out.publish(time.time_ns(), (0, 0, -6)))
        out.publish(1, (0, 0, 2e6))
        out.publish(1, (0, 0, -4), (0, 0, 0, 0))
        depths.wait_for(13, lambda: out.publish(time.time_ns(), (0, 0, -7)))
        status, output = helper.stop()
        self.assertEqual(status, 0)
        self.assertEqual(output.count("a message was refused"), 1, output)
        self.assertRegex(output, r"refused +([3-9]|\d\d+) messages \(the last: /pose: the orientation is all zero")

    def test_poses_of_debians_own_tool(self):
        need(Path(TOPIC_TOOL).exists(), "ign-transport-topic is missing (tools/install test)")
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        helper = self.helper("--topic", "/tool", "--to", f"udp://127.0.0.1:{port}")

        def publish():
            subprocess.run([TOPIC_TOOL, "-t", "/tool", "-m", "ignition.msgs.Pose", "-p", "position: {z: -9}"],
                           env={**os.environ, **ENV}, check=True, timeout=30)

        # It waits a tenth of a second only for a subscriber to be found: on a busy machine it takes some tries.
        depths.wait_for(11, publish, 150)
        self.assertEqual(helper.stop()[0], 0)

    def test_a_name_that_is_no_topic(self):
        helper = Process(self, program("echoloop-pose-gz"), "--topic", "a topic~", env=ENV)
        helper.wait_for("is no name of a topic; write it as in")
        self.assertEqual(helper.process.wait(10), 64)


if __name__ == "__main__":
    unittest.main()
