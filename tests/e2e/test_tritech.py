"""SeaKing, profiler and the AUX port's echosounder end to end, against hosts written apart from the C++."""

import math
import statistics
import unittest
from dataclasses import replace

from program import Emulator
from test_micron import PTY, SHARP, TANK, MicronCase, first_echo, nearest_wall, sees_only_walls, wall_range

import seanet_profiler as profiler
import seanet_wire as wire
from byte_line import open_line
from seanet_handshakes import HANDSHAKES
from seanet_host import scan
from seanet_session import Session
from seanet_styles import RX_325_KHZ, TX_325_KHZ, Settings

SEAKING = TANK.replace("tritech-micron", "tritech-seaking")
PROFILER = TANK.replace("model: tritech-micron", "model: tritech-profiler\n    mount: {rpy_deg: [0, %d, 0]}")
POST = math.atan2(2.6, 1.2)  # rad clockwise from ahead; 0.15 m thick, 2.86 m away


class SeaKing(MicronCase):
    def session(self, emulator, settings):
        line = open_line(str(emulator.folder / "micron"))
        self.addCleanup(line.close)
        session = Session(line, "hostC", settings, profile="miniking", limit=60)
        HANDSHAKES["hostC"](session)
        return session

    def lines_of(self, session, count):
        lines = []
        scan(session, count, (), lambda _n, line, faults, _j: lines.append(line) or self.assertEqual(faults, []))
        return lines

    def test_walls_stand_where_the_scene_has_them(self):
        with Emulator(SEAKING % (PTY, ", baud: 0") + SHARP) as emulator:
            lines = self.lines_of(self.session(emulator, Settings(range=10.0, bins=400, step=32)), 200)
        checked = 0
        for line in lines:
            bearing = (line.bearing - 3200) * math.tau / 6400
            if not sees_only_walls(bearing) or wall_range(bearing) > 5.4:  # there the fan meets the floor
                continue
            metres = line.ad_interval * 640e-9 * 1500 / 2
            edge = first_echo(line)
            self.assertIsNotNone(edge)
            self.assertGreaterEqual((edge + 1) * metres, nearest_wall(bearing, math.radians(1.5)) - metres)
            self.assertLessEqual(edge * metres, wall_range(bearing) + metres + 0.05)
            checked += 1
        self.assertGreater(checked, 20)

    def test_the_beam_is_twice_as_wide_at_325_khz(self):
        sector = Settings(range=5.0, bins=200, continuous=False, left=4100, right=4580, step=8)
        with Emulator(SEAKING % (PTY, ", baud: 0") + SHARP) as emulator:
            session = self.session(emulator, sector)
            high = self.width_of_post(self.lines_of(session, 60))
            session.expect(
                replace(session.command, tx_number=(TX_325_KHZ,) * 2, rx_number=(RX_325_KHZ,) * 2, slope=(90, 90))
            )
            session.send(session.command.encode())
            session.wait(3, wire.ALIVE)
            low = self.width_of_post(self.lines_of(session, 60))
        post = 2 * math.degrees(math.asin(0.15 / math.hypot(2.6, 1.2)))
        self.assertAlmostEqual(high, post + 1.5, delta=1.0)
        self.assertAlmostEqual(low, post + 3.0, delta=1.0)
        self.assertGreater(low, high)

    @staticmethod
    def width_of_post(lines):
        """deg over which something stands between 2.5 and 3.2 m."""
        seen = set()
        for line in lines:
            metres = line.ad_interval * 640e-9 * 1500 / 2
            if any(v >= 25 for v in line.levels[int(2.5 / metres) : int(3.2 / metres)]):
                seen.add(line.bearing)
        return (max(seen) - min(seen)) * 360 / 6400 if seen else 0


class Profiler(unittest.TestCase):
    def host(self, emulator):
        line = open_line(str(emulator.folder / "micron"))
        self.addCleanup(line.close)
        return profiler.Host(line)

    def test_walls_of_the_tank_both_ways(self):
        with Emulator(PROFILER % (0, PTY, "")) as emulator:
            host = self.host(emulator)
            host.configure(profiler.Command(left=5600, right=800, step=32, range=10.0))  # astern: no objects ahead
            (first, one), (second, other) = host.scan(), host.scan()
        self.assertTrue(first.clockwise)
        self.assertFalse(second.clockwise, "passes alternate")
        # 51 pings of 13.5 ms and 8 ms for the motor in between
        told = 51 * 0.0135 + 50 * 0.008
        self.assertGreater(min(one, other), told - 0.1)
        self.assertLess(min(one, other), told + 0.25, "the quicker one: a busy machine may hold up a pass")
        for reply in (first, second):
            self.assertEqual(len(reply.times), 51)
            errors = [r - wall_range(b) for b, r in reply.echoes() if 165 <= math.degrees(b) % 360 <= 195]
            self.assertEqual(len(errors), 17)
            # The strongest echo lies within the pulse of 50 us, 4 cm, behind the wall's edge.
            self.assertLess(abs(statistics.median(errors)), 0.08)
            self.assertLess(max(map(abs, errors)), 0.25)

    def test_floor_below_a_profiler_on_its_side(self):
        with Emulator(PROFILER % (90, PTY, ", baud: 0")) as emulator:
            host = self.host(emulator)
            for mode in ("first", "normal", "max"):
                host.configure(profiler.Command(left=2560, right=3840, step=64, range=6.0, mode=mode))
                reply, _ = host.scan()
                depths = [r * math.cos(b) for b, r in reply.echoes() if abs(b) < math.radians(20)]
                self.assertAlmostEqual(statistics.median(depths), 2.0, delta=0.08, msg=mode)

    def test_range_and_threshold_change_what_is_heard(self):
        with Emulator(PROFILER % (0, PTY, ", baud: 0") + "effects: {second_time_around: off}\n") as emulator:
            host = self.host(emulator)
            away = profiler.Command(left=6336, right=64, step=32)  # astern, 6 m
            host.configure(replace(away, range=10.0))
            self.assertNotIn(0, host.scan()[0].times)
            host.configure(replace(away, range=5.0))
            self.assertEqual(set(host.scan()[0].times), {0}, "the wall is out of range")
            host.configure(replace(away, range=10.0, threshold=255))
            self.assertEqual(set(host.scan()[0].times), {0}, "nothing is as loud as that")
            host.configure(replace(away, range=10.0, nearest=7.0))
            self.assertTrue(all(t == 0 or t * 750e-6 > 7 for t in host.scan()[0].times))


class Aux(MicronCase):
    def test_depth_comes_between_the_lines(self):
        with Emulator(TANK % (PTY, ", aux_echosounder: true, aux_period: 0.5, aux_range: 10")) as emulator:
            line = open_line(str(emulator.folder / "micron"))
            self.addCleanup(line.close)
            session, texts = Session(line, "rock", Settings(range=10.0, bins=200), limit=60), []

            def note(event):
                if event["event"] == "AuxData":
                    texts.append(bytes.fromhex(event["hex"])[2:].decode())

            session.emit = note
            session.wait_alive(20, where=lambda alive: alive.head_inf & 2)
            HANDSHAKES["rock"](session)
            for _ in range(60):
                session.send(wire.send_data())
                session.wait(1.5, wire.HEAD_DATA)
        self.assertGreater(len(texts), 3)
        for text in texts:
            self.assertRegex(text, r"^\d{4}mm$")
            self.assertAlmostEqual(int(text[:-2]), 2000, delta=60)


if __name__ == "__main__":
    unittest.main()
