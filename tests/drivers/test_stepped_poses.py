"""A vehicle that circles in the tank, in lockstep: the same poses in JSON and as pymavlink packs them give the same
bytes."""

import hashlib
import json
import math
import os
import sys
import unittest

from public_driver import ROOT, use

use("mavlink", "pymavlink")
os.environ["MAVLINK20"] = "1"
from pymavlink.dialects.v20 import ardupilotmega as v2  # noqa: E402

sys.path.insert(0, str(ROOT / "tests" / "e2e"))
from ports import free_port  # noqa: E402
from program import Emulator  # noqa: E402
from stepper import Circle, Stepper, single  # noqa: E402
from test_mavlink import Pilot  # noqa: E402
from test_stepped import MULTIBEAM, SCENARIO, SOUNDER, Datagrams  # noqa: E402

INTERVAL, STEPS = 0.1, 21
EPOCH = 7_000_000_000  # us: an autopilot's clock begins when it likes


def json_in_the_step(circle, simulator, pilot, t):
    simulator.step(t, **circle.pose(t))


def json_beside_the_step(circle, simulator, pilot, t):
    pilot.socket.send(json.dumps({"t": t, **circle.pose(t)}).encode())
    simulator.step(t)


def odometry(circle, simulator, pilot, t):
    """In the frames that are east, north, up and forward, left, up."""
    position, orientation = circle.at(t)
    pilot.say("odometry", EPOCH + int(1e6 * t), v2.MAV_FRAME_LOCAL_ENU, v2.MAV_FRAME_LOCAL_FLU, *position, orientation,
              0, 0, 0, 0, 0, 0, [math.nan] * 21, [math.nan] * 21)
    simulator.step(t)


def north_east_down(circle, t):
    (east, north, up), _ = circle.at(t)
    yaw = -2 * math.pi * t / circle.seconds  # clockwise from north
    return [north, east, -up], [single(math.cos(yaw / 2)), 0.0, 0.0, single(math.sin(yaw / 2))]


def ardupilot_json(circle, simulator, pilot, t):
    position, quaternion = north_east_down(circle, t)
    simulator.step(t, timestamp=1e3 + t, position=position, quaternion=quaternion)


def local_position(circle, simulator, pilot, t):
    """Two messages, each of which tells a half."""
    position, quaternion = north_east_down(circle, t)
    milliseconds = EPOCH // 1000 + round(1000 * t)
    pilot.say("attitude_quaternion", milliseconds, *quaternion, 0, 0, 0)
    pilot.say("local_position_ned", milliseconds + 3, *position, 0, 0, 0)
    simulator.step(t)


class SamePoses(unittest.TestCase):
    def bytes_of(self, say):
        circle = Circle(radius=1.5, depth=2, seconds=10)
        sounder, multibeam = Datagrams(self.addCleanup), Datagrams(self.addCleanup, 8)
        steps, head = free_port(), free_port(16)
        poses = head + 15
        devices = [SOUNDER % sounder.port, MULTIBEAM % (head, multibeam.port, head + 12)]
        text = SCENARIO % {"devices": ", ".join(devices), "clock": ", input: 'tcp-listen://127.0.0.1:%d'" % steps,
                           "vehicle": ", input: 'udp-listen://127.0.0.1:%d'" % poses}
        with Emulator(text) as emulator:
            with Stepper(steps) as simulator, Pilot(poses) as pilot:
                for n in range(STEPS):
                    say(circle, simulator, pilot, n * INTERVAL)
                    sounder.take()
                    multibeam.take()
            self.assertRegex(emulator.stop()[1], r"vehicle +%d poses? from" % (STEPS * (1 + (say is local_position))))
        self.assertGreater(len(multibeam.heard), 10)
        return hashlib.sha256(b"".join(sounder.heard + multibeam.heard)).hexdigest()

    def test_east_north_up(self):
        self.assertEqual(len({self.bytes_of(say) for say in (json_in_the_step, json_beside_the_step, odometry)}), 1)

    def test_north_east_down(self):
        self.assertEqual(len({self.bytes_of(say) for say in (ardupilot_json, local_position)}), 1)

    def test_another_circle_gives_other_bytes(self):
        def wider(circle, simulator, pilot, t):
            json_in_the_step(Circle(radius=1.6, depth=2, seconds=10), simulator, pilot, t)

        self.assertNotEqual(self.bytes_of(wider), self.bytes_of(json_in_the_step))


if __name__ == "__main__":
    unittest.main()
