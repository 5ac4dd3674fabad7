"""A navigation unit on a vehicle that sails a straight line and rolls, read by Debian's gpsd and pynmea2, and by the
offsets of TSS1 and EM Attitude 3000. Everything is compared with the trajectory, at the times that the stamps tell."""

import json
import math
import os
import re
import socket
import statistics
import struct
import time
import unittest

from program import Emulator
from test_nmea import GPSD, Gpsd, need, pynmea2

import byte_line

SPEED, HEADING = 1.5, 60.0  # m/s, deg from north
ROLL, PERIOD, PITCH = 5.0, 4.0, 2.0  # deg, s, deg
ORIGIN = 59.4, 10.5  # deg
METRES = 111420.0, 56829.0  # of a degree of latitude and longitude there, WGS 84
SCENARIO = """
scene: "{scenes}/flat.glb"
origin: {latitude: 59.4, longitude: 10.5}
effects: {sensor_noise: off}
vehicle: {trajectory: "{folder}/way.csv"}
devices:
  - name: ins
    model: nmea-ins
    endpoints: ["pty:{folder}/ins", "pty:{folder}/tss1", "pty:{folder}/em3000", "udp://127.0.0.1:%d"]
    options: {ports: "GGA ZDA VTG HDT PASHR; TSS1; EM3000; GGA ZDA PASHR", gga: 5, vtg: 5, hdt: 5}
"""


def roll_at(t):
    return ROLL * math.sin(2 * math.pi * t / PERIOD)


def way():
    """40 s of the trajectory, every 50 ms."""
    lines = ["t,x,y,z,qw,qx,qy,qz"]
    yaw, pitch = math.radians(90 - HEADING) / 2, math.radians(-PITCH) / 2
    for i in range(801):
        t = 0.05 * i
        roll = math.radians(roll_at(t)) / 2
        cy, sy, cp, sp, cr, sr = math.cos(yaw), math.sin(yaw), math.cos(pitch), math.sin(pitch), math.cos(roll), math.sin(roll)
        q = (cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy)
        run = SPEED * t
        place = run * math.sin(math.radians(HEADING)), run * math.cos(math.radians(HEADING)), -12.0
        lines.append(",".join(f"{v:.9f}" for v in (t, *place, *q)))
    return "\n".join(lines) + "\n"


def seconds_of(stamp):
    """Of the day, from hhmmss.sss."""
    return int(stamp[:2]) * 3600 + int(stamp[2:4]) * 60 + float(stamp[4:])


class NavigationUnit(unittest.TestCase):
    def setUp(self):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(self.socket.close)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(20)
        self.emulator = Emulator(SCENARIO % self.socket.getsockname()[1], files={"way.csv": way()})
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.emulator.__enter__()

    def line(self, name):
        line = byte_line.open_line(str(self.emulator.folder / name), 115200)
        self.addCleanup(line.close)
        return line

    def read(self, name, enough):
        line, data, end = self.line(name), b"", time.monotonic() + 20
        while not enough(data):
            self.assertLess(time.monotonic(), end, data)
            data += line.read(0.1)
        return data

    def test_pynmea2_reads_where_it_is_when_and_how_it_lies(self):
        need(pynmea2, "python3-nmea2")
        data = self.read("ins", lambda data: data.count(b"ZDA") > 2 and data.endswith(b"\n"))
        read = [pynmea2.parse(line.decode().strip(), check=True) for line in data.split(b"\n")[1:-1]]
        kinds = {}
        for one in read:
            kinds.setdefault(one.identifier() if one.identifier().startswith("P") else one.sentence_type, []).append(one)
        run = []  # s of the run at midnight, by each position
        for fix in kinds["GGA"]:
            north, east = (fix.latitude - ORIGIN[0]) * METRES[0], (fix.longitude - ORIGIN[1]) * METRES[1]
            self.assertAlmostEqual(math.degrees(math.atan2(east, north)), HEADING, delta=0.5)
            self.assertEqual((fix.gps_qual, fix.altitude), (4, -12.0))
            run.append(seconds_of(fix.data[0]) - math.hypot(north, east) / SPEED)
        start = statistics.median(run)
        self.assertLess(max(abs(one - start) for one in run), 0.02, "stamps are of the moments of the positions")
        for course in kinds["VTG"]:
            self.assertAlmostEqual(course.true_track, HEADING, delta=0.5)
            self.assertAlmostEqual(float(course.data[4]) * 1852 / 3600, SPEED, delta=0.01)
        for heading in kinds["HDT"]:
            self.assertAlmostEqual(float(heading.heading), HEADING, delta=0.02)
        for second in kinds["ZDA"]:
            self.assertRegex(second.data[0], r"\.00$", "the edge of a second")
            self.assertEqual(second.datestamp.isoformat(), time.strftime("%Y-%m-%d", time.gmtime()))
        attitudes = [one for name, found in kinds.items() if name.startswith("PASH") for one in found]
        self.assertGreater(len(attitudes), 15)
        for one in attitudes:
            stamp, heading, _, roll, pitch, heave = one.data[1:7] if one.data[0] == "R" else one.data[:6]
            self.assertAlmostEqual(float(roll), roll_at(seconds_of(stamp) - start), delta=0.1)
            self.assertAlmostEqual(float(pitch), PITCH, delta=0.02)
            self.assertAlmostEqual(float(heading), HEADING, delta=0.02)
            self.assertAlmostEqual(float(heave), 0, delta=0.01)

    def test_gpsd_tells_the_heading_and_understands_position_and_attitude(self):
        """gpsd 3.22 and 3.25 pass on the heading; what they make of sentences at several rates is in their logs only."""
        need(GPSD, "gpsd")
        log = self.emulator.folder / "gpsd.log"
        gpsd = Gpsd(os.path.realpath(self.emulator.folder / "ins"), log, 115200)
        self.addCleanup(gpsd.close)
        connection = gpsd.connect()
        self.addCleanup(connection.close)
        found, text, end = [], b"", time.monotonic() + 20
        while len(found) < 8:
            self.assertLess(time.monotonic(), end, log.read_text()[-3000:])
            text += connection.recv(65536)
            *lines, text = text.split(b"\n")
            found += [report for report in map(json.loads, filter(None, lines)) if report["class"] == "ATT"]
        for attitude in found:
            self.assertAlmostEqual(attitude["heading"], HEADING, delta=0.02)
        gpsd.wait_for(lambda: re.findall(r"GGA: hhmmss=\d+\.\d\d lat=59\.40 lon=10\.50 altMSL=-12\.00 mode=3", log.read_text()), 3)
        gpsd.wait_for(lambda: re.findall(r"PASHR \(OxTS\).*heading 60\.00", log.read_text()), 3)
        self.assertNotRegex(log.read_text(), r"(?i)bad checksum|unknown sentence")

    def test_bytes_of_motion_come_at_their_rates(self):
        """Rolls, one after another, are a sine of the trajectory's period at 50 and 100 samples a second."""
        text = self.read("tss1", lambda data: data.count(b"\n") > 60)
        rolls = []
        for line in text.split(b"\n")[1:-1]:
            self.assertRegex(line, rb"^:[0-9A-F]{6} [ -]\d{4}F[ -]\d{4} [ -]\d{4}\r$")
            rolls.append(int(line[14:19].replace(b" ", b"")) / 100)
            self.assertAlmostEqual(int(line[20:25]) / 100, PITCH, delta=0.02)
        self.check_sine(rolls, 50)
        data = self.read("em3000", lambda data: len(data) > 1200)
        data = data[data.index(b"\x90\x90"):]
        rolls = []
        for at in range(0, len(data) - 9, 10):
            status, sync, roll, pitch, heave, heading = struct.unpack_from("<BBhhhH", data, at)
            self.assertEqual((status, sync, heave), (0x90, 0x90, 0))
            self.assertAlmostEqual(heading / 100, HEADING, delta=0.02)
            self.assertAlmostEqual(pitch / 100, PITCH, delta=0.02)
            rolls.append(roll / 100)
        self.check_sine(rolls, 100)

    def check_sine(self, rolls, rate):
        """What a sine of that rate leaves, by its own recurrence, is what rounding and the trajectory's pieces leave."""
        turn = 2 * math.cos(2 * math.pi * 10 / rate / PERIOD)
        left = [rolls[i + 20] - turn * rolls[i + 10] + rolls[i] for i in range(len(rolls) - 20)]
        self.assertGreater(len(left), 30)
        self.assertLess(max(map(abs, left)), 0.06)

    def test_each_sentence_is_a_datagram_some_milliseconds_after_its_moment(self):
        late = []
        while len(late) < 20:
            sentence = self.socket.recv(2048)
            arrived = time.time()
            fields = sentence.decode().strip()[1:].split("*")[0].split(",")
            self.assertTrue(sentence.endswith(b"\r\n") and sentence.count(b"$") == 1)
            late.append((arrived - seconds_of(fields[1])) % 86400)
        self.assertGreater(min(late), 0.0049)
        self.assertLess(statistics.median(late), 0.2, late)


if __name__ == "__main__":
    unittest.main()
