"""The Ping360 end to end on loopback: found by a broadcast, scanned as Ping Viewer does, its walls where they are."""

import math
import re
import unittest

from ports import free_port
from program import ROOT, Emulator

import ping360_host as wire
from ping360_host import Host, Settings

SOUND_SPEED = 1500.0
HALF_LENGTH, HALF_WIDTH = 6.0, 4.0  # m, the tank's walls as seen from its middle
SCENARIO = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
effects: {beam_pattern: off, side_lobes: off, speckle: off, multipath: off, second_time_around: off}
devices:
  - name: ping360
    model: ping360
    endpoints: ["%s"]
"""


def wall(degrees):
    b = math.radians(degrees)
    return min(HALF_LENGTH / max(abs(math.cos(b)), 1e-9), HALF_WIDTH / max(abs(math.sin(b)), 1e-9))


def edge(ping, settings, least=80):
    """Range of the first sample beyond the ring-down that is as high, in m; None without one."""
    step = settings.bin_length(SOUND_SPEED)
    first = int(1 / step)
    found = next((i for i in range(first, len(ping.data)) if ping.data[i] >= least), None)
    return None if found is None else found * step


class PingViewer(unittest.TestCase):
    def run_host(self):
        port = free_port()
        self.enterContext(Emulator(SCENARIO % f"udp-listen://127.0.0.1:{port}"))
        return self.enterContext(Host("127.0.0.1", port))

    def enterContext(self, manager):  # unittest has it from Python 3.11 on
        result = manager.__enter__()
        self.addCleanup(manager.__exit__, None, None, None)
        return result

    def test_scans_by_itself_and_changes_its_mind(self):
        host = self.run_host()
        information = host.ask(wire.DEVICE_INFORMATION)
        self.assertEqual(information.source, 2)
        self.assertGreater(tuple(information.payload[2:5]), (3, 3, 0), "else it would scan ping by ping")

        near = Settings().for_range(10, SOUND_SPEED)
        host.scan(near, 240, 310)  # behind the right, where there are walls only
        pings = host.pings(60, 10)
        self.assertEqual([p.angle for p in pings], list(range(240, 300)))
        for ping in pings:
            self.assertEqual(Settings(ping.gain, ping.duration, ping.period, ping.frequency, ping.samples), near)
            degrees = (ping.angle - 200) * 0.9
            if not 120 <= degrees:
                continue
            step = near.bin_length(SOUND_SPEED)
            self.assertAlmostEqual(edge(ping, near), wall(degrees), delta=2 * step + 0.02 * wall(degrees))

        wide = Settings(gain=1).for_range(20, SOUND_SPEED)
        host.scan(wide, 340, 379)
        pings = host.pings(20, 10)
        self.assertEqual([p.angle for p in pings], list(range(340, 360)), "not one ping of the scan before")
        for ping in pings:
            self.assertEqual((ping.gain, ping.period), (1, wide.period))
            degrees = (ping.angle - 200) * 0.9
            step, found = wide.bin_length(SOUND_SPEED), edge(ping, wide, 99)
            # One side of a beam of 2 deg meets a slanting wall sooner.
            self.assertGreater(found, min(wall(degrees - 1), wall(degrees + 1)) - 2 * step, degrees)
            self.assertLess(found, wall(degrees) + 2 * step, degrees)
        host.line_break()
        self.assertEqual(len(host.pings(15, 10)), 15, "no line carries an empty datagram to the head")
        host.say(wire.frame(wire.MOTOR_OFF))
        host.silence()
        self.assertIsNone(host.hear(0.5))

    def test_gain_is_seen_in_the_samples(self):
        host = self.run_host()
        settings = Settings().for_range(10, SOUND_SPEED)
        angle = 350  # 135 deg to the right
        edges = []
        for gain in (0, 1, 2):
            ping = host.ping(angle, settings._replace(gain=gain))
            self.assertEqual((ping.mode, ping.gain), (0, gain))
            at = int(wall((angle - 200) * 0.9) / settings.bin_length(SOUND_SPEED))
            edges.append(max(ping.data[at - 5 : at + 60]))
        self.assertLess(edges[2], 255, "clipped")
        for low, high in zip(edges, edges[1:]):
            self.assertAlmostEqual(high - low, 255 * 6 / 120, delta=4, msg="6 dB of 120")

    def test_looks_at_an_endpoint_of_the_demo_scenario(self):
        text = (ROOT / "config" / "ping360.yaml").read_text()
        self.assertRegex(text, r'endpoints: \[.*"udp-listen://127\.0\.0\.1:1234"')


class Discovery(unittest.TestCase):
    def test_a_broadcast_finds_the_sonar_and_it_answers_where_it_says(self):
        address = "127.36.0.12"
        with Emulator(SCENARIO % f"udp-listen://{address}:12345"):
            found = wire.discover("127.255.255.255")
            self.assertIn(address, [ip for _, ip in found])
            with Host(address, 12345) as host:
                self.assertEqual(host.ask(wire.PROTOCOL_VERSION).payload, bytes([1, 1, 0, 0]))

    def test_finds_nothing_where_nobody_would_get_through(self):
        port = free_port()
        with Emulator(SCENARIO % f"udp-listen://127.0.0.1:{port}") as emulator:
            emulator.stop()
            self.assertFalse(re.search(r"\b30303\b", emulator.output))


if __name__ == "__main__":
    unittest.main()
