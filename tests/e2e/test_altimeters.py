"""The six altimeters of config/altimeters.yaml above a flat floor, each read as its hosts read it, from their description."""

import functools
import operator
import re
import struct
import time
import unittest

from program import ROOT, Emulator

import byte_line

DEPTH, PULSE = 8.0, 0.08  # m; half of 100 us of sound, whose beginning speckle may hide
BAUD = {"valeport-va500": 115200, "tritech-pa500": 9600, "tritech-pa200": 9600, "benthos-psa916": 9600,
        "echologger-ect400": 115200, "imagenex-863": 2400}


def checked(sentence):
    """The fields of an NMEA sentence whose checksum fits, in either case, as ArduPilot takes it."""
    body, digits = re.fullmatch(rb"\$([^*]*)\*([0-9A-Fa-f]{2})\r", sentence).groups()
    assert functools.reduce(operator.xor, body) == int(digits, 16), sentence
    return body.decode().split(",")


class Altimeters(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scenario = (ROOT / "config" / "altimeters.yaml").read_text()
        scenario = scenario.replace("scenes/", "{scenes}/").replace("pty:/tmp/echoloop/", "pty:{folder}/")
        cls.emulator = Emulator(scenario)
        cls.addClassCleanup(cls.emulator.__exit__, None, None, None)
        cls.emulator.__enter__()

    def open(self, model):
        self.line = byte_line.open_line(str(self.emulator.folder / model), BAUD[model])
        self.addCleanup(self.line.close)

    def read(self, enough, seconds=20):
        data, end = b"", time.monotonic() + seconds
        while not enough(data):
            self.assertLess(time.monotonic(), end, data)
            data += self.line.read(0.1)
        return data

    def lines(self, count):
        """Whole lines without LF; the first may be cut and is left out."""
        return self.read(lambda data: data.count(b"\n") > count).split(b"\n")[1 : count + 1]

    def check(self, metres):
        self.assertGreaterEqual(metres, DEPTH - 0.02)
        self.assertLessEqual(metres, DEPTH + PULSE)

    def test_va500_as_a_public_driver_sets_it(self):
        """It stops it, sets ranges and mode, each answer an echo, a value and '>', lets it run and splits at commas."""
        self.open("valeport-va500")
        self.line.write(b"#\r\n#")
        self.read(lambda data: data.count(b">") == 2)
        for command in b"#823;100", b"#840;1", b"#039;M4":
            self.line.write(command + b"\r\n")
            self.assertEqual(self.read(lambda data: data.endswith(b">")),
                             command + b"\r\n" + command.split(b";")[1] + b"\r\n>")
        self.line.write(b"#028\r\n")
        data = self.read(lambda data: data.count(b"\n") > 4)
        self.assertTrue(data.startswith(b"#028\r\n"), data)
        for line in data.split(b"\n")[1:4]:
            name, metres, unit, pressure, dbar = checked(line)
            self.assertEqual((name, unit, dbar), ("PRVAT", "M", "dBar"))
            self.assertRegex(metres, r"^\d\d\.\d{3}$")
            self.check(float(metres))
            self.assertAlmostEqual(float(pressure), 12, delta=0.1)  # m of water above it

    def test_pa500_and_pa200_in_ten_bytes(self):
        for model in "tritech-pa500", "tritech-pa200":
            self.open(model)
            for line in self.lines(4):
                self.assertRegex(line, rb"^\d{3}\.\d{3}m\r$")
                self.check(float(line[:7]))

    def test_psa916_behind_an_r(self):
        self.open("benthos-psa916")
        for line in self.lines(4):
            self.assertRegex(line, rb"^R\d\d\.\d\d\r$")
            self.check(float(line[1:6]))

    def test_ect400_in_nmea_and_alone(self):
        """DBT has metres in its third field, DPT in its first; then a driver's commands without line ends."""
        self.open("echologger-ect400")
        seen = {}
        for line in self.lines(6):
            fields = checked(line)
            seen[fields[0][2:]] = fields
        self.check(float(seen["DBT"][3]))
        self.check(float(seen["DPT"][1]))
        self.assertAlmostEqual(float(seen["MTW"][1]), 10, delta=0.5)
        for command in b"#output 1", b"#interval 0.2":
            self.line.write(command)
            time_over = time.monotonic() + 0.2  # the driver's own pause after each
            self.read(lambda data, end=time_over: time.monotonic() > end)
        for line in self.lines(3):
            self.check(float(line))

    def test_863_in_four_bytes(self):
        self.open("imagenex-863")
        data = self.read(lambda data: len(data) >= 12)
        for at in range(0, 12, 4):
            start, microseconds, level = struct.unpack_from(">BHB", data, at)
            self.assertEqual(start, 0xFF)
            self.check(microseconds * 1e-6 * 1500 / 2)
            self.assertGreater(level, 20)


if __name__ == "__main__":
    unittest.main()
