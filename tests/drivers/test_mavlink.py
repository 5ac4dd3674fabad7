"""pymavlink tells the emulator where the vehicle is, in every message that can, over UDP and TCP, versions 1 and 2."""

import math
import os
import shutil
import socket
import sys
import tempfile
import time
import tty
import unittest
from pathlib import Path

from public_driver import ROOT, use

use("mavlink", "pymavlink")
os.environ["MAVLINK20"] = "1"
from pymavlink.dialects.v10 import ardupilotmega as v1  # noqa: E402
from pymavlink.dialects.v20 import ardupilotmega as v2  # noqa: E402

sys.path.insert(0, str(ROOT / "tests" / "e2e"))
from ports import free_port  # noqa: E402
from test_pose import FLOOR_Z, Depths, PoseCase  # noqa: E402

HOME = (43.1, 5.9)  # deg


class Pilot:
    """Packs messages and sends them, one or several at a time."""

    def __init__(self, port, dialect=v2, tcp=False):
        self.dialect = dialect
        self.mavlink = dialect.MAVLink(None, srcSystem=7)
        kind = socket.SOCK_STREAM if tcp else socket.SOCK_DGRAM
        self.socket = socket.socket(socket.AF_INET, kind)
        self.socket.connect(("127.0.0.1", port))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def bytes_of(self, name, *values):
        message = getattr(self.dialect, f"MAVLink_{name}_message")(*values)
        return message.pack(self.mavlink)

    def say(self, name, *values):
        self.socket.sendall(self.bytes_of(name, *values))


class Mavlink(PoseCase):
    def depths_at(self, port, tcp=False):
        depths = Depths(self)
        scheme = "tcp-listen" if tcp else "udp-listen"
        self.emulator = self.start("{input: '%s://127.0.0.1:%d'}" % (scheme, port), depths)
        return depths

    def test_local_position_and_attitude_in_both_versions(self):
        for dialect in (v1, v2):
            port = free_port(8)
            depths = self.depths_at(port)
            with Pilot(port, dialect) as pilot:
                pilot.say("attitude", 1000, 0, 0, 0.5, 0, 0, 0)
                pilot.say("local_position_ned", 1001, 3, 4, 9, 0, 0, 0)
                depths.wait_for(-9 - FLOOR_Z)
                pilot.say("attitude_quaternion", 3000, math.cos(0.25), 0, 0, math.sin(0.25), 0, 0, 0)
                pilot.say("local_position_ned", 3001, 3, 4, 13, 0, 0, 0)
                depths.wait_for(-13 - FLOOR_Z)
            self.assertRegex(self.emulator.stop()[1], r"vehicle +4 poses from \S+, 0 refused, 0 jumps")

    def test_roll_tilts_the_beam(self):
        port = free_port(8)
        depths = self.depths_at(port)
        with Pilot(port) as pilot:
            pilot.say("local_position_ned", 1000, 0, 0, 9, 0, 0, 0)
            pilot.say("attitude", 1001, math.radians(30), 0, 0, 0, 0, 0)
            end = time.monotonic() + 20
            while depths.next() < 11.4:  # 11 m / cos 30 deg, less half the beam
                self.assertLess(time.monotonic(), end)

    def test_an_autopilot_on_a_serial_line(self):
        folder = Path(tempfile.mkdtemp(prefix="echoloop-mavlink-"))
        self.addCleanup(shutil.rmtree, folder)
        depths = Depths(self)
        self.start("{input: 'pty:%s/autopilot'}" % folder, depths)
        line = os.open(folder / "autopilot", os.O_RDWR | os.O_NOCTTY)
        self.addCleanup(os.close, line)
        tty.setraw(line)
        mavlink = v2.MAVLink(None, srcSystem=1)
        for z in (6, 11):
            os.write(line, v2.MAVLink_local_position_ned_message(1000 * z, 0, 0, z, 0, 0, 0).pack(mavlink))
            depths.wait_for(-z - FLOOR_Z)

    def test_places_on_the_globe(self):
        port = free_port()
        depths = self.depths_at(port, tcp=True)
        with Pilot(port, tcp=True) as pilot:
            lat, lon = (round(angle * 1e7) for angle in HOME)
            pilot.say("attitude", 1000, 0, 0, 0, 0, 0, 0)
            pilot.say("global_position_int", 1001, lat, lon, -8000, -8000, 0, 0, 0, 65535)
            depths.wait_for(12)
            pilot.say("global_position_int", 3001, lat + 100, lon, -15000, -15000, 0, 0, 0, 65535)
            depths.wait_for(5)

    def test_odometry_and_sim_state_stand_for_themselves(self):
        port = free_port(8)
        depths = self.depths_at(port)
        q = [1, 0, 0, 0]
        with Pilot(port) as pilot:
            pilot.say("sim_state", *q, 0, 0, 0, 0, 0, 0, 0, 0, 0, *HOME, -6, 0, 0, 0, 0, 0)
            depths.wait_for(14)
            time_usec = 1_700_000_000_000_000
            pilot.say("odometry", time_usec, v2.MAV_FRAME_LOCAL_NED, v2.MAV_FRAME_BODY_FRD, 0, 0, 12, q, *[0] * 6,
                      [0] * 21, [0] * 21)
            depths.wait_for(8)
            for _ in range(5):  # on a busy machine 6 m took 0.3 s or more, which is motion and goes on for a moment
                depths.next()
            # What is less exact counts no more.
            pilot.say("local_position_ned", 5000, 0, 0, 2, 0, 0, 0)
            for _ in range(8):
                self.assertLess(abs(depths.next() - 8), 0.2)

    def test_noise_other_messages_and_other_systems_do_no_harm(self):
        port = free_port()
        depths = self.depths_at(port, tcp=True)
        with Pilot(port, tcp=True) as pilot, Pilot(port, tcp=False) as other:
            other.mavlink = v2.MAVLink(None, srcSystem=42)
            stream = pilot.bytes_of("heartbeat", 12, 3, 0, 0, 4, 3)
            stream += pilot.bytes_of("attitude", 1000, 0, 0, 0, 0, 0, 0) + b"\xfe\xfd noise \x00"
            damaged = bytearray(pilot.bytes_of("local_position_ned", 1001, 0, 0, 2, 0, 0, 0))
            damaged[12] ^= 0x55
            stream += bytes(damaged) + pilot.bytes_of("local_position_ned", 1001, 0, 0, 10, 0, 0, 0)
            stream += other.bytes_of("local_position_ned", 1002, 0, 0, 3, 0, 0, 0)
            stream += pilot.bytes_of("statustext", 6, b"all well")
            for i in range(0, len(stream), 11):
                pilot.socket.sendall(stream[i:i + 11])
            depths.wait_for(10)
            for _ in range(8):
                self.assertLess(abs(depths.next() - 10), 0.2)
        output = self.emulator.stop()[1]
        self.assertRegex(output, r"vehicle +2 poses from \S+, [2-9] refused")
        self.assertIn("damaged MAVLink, or bytes that are none", output)


if __name__ == "__main__":
    unittest.main()
