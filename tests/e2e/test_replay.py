"""`echoloop replay`: captures made by hand, played to drivers that note what came and when."""

import contextlib
import functools
import json
import os
import socket
import struct
import subprocess
import termios
import time
import unittest

from ports import free_port
from program import PROGRAM, ROOT
from replaying import Folder, Replay, open_line, read_line, udp_listener

from captures import ETHERNET, RAW, RTAC_SERIAL, Pcapng, ethernet, fragments, ipv4, pcap, rtac, tcp

MILLISECOND = 1_000_000
BUSY = os.getloadavg()[0] > 1.5 * os.cpu_count()  # with other things
USUAL, WORST = (0.020, 0.100) if BUSY else (0.004, 0.040)  # s that a gap may be off: most of them, and any
SENT, RECEIVED = 1, 2
GRACE = 100  # ms that a driver gets to set its line up
SHARED = ROOT.parent / "shared" / "data"


def with_patience(test):
    """Times are those of a machine that does other things, too: one good run of three will do."""

    @functools.wraps(test)
    def attempts(self):
        for _ in range(2):
            with contextlib.suppress(AssertionError):
                return test(self)
        return test(self)

    return attempts


def udp(payload, source=65500, destination=4000):
    return struct.pack(">HHHH", source, destination, len(payload) + 8, 0) + payload


def on_udp(messages, **ports):
    """A pcapng of datagrams: [(ms, payload)]."""
    file = Pcapng().interface(ETHERNET)
    for at, payload in messages:
        file.packet(0, ethernet(ipv4(udp(payload, **ports))), at * MILLISECOND)
    return file.data


def on_lines(messages, names=(b"micron line",)):
    """A pcapng of serial lines: [(ms, event, payload)] or [(ms, event, payload, line)]."""
    file = Pcapng()
    for name in names:
        file.interface(RTAC_SERIAL, name)
    for at, event, payload, *line in messages:
        file.packet(line[0] if line else 0, rtac(payload, event), at * MILLISECOND)
    return file.data


def gaps(times):
    return [b - a for a, b in zip(times, times[1:])]


class Played(unittest.TestCase):
    def setUp(self):
        folder = Folder()
        self.addCleanup(folder.remove)
        self.file = folder.file
        self.folder = folder.path

    def assert_gaps(self, times, milliseconds):
        errors = sorted(abs(got - wanted / 1000) for got, wanted in zip(gaps(times), milliseconds, strict=True))
        self.assertLess(errors[-1], WORST, errors)
        if len(errors) > 2:
            self.assertLess(errors[len(errors) // 2], USUAL, errors)

    def refused(self, status, *arguments):
        done = subprocess.run([PROGRAM, "replay", *map(str, arguments)], capture_output=True, check=False, timeout=20,
                              stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stderr.decode()


class Datagrams(Played):
    TIMES = (5000, 5040, 5041, 5200, 5290)  # ms
    SAID = [bytes([n]) * (n * 30) for n in range(1, 6)]

    def heard(self, capture, *arguments, count=5, ends=True, endpoint="udp://127.0.0.1:%d"):
        with udp_listener() as listener:
            with Replay(capture, endpoint % listener.getsockname()[1], *arguments) as replay:
                times, said = [], []
                for _ in range(count):
                    said.append(listener.recv(65536))
                    times.append(time.monotonic())
                status, output = replay.end() if ends else replay.stop()
        self.assertEqual(status, 0, output)
        return times, said, output

    @with_patience
    def test_each_comes_whole_after_its_gap(self):
        capture = self.file("a.pcapng", on_udp(zip(self.TIMES, self.SAID)))
        times, said, output = self.heard(capture)
        self.assertEqual(said, self.SAID)
        self.assert_gaps(times, gaps(self.TIMES))
        self.assertIn("5 messages of 450 bytes", output)

    @with_patience
    def test_twice_as_fast(self):
        capture = self.file("a.pcapng", on_udp(zip(self.TIMES, self.SAID)))
        times, said, _ = self.heard(capture, "--speed", 2)
        self.assertEqual(said, self.SAID)
        self.assert_gaps(times, [gap / 2 for gap in gaps(self.TIMES)])

    @with_patience
    def test_a_part_of_it_again_and_again(self):
        capture = self.file("a.pcapng", on_udp(zip(self.TIMES, self.SAID)))
        times, said, _ = self.heard(capture, "--from", 0.03, "--until", 0.25, "--loop", count=7, ends=False)
        self.assertEqual(said, (self.SAID[1:4] * 3)[:7])
        self.assert_gaps(times, [1, 159, 159, 1, 159, 159])  # between laps: the gap of the last message

    def test_fragments_are_one_datagram(self):
        payload = bytes(range(256)) * 8
        packets = [ethernet(p) for p in fragments(udp(payload), 1480)]
        _, said, _ = self.heard(self.file("a.pcap", pcap(packets)), count=1)
        self.assertEqual(said, [payload])

    def test_json_says_where_it_plays_and_what_was_played(self):
        capture = self.file("a.pcapng", on_udp(zip(self.TIMES, self.SAID)))
        with udp_listener() as listener:
            place = f"udp://127.0.0.1:{listener.getsockname()[1]}"
            done = subprocess.run([PROGRAM, "replay", capture, place, "--json", "--speed", "100"], capture_output=True,
                                  check=True, timeout=20, stdin=subprocess.DEVNULL)
        started, ended = map(json.loads, done.stdout.splitlines())
        self.assertEqual([port["name"] for port in started["ports"]], ["10.0.0.86:65500 - 10.0.1.102:4000 (UDP)"])
        self.assertEqual((ended["messages"], ended["bytes"], ended["bytes_taken"]), (5, 450, 450))

    def test_nothing_goes_where_the_capture_came_from(self):
        with udp_listener() as source, udp_listener() as destination:
            ends = {"source": source.getsockname()[1], "destination": destination.getsockname()[1]}
            packets = [ethernet(ipv4(udp(said, **ends)).replace(bytes([10, 0, 0, 86]), bytes([127, 0, 0, 1]))
                                .replace(bytes([10, 0, 1, 102]), bytes([127, 0, 0, 1]))) for said in self.SAID]
            file = Pcapng().interface(ETHERNET)
            for i, packet in enumerate(packets):
                file.packet(0, packet, i * MILLISECOND)
            self.heard(self.file("a.pcapng", file.data))
            for end in (source, destination):
                end.setblocking(False)
                self.assertRaises(BlockingIOError, end.recv, 65536)

    @with_patience
    def test_a_recording_of_a_real_sonar(self):
        real = SHARED / "r2sonic" / "r2sonic_bth0_20.pcap"
        if not real.exists():
            self.assertNotEqual(os.environ.get("CI"), "true", f"{real} is missing")
            self.skipTest(f"{real} is not here")
        packets = list(pcap_packets(real.read_bytes()))
        with udp_listener() as listener, Replay(real, f"udp://127.0.0.1:{listener.getsockname()[1]}") as replay:
            times = []
            for _, packet in packets:
                self.assertEqual(listener.recv(65536), packet[42:])
                times.append(time.monotonic())
            self.assertEqual(replay.end()[0], 0)
        self.assert_gaps(times, [1000 * gap for gap in gaps([at for at, _ in packets])])


def pcap_packets(data):
    """(s, bytes) of each packet of a little-endian pcap file."""
    nano = data[:4] == b"\x4d\x3c\xb2\xa1"
    at = 24
    while at < len(data):
        seconds, fraction, size, _ = struct.unpack_from("<IIII", data, at)
        yield seconds + fraction * (1e-9 if nano else 1e-6), data[at + 16:at + 16 + size]
        at += 16 + size


class Streams(Played):
    LINE = [(1000, RECEIVED, b"ask"), (1100, SENT, b"first "), (1150, RECEIVED, b"more"), (1250, SENT, b"second "),
            (1251, SENT, b"third "), (1400, SENT, b"last")]
    SAID = b"first second third last"

    @with_patience
    def test_a_line_on_a_pty_begins_when_a_driver_opens_it(self):
        capture = self.file("a.pcapng", on_lines(self.LINE))
        with Replay(capture, f"pty:{self.folder}/line") as replay:
            begin = time.monotonic()
            line = open_line(self.folder / "line")
            pieces = read_line(line, len(self.SAID))
            self.assertEqual(b"".join(data for _, data in pieces), self.SAID)
            self.assert_gaps([begin, pieces[0][0], pieces[-1][0]], [GRACE + 100, 300])
            status, output = replay.end()
            os.close(line)
        self.assertEqual(status, 0, output)
        self.assertIn("4 messages of 23 bytes", output)

    @with_patience
    def test_who_opens_a_line_and_flushes_it_loses_nothing(self):
        capture = self.file("a.pcapng", on_lines([(0, SENT, b"first"), (40, SENT, b"second")]))
        with Replay(capture, f"pty:{self.folder}/line"):
            line = open_line(self.folder / "line")
            time.sleep(0.03)  # as long as a driver's setting up takes
            termios.tcflush(line, termios.TCIOFLUSH)
            self.assertEqual(b"".join(data for _, data in read_line(line, 11)), b"firstsecond")
            os.close(line)

    def test_the_drivers_side_can_be_played_too(self):
        capture = self.file("a.pcapng", on_lines(self.LINE))
        with Replay(capture, f"pty:{self.folder}/line", "--direction", "driver"):
            line = open_line(self.folder / "line")
            self.assertEqual(b"".join(data for _, data in read_line(line, 7)), b"askmore")
            os.close(line)

    @with_patience
    def test_a_paced_line_has_said_all_of_a_message_at_its_time(self):
        capture = self.file("a.pcapng", on_lines([(0, RECEIVED, b"ask"), (500, SENT, bytes(300)), (1000, SENT, b"x")]))
        with Replay(capture, f"pty:{self.folder}/line", "--baud", 9600):
            begin = time.monotonic()
            line = open_line(self.folder / "line")
            pieces = read_line(line, 301)
            os.close(line)
        self.assert_gaps([pieces[0][0], pieces[-2][0]], [312])  # 300 bytes of 10 bits, the first one at once
        self.assert_gaps([begin, pieces[-2][0], pieces[-1][0]], [GRACE + 500, 500])

    def test_tcp_segments_come_in_their_order_to_who_connects(self):
        parts = [(b"", 99, 2), (b"two ", 104), (b"one ", 100), (b"two ", 104), (b"three", 108)]
        capture = self.file("a.pcap", pcap([ethernet(ipv4(tcp(*part), protocol=6)) for part in parts]))
        port = free_port()
        with Replay(capture, f"tcp-listen://127.0.0.1:{port}", "--speed", 100) as replay:
            with socket.create_connection(("127.0.0.1", port), timeout=20) as driver:
                said = b""
                while piece := driver.recv(4096):
                    said += piece
            self.assertEqual(said, b"one two three")
            self.assertEqual(replay.end()[0], 0)

    def test_of_several_ports_one_is_chosen(self):
        lines = on_lines([(0, SENT, b"a", 0), (1, SENT, b"b", 1)], (b"one line", b"other line"))
        capture = self.file("a.pcapng", lines)
        place = f"pty:{self.folder}/line"
        text = self.refused(64, capture, place)
        self.assertIn("'one line'", text)
        self.assertIn("choose one with --port", text)
        self.assertIn("no port 'third'", self.refused(64, capture, place, "--port", "third"))
        for port in ("other line", "other"):  # the device's name is enough where it has one port
            with Replay(capture, place, "--port", port):
                line = open_line(self.folder / "line")
                self.assertEqual(read_line(line, 1)[0][1], b"b")
                os.close(line)
        both = self.file("b.pcapng", on_lines([(0, SENT, b"a", 0), (1, SENT, b"b", 1)], (b"one line", b"one other")))
        self.assertIn("'one' has several ports; name one", self.refused(64, both, place, "--port", "one"))

    def test_several_ports_at_once(self):
        capture = self.file("a.pcapng", on_lines([(0, SENT, b"a", 0), (1, SENT, b"b", 1)], (b"one", b"other=1")))
        with udp_listener() as one, udp_listener() as other:
            places = [f"{name}=udp://127.0.0.1:{s.getsockname()[1]}" for name, s in (("one", one), ("other=1", other))]
            with Replay(capture, "--play", places[0], "--play", places[1]) as replay:
                self.assertEqual((one.recv(10), other.recv(10)), (b"a", b"b"))
                self.assertEqual(replay.end()[0], 0)

    def test_what_cannot_be_played_is_refused_with_its_reason(self):
        capture = self.file("a.pcapng", on_lines(self.LINE))
        self.assertIn("ENDPOINT is missing", self.refused(64, capture))
        self.assertIn("--until must be later", self.refused(64, capture, "pty:/tmp/x", "--from", 2, "--until", 1))
        self.assertIn("known scheme", self.refused(64, capture, "nonsense"))
        self.assertIn("save standard input", self.refused(64, "-", "pty:/tmp/x"))
        self.assertIn("nothing to play", self.refused(64, self.file("b.pcapng", Pcapng().data), "pty:/tmp/x"))
        self.refused(66, self.folder / "missing", "pty:/tmp/x")
        self.assertIn("'%s' is empty; a tcpdump that still runs" % (self.folder / "e.pcap"),
                      self.refused(65, self.file("e.pcap", b""), "pty:/tmp/x"))
        cut = capture.read_bytes()[:-30]
        self.assertIn("the last block is cut short",
                      self.refused(64, self.file("c.pcapng", cut), "pty:/tmp/x", "--port", "none"))


def ping_frame(number, payload, source=0):
    frame = b"BR" + struct.pack("<HHBB", len(payload), number, source, 0) + payload
    return frame + struct.pack("<H", sum(frame) & 0xFFFF)


def get(number):
    """general_request: send that message."""
    return ping_frame(6, struct.pack("<H", number))


VOLTAGE, INTERVAL = 1202, 1206
VOLTS = [ping_frame(VOLTAGE, struct.pack("<H", mv), 1) for mv in (4900, 5000, 5100)]
PACE = ping_frame(INTERVAL, struct.pack("<H", 100), 1)
ASKED = [(0, RECEIVED, get(VOLTAGE)), (40, SENT, VOLTS[0]), (100, RECEIVED, get(INTERVAL)), (220, SENT, PACE),
         (300, RECEIVED, get(VOLTAGE)), (330, SENT, VOLTS[1]), (400, RECEIVED, get(VOLTAGE)), (450, SENT, VOLTS[2])]


class Answers(Played):
    def ask(self, line, request, size):
        begin = time.monotonic()
        os.write(line, request)
        pieces = read_line(line, size)
        return b"".join(data for _, data in pieces), pieces[-1][0] - begin

    @with_patience
    def test_by_command_in_another_order_each_at_its_own_delay(self):
        capture = self.file("a.pcapng", on_lines(ASKED))
        with Replay(capture, f"pty:{self.folder}/line", "--answer") as replay:
            line = open_line(self.folder / "line")
            for request, answer, delay in ((INTERVAL, PACE, 0.120), (VOLTAGE, VOLTS[0], 0.040),
                                           (VOLTAGE, VOLTS[1], 0.030), (INTERVAL, PACE, 0.120),
                                           (VOLTAGE, VOLTS[2], 0.050), (VOLTAGE, VOLTS[0], 0.040)):
                said, after = self.ask(line, get(request), len(answer))
                self.assertEqual(said, answer)
                self.assertAlmostEqual(after, delay, delta=WORST / 2)
            os.write(line, b"noise" + get(1200) + get(1200))
            self.ask(line, get(VOLTAGE), len(VOLTS[1]))
            os.close(line)
            status, output = replay.stop()
        self.assertEqual(status, 0)
        self.assertIn("9, 7 answered, 2 that the capture does not hold: GeneralRequest 2; 5 bytes of noise", output)

    def test_to_another_kind_of_endpoint(self):
        """Of a serial line each message becomes a datagram of its own."""
        capture = self.file("a.pcapng", on_lines(ASKED))
        with Replay(capture, "udp-listen://127.0.0.1:0", "--answer") as replay:
            port = int(replay.output.split("udp-listen://127.0.0.1:")[1].split()[0])
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as driver:
                driver.settimeout(20)
                driver.connect(("127.0.0.1", port))
                driver.send(get(VOLTAGE))
                driver.send(get(INTERVAL))
                self.assertEqual([driver.recv(100), driver.recv(100)], [VOLTS[0], PACE])

    def test_step_by_step_for_each_request_and_each_line(self):
        capture = self.file("a.pcapng", on_lines(ASKED))
        with Replay(capture, f"pty:{self.folder}/line", "--stepped", stdin=subprocess.PIPE) as replay:
            line = open_line(self.folder / "line")
            self.assertEqual(self.ask(line, get(1200), len(VOLTS[0]))[0], VOLTS[0])
            replay.process.stdin.write(b"\n")
            replay.process.stdin.flush()
            self.assertEqual(b"".join(data for _, data in read_line(line, len(PACE))), PACE)
            os.write(line, get(1200) + get(1200))
            self.assertEqual(b"".join(data for _, data in read_line(line, 2 * len(VOLTS[1]))), VOLTS[1] + VOLTS[2])
            status, output = replay.end()
            os.close(line)
        self.assertEqual(status, 0)
        self.assertIn("4 messages", output)

    def test_modes_that_exclude_each_other_are_refused(self):
        capture = self.file("a.pcapng", on_lines(ASKED))
        for modes in (("--answer", "--stepped"), ("--answer", "--speed", 0), ("--answer", "--loop"),
                      ("--stepped", "--speed", 2), ("--family", "nonsense")):
            self.refused(64, capture, "pty:/tmp/x", *modes)


if __name__ == "__main__":
    unittest.main()
