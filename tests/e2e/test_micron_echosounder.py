"""The Micron Echosounder above a flat floor, read as its hosts do, each written from its description."""

import re
import subprocess
import time
import unittest

from ports import free_port
from program import PROGRAM, Emulator

import byte_line

FLOOR = """
scene: {scenes}/flat.glb
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, %g]}}
devices:
  - name: altimeter
    model: micron-echosounder
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["%s"]
    options: {%s}
"""
PULSE = 0.03  # m, half of 40 us of sound, whose beginning speckle may hide


class Altimeter(unittest.TestCase):
    def start(self, depth, options="", endpoint="pty:{folder}/line", baud=9600):
        emulator = Emulator(FLOOR % (depth - 20, endpoint, options))
        self.addCleanup(emulator.__exit__, None, None, None)
        emulator.__enter__()
        uri = endpoint.replace("-listen", "") if "tcp" in endpoint else str(emulator.folder / "line")
        self.line = byte_line.open_line(uri, baud)
        self.addCleanup(self.line.close)
        return emulator

    def read(self, enough, seconds=20):
        """Bytes until `enough(bytes)`."""
        data, end = b"", time.monotonic() + seconds
        while not enough(data):
            self.assertLess(time.monotonic(), end, data)
            data += self.line.read(0.1)
        return data

    def lines(self, count, end=b"\n"):
        return self.read(lambda data: data.count(end) >= count).split(end)[:count]

    def check(self, metres, depth):
        self.assertGreaterEqual(metres, depth - 0.002)
        self.assertLessEqual(metres, depth + PULSE)


class Formats(Altimeter):
    def test_a_host_of_ten_bytes_a_line(self):
        """It reads ten bytes at a time and scans "%lfm\\r\\n"."""
        for depth in (0.5, 19.0):
            with self.subTest(depth):
                self.start(depth)
                data = self.read(lambda d: len(d) >= 80)
                for at in range(0, 80, 10):
                    found = re.fullmatch(rb"(\d+\.\d+)m\r\n", data[at : at + 10])
                    self.assertIsNotNone(found, data)
                    self.check(float(found[1]), depth)

    def test_a_host_that_wants_the_m_at_index_six(self):
        """Delphin: "xxx.xxm"; 5 Hz would be too fast for it."""
        self.start(8.0, "format: 3P2")
        begin = time.monotonic()
        for line in self.lines(8):
            self.assertEqual(line[6:7], b"m", line)
            self.check(float(line[:6]) + 0.005, 8.0)
        self.assertGreater(time.monotonic() - begin, 6 / 5, "no faster than 5 Hz")

    def test_a_host_of_whole_millimetres(self):
        """Rock: "%dmm" up to a line feed, at 115200, one within a second."""
        self.start(8.0, "format: mm, baud: 115200", baud=115200)
        last = time.monotonic()
        for _ in range(6):
            (line,) = self.lines(1)
            self.assertLess(time.monotonic() - last, 1.0)
            last = time.monotonic()
            self.check(int(re.fullmatch(rb"(\d+)mm", line)[1]) / 1000, 8.0)

    def test_nmea_has_a_checksum(self):
        self.start(8.0, "format: nmea")
        for line in self.lines(4):
            body, _, checksum = line.decode().strip().lstrip("$").partition("*")
            total = 0
            for character in body:
                total ^= ord(character)
            self.assertEqual(int(checksum, 16), total, line)
            self.check(float(body.split(",")[3]) + 0.005, 8.0)


class Behaviour(Altimeter):
    def test_out_of_reach_it_fails_low_or_high(self):
        for word, expected in (("zero", b"000.000m\r"), ("maximum", b"005.000m\r")):
            with self.subTest(word):
                self.start(8.0, f"range: 5, no_bottom: {word}")
                self.assertEqual(set(self.lines(4)), {expected})

    def test_silent_it_says_nothing_at_all(self):
        self.start(8.0, "range: 5, no_bottom: silent")
        self.assertEqual(self.line.read(1.5), b"")

    def test_it_is_as_fast_as_it_is_told(self):
        self.start(2.0, "range: 5, rate: 10")
        self.lines(2)
        begin = time.monotonic()
        self.lines(20)
        self.assertAlmostEqual((time.monotonic() - begin) / 20, 0.1, delta=0.03)

    def test_it_answers_a_z_over_tcp_and_runs_again_after_an_f(self):
        port = free_port()
        self.start(8.0, "mode: interrogated", f"tcp-listen://127.0.0.1:{port}")
        self.assertEqual(self.line.read(0.5), b"")
        for _ in range(3):
            self.line.write(b"Z")
            (line,) = self.lines(1)
            self.check(float(line.rstrip(b"m\r")), 8.0)
        self.assertEqual(self.line.read(0.5), b"")
        self.line.write(b"F")
        self.lines(4)

    def test_what_it_says_can_be_inspected(self):
        for options, found in (("", "Reading 3"), ("format: mm", "Reading 3"), ("format: nmea", "DBT 3")):
            with self.subTest(options):
                emulator = self.start(8.0, options)
                log = emulator.folder / "log.txt"
                log.write_bytes(b"\n".join(self.lines(3)) + b"\n")
                command = [PROGRAM, "inspect", str(log)]
                output = subprocess.run(command, capture_output=True, text=True, timeout=30).stdout
                self.assertIn(f"messages: {found}; broken 0; not decoded 0 bytes", output)


if __name__ == "__main__":
    unittest.main()
