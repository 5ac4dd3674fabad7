"""A vehicle that circles in the tank, in stepped time: told by ROS 1, by rosbridge, by Gazebo's transport and by lines
of JSON, the same poses give the same bytes of every sonar."""

import hashlib
import socket
import threading
import unittest

import ros1_system as ros
from gz_system import ENV as GZ_ENV
from gz_system import Publisher
from poses_programs import PosesCase, Process, program
from ports import free_port
from ros1_system import Master
from rosbridge_double import Double, message
from stepper import Circle, Stepper

SECONDS, STEP = 6, 100  # s; ms between poses
START = 1_700_000_000_123_456_789  # ns, when a ROS system of today might start
SCENARIO = """
scene: {scenes}/tank.glb
seed: 7
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500, depth: 3}
vehicle: {input: "tcp-listen://127.0.0.1:%d"}
clock: {mode: stepped}
devices:
  - name: deltat
    model: imagenex-deltat
    mount: {rpy_deg: [0, 20, 0]}
    endpoints: ["udp://127.0.0.1:%d?local_port=%d"]
    options: {range: 10}
  - name: ahead
    model: nmea-echosounder
    endpoints: ["udp://127.0.0.1:%d"]
    options: {rate: 10, sentences: DBT}
"""


class Ear:
    """Everything that arrives at a port of loopback."""

    def __init__(self):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.port = self.socket.getsockname()[1]
        self.socket.settimeout(None)  # rospy sets a default
        self.bytes, self.datagrams = b"", 0
        self.thread = threading.Thread(target=self._listen)
        self.thread.start()

    def _listen(self):
        while data := self.socket.recv(65536):  # nothing ends it
            self.bytes += data
            self.datagrams += 1

    def end(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as s:
            s.sendto(b"", ("127.0.0.1", self.port))  # behind everything that the emulator sent
        self.thread.join(20)
        self.socket.close()
        return self.bytes


class CirclingVehicle(PosesCase):
    def bytes_of(self, tell, circle=Circle()):
        """What the sonars say while `tell(port, poses)` steps the emulator; poses are (ns, position, quaternion)."""
        port, ears = free_port(), [Ear(), Ear()]
        emulator = self.emulator(SCENARIO % (port, ears[0].port, free_port(), ears[1].port))
        poses = [(n * STEP * 10**6, *circle.at(n * STEP / 1000)) for n in range(SECONDS * 1000 // STEP + 1)]
        try:
            tell(port, poses)
            status, output = emulator.stop()
        finally:
            said = [ear.end() for ear in ears]
        self.assertEqual(status, 0, output)
        for ear, least in zip(ears, (SECONDS * 2, SECONDS * 5)):
            self.assertGreater(ear.datagrams, least, output)
        return [hashlib.sha256(part).hexdigest() for part in said]

    def by_json(self, port, poses):
        with Stepper(port) as stepper:
            for time, position, orientation in poses:
                stepper.step(time / 1e9, position=position, orientation=orientation)

    def by_ros1(self, port, poses):
        Master.get().start()
        helper = self.helper("ros1", port, "/odom", "--answer", "/answers", env=Master.get().env)
        out, answers = ros.publisher("/odom", ros.Odometry), ros.Answers("/answers")
        for time, position, orientation in poses:  # in lockstep
            out.publish(ros.stamped(ros.Odometry, START + time, position, orientation))
            self.assertEqual(answers.next(), START + time)
        self.ends(helper, poses)

    def by_ros1_tf(self, port, poses):
        Master.get().start()
        helper = self.helper("ros1", port, "/tf#base_link", "--answer", "/answers", env=Master.get().env)
        out, answers = ros.publisher("/tf", ros.TFMessage), ros.Answers("/answers")
        for time, position, orientation in poses:  # as fast as they come
            out.publish(ros.TFMessage([ros.stamped(ros.TransformStamped, START + time, position, orientation)]))
        self.assertEqual([answers.next() for _ in poses], [START + pose[0] for pose in poses])
        self.ends(helper, poses)

    def by_rosbridge(self, port, poses):
        double = Double(self, ["/pose"])
        helper = self.helper("rosbridge", port, "/pose", "--server", double.url, "--answer", "/answers")
        double.wait_for_subscriber("/pose")
        self.assertIn({"op": "advertise", "topic": "/answers", "type": "rosgraph_msgs/Clock"}, double.requests)
        for time, position, orientation in poses:
            double.publish("/pose", message("PoseStamped", START + time, position, orientation))
            self.assertEqual(double.next_answer("/answers"), START + time)
        self.ends(helper, poses)

    def by_gazebo(self, port, poses):
        topic = "/world/tank/dynamic_pose/info"
        helper = self.helper("gz", port, f"{topic}#rov", "--answer", "/answers", env=GZ_ENV)
        out = Publisher(self, topic, "gz.msgs.Pose_V", "tank", "rov")
        out.prove_connection(helper)
        for time, position, orientation in poses:  # a simulation begins at 0
            out.publish(time, position, orientation)
            self.assertEqual(out.next_answer(), time)
        self.ends(helper, poses)

    def helper(self, kind, port, topic, *arguments, env=()):
        helper = Process(self, program(f"echoloop-pose-{kind}"), "--topic", topic, "--step", "--to",
                         f"tcp://127.0.0.1:{port}", *arguments, env=env)
        helper.wait_for("Ctrl-C")
        return helper

    def ends(self, helper, poses):
        status, output = helper.stop()
        self.assertEqual(status, 0, output)
        self.assertRegex(output, rf"steps +{len(poses)} answered")

    def test_the_same_poses_give_the_same_bytes(self):
        expected = self.bytes_of(self.by_json)
        for tell in (self.by_json, self.by_ros1, self.by_ros1_tf, self.by_rosbridge, self.by_gazebo):
            with self.subTest(tell.__name__):
                self.assertEqual(self.bytes_of(tell), expected)
        other = self.bytes_of(self.by_json, Circle(radius=2.001))
        self.assertNotEqual(other[0], expected[0], "the bytes do not depend on the poses")


if __name__ == "__main__":
    unittest.main()
