"""A ROS 1 system of Debian's own parts: rosmaster on a free port, and publishers through rospy in this process."""

import atexit
import os
import queue
import tempfile
import time
import xmlrpc.client

from poses_programs import Process, need
from ports import free_port

try:
    import rospy
    from geometry_msgs.msg import (Point, Pose, PoseStamped, PoseWithCovarianceStamped, Quaternion, Transform,
                                   TransformStamped, Vector3)
    from nav_msgs.msg import Odometry
    from rosgraph_msgs.msg import Clock
    from sensor_msgs.msg import NavSatFix
    from tf2_msgs.msg import TFMessage
except ImportError as error:
    rospy = None
    missing = str(error)


class Master:
    """Debian's rosmaster. One for a process, since rospy knows one only."""

    _one = None

    @classmethod
    def get(cls):
        need(rospy, "" if rospy else f"rospy is missing: {missing} (tools/install test)")
        if cls._one is None:
            cls._one = cls()
        return cls._one

    def __init__(self):
        self.folder = tempfile.mkdtemp(prefix="echoloop-ros-")
        self.uri = f"http://127.0.0.1:{free_port()}"
        self.env = {"ROS_MASTER_URI": self.uri, "ROS_HOSTNAME": "127.0.0.1", "ROS_LOG_DIR": self.folder,
                    "ROS_HOME": self.folder}
        os.environ.update(self.env)
        self.process = None

    def start(self):
        """Starts the master and this process's node."""
        if self.process:
            return self

        class Keeper:  # the master outlives a single test
            addCleanup = staticmethod(lambda *call: atexit.register(*call))

        port = self.uri.rsplit(":", 1)[1]
        self.process = Process(Keeper, "/usr/bin/rosmaster", "--core", "-p", port)
        end = time.monotonic() + 30
        while True:
            try:
                with xmlrpc.client.ServerProxy(self.uri) as proxy:
                    proxy.getPid("/test")
                break
            except OSError:
                if time.monotonic() > end or self.process.process.poll() is not None:
                    raise
                time.sleep(0.02)
        rospy.init_node("publisher", anonymous=True, disable_signals=True, disable_rosout=True)
        return self


def pose(position, orientation=(1, 0, 0, 0)):
    w, x, y, z = orientation
    return Pose(Point(*position), Quaternion(x, y, z, w))


def stamped(kind, stamp, position, orientation=(1, 0, 0, 0), frame="map", child="base_link"):
    """A message of one of the types that tell poses; `stamp` in nanoseconds."""
    w, x, y, z = orientation
    message = kind()
    message.header.frame_id = frame
    message.header.stamp = rospy.Time(*divmod(stamp, 10**9))
    if kind is TransformStamped:
        message.transform = Transform(Vector3(*position), Quaternion(x, y, z, w))
        message.child_frame_id = child
    elif kind is NavSatFix:
        message.latitude, message.longitude, message.altitude = position
    elif kind is PoseStamped:
        message.pose = pose(position, orientation)
    else:
        message.pose.pose = pose(position, orientation)
    if kind is Odometry:
        message.child_frame_id = child
    return message


class Answers:
    """The times that the pose program publishes as the emulator gets to them; it must be running already."""

    def __init__(self, topic):
        self.times = queue.Queue()
        subscriber = rospy.Subscriber(topic, Clock, lambda m: self.times.put(m.clock.secs * 10**9 + m.clock.nsecs))
        end = time.monotonic() + 30
        while subscriber.get_num_connections() < 1:
            if time.monotonic() > end:
                raise AssertionError(f"nobody publishes {topic}")
            time.sleep(0.01)

    def next(self):
        return self.times.get(timeout=60)


def publisher(topic, kind, subscribers=1):
    """A publisher that the pose program has already subscribed to."""
    made = rospy.Publisher(topic, kind, queue_size=1000, latch=False)
    end = time.monotonic() + 30
    while made.get_num_connections() < subscribers:
        if time.monotonic() > end:
            raise AssertionError(f"nobody subscribes to {topic}")
        time.sleep(0.01)
    return made
