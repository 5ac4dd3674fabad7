"""echoloop-pose-dds between CycloneDDS' own Python, which publishes as ROS 2 does, and the running emulator."""

import os
import sys
import time
import unittest
from dataclasses import dataclass

import public_driver

public_driver.use("dds", "cyclonedds")
sys.path.insert(0, str(public_driver.ROOT / "tests" / "poses"))

from cyclonedds.core import Policy, Qos  # noqa: E402
from cyclonedds.domain import DomainParticipant  # noqa: E402
from cyclonedds.idl import IdlStruct, types  # noqa: E402
from cyclonedds.pub import DataWriter, Publisher  # noqa: E402
from cyclonedds.sub import DataReader, Subscriber  # noqa: E402
from cyclonedds.topic import Topic  # noqa: E402
from cyclonedds.util import duration  # noqa: E402
from poses_programs import FLOOR_Z, PosesCase, Process, program  # noqa: E402
from ports import free_port  # noqa: E402

# This machine only, and no multicast, which a container may lack.
URI = ("<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='lo' multicast='false'/></Interfaces>"
       "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
       "<Peers><Peer Address='127.0.0.1'/></Peers></Discovery></Domain></CycloneDDS>")
DOMAIN = 100 + os.getpid() % 100
os.environ["CYCLONEDDS_URI"] = URI


@dataclass
class Time(IdlStruct, typename="builtin_interfaces::msg::dds_::Time_"):
    sec: types.int32
    nanosec: types.uint32


@dataclass
class Header(IdlStruct, typename="std_msgs::msg::dds_::Header_"):
    stamp: Time
    frame_id: str


@dataclass
class Vector3(IdlStruct, typename="geometry_msgs::msg::dds_::Vector3_"):
    x: types.float64
    y: types.float64
    z: types.float64


@dataclass
class Point(IdlStruct, typename="geometry_msgs::msg::dds_::Point_"):
    x: types.float64
    y: types.float64
    z: types.float64


@dataclass
class Quaternion(IdlStruct, typename="geometry_msgs::msg::dds_::Quaternion_"):
    x: types.float64
    y: types.float64
    z: types.float64
    w: types.float64


@dataclass
class Pose(IdlStruct, typename="geometry_msgs::msg::dds_::Pose_"):
    position: Point
    orientation: Quaternion


@dataclass
class PoseWithCovariance(IdlStruct, typename="geometry_msgs::msg::dds_::PoseWithCovariance_"):
    pose: Pose
    covariance: types.array[types.float64, 36]


@dataclass
class Twist(IdlStruct, typename="geometry_msgs::msg::dds_::Twist_"):
    linear: Vector3
    angular: Vector3


@dataclass
class TwistWithCovariance(IdlStruct, typename="geometry_msgs::msg::dds_::TwistWithCovariance_"):
    twist: Twist
    covariance: types.array[types.float64, 36]


@dataclass
class Transform(IdlStruct, typename="geometry_msgs::msg::dds_::Transform_"):
    translation: Vector3
    rotation: Quaternion


@dataclass
class TransformStamped(IdlStruct, typename="geometry_msgs::msg::dds_::TransformStamped_"):
    header: Header
    child_frame_id: str
    transform: Transform


@dataclass
class PoseStamped(IdlStruct, typename="geometry_msgs::msg::dds_::PoseStamped_"):
    header: Header
    pose: Pose


@dataclass
class Odometry(IdlStruct, typename="nav_msgs::msg::dds_::Odometry_"):
    header: Header
    child_frame_id: str
    pose: PoseWithCovariance
    twist: TwistWithCovariance


@dataclass
class TFMessage(IdlStruct, typename="tf2_msgs::msg::dds_::TFMessage_"):
    transforms: types.sequence[TransformStamped]


@dataclass
class Clock(IdlStruct, typename="rosgraph_msgs::msg::dds_::Clock_"):
    clock: Time


@dataclass
class String(IdlStruct, typename="std_msgs::msg::dds_::String_"):
    data: str


RELIABLE = Qos(Policy.Reliability.Reliable(duration(milliseconds=100)), Policy.History.KeepLast(10))
FIXED = Qos(Policy.Reliability.Reliable(duration(milliseconds=100)), Policy.Durability.TransientLocal,
            Policy.History.KeepLast(1))


def stamp(nanoseconds):
    return Time(*divmod(nanoseconds, 10**9))


def pose(z, orientation=(0, 0, 0, 1)):
    return Pose(Point(1.0, 2.0, float(z)), Quaternion(*map(float, orientation)))


def odometry(z, when=None):
    return Odometry(Header(stamp(when or time.time_ns()), "odom"), "base_link", PoseWithCovariance(pose(z), [0.0] * 36),
                    TwistWithCovariance(Twist(Vector3(0.0, 0.0, 0.0), Vector3(0.0, 0.0, 0.0)), [0.0] * 36))


def edge(parent, child, z, rotation=(0, 0, 0, 1), when=None):
    return TransformStamped(Header(stamp(time.time_ns() if when is None else when), parent), child,
                            Transform(Vector3(0.0, 0.0, float(z)), Quaternion(*map(float, rotation))))


class Dds(PosesCase):
    def setUp(self):
        self.participant = DomainParticipant(DOMAIN)

    def writer(self, topic, kind, qos=RELIABLE):
        return DataWriter(Publisher(self.participant), Topic(self.participant, "rt" + topic, kind), qos=qos)

    def helper(self, *arguments):
        return Process(self, program("echoloop-pose-dds"), *arguments, env={"ROS_DOMAIN_ID": str(DOMAIN)})

    def test_odometry_and_poses_whose_type_is_found_out(self):
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        helper = self.helper("--topic", "/odom", "--object", "ball=/ball", "--to", f"udp://127.0.0.1:{port}")
        helper.wait_for(f"/odom, /ball from DDS domain {DOMAIN}")
        out = self.writer("/odom", Odometry)
        for z in (-5, -9):
            depths.wait_for(z - FLOOR_Z, lambda: out.write(odometry(z)))
        ball, later = self.writer("/ball", PoseStamped), time.monotonic() + 5
        while time.monotonic() < later and not ball.get_matched_subscriptions():
            time.sleep(0.05)
        ball.write(PoseStamped(Header(stamp(0), "map"), pose(3)))
        depths.wait_for(14, lambda: out.write(odometry(-6)))
        status, output = helper.stop()
        self.assertEqual(status, 0, output)
        self.assertRegex(output, r"vehicle +[1-9]\d* poses from /odom\n")
        self.assertRegex(output, r"ball +1 poses from /ball\n")

    def test_tf_through_a_chain_whose_fixed_part_was_published_before(self):
        port = free_port()
        _, depths = self.sounder(f"udp-listen://127.0.0.1:{port}")
        fixed = self.writer("/tf_static", TFMessage, FIXED)
        fixed.write(TFMessage([edge("base_link", "keel", 2, (1, 0, 0, 0), 0)]))
        helper = self.helper("--topic", "/tf#keel", "--to", f"udp://127.0.0.1:{port}")
        helper.wait_for("Ctrl-C")
        moving = self.writer("/tf", TFMessage)
        # base_link is upside down, so the 2 m up to the keel are 2 m down; the keel is turned upright again.
        depths.wait_for(-4 - 3 - 2 - FLOOR_Z, lambda: moving.write(TFMessage([
            edge("map", "odom", -4), edge("odom", "base_link", -3, (1, 0, 0, 0))])))
        status, output = helper.stop()
        self.assertEqual(status, 0, output)
        self.assertNotIn("refused", output)

    def test_steps_and_their_answers(self):
        port = free_port()
        scenario = """
scene: {scenes}/flat.glb
clock: {mode: stepped}
vehicle: {input: "tcp-listen://127.0.0.1:%d"}
devices: [{name: sounder, model: nmea-echosounder, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["udp://127.0.0.1:9"]}]
""" % port
        self.emulator(scenario)
        answers = DataReader(Subscriber(self.participant), Topic(self.participant, "rt/answers", Clock), qos=RELIABLE)
        helper = self.helper("--topic", "/odom", "--type", "/odom=nav_msgs/msg/Odometry", "--step", "--answer", "/answers",
                             "--to", f"tcp://127.0.0.1:{port}")
        helper.wait_for("stepping")
        out = self.writer("/odom", Odometry)
        later = time.monotonic() + 10
        while time.monotonic() < later and not out.get_matched_subscriptions():
            time.sleep(0.05)
        for second in (10, 11):
            out.write(odometry(-5, second * 10**9))
        got = []
        while time.monotonic() < later and len(got) < 2:
            got += [sample.clock.sec for sample in answers.take(10)]
            time.sleep(0.02)
        self.assertEqual(got, [10, 11])
        self.assertRegex(helper.stop()[1], r"steps +2")

    def test_what_cannot_be_is_refused(self):
        helper = self.helper("--topic", "/words", "--to", "udp://127.0.0.1:9")
        helper.wait_for("Ctrl-C")
        words = self.writer("/words", String)
        helper.wait_for("its type std_msgs::msg::dds_::String_ tells no pose", publish=lambda: words.write(String("a")))
        helper.stop()
        bad = self.helper("--topic", "/odom", "--type", "/odom=std_msgs/msg/String")
        bad.wait_for("is no type that tells poses; known are Odometry")
        self.assertEqual(bad.process.wait(10), 64)
        out = self.writer("/odom", Odometry)
        helper = self.helper("--topic", "/odom", "--to", "udp://127.0.0.1:9")
        helper.wait_for("Ctrl-C")
        wrong = odometry(1e300)
        helper.wait_for("the position is more than 1000 km", publish=lambda: out.write(wrong))


if __name__ == "__main__":
    unittest.main()
