"""A clock that is set back while a capture is written: the order of the file rules, times give the gaps, the step makes
none and is told once. Every reader; replay, inspect and diff."""
import json
import socket
import struct
import unittest

from captures import RAW, RTAC_SERIAL, Pcapng, ethernet, ipv4, rtac, udp
from program import ProgramTest, run
from test_capture_files import device_data, ping_frame, ping_viewer_log

FORTH = [5000.0 + 0.2 * i for i in range(10)]   # 5000.0 to 5001.8
BACK = [4999.0 + 0.2 * i for i in range(15)]    # 4999.0 to 5001.8
TIMES = FORTH + BACK
LENGTH = 1.8 + 2.8  # s: the step back makes no gap


def pcap(times):
    packets = [ethernet(ipv4(udp(device_data(i)))) for i in range(len(times))]
    parts = [struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 262144, 1)]
    for time, packet in zip(times, packets):
        parts += [struct.pack("<IIII", int(time), round(time % 1 * 1e6), len(packet), len(packet)), packet]
    return b"".join(parts)


def pcapng(times):
    capture = Pcapng().interface(RTAC_SERIAL, b"head line")
    for i, time in enumerate(times):
        capture.packet(0, rtac(device_data(i), 1), round(time * 1e9))
    return capture.data


def serial_log(times):
    return "".join(f"{time:.3f} < {device_data(i).hex()}\n" for i, time in enumerate(times)).encode()


def viewer_log(times):
    return ping_viewer_log([("01:%02d:%06.3f" % divmod(time % 3600, 60), device_data(i)) for i, time in enumerate(times)])


def svlog(times):
    """Omniscan profiles, whose time is the head's in ms."""
    profile = struct.pack("<5I3HBB6f", 1, 0, 5000, 2000, 450000, 4, 2, 15000, 0, 0, 1e-4, 1, 0, -90, 0, 0)
    frames = [ping_frame(2198, profile[:12] + struct.pack("<I", round(time * 1000)) + profile[16:] + bytes(4), 1)
              for time in times]
    return ping_frame(10, b'{"session_id": 1}', 0) + b"".join(frames)


READERS = {"pcap": pcap, "pcapng": pcapng, "text": serial_log, ".bin": viewer_log, ".svlog": svlog}


class ClockSteps(ProgramTest):
    def file(self, data, name="capture"):
        path = self.folder / name
        path.write_bytes(data)
        return path

    def ports(self, path):
        done = run("replay", path, "--list", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout), done.stderr.decode()

    def assert_steps_once(self, path, pieces, length, delta=0.002):
        found, told = self.ports(path)
        port, = found["ports"]
        self.assertEqual((port["device"]["pieces"], found["clock_steps_back"]), (pieces, 1), path)
        self.assertAlmostEqual(port["end"], length, delta=delta)
        self.assertEqual(told.count("steps back"), 1, told)
        return told

    def test_every_reader_keeps_all_gaps_but_that_of_the_step(self):
        for name, made in READERS.items():
            with self.subTest(name):
                told = self.assert_steps_once(self.file(made(TIMES), "a" + name), 25, LENGTH)
                self.assertRegex(told, r"the clock of the file steps back by 2\.8 s at (packet|message) 11; no gap")

    def test_a_replay_says_all_of_them_at_their_times(self):
        speed = 20
        for name, made in READERS.items():
            with self.subTest(name), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as listener:
                listener.bind(("127.0.0.1", 0))
                place = "udp://127.0.0.1:%d" % listener.getsockname()[1]
                done = run("replay", self.file(made(TIMES), "a" + name), place, "--start", "now", "--speed", speed, "--json")
                self.assertEqual(done.returncode, 0, done.stderr)
                ended = json.loads(done.stdout.splitlines()[-1])
                self.assertEqual(ended["messages"], 25)
                self.assertGreater(ended["seconds"], 0.98 * LENGTH / speed)
                self.assertEqual(done.stderr.count(b"steps back"), 1)

    def test_three_lines_and_three_earlier_ones_do_hold_times(self):
        log = "".join(f"{time} < {device_data(i).hex()}\n" for i, time in enumerate([10, 10, 10, 3, 3, 3]))
        done = run("replay", self.file(log.encode()), "udp://127.0.0.1:20999", "--start", "now", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(b'"messages":6', done.stdout.replace(b" ", b""))

    def test_inspect_and_diff_tell_it_and_take_all(self):
        stepped, steady = pcapng(TIMES), pcapng([1000 + 0.2 * i for i in range(10)] + [1001.8 + 0.2 * i for i in range(15)])
        done = run("inspect", self.file(stepped), "--json")
        times = [message["time"] for message in json.loads(done.stdout)["messages"]]
        self.assertEqual(len(times), 25)
        self.assertEqual(times, sorted(times))
        self.assertAlmostEqual(times[-1], LENGTH, places=5)
        self.assertEqual(done.stderr.count(b"steps back"), 1)
        done = run("diff", self.file(stepped, "a"), self.file(steady, "b"), "--json")
        report = json.loads(done.stdout)
        self.assertTrue(report["equal"])
        type_, = report["directions"][0]["types"]
        self.assertEqual(type_["gap"]["a"], type_["gap"]["b"])
        self.assertEqual(done.stderr.count(b"steps back"), 1)

    def test_several_steps_are_told_in_one_line(self):
        found, told = self.ports(self.file(serial_log([9, 9.5, 4, 4.5, 1, 1.5, 0])))
        self.assertEqual((found["clock_steps_back"], found["ports"][0]["end"]), (3, 1.5))
        self.assertRegex(told, "steps back by 5.5 s at packet 3, and 2 times more; no gap")
        self.assertEqual(len(told.splitlines()), 1)

    def test_what_two_processors_wrote_in_turn_is_no_step(self):
        found, told = self.ports(self.file(pcap([1.0, 1.1, 1.2, 1.199998, 1.3])))
        self.assertEqual((found["clock_steps_back"], told), (0, ""))
        self.assertAlmostEqual(found["ports"][0]["end"], 0.3, places=4)

    def test_a_second_interface_that_is_written_late_is_no_step(self):
        capture = Pcapng().interface(RAW, b"eth0").interface(RAW, b"eth1")
        for i in range(10):
            capture.packet(0, ipv4(udp(device_data(i))), round((100 + i) * 1e9))
            capture.packet(1, ipv4(udp(device_data(i))), round((99.2 + i) * 1e9))
        found, told = self.ports(self.file(capture.data))
        self.assertEqual((found["clock_steps_back"], told), (0, ""))
        self.assertAlmostEqual(found["ports"][0]["end"], 9)

    def test_both_interfaces_step_and_it_is_one_step(self):
        capture = Pcapng().interface(RAW, b"eth0").interface(RAW, b"eth1")
        for second in [*range(100, 110), *range(50, 60)]:
            for interface in (0, 1):
                capture.packet(interface, ipv4(udp(device_data(second))), round((second + 0.1 * interface) * 1e9))
        self.assert_steps_once(self.file(capture.data), 40, 18.1)

    def test_a_real_852_behind_itself(self):
        data = self.shared("imagenex852", "19_26_51-2016_11_18-sonar.852").read_bytes()[:100 * 640]
        single, _ = self.ports(self.file(data, "once.852"))
        self.assert_steps_once(self.file(2 * data, "twice.852"), 200, 2 * single["ports"][0]["end"])

    def test_a_real_sonar_3d_15_behind_itself(self):
        data = self.shared("sonar-3d-15", "ship_short.sonar").read_bytes()
        single, _ = self.ports(self.file(data, "once.sonar"))
        self.assert_steps_once(self.file(2 * data, "twice.sonar"), 24, 2 * single["ports"][0]["end"], delta=0.2)


if __name__ == "__main__":
    unittest.main()
