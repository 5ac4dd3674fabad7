"""The NMEA echosounder against readers that know nothing of it: Debian's gpsd and pynmea2."""

import functools
import json
import operator
import os
import re
import select
import shutil
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from ports import free_port
from program import PROGRAM, Emulator

import byte_line

try:
    import pynmea2
except ImportError:
    pynmea2 = None
GPSD = shutil.which("gpsd", path=os.environ.get("PATH", "") + ":/usr/sbin:/usr/local/sbin")

FLOOR = """
scene: {scenes}/flat.glb
water: {temperature: 7.5, salinity: 35, ph: 8, sound_speed: %g}
vehicle: {pose: {position: [0, 0, %g]}}
devices:
  - name: echosounder
    model: nmea-echosounder
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["%s"]
    options: {rate: 4, baud: 38400, temperature: 7.5, sentences: DPT DBT MTW DBS, offset: 1.25, range: %g, no_bottom: %s}
"""
PULSE = 0.075  # m, half of 100 us of sound: what the sounder can resolve


def need(thing, package):
    if thing:
        return
    if os.environ.get("CI") == "true":
        raise AssertionError(f"{package} is missing and CI is true: run tools/install test")
    raise unittest.SkipTest(f"{package} is not installed: run tools/install test")


def sentence(body):
    checksum = functools.reduce(operator.xor, body.encode())
    return f"${body}*{checksum:02X}\r\n".encode()


class Gpsd:
    """gpsd on one source of sentences, asked over its own JSON protocol. Ended by its process id. `rate`: of a line, bit/s,
    which it would else look for, for up to half a minute."""

    def __init__(self, source, log, rate=None):
        self.port, self.source, self.log = free_port(), source, log
        command = [GPSD, "-N", "-n", "-b", "-D", "6", *(["-s", str(rate)] if rate else []), "-S", str(self.port), source]
        with open(log, "wb") as out:
            self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=out)

    def wait_for(self, look, count, seconds=30):
        """The first `count` things that `look()` finds, asked again until there are as many."""
        end = time.monotonic() + seconds
        while len(found := look()) < count:
            if time.monotonic() > end or self.process.poll() is not None:
                raise AssertionError(f"{len(found)} of {count}, gpsd: {self.log.read_text()[-3000:]}")
            select.select([], [], [], 0.1)
        return found[:count]

    def logged_depths(self):
        """What gpsd has made of the sentences so far. It passes depths on only beside a position in three axes."""
        return [float(d) for d in re.findall(r"NMEA0183: (?:[A-Z]+ )?mode \d, depth (-?\d+\.\d+)", self.log.read_text())]

    def connect(self):
        def tried():
            try:
                return [socket.create_connection(("127.0.0.1", self.port), 1)]
            except OSError:
                return []

        connection = self.wait_for(tried, 1)[0]
        connection.settimeout(30)
        connection.sendall(b'?WATCH={"enable":true,"json":true};\n')
        return connection

    def close(self):
        self.process.terminate()
        self.process.wait(10)


class NmeaCase(unittest.TestCase):
    def start(self, endpoint, *arguments, z=-12.0, sound_speed=1500.0, reach=50.0, no_bottom="empty"):
        emulator = Emulator(FLOOR % (sound_speed, z, endpoint, reach, no_bottom), *arguments)
        self.addCleanup(emulator.__exit__, None, None, None)
        return emulator.__enter__()

    def check_depth(self, depth, expected):
        self.assertAlmostEqual(depth, expected, delta=0.005 * expected + PULSE)


class WithGpsd(NmeaCase):
    def setUp(self):
        need(GPSD, "gpsd")

    def gpsd(self, emulator, source, rate=None):
        gpsd = Gpsd(source, emulator.folder / "gpsd.log", rate)
        self.addCleanup(gpsd.close)
        return gpsd

    def test_reads_the_depth_from_the_pseudo_terminal(self):
        emulator = self.start("pty:{folder}/line")
        gpsd = self.gpsd(emulator, os.path.realpath(emulator.folder / "line"), 38400)
        for depth in gpsd.wait_for(gpsd.logged_depths, 8):
            self.check_depth(depth, 8.0)
        status, output = emulator.stop()
        self.assertEqual(status, 0, output)

    def test_passes_the_depth_on_beside_the_position_of_a_vessel(self):
        port = free_port(8)
        emulator = self.start(f"udp://127.0.0.1:{port}", z=-5)
        gpsd = self.gpsd(emulator, f"udp://127.0.0.1:{port}")
        with gpsd.connect() as reports, reports.makefile() as lines:
            depths = []
            while len(depths) < 4:
                self.send_position(port)  # with each report, as a receiver goes on
                report = json.loads(lines.readline())
                self.assertNotEqual(report["class"], "ERROR", report)
                if "depth" in report:
                    self.assertEqual(report["class"], "TPV")
                    depths.append(report["depth"])
        for depth in depths:
            self.check_depth(depth, 15.0)

    def send_position(self, port):
        """What a receiver beside the sounder says, on the same port."""
        now = time.gmtime()
        clock, date = time.strftime("%H%M%S.00", now), time.strftime("%d%m%y", now)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
            for body in (
                f"GPRMC,{clock},A,5400.000,N,01000.000,E,0.0,0.0,{date},,,A",
                f"GPGGA,{clock},5400.000,N,01000.000,E,1,08,1.0,0.0,M,45.0,M,,",
                "GPGSA,A,3,01,02,03,04,05,06,07,08,,,,,2.0,1.0,1.7",
            ):
                out.sendto(sentence(body), ("127.0.0.1", port))


class WithPynmea2(NmeaCase):
    def setUp(self):
        need(pynmea2, "python3-nmea2")

    def sentences(self, count, **scene):
        """`count` sentences from UDP, one a datagram, checked by pynmea2."""
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as host:
            host.bind(("127.0.0.1", 0))
            host.settimeout(30)
            self.start(f"udp://127.0.0.1:{host.getsockname()[1]}", **scene)
            texts = [host.recv(4096).decode("ascii") for _ in range(count)]
        for text in texts:
            self.assertTrue(text.endswith("\r\n"), text)
        return [pynmea2.parse(text.rstrip(), check=True) for text in texts]

    def test_reads_every_sentence(self):
        for s in self.sentences(16):
            self.assertEqual(s.talker, "SD")
            if s.sentence_type == "DPT":
                self.check_depth(float(s.depth), 8.0)
                self.assertEqual(float(s.offset), 1.25)
                self.assertEqual(float(s.range), 50)
            elif s.sentence_type == "MTW":
                self.assertAlmostEqual(float(s.temperature), 7.5, delta=0.3)
                self.assertEqual(s.units, "C")
            else:
                depth = 8.0 + (1.25 if s.sentence_type == "DBS" else 0)
                metres = float(s.depth_meters if s.sentence_type == "DBT" else s.data[2])
                self.check_depth(metres, depth)
                self.assertAlmostEqual(float(s.data[0]) * 0.3048, metres, delta=0.01)
                self.assertAlmostEqual(float(s.data[4]) * 1.8288, metres, delta=0.02)

    def test_a_wrong_sound_speed_makes_wrong_depths(self):
        """2 x 8 m / 1450 m/s at 1500 m/s are 8.28 m."""
        depths = [float(s.depth) for s in self.sentences(16, sound_speed=1450.0) if s.sentence_type == "DPT"]
        for depth in depths:
            self.assertAlmostEqual(depth, 8.0 * 1500 / 1450, delta=PULSE)

    def test_no_bottom_within_its_range_gives_null_fields(self):
        """10 m of range end 2 m above the floor."""
        for s in self.sentences(8, z=-8.0, reach=10.0):
            if s.sentence_type in ("DPT", "DBT", "DBS"):
                self.assertEqual(s.data[0], "", str(s))

    def test_no_bottom_may_mean_no_depth_sentence(self):
        found = {s.sentence_type for s in self.sentences(4, z=-8.0, reach=10.0, no_bottom="silent")}
        self.assertEqual(found, {"MTW"})


class SeveralPlaces(NmeaCase):
    def test_autopilot_logger_and_two_plotters_hear_the_same(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as logger:
            logger.bind(("127.0.0.1", 0))
            logger.settimeout(30)
            port = free_port()
            places = ("pty:{folder}/autopilot", f"udp://127.0.0.1:{logger.getsockname()[1]}", f"tcp-listen://127.0.0.1:{port}")
            emulator = self.start('", "'.join(places))
            plotters = [socket.create_connection(("127.0.0.1", port), 30) for _ in range(2)]
            for plotter in plotters:
                self.addCleanup(plotter.close)
            autopilot = byte_line.open_line(str(emulator.folder / "autopilot"), 38400)
            self.addCleanup(autopilot.close)
            said, end = b"", time.monotonic() + 20
            while said.count(b"\n") < 6 and time.monotonic() < end:
                said += autopilot.read(0.5)
            shown = [plotter.makefile("rb").readline() for plotter in plotters]
            logged = [logger.recv(4096) for _ in range(8)]
            for line in [*shown, *said.splitlines(keepends=True)[1:5]]:
                self.assertEqual(line[-2:], b"\r\n")
                self.assertIn(line[:6], {one[:6] for one in logged}, "the same kinds of sentences")
                self.assertEqual(line, sentence(line[1:-5].decode()), "whole")


class Inspected(NmeaCase):
    """`echoloop inspect` on what a line and a socket carried."""

    def inspect(self, *arguments):
        command = [PROGRAM, "inspect", *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, timeout=60, check=True).stdout

    def test_a_log_of_a_serial_line(self):
        emulator = self.start("pty:{folder}/line")
        line = byte_line.open_line(str(emulator.folder / "line"), 38400)
        self.addCleanup(line.close)
        data, end = b"", time.monotonic() + 20
        while data.count(b"\n") < 9 and time.monotonic() < end:
            data += line.read(0.5)
        log = emulator.folder / "line.log"
        log.write_bytes(b"\x00half,a,sentence*00\r\n" + data + sentence("GPGLL,5400.0,N,01000.0,E,,A"))
        messages = json.loads(self.inspect(log, "--json"))["messages"]
        depths = [f for m in messages if m["name"] == "DPT" for f in m["fields"] if f["name"] == "depth"]
        self.assertGreaterEqual(len(depths), 2)
        for depth in depths:
            self.assertEqual(depth["unit"], "m")
            self.check_depth(float(depth["value"]), 8.0)
        self.assertIn("GPGLL", [m["name"] for m in messages])

    def test_a_recorded_run_with_datagrams(self):
        folder = tempfile.TemporaryDirectory(prefix="echoloop-record-")
        self.addCleanup(folder.cleanup)
        capture = Path(folder.name) / "run.pcapng"
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as host:
            host.bind(("127.0.0.1", 0))
            host.settimeout(30)
            emulator = self.start(f"udp://127.0.0.1:{host.getsockname()[1]}", "--record", str(capture))
            for _ in range(8):
                host.recv(4096)
            emulator.stop()
        summary = self.inspect(capture, "--summary")
        self.assertRegex(summary, r"DBS \d+, DBT \d+, DPT \d+, MTW \d+; broken 0")


if __name__ == "__main__":
    unittest.main()
