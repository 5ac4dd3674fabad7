"""The Micron end to end: real pty, real TCP, a host written apart from the C++, and the walls of the tank."""

import math
import os
import unittest
from pathlib import Path

from ports import free_port
from program import Emulator

import seanet_wire as wire
from byte_line import open_line
from seanet_handshakes import HANDSHAKES
from seanet_host import scan
from seanet_session import Session
from seanet_styles import Settings

SOUND_SPEED = 1500.0
HALF_LENGTH, HALF_WIDTH = 6.0, 4.0  # m, the tank's walls as seen from its middle
FLOOR_RANGE = 2.0 / math.sin(math.radians(17.5))  # m, where the lower edge of the fan meets the floor

TANK = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - name: micron
    model: tritech-micron
    endpoints: ["%s"]
    options: {first_alive: 0.1, recentring_alives: 2%s}
"""
# Edges to a bin need a beam with edges, steady levels and direct echoes only; noise, pulse and gain stay on.
SHARP = """effects: {beam_pattern: off, side_lobes: off, speckle: off, multipath: off, second_time_around: off,
  ring_down: off, interference: off}
"""
PTY = "pty:{folder}/micron"


def nearest_wall(bearing, half_beam):
    """Range to the nearest wall or floor within the beam at `bearing` rad, clockwise from ahead (x east, y port)."""
    ranges = []
    for i in range(-20, 21):
        b = bearing + half_beam * i / 20
        x, y = abs(math.cos(b)), abs(math.sin(b))
        ranges.append(min(FLOOR_RANGE, HALF_LENGTH / x if x > 1e-9 else 1e9, HALF_WIDTH / y if y > 1e-9 else 1e9))
    return min(ranges)


def wall_range(bearing):
    """Range at `bearing` to the wall that stands there, at the head's height."""
    x, y = abs(math.cos(bearing)), abs(math.sin(bearing))
    return min(HALF_LENGTH / max(x, 1e-9), HALF_WIDTH / max(y, 1e-9))


def sees_only_walls(bearing):
    """Directions in which neither the grid, the ball nor the post stands (degrees clockwise from ahead)."""
    degrees = math.degrees(bearing) % 360
    return 110 <= degrees <= 200 or 240 <= degrees <= 290


def first_echo(line, level=45):
    """Index of the first bin of at least `level`."""
    return next((i for i, v in enumerate(line.levels) if v >= level), None)


class MicronCase(unittest.TestCase):
    def read_lines(self, line, style, settings, count, actions=(), profile="dst"):
        lines = []

        def note(_number, data, faults, _jumped):
            self.assertEqual(faults, [])
            lines.append(data)

        session = Session(line, style, settings, profile=profile, limit=60)
        if style == "rock":  # never reboots, and gives up on a head that is still re-centring
            session.wait_alive(20, where=lambda alive: alive.head_inf & 2)
        HANDSHAKES[style](session)
        scan(session, count, actions, note)
        self.assertEqual(session.faults, 0)
        return lines

    def check_walls(self, lines):
        """Leading edges of the walls: within one bin plus what half a beam changes in range."""
        checked = 0
        for line in lines:
            bearing = (line.bearing - 3200) * math.tau / 6400
            if not sees_only_walls(bearing):
                continue
            metres = line.ad_interval * 640e-9 * SOUND_SPEED / 2
            near, far = nearest_wall(bearing, math.radians(3)), nearest_wall(bearing, 0)
            edge = first_echo(line)
            self.assertIsNotNone(edge, f"no wall at bearing {line.bearing}")
            # The fan's lower edge on the floor is only as sharp as the pixels that draw it: half of one, 0.04 m there.
            early = 0.05 if near == FLOOR_RANGE else 0
            self.assertGreaterEqual((edge + 1) * metres, near - metres - early, f"bearing {line.bearing}")
            self.assertLessEqual(edge * metres, far + metres + 0.05, f"bearing {line.bearing}")
            checked += 1
        self.assertGreater(checked, 10)


    def check_strongest(self, lines):
        """With every effect on the strongest echo of a line is its wall, from 2 m below to 2 m above the head."""
        checked = 0
        for line in lines:
            bearing = (line.bearing - 3200) * math.tau / 6400
            if not sees_only_walls(bearing):
                continue
            metres = line.ad_interval * 640e-9 * SOUND_SPEED / 2
            strongest = (max(range(len(line.levels)), key=line.levels.__getitem__) + 0.5) * metres
            walls = [wall_range(bearing + math.radians(d)) for d in range(-6, 7)]  # in the main lobe
            near, far = min(walls), max(math.hypot(wall, 2) for wall in walls)
            self.assertGreaterEqual(strongest, near - 2 * metres, f"bearing {line.bearing}")
            self.assertLessEqual(strongest, far + 2 * metres, f"bearing {line.bearing}")
            checked += 1
        self.assertGreater(checked, 10)


class OverPty(MicronCase):
    def test_walls_stand_where_the_scene_has_them(self):
        with Emulator(TANK % (PTY, "") + SHARP) as emulator:
            line = open_line(str(emulator.folder / "micron"))
            lines = self.read_lines(line, "mcgill", Settings(range=10.0, bins=400, step=32), 200)
            self.check_walls(lines)
            line.close()
            status, output = emulator.stop()
            self.assertEqual(status, 0, output)
            self.assertFalse(os.path.lexists(emulator.folder / "micron"), "the link is removed at the end")

    def test_range_and_bins_change_the_picture(self):
        with Emulator(TANK % (PTY, ", baud: 0") + SHARP) as emulator:
            line = open_line(str(emulator.folder / "micron"))
            lines = self.read_lines(
                line, "rock", Settings(range=10.0, bins=200, step=64), 220, [(110, "range=20,bins=800")]
            )
            first, second = lines[:100], lines[120:]
            self.assertEqual({len(l.levels) for l in first}, {200})
            self.assertEqual({len(l.levels) for l in second}, {800})
            self.check_walls(first)
            self.check_walls(second)

    def test_every_known_handshake_gets_its_lines(self):
        for style in ("rock", "mcgill", "hostB", "delphin"):
            with self.subTest(style), Emulator(TANK % (PTY, ", baud: 0")) as emulator:
                line = open_line(str(emulator.folder / "micron"))
                self.read_lines(line, style, Settings(range=10.0, bins=200), 20)

    def test_sector_reverse_and_gain(self):
        with Emulator(TANK % (PTY, ", baud: 0")) as emulator:
            line = open_line(str(emulator.folder / "micron"))
            sector = Settings(range=10.0, bins=200, continuous=False, left=2400, right=4000, step=32)
            lines = self.read_lines(
                line, "mcgill", sector, 120, [(60, "level=95,31,105"), (90, "reverse")]
            )
            bearings = [l.bearing for l in lines]
            self.assertEqual(bearings[:52], list(range(2400, 4001, 32)) + [3968])
            self.assertTrue(all(2400 <= b <= 4000 for b in bearings))

    def test_a_driver_that_comes_back_finds_a_clean_line(self):
        with Emulator(TANK % (PTY, "")) as emulator:
            path = str(emulator.folder / "micron")
            line = open_line(path)
            self.read_lines(line, "mcgill", Settings(range=10.0, bins=200), 5)
            line.write(wire.build(wire.SEND_DATA, b"\0\0\0\0")[:7])  # dies in the middle of a command
            line.close()
            line = open_line(path)
            session = Session(line, "hostB", Settings(range=10.0, bins=200), limit=30)
            HANDSHAKES["hostB"](session)
            self.assertEqual(session.framer.skipped, 0, "stale bytes on a fresh line")

    def test_garbage_is_not_answered_and_wedges_nothing(self):
        with Emulator(TANK % (PTY, "")) as emulator:
            line = open_line(str(emulator.folder / "micron"))
            line.write(os.urandom(5000).replace(b"@", b"?") + b"@" * 100 + b"@FFFF\xff\xff" + b"\0" * 5000)
            self.read_lines(line, "mcgill", Settings(range=10.0, bins=200), 10)
            status, output = emulator.stop()
            self.assertEqual(status, 0)
            self.assertIn("skipped", output)


class OverTcp(MicronCase):
    def test_over_a_tcp_bridge_with_every_effect_on(self):
        port = free_port()
        with Emulator(TANK % (f"tcp-listen://127.0.0.1:{port}", ", baud: 0")):
            line = open_line(f"tcp://127.0.0.1:{port}")
            self.addCleanup(line.close)
            self.check_strongest(self.read_lines(line, "mcgill", Settings(range=10.0, bins=400, step=64), 120))


class SameSeedSameBytes(MicronCase):
    def test_two_runs_give_the_same_lines(self):
        def one_run():
            with Emulator(TANK % (PTY, ", baud: 0")) as emulator:
                line = open_line(str(emulator.folder / "micron"))
                lines = self.read_lines(line, "mcgill", Settings(range=10.0, bins=400), 60)
                return [(l.bearing, bytes(l.levels)) for l in lines]

        self.assertEqual(one_run(), one_run())


if __name__ == "__main__":
    unittest.main()
