"""The 881A and the 852 end to end: real pty and TCP, hosts written apart from the C++, walls and floor of the scene."""

import math
import socket
import statistics
import time
import unittest

from ports import free_port
from program import Emulator

import imagenex_wire as wire
from byte_line import open_line
from imagenex_host import Host, NoReply, Reads513, ReadsUntilFC

HALF_LENGTH, HALF_WIDTH = 6.0, 4.0  # m, the tank's walls as seen from its middle

TANK = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, %g, -2]}}
clock: {mode: %s}
devices:
  - name: sonar
    model: imagenex-881a
    endpoints: ["%s"]
    options: {%s}
"""
FLOOR = """
scene: {scenes}/flat.glb
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: %g, scattering: pure}     # as the lake of the recordings
vehicle: {pose: {position: [0, 0, %g]}}
devices:
  - name: sounder
    model: imagenex-852
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["pty:{folder}/line"]
    options: {%s}
"""
# Edges to a bin need a beam with edges, steady levels and direct echoes only; noise, pulse and gain stay on.
SHARP = "effects: {beam_pattern: off, side_lobes: off, speckle: off, multipath: off, second_time_around: off}\n"
PTY = "pty:{folder}/line"
FAST, REAL = "scaled, rate: 4", "real"


def wall_range(degrees):
    """Range to the wall at a bearing clockwise from ahead, at the head's height."""
    x, y = abs(math.cos(math.radians(degrees))), abs(math.sin(math.radians(degrees)))
    return min(HALF_LENGTH / max(x, 1e-9), HALF_WIDTH / max(y, 1e-9))


def walls(degrees, half_beam=1.0):
    """Nearest and farthest wall within the beam."""
    ranges = [wall_range(degrees + half_beam * i / 10) for i in range(-10, 11)]
    return min(ranges), max(ranges)


def sees_only_walls(degrees):
    """Directions in which neither the grid, the ball nor the post stands."""
    return 110 <= degrees % 360 <= 200 or 240 <= degrees % 360 <= 290


class ImagenexCase(unittest.TestCase):
    def start(self, scenario, host=Host, path="line"):
        emulator = Emulator(scenario)
        self.addCleanup(emulator.__exit__, None, None, None)
        emulator.__enter__()
        line = open_line(path if "://" in path else str(emulator.folder / path))
        self.addCleanup(line.close)
        self.emulator = emulator
        return host(line)

    def seconds_per_shot(self, host, command, shots):
        """The median: a shot that a busy machine has kept waiting is none of the head's."""
        host.ask(command)
        times = [time.monotonic()]
        for _ in range(shots):
            host.ask(command)
            times.append(time.monotonic())
        return statistics.median(b - a for a, b in zip(times, times[1:]))


class Sonar(ImagenexCase):
    def check_walls(self, shots, metres):
        """Where the data first rise there is a wall, within a point."""
        checked = 0
        for shot in shots:
            if not sees_only_walls(shot.degrees):
                continue
            near, far = walls(shot.degrees)
            points = shot.data
            edge = next((i for i, v in enumerate(points) if i * metres > 0.5 and v >= 40), None)
            self.assertIsNotNone(edge, f"no wall at {shot.degrees} deg: {max(points)}")
            self.assertGreaterEqual((edge + 1) * metres, near - metres, f"{shot.degrees} deg")
            self.assertLessEqual(edge * metres, far + metres, f"{shot.degrees} deg")
            checked += 1
        self.assertGreater(checked, 10)

    def test_a_turn_of_the_host_that_reads_until_fc(self):
        host = self.start(TANK % (0, FAST, PTY, "") + SHARP, ReadsUntilFC)
        shots = host.turn(step=8, points=25)
        self.assertEqual(len(shots), 151, "150 steps of 2.4 deg and the one that ends the turn")
        self.assertTrue(all(shot.clockwise for shot in shots))
        self.check_walls(shots, 10 / 252)
        status, output = self.emulator.stop()
        self.assertEqual(status, 0, output)

    def test_range_and_points_change_the_picture(self):
        host = self.start(TANK % (0, FAST, PTY, "start_angle: 100") + SHARP)
        near = [host.ask(wire.command(step=4, sector=120)) for _ in range(30)]
        self.assertEqual({len(shot.data) for shot in near}, {500})
        self.check_walls(near, 10 / 500)
        far = [host.ask(wire.command(step=4, sector=120, range=20, points=25)) for _ in range(30)]
        self.assertEqual({(len(shot.data), shot.range) for shot in far}, {(252, 20)})
        self.check_walls(far, 20 / 252)
        short = host.ask(wire.command(step=0, range=3))
        self.assertLess(max(short.data[250:]), 40, "all walls are farther than 3 m")

    def test_profile_mode_tells_the_walls_in_centimetres_and_in_two_millimetres(self):
        host = self.start(TANK % (-1.5, FAST, PTY, "start_angle: 88") + SHARP)  # starboard wall 2.5 m away
        for metres, unit in ((10, 0.01), (5, 0.01), (4, 0.002)):
            for _ in range(4):
                shot = host.ask(wire.command(profile=1, train=90, sector=4, step=1, range=metres, gain=30))
                self.assertEqual((shot.letter, shot.data), ("P", b""))
                wall = 2.5 / math.cos(math.radians(shot.degrees - 90))
                self.assertAlmostEqual(shot.profile * unit, wall, delta=0.015, msg=f"{metres} m")

    def test_gain_makes_echoes_stronger(self):
        host = self.start(TANK % (0, FAST, PTY, "start_angle: 120"))
        means = [statistics.mean(host.ask(wire.command(step=0, gain=gain)).data) for gain in (0, 10, 20, 30)]
        self.assertEqual(means, sorted(means))
        self.assertGreater(means[3], 2 * means[0])

    def test_four_and_sixteen_bits_show_the_same_picture(self):
        host = self.start(TANK % (0, FAST, PTY, "start_angle: 120") + SHARP)
        found = {}
        for bits, points in ((8, 500), (4, 504), (16, 250)):
            shot = host.ask(wire.command(step=0, bits=bits, gain=10), bits)
            data = wire.levels(shot.data, bits)
            self.assertEqual(len(data), points)
            half = max(data) / 2
            found[bits] = next(i for i, v in enumerate(data) if v >= half and i > points / 20) * 10 / points
        self.assertAlmostEqual(found[8], found[4], delta=0.05)
        self.assertAlmostEqual(found[8], found[16], delta=0.05)

    def test_a_turn_takes_what_the_maker_says(self):
        """10 m, 0.3 deg: 49.2 s a turn with data, 22.8 s in profile mode; with and without a slow line."""
        for options in ("baud: 0", ""):
            host = self.start(TANK % (0, REAL, PTY, options))
            data = self.seconds_per_shot(host, wire.command(step=1, points=25), 25)
            profile = self.seconds_per_shot(host, wire.command(step=1, profile=1), 50)
            for taken, told in ((data, 49.2 / 1200), (profile, 22.8 / 1200)):
                self.assertGreater(taken, told - 0.003)
                self.assertLess(taken, told + 0.012, "a busy machine adds to every shot")

    def test_half_duplex_manners(self):
        host = self.start(TANK % (0, REAL, PTY, ""))
        self.assertEqual(host.silence(0.3), b"", "before the first command")
        host.line.write(wire.command(head_id=0x11))
        self.assertEqual(host.silence(0.3), b"", "for another head")
        first = host.ask(wire.command())
        self.assertEqual(host.silence(0.3), b"", "one reply to one command")
        self.assertNotEqual(host.ask(wire.command()).position, first.position)

    def test_over_tcp_after_noise_and_half_a_command(self):
        port = free_port()
        host = self.start(TANK % (0, REAL, f"tcp-listen://127.0.0.1:{port}", ""), path=f"tcp://127.0.0.1:{port}")
        host.line.write(bytes(range(253)) * 20 + wire.command()[:13])
        self.assertEqual(host.ask(wire.command()).letter, "G")


class Sounder(ImagenexCase):
    def test_the_floor_is_where_it_is(self):
        host = self.start(FLOOR % (1500, -12, ""))  # 8 m above the floor
        for settings in ({"range": 10}, {"range": 20}, {"range": 50, "points": 25}, {"range": 10, "profile": 1}):
            shot = host.ask(wire.sounder_command(**settings))
            self.assertAlmostEqual(shot.profile / 100, 8.0, delta=0.03, msg=str(settings))
            self.assertEqual(shot.profile % 2, 0, "steps of 2 cm")
            if shot.data:
                metres = settings["range"] / len(shot.data)
                edge = next(i for i, v in enumerate(shot.data) if i * metres > 1 and v >= 64)
                self.assertAlmostEqual(edge * metres, 8.0, delta=metres + 0.03)
        self.assertEqual(host.ask(wire.sounder_command(range=5)).profile, 0, "beyond the range")
        self.assertEqual(host.ask(wire.sounder_command(range=10, least=90)).profile, 0, "blanked by the host")

    def test_slow_sound_makes_it_deeper_and_shallow_water_nearer(self):
        host = self.start(FLOOR % (1450, -17, ""))
        shot = host.ask(wire.sounder_command(range=5))
        self.assertAlmostEqual(shot.profile / 100, 3.0 * 1500 / 1450, delta=0.03)

    def test_the_host_that_always_reads_513_bytes(self):
        host = self.start(FLOOR % (1500, -17, ""), Reads513)
        for _ in range(10):
            altitude, seconds = host.shot()
            self.assertAlmostEqual(altitude, 3.0, delta=0.03)
            self.assertLess(seconds, 0.5, "it is not the time-out that ends the shot")
        self.assertEqual(host.shot(profile=1)[0], None)
        self.assertAlmostEqual(host.shot()[0], 3.0, delta=0.03)

    def test_a_host_that_leaves_byte_6_at_zero(self):
        self.assertEqual(self.start(FLOOR % (1500, -12, "")).ask(wire.sounder_command(mode=0)).letter, "G")
        strict = self.start(FLOOR % (1500, -12, "mode_byte: strict"))
        with self.assertRaises(NoReply):
            strict.ask(wire.sounder_command(mode=0))

    def test_levels_are_like_those_of_a_real_one(self):
        """10 m, 12 dB, 100 us, floor at 4.5 m; recorded: 37.7 % zeros, 2.1 % at 127."""
        host = self.start(FLOOR % (1460, -15.5, ""))
        points = [v for _ in range(15) for v in host.ask(wire.sounder_command()).data]
        zeros, full = points.count(0) / len(points), points.count(127) / len(points)
        self.assertLessEqual(max(points), 127)
        self.assertTrue(0.15 < zeros < 0.6, zeros)
        self.assertTrue(0.005 < full < 0.06, full)

    def reply_seconds(self, host, code, rate):
        """From a command to the last byte of its reply, which the driver hears at `rate`; the shortest of some."""
        taken = []
        for _ in range(4):
            start = time.monotonic()
            host.line.write(wire.sounder_command(range=5, baud=code))
            host.line.set_baud(rate)
            reply = wire.parse(host.read(513))
            taken.append(time.monotonic() - start)
            self.assertAlmostEqual(reply.profile / 100, 3.0, delta=0.03)
            host.line.set_baud(115200)
        return min(taken)

    def test_a_reply_has_the_pace_that_its_command_asks_for(self):
        host = self.start(FLOOR % (1500, -17, "reply_baud: honoured"))
        echo = 2 * 5 / 1500 + 4.7e-3
        for code, rate in ((6, 115200), (0x0B, 9600), (2, 38400), (6, 115200)):
            seconds = self.reply_seconds(host, code, rate)
            self.assertGreater(seconds, echo + 5130 / rate - 1e-3, f"{rate} bit/s")
            self.assertLess(seconds, echo + 1.5 * 5130 / rate + 0.15, f"{rate} bit/s, on a busy machine")

    def test_who_stays_at_the_old_rate_hears_garbage_and_is_served_again(self):
        host = self.start(FLOOR % (1500, -17, "reply_baud: honoured"))
        self.assertEqual(host.ask(wire.sounder_command(range=5, baud=6)).letter, "G")
        start = time.monotonic()
        host.line.write(wire.sounder_command(range=5, baud=0x0B))
        self.emulator.read_until("asked for an answer at 9600 bit/s and has set 115200", 20)
        garbage = host.read_some(9999, 20)
        while piece := host.read_some(9999, 0.5):
            garbage += piece
        self.assertGreater(time.monotonic() - start, 0.5 + 5130 / 9600, "at its pace")
        self.assertGreater(len(garbage), 100)
        self.assertNotIn(b"IGX", garbage)
        self.assertAlmostEqual(host.ask(wire.sounder_command(range=5, baud=6)).profile / 100, 3.0, delta=0.03)

    def test_without_power_the_slow_reply_ends_and_the_head_is_as_it_came(self):
        host = self.start(FLOOR % (1500, -17, "reply_baud: honoured") + "control: unix:{folder}/control\n")
        host.ask(wire.sounder_command(range=5, baud=6))
        host.line.write(wire.sounder_command(range=5, baud=0x0B))
        host.line.set_baud(9600)
        with socket.socket(socket.AF_UNIX) as control:
            control.connect(str(self.emulator.folder / "control"))
            got = host.read_some(513, 20)
            control.sendall(b'{"fault": {"device": "sounder", "kind": "reboot", "off": 0.2}}\n')
            self.assertIn(b'"ok":true', control.recv(4096).replace(b" ", b""))
        got += host.silence(1)
        self.assertLess(len(got), 400, "half a second of bytes was not to come any more")
        host.line.set_baud(115200)
        start = time.monotonic()
        self.assertEqual(host.ask(wire.sounder_command(range=5)).letter, "G")
        self.assertLess(time.monotonic() - start, 0.4)

    def test_the_automatic_trigger_sends_on_after_one_command(self):
        host = self.start(FLOOR % (1500, -12, "trigger_rate: 10"))
        host.line.write(wire.sounder_command(trigger=6, points=25))
        for _ in range(5):
            self.assertEqual(wire.parse(host.read(265)).letter, "M")


if __name__ == "__main__":
    unittest.main()
