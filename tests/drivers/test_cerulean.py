"""The maker's Python package, as it is, drives two Omniscan 450 and an S500 over TCP and UDP, and finds the walls and the
floor of the tank. Its classes wait without end for a device that says nothing, so each test has a watchdog."""

import collections
import contextlib
import faulthandler
import io
import json
import socket
import statistics
import struct
import subprocess
import tempfile
import threading
import unittest
from pathlib import Path

import public_driver

public_driver.use("ping360", "brping")

from brping import S500, Omniscan450, definitions  # noqa: E402
from ports import free_port  # noqa: E402
from program import PROGRAM, Emulator  # noqa: E402

SOUND_SPEED = 1500.0
TO_PORT, TO_STERN, TO_FLOOR = 4.0, 6.0, 2.0  # m, from (0, 0, -2) to the tank's walls and its floor

TANK = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - name: port
    model: omniscan450
    mount: {rpy_deg: [0, 0, 90]}
    endpoints: ["tcp-listen://127.0.0.1:%d", "udp-listen://127.0.0.1:%d"]
    options: {mount_bearing: -90, speed_of_sound_id: "1002"}
  - name: stern
    model: omniscan450
    mount: {rpy_deg: [0, 0, 180]}
    endpoints: ["tcp-listen://127.0.0.1:%d"]
    options: {channel_number: 1, mount_bearing: 180, speed_of_sound_id: "1002"}
  - name: s500
    model: s500
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["tcp-listen://127.0.0.1:%d", "udp-listen://127.0.0.1:%d"]
    options: {temperature_bytes: "4"}  # the package knows nothing else
"""
# Edges to a bin need a beam with edges, steady levels and direct echoes only; noise, pulse and gain stay on.
SHARP = """
effects: {beam_pattern: off, side_lobes: off, speckle: off, multipath: off, second_time_around: off, sensor_noise: off}
"""
PROFILE, DEPTH, DISTANCE = (
    definitions.OMNISCAN450_OS_MONO_PROFILE,
    definitions.S500_PROFILE6_T,
    definitions.S500_DISTANCE2,
)


def leading_edge(levels):
    """First bin within 20 dB of the strongest: the echo of a wall grows while the pulse passes over it."""
    strongest = max(levels)
    return next(i for i, level in enumerate(levels) if level >= strongest - 20)


class Cerulean(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.udp = free_port(2)
        cls.tcp = [free_port() for _ in range(3)]
        ports = (cls.tcp[0], cls.udp, cls.tcp[1], cls.tcp[2], cls.udp + 1)
        cls.emulator = Emulator(SHARP + TANK % ports)
        cls.emulator.__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.emulator.__exit__(None, None, None)

    def setUp(self):
        end_of_patience = threading.Timer(60, self.emulator.process.kill)  # ends a wait on TCP
        end_of_patience.start()
        self.addCleanup(end_of_patience.cancel)
        faulthandler.dump_traceback_later(65, exit=True)
        self.enterContext(contextlib.redirect_stdout(io.StringIO()))  # the package prints what it opens

    def tearDown(self):
        faulthandler.cancel_dump_traceback_later()

    def connect(self, sonar, kind, port):
        sonar._input_buffer = collections.deque()  # the package's is one for all devices of a process
        (sonar.connect_tcp if kind == "tcp" else sonar.connect_udp)("127.0.0.1", port)
        self.addCleanup(sonar.iodev.close)
        self.assertTrue(sonar.initialize())
        return sonar

    def next_profiles(self, sonar, message, count):
        found = [sonar.wait_message([message], timeout=5) for _ in range(count)]
        self.assertNotIn(None, found)
        return found

    def settled(self, sonar, message, is_new):
        """The first profile that has what was just set."""
        for _ in range(20):
            (found,) = self.next_profiles(sonar, message, 1)
            if is_new(found):
                return found
        self.fail("what was set did not change the pings")

    def check_wall(self, sonar, profile, distance, resolution=0.0):
        """The wall is where it is to a bin, or to a chirp's resolution. Half a metre around it, since the fan also meets the
        floor."""
        bin_size = profile.length_mm / 1000 / profile.num_results
        first = int((distance - 0.5 - profile.start_mm / 1000) / bin_size)
        levels = sonar.scale_power(profile)[first : first + int(1 / bin_size)]
        middle = profile.start_mm / 1000 + (first + leading_edge(levels) + 0.5) * bin_size
        self.assertLess(abs(middle - distance), max(bin_size, resolution) * 1.01)


class Omniscan(Cerulean):
    def ping(self, sonar, **changes):
        settings = {"length_mm": 9000, "msec_per_ping": 50, "num_results": 1200, "gain_index": 2, **changes}
        sonar.control_os_ping_params(**settings)
        return self.settled(
            sonar, PROFILE, lambda p: (p.length_mm, p.num_results) == (settings["length_mm"], settings["num_results"])
        )

    def stop(self, sonar):
        sonar.control_os_ping_params(enable=False)

    def test_walls_are_where_they_are_over_tcp_and_udp(self):
        for kind, port, distance in (("tcp", self.tcp[0], TO_PORT), ("udp", self.udp, TO_PORT), ("tcp", self.tcp[1], TO_STERN)):
            with self.subTest(kind, port=port):
                sonar = self.connect(Omniscan450(), kind, port)
                sonar.control_set_speed_of_sound(int(SOUND_SPEED * 1000))
                for changes in ({}, {"length_mm": 12000, "num_results": 600}, {"start_mm": 1000, "length_mm": 6000}):
                    profile = self.ping(sonar, **changes)
                    self.check_wall(sonar, profile, distance)
                self.stop(sonar)

    def test_pace_is_the_hosts_and_no_ping_is_lost(self):
        sonar = self.connect(Omniscan450(), "tcp", self.tcp[0])
        for wanted in (40, 100):
            self.ping(sonar, msec_per_ping=wanted)
            profiles = self.next_profiles(sonar, PROFILE, 40)[2:]
            times = [b.timestamp_ms - a.timestamp_ms for a, b in zip(profiles, profiles[1:])]
            self.assertAlmostEqual(statistics.median(times), wanted, delta=1)  # a busy machine is late at times
            numbers = [p.ping_number for p in profiles]
            self.assertEqual(numbers, list(range(numbers[0], numbers[0] + len(numbers))))
        self.stop(sonar)

    def test_gain_pulse_and_range_change_the_picture(self):
        sonar = self.connect(Omniscan450(), "tcp", self.tcp[0])
        low = self.ping(sonar, gain_index=1)
        self.assertEqual(low.gain_index, 1)
        sonar.control_os_ping_params(length_mm=9000, msec_per_ping=50, num_results=1200, gain_index=3, pulse_len_percent=0.008)
        high = self.settled(sonar, PROFILE, lambda p: p.gain_index == 3)
        self.assertGreater(high.analog_gain, 2 * low.analog_gain)
        self.assertAlmostEqual(high.pulse_duration_sec / low.pulse_duration_sec, 4, places=3)
        self.assertGreater(high.max_pwr_db, low.max_pwr_db + 3)
        self.assertEqual((min(high.pwr_results), max(high.pwr_results)), (0, 65535))
        self.assertLessEqual(high.max_pwr_db - high.min_pwr_db, 90.001)
        self.stop(sonar)

    def test_two_sonars_at_once_as_a_ros_host_has_them(self):
        """One connection each, 1002, msec_per_ping as the loop's rate, and the headings of both sides."""
        pair = [self.connect(Omniscan450(), "tcp", port) for port in self.tcp[:2]]
        for sonar in pair:
            sonar.control_set_speed_of_sound(1482000)
            self.ping(sonar, num_results=600)
        for _ in range(10):
            port, stern = (self.next_profiles(sonar, PROFILE, 1)[0] for sonar in pair)
            self.assertEqual((port.sos_dmps, stern.sos_dmps), (14820, 14820))
            self.assertEqual((port.channel_number, stern.channel_number), (0, 1))
            self.assertAlmostEqual(port.transducer_heading_deg, 0, places=2)
            self.assertAlmostEqual(stern.transducer_heading_deg, 270, places=2)
            self.assertAlmostEqual(port.vehicle_heading_deg, 90, places=2)
            self.assertAlmostEqual(stern.vehicle_heading_deg, 90, places=2)
        for sonar in pair:
            self.stop(sonar)

    def test_its_log_reads_back_and_inspect_names_its_messages(self):
        with tempfile.TemporaryDirectory() as folder:
            sonar = Omniscan450(logging=True, log_directory=folder)
            self.connect(sonar, "tcp", self.tcp[0])
            self.ping(sonar, num_results=1200)
            self.next_profiles(sonar, PROFILE, 5)
            self.stop(sonar)
            (log,) = Path(folder).glob("*.svlog")
            with open(log, "rb") as file:
                packets = list(iter(lambda: Omniscan450.read_packet(file), None))
            self.assertEqual(packets[0].message_id, definitions.OMNISCAN450_JSON_WRAPPER)
            self.assertGreaterEqual([p.message_id for p in packets].count(PROFILE), 5)
            self.check_inspect(log, len(packets))

    def check_inspect(self, log, count):
        text = subprocess.run([PROGRAM, "inspect", str(log), "--json"], capture_output=True, check=True, timeout=60).stdout
        read = json.loads(text)
        self.assertEqual(len(read["messages"]), count)
        self.assertEqual(read["summary"]["messages"]["JsonWrapper"], 1)
        self.assertGreaterEqual(read["summary"]["messages"]["OsMonoProfile"], 5)

    def test_the_parameters_of_the_makers_manual_are_two_bytes_shorter(self):
        """A ROS host of its own packs them so, and says the speed of sound in m/s, which must not matter."""

        def packet(number, payload):
            body = struct.pack("<2sHHBB", b"BR", len(payload), number, 0, 0) + payload
            return body + struct.pack("<H", sum(body) & 0xFFFF)

        def receive(link):
            start, size, number = struct.unpack("<2sHHxx", link.recv(8, socket.MSG_WAITALL))
            self.assertEqual(start, b"BR")
            return number, link.recv(size + 2, socket.MSG_WAITALL)

        with socket.create_connection(("127.0.0.1", self.tcp[1]), timeout=5) as link:
            link.sendall(packet(116, struct.pack("<I", 1515)))
            link.sendall(packet(2197, struct.pack("<IIIffffhHBB", 0, 20000, 0, 0, 0, 0.002, 0.0015, -1, 200, 1, 0)))
            profiles = [payload for number, payload in (receive(link) for _ in range(10)) if number == 2198]
            self.assertGreaterEqual(len(profiles), 7)
            self.assertEqual(struct.unpack_from("<H", profiles[-1], 22)[0], 200)
            self.assertEqual(struct.unpack_from("<H", profiles[-1], 24)[0], 15000)
            link.sendall(packet(2197, struct.pack("<IIIffffhHBB", 0, 20000, 0, 0, 0, 0.002, 0.0015, -1, 200, 0, 0)))


class Sounder(Cerulean):
    def test_depth_and_profile_show_the_floor(self):
        for kind, port in (("tcp", self.tcp[2]), ("udp", self.udp + 1)):
            with self.subTest(kind):
                sonar = self.connect(S500(), kind, port)
                sonar.control_set_speed_of_sound(int(SOUND_SPEED * 1000))
                sonar.control_set_ping_params(length_mm=5000, msec_per_ping=50, report_id=DEPTH)
                profile = self.next_profiles(sonar, DEPTH, 22)[-1]
                self.assertEqual(profile.num_results, 1024)
                self.check_wall(sonar, profile, TO_FLOOR)
                self.assertAlmostEqual(profile.this_ping_depth_m, TO_FLOOR, delta=0.01)
                self.assertAlmostEqual(profile.smooth_depth_m, TO_FLOOR, delta=0.01)
                self.assertGreater(profile.ping_depth_measurement_confidence, 90)
                sonar.control_set_ping_params(length_mm=5000, msec_per_ping=50, report_id=DISTANCE)
                (distance,) = self.next_profiles(sonar, DISTANCE, 1)
                self.assertAlmostEqual(distance.averaged_distance_mm, 1000 * TO_FLOOR, delta=10)
                sonar.control_set_ping_params(report_id=0)

    def test_automatic_range_and_chirp(self):
        sonar = self.connect(S500(), "udp", self.udp + 1)
        sonar.control_set_ping_params(length_mm=0, msec_per_ping=50, report_id=DEPTH, chirp=1)
        profile = self.settled(sonar, DEPTH, lambda p: p.length_mm in (3000, 4000) and p.end_ping_hz > p.start_ping_hz)
        self.assertGreaterEqual(profile.num_results, 1000)
        self.check_wall(sonar, profile, TO_FLOOR, SOUND_SPEED / 2 / (profile.end_ping_hz - profile.start_ping_hz))
        sonar.control_set_ping_params(report_id=0)

    def test_a_single_ping_is_one(self):
        sonar = self.connect(S500(), "tcp", self.tcp[2])
        sonar.control_set_ping_params(length_mm=5000, msec_per_ping=-1, report_id=DEPTH)
        (first,) = self.next_profiles(sonar, DEPTH, 1)
        sonar.control_set_ping_params(length_mm=5000, msec_per_ping=-1, report_id=DEPTH)
        (second,) = self.next_profiles(sonar, DEPTH, 1)
        self.assertEqual(second.ping_number, first.ping_number + 1)

    def test_every_get_of_the_package_is_answered(self):
        sonar = self.connect(S500(), "tcp", self.tcp[2])
        sonar.control_set_ping_params(length_mm=5000, msec_per_ping=50, gain_index=4, report_id=DISTANCE)
        self.next_profiles(sonar, DISTANCE, 2)
        self.assertEqual(sonar.get_range(), {"start_mm": 0, "length_mm": 5000})
        self.assertEqual(sonar.get_gain_index(), {"gain_index": 4})
        self.assertEqual(sonar.get_ping_rate_msec(), {"msec_per_ping": 50})
        self.assertEqual(sonar.get_speed_of_sound(), {"sos_mm_per_sec": 1500000})
        self.assertEqual(sonar.get_processor_degC(), {"centi_degC": 4000})
        self.assertAlmostEqual(sonar.get_altitude()["altitude_mm"], 1000 * TO_FLOOR, delta=10)
        self.assertEqual(sonar.get_fw_version()["version_major"], 1)
        self.assertGreater(sonar.get_profile6_t()["num_results"], 1000)
        self.assertEqual(sonar.get_device_information()["device_type"], 198)
        sonar.control_set_ping_params(report_id=0)


if __name__ == "__main__":
    del Cerulean
    unittest.main()
