"""An Imagenex 831L in a sewer of known width, end to end: TCP, a host written apart from the C++ that reads once a reply, as a
public driver does, and its .31l file."""

import math
import socket
import statistics
import struct
import subprocess
import unittest
from pathlib import Path
from tempfile import TemporaryDirectory

from ports import free_port
from program import PROGRAM, ROOT, Emulator

import imagenex_wire as wire

RADIUS, DEPOSIT = 0.3, 0.22  # m, of config/scenes/pipe.glb: of the wall, of the deposit below the axis
RIGHT, UP = -0.03, -0.02  # m, the head from the axis, seen along the pipe: config/imagenex-831l.yaml
CONNECTION, HALF = 60, 14  # deg clockwise from up, as the head sees it, and half of what it covers and blurs


class Host:
    """One command, one read: a reply in pieces is none."""

    def __init__(self, port):
        self.line = socket.create_connection(("127.0.0.1", port), timeout=10)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.line.close()

    def ask(self, **settings):
        self.line.sendall(wire.pipe_command(**settings))
        return wire.parse_pipe(self.line.recv(4096))

    def turn(self, **settings):
        return [self.ask(**settings) for _ in range(400)]


def wall(degrees):
    """m from the head, `degrees` clockwise from up."""
    x, y = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    along = -(RIGHT * x + UP * y)
    return along + math.sqrt(along**2 + RADIUS**2 - RIGHT**2 - UP**2)


def deposit(degrees):
    """m to the plane of the deposit; infinite where it does not meet it."""
    down = -math.cos(math.radians(degrees))
    return (DEPOSIT + UP) / down if down > 0 else math.inf


def sees_only_the_wall(degrees):
    return abs(degrees - CONNECTION) > HALF and deposit(degrees) > wall(degrees) + 0.04


class Pipe(unittest.TestCase):
    def emulator(self, *changes, record=None):
        text = (ROOT / "config" / "imagenex-831l.yaml").read_text().replace("scenes/", "{scenes}/")
        self.port = free_port()
        words = [word for change in changes for word in ("--set", change)]
        words += ["--record", str(record)] if record else []
        return Emulator(text, "--set", f"devices.profiler.endpoints=[tcp-listen://127.0.0.1:{self.port}]", *words)

    def test_the_profile_is_the_wall_the_deposit_and_the_connection(self):
        with self.emulator(), Host(self.port) as host:
            turn = host.turn()
        self.assertEqual({reply.status for reply in turn}, {0x80})
        self.assertEqual(len({round(reply.degrees, 1) for reply in turn}), 400)
        of_wall = [r.profile - wall(r.degrees) for r in turn if r.profile and sees_only_the_wall(r.degrees)]
        self.assertGreater(len(of_wall), 190)
        self.assertLess(abs(statistics.median(of_wall)), 0.0005, "the wall at its radius")
        self.assertLess(sorted(map(abs, of_wall))[int(0.9 * len(of_wall))], 0.0015)
        below = [r.profile - deposit(r.degrees) for r in turn if r.profile and abs(r.degrees) > 160]
        self.assertGreater(len(below), 35)
        self.assertLess(abs(statistics.median(below)), 0.001, "the deposit")
        near = [r.profile - wall(r.degrees) for r in turn if r.profile and abs(r.degrees - CONNECTION) < 4]
        self.assertLess(statistics.median(near), -0.06, "the connection, on the starboard side")
        port = [r.profile - wall(r.degrees) for r in turn if r.profile and abs(r.degrees + CONNECTION) < 4]
        self.assertLess(abs(statistics.median(port)), 0.001, "and not to port")

    def test_a_long_pulse_has_the_wall_where_it_is(self):
        with self.emulator(), Host(self.port) as host:
            for settings in ({"pulse": 40}, {"pulse": 40, "motion": 1}):
                found = [r.profile - wall(r.degrees) for r in host.turn(**settings)
                         if r.profile and sees_only_the_wall(r.degrees)]  # fmt: skip
                self.assertLess(abs(statistics.median(found)), 0.0012, settings)

    def test_echo_data_have_the_echo_where_the_profile_is(self):
        with self.emulator(), Host(self.port) as host:
            replies = [host.ask(range=6) for _ in range(40)]
        for reply in replies:
            self.assertEqual((reply.range, len(reply.data)), (0.5, 250))
            point = int(reply.profile / 0.002)
            self.assertGreater(max(reply.data[point - 1 : point + 5]), 60)
            self.assertLess(max(reply.data[40 : point - 4]), 60)

    def test_roll_and_pitch_are_the_vehicle_s(self):
        with self.emulator("vehicle.pose.rpy_deg=[11, -4, 0]", "effects.sensor_noise=off"), Host(self.port) as host:
            reply = host.ask()
        self.assertTrue(reply.is_new)
        self.assertAlmostEqual(reply.pitch, 4, delta=0.03, msg="bow up")
        self.assertAlmostEqual(reply.roll_g, math.sin(math.radians(11)) * math.cos(math.radians(4)), delta=0.0005)
        self.assertAlmostEqual(reply.roll, math.degrees(math.asin(reply.roll_g)), delta=0.03)

    def convert(self, capture, out, status=0):
        done = subprocess.run([PROGRAM, "convert", str(capture), str(out)], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def test_a_31l_file_of_a_recorded_run(self):
        with TemporaryDirectory() as name:
            capture, out = Path(name) / "run.pcapng", Path(name) / "sewer.31l"
            with self.emulator(record=capture) as emulator:
                with Host(self.port) as host:
                    replies = [host.ask(gain=gain) for gain in (6, 7, 8)]
                    host.ask(profile=1)
                emulator.stop()
            done = self.convert(capture, out)
            self.assertEqual(done.stdout, "3 shots\n")
            self.assertIn("1 message without echo data", done.stderr)
            data = out.read_bytes()
            self.assertEqual(len(data), 3 * 512)
            shots = [data[at : at + 512] for at in range(0, len(data), 512)]
            self.assertEqual([wire.parse_pipe(shot[228:511]) for shot in shots], replies)
            self.assertEqual([shot[38] for shot in shots], [6, 7, 8])
            for shot in shots:
                self.assertEqual(struct.unpack(">3sBHH", shot[:8]), (b"31L", 2, 512, 283))
                self.assertEqual((shot[41], shot[42], shot[44]), (10, 10, 10), "range code, absorption, pulse")
                self.assertEqual(struct.unpack(">H", shot[80:82])[0], 2250)
            shown = subprocess.run([PROGRAM, "inspect", "--summary", str(out)], capture_output=True, text=True, timeout=60)
            self.assertEqual(shown.stdout, "messages: Shot31L 3; broken 0; not decoded 0 bytes\n")
            self.assertIn("no reply of an Imagenex head", self.convert(capture, Path(name) / "a.81a", status=65).stderr)


if __name__ == "__main__":
    unittest.main()
