"""The Omniscan 450 and the S500 end to end: walls and bottom are where the scene has them, what a host sets changes the
picture, and times are those of the sound, of the host's pace and of the line."""

import math
import socket
import statistics
import time
import unittest

from ports import free_port
from program import ROOT, Emulator

import byte_line
import cerulean_wire as wire
from surveyor_wire import Reader, request

SCENARIO = """
scene: %s
seed: 5
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, %g]}}
effects: {%s}
devices:
  - name: sonar
    model: %s
    mount: {rpy_deg: [%s]}
    endpoints: ["%s"]
    options: {%s}
"""
FLAT = ROOT / "config" / "scenes" / "flat.glb"
TANK = ROOT / "config" / "scenes" / "tank.glb"
FLAT_Z = -20.0
SOUND_SPEED = 1500.0
THOUGHT = 0.002  # s from the end of the range to the profile
SHARP = "beam_pattern: off, side_lobes: off, speckle: off, multipath: off, second_time_around: off"


def typical_step(times):
    """The median: a busy machine is late at times."""
    return statistics.median(b - a for a, b in zip(times, times[1:]))


class Datagrams:
    """Like a ByteLine, and remembers every datagram."""

    def __init__(self, port):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.connect(("127.0.0.1", port))
        self.all = []

    def read(self, seconds):
        self.socket.settimeout(max(seconds, 0.001))
        try:
            self.all.append(self.socket.recv(65536))
        except TimeoutError:
            return b""
        return self.all[-1]

    def write(self, data):
        self.socket.send(data)

    def close(self):
        self.socket.close()


class Host:
    def __init__(self, line):
        self.line, self.reader, self.waiting = line, Reader(), []

    def say(self, *messages):
        for message in messages:
            self.line.write(message)

    def wait(self, message_id, seconds=5.0):
        """(time of arrival, payload) of the next message of this id; AssertionError if none comes in time."""
        end = time.monotonic() + seconds
        while True:
            while self.waiting:
                arrived, frame = self.waiting.pop(0)
                if frame.id == message_id:
                    return arrived, frame.payload
            if time.monotonic() > end:
                raise AssertionError(f"no message {message_id} within {seconds} s")
            data = self.line.read(end - time.monotonic())
            self.waiting += [(time.monotonic(), frame) for frame in self.reader.feed(data)]

    def profile(self):
        return wire.read_omniscan(self.wait(wire.OS_MONO_PROFILE)[1])

    def sounding(self):
        return wire.read_s500(self.wait(wire.PROFILE6)[1])

    def settled(self, read, is_new):
        """The first profile that has what was just set."""
        for _ in range(20):
            found = read()
            if is_new(found):
                return found
        raise AssertionError("what was set did not change the pings")


class CeruleanCase(unittest.TestCase):
    def start(self, model, scene=TANK, z=-2.0, rpy="0, 0, 90", link="tcp", effects="", options=""):
        port = free_port() if link == "udp" else free_port()
        endpoint = "pty:{folder}/line" if link == "pty" else f"{link}-listen://127.0.0.1:{port}"
        emulator = Emulator(SCENARIO % (scene, z, effects, model, rpy, endpoint, options))
        self.addCleanup(emulator.__exit__, None, None, None)
        emulator.__enter__()
        if link == "pty":
            line = byte_line.open_tty(str(emulator.folder / "line"))
        else:
            line = Datagrams(port) if link == "udp" else byte_line.open_line(f"tcp://127.0.0.1:{port}")
        self.addCleanup(line.close)
        self.emulator = emulator
        return Host(line)


class Omniscan(CeruleanCase):
    def test_a_side_scan_sees_water_then_bottom(self):
        """Tilted 30 deg down, a fan of 50 deg meets the bottom, 8 m below, from 55 deg on."""
        host = self.start("omniscan450", FLAT, FLAT_Z + 8, "0, 30, -90", effects=SHARP)
        nearest = 8 / math.sin(math.radians(30 + 25))
        for length, results in ((40000, 1200), (20000, 600)):
            host.say(wire.os_ping_params(length_mm=length, num_results=results, msec_per_ping=60))
            profile = host.settled(host.profile, lambda p: p.length == length / 1e3 and len(p.raw) == results)
            self.assertAlmostEqual(profile.edge(below=20, beyond=1), nearest, delta=0.3)
            levels = [(profile.range_of(i), level) for i, level in enumerate(profile.levels())]
            water = [level for r, level in levels if 1 < r < nearest - 0.5]
            bottom = [level for r, level in levels if nearest + 1 < r < nearest + 5]
            self.assertGreater(sum(bottom) / len(bottom), sum(water) / len(water) + 20)

    def test_walls_with_every_effect(self):
        host = self.start("omniscan450", rpy="0, 0, 90")
        host.say(wire.os_ping_params(length_mm=8000, num_results=800, msec_per_ping=50))
        for _ in range(5):
            profile = host.profile()
            # Its corner with the floor, 4.5 m away, is louder still.
            self.assertAlmostEqual(profile.edge(below=30, beyond=3.0), 4.0, delta=0.05)

    def test_gain_moves_the_levels_until_the_input_clips(self):
        host = self.start("omniscan450", FLAT, FLAT_Z + 8, "0, 30, -90", effects=SHARP)
        tops = {}
        for gain in (2, 4, 7):
            host.say(wire.os_ping_params(length_mm=20000, msec_per_ping=50, gain_index=gain))
            profile = host.settled(host.profile, lambda p, gain=gain: p.gain == gain)
            tops[gain] = profile.highest
            self.assertEqual((min(profile.raw), max(profile.raw)), (0, 65535))
            self.assertLessEqual(profile.highest, 0.1, "nothing is louder than full scale")
        self.assertAlmostEqual(tops[4] - tops[2], 20 * math.log10(74.55 / 22), delta=1.0)

    def test_times_are_those_of_sound_and_of_the_host(self):
        host = self.start("omniscan450", FLAT, FLAT_Z + 8)
        asked = time.monotonic()
        host.say(wire.os_ping_params(length_mm=60000, msec_per_ping=200))
        first, payload = host.wait(wire.OS_MONO_PROFILE)
        earliest = 2 * 60 / SOUND_SPEED + THOUGHT
        self.assertGreaterEqual(first - asked, earliest)
        self.assertLess(first - asked, earliest + 0.15)
        arrivals = [first] + [host.wait(wire.OS_MONO_PROFILE)[0] for _ in range(10)]
        self.assertAlmostEqual(typical_step(arrivals), 0.2, delta=0.01)
        host.say(wire.os_ping_params(length_mm=60000, msec_per_ping=0))
        host.wait(wire.OS_MONO_PROFILE)
        arrivals = [host.wait(wire.OS_MONO_PROFILE)[0] for _ in range(11)]
        self.assertGreaterEqual((arrivals[-1] - arrivals[0]) / 10, earliest - 0.005)
        self.assertLess(typical_step(arrivals), earliest + 0.02)

    def test_a_message_begins_a_datagram_and_goes_on_in_the_next(self):
        host = self.start("omniscan450", link="udp")
        host.say(request(4), wire.os_ping_params(num_results=1200, msec_per_ping=50))
        self.assertEqual(len(host.wait(4)[1]), 6)
        for _ in range(5):
            self.assertEqual(len(host.profile().raw), 1200)
        sizes = [len(data) for data in host.line.all]
        self.assertEqual(sizes[:5], [16, 1472, 990, 1472, 990])
        for data, size in zip(host.line.all, sizes):
            self.assertEqual(data.startswith(b"BR"), size != 990)

    def test_a_host_that_goes_leaves_it_pinging_for_the_next(self):
        host = self.start("omniscan450")
        host.say(wire.os_ping_params(msec_per_ping=50))
        first = host.profile()
        port = host.line._owner.getpeername()[1]
        host.line.close()
        time.sleep(0.2)  # it pings into the void
        host.line = byte_line.open_line(f"tcp://127.0.0.1:{port}")
        self.addCleanup(host.line.close)
        host.reader, host.waiting = Reader(), []
        self.assertGreater(host.profile().number, first.number + 2)
        host.say(wire.os_ping_params(enable=0), request(5))
        host.wait(5)
        self.assertRaises(AssertionError, host.wait, wire.OS_MONO_PROFILE, 0.3)

    def test_it_is_found_on_loopback(self):
        self.start("omniscan450", options="discovery: 127.0.0.5")
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as seeker:
            seeker.settimeout(5)
            seeker.sendto(b"Discovery", ("127.0.0.5", 30303))
            lines = seeker.recv(1500).decode().split("\r\n")
        self.assertEqual(lines[1], "Cerulean Sonar")
        self.assertEqual(lines[3], "IP Address:- 127.0.0.5")
        self.assertRegex(lines[4], r"^Port:- \d+$")


class Sounder(CeruleanCase):
    def test_depth_of_a_flat_bottom_with_every_effect(self):
        for depth in (2.5, 12.0):
            with self.subTest(depth=depth):
                host = self.start("s500", FLAT, FLAT_Z + depth, "0, 90, 0")
                host.say(wire.s500_ping_params(length_mm=20000, msec_per_ping=60))
                soundings = [host.sounding() for _ in range(20)]
                for sounding in soundings:
                    self.assertAlmostEqual(sounding.depth, depth, delta=2 * 20 / 1024)
                    self.assertGreater(sounding.confidence, 80)
                self.assertAlmostEqual(soundings[-1].smooth_depth, depth, delta=2 * 20 / 1024)

    def test_depth_follows_the_hosts_speed_of_sound(self):
        host = self.start("s500", FLAT, FLAT_Z + 10, "0, 90, 0")
        host.say(wire.speed_of_sound(1450), wire.s500_ping_params(length_mm=20000))
        self.assertAlmostEqual(host.sounding().depth, 10 * 1450 / 1500, delta=0.05)

    def test_without_a_bottom_it_says_so(self):
        host = self.start("s500", FLAT, FLAT_Z + 10, "0, 90, 0", effects=SHARP)
        host.say(wire.s500_ping_params(length_mm=6000, report_id=wire.DISTANCE2))
        distance = wire.read_distance2(host.wait(wire.DISTANCE2)[1])
        self.assertLess(distance.confidence, 30)

    def test_automatic_range_finds_the_bottom_and_a_chirp_resolves_it(self):
        host = self.start("s500", FLAT, FLAT_Z + 15, "0, 90, 0")
        host.say(wire.s500_ping_params(length_mm=0, msec_per_ping=0, chirp=1))
        sounding = host.settled(host.sounding, lambda s: 15 / 0.8 <= s.profile.length <= 15 / 0.4 and s.confidence > 80)
        self.assertAlmostEqual(sounding.depth, 15, delta=0.03)
        self.assertEqual(sounding.hertz, (450000, 550000))
        self.assertGreater(len(sounding.profile.raw), 1000)
        self.assertLessEqual(len(sounding.profile.raw), 2000)

    def test_a_serial_line_takes_its_time_and_never_queues(self):
        host = self.start("s500", rpy="0, 90, 0", link="pty", options="baud: 115200")
        said = time.monotonic()
        host.say(b"U", wire.s500_ping_params(length_mm=5000, msec_per_ping=20))
        arrivals = [host.wait(wire.PROFILE6)[0] for _ in range(6)]
        wire_time = 10 * (10 + 66 + 2048) / 115200
        self.assertGreaterEqual((arrivals[-1] - said) / 6, wire_time, "whenever a busy reader saw the first")
        self.assertLess((arrivals[-1] - arrivals[0]) / 5, wire_time + 0.05)
        asked = time.monotonic()
        host.say(request(5))
        host.wait(5)
        self.assertLess(time.monotonic() - asked, 2 * wire_time + 0.1, "nothing waits but the profile on the line")

    def test_a_single_ping_is_one(self):
        host = self.start("s500", rpy="0, 90, 0", link="udp")
        host.say(wire.s500_ping_params(msec_per_ping=-1))
        self.assertEqual(host.sounding().profile.number, 0)
        self.assertRaises(AssertionError, host.wait, wire.PROFILE6, 0.3)


if __name__ == "__main__":
    unittest.main()
