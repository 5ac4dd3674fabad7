"""inspect reads what replay plays: logs of Ping Viewer, serial logs as text, makers' files. All but the recordings of
real sonars are made here, byte by byte from their descriptions."""
import json
import struct
import unittest

from captures import REBOOT, SEND_DATA
from program import ProgramTest, run


def text(characters):
    """A QString as Qt's QDataStream writes it."""
    return struct.pack(">I", 2 * len(characters)) + characters.encode("utf-16-be")


def text8(characters):
    return struct.pack(">I", len(characters)) + characters.encode()


def ping_viewer_log(records, version=1, device=2, encode=text):
    head = encode("PingViewer sensor log file") + struct.pack(">I", version)
    head += b"".join(map(encode, ("a1b2c3", "2026-11-21", "v2.6", "linux", "6.1"))) + struct.pack(">ii", 1, device)
    return head + b"".join(encode(time) + struct.pack(">I", len(data)) + data for time, data in records)


def ping_frame(number, payload, source=2):
    frame = b"BR" + struct.pack("<HHBB", len(payload), number, source, 0) + payload
    return frame + struct.pack("<H", sum(frame) & 0xFFFF)


def device_data(angle):
    return ping_frame(2300, struct.pack("<BBHHHHHH", 1, 0, angle, 32, 80, 740, 4, 4) + bytes([1, 2, 3, angle % 256]))


class CaptureFiles(ProgramTest):
    def file(self, data, name="capture"):
        path = self.folder / name
        path.write_bytes(data)
        return path

    def messages(self, data, *arguments):
        return self.json("inspect", self.file(data), *arguments)["messages"]


class PingViewer(CaptureFiles):
    RECORDS = [("00:00:01.000", device_data(7)), ("00:00:01.250", device_data(8)), ("01:00:00.000", device_data(9))]

    def test_frames_with_their_times(self):
        found = self.messages(ping_viewer_log(self.RECORDS))
        self.assertEqual([m["name"] for m in found], ["DeviceData"] * 3)
        self.assertEqual([round(m["time"], 3) for m in found], [0, 0.25, 3599])
        self.assertEqual({m["line"] for m in found}, {"Ping360, sent"})

    def test_a_log_that_is_re_encoded_as_utf_8(self):
        """As the script ping_sensor_binary_log.py of Ping Viewer writes it: each text as a length and UTF-8."""
        found = self.messages(ping_viewer_log(self.RECORDS, encode=text8))
        self.assertEqual([round(m["time"], 3) for m in found], [0, 0.25, 3599])
        self.assertEqual({m["line"] for m in found}, {"Ping360, sent"})

    def test_a_log_that_ends_early(self):
        done = run("inspect", self.file(ping_viewer_log(self.RECORDS)[:-5]))
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr.decode(), r"ends early: the last 55 bytes, from byte \d+ on, are no whole record")
        self.assertIn("version 1 can", self.bad(65, "inspect", self.file(ping_viewer_log([], version=2))))

    def test_damage_in_the_middle_costs_what_is_damaged(self):
        records = [(f"00:00:{i:02d}.000", device_data(i)) for i in range(40)]
        for encode in (text, text8):
            whole = ping_viewer_log(records, encode=encode)
            begin, size = len(ping_viewer_log(records[:20], encode=encode)), len(ping_viewer_log(records[:1], encode=encode))
            size -= len(ping_viewer_log([], encode=encode))
            for name, damaged, lost in (
                    ("a length", whole[:begin + size - 32] + b"\x7F" + whole[begin + size - 31:], {20}),
                    ("a time", whole[:begin + 5] + b"?" + whole[begin + 6:], {20}),
                    ("cut out", whole[:begin + 3] + whole[begin + size + 9:], {20, 21}),
                    ("noise", whole[:begin] + bytes(range(7, 250)) + whole[begin:], set()),
                    ("a frame that is too long", ping_viewer_log(
                        records[:20] + [("00:00:20.000", bytes(3000))] + records[20:], encode=encode), set())):
                with self.subTest(name, encode=encode.__name__):
                    done = run("inspect", self.file(damaged), "--json")
                    angles = [f["value"] for m in json.loads(done.stdout)["messages"] for f in m["fields"] if f["name"] == "angle"]
                    self.assertEqual(angles, [i for i in range(40) if i not in lost])
                    self.assertRegex(done.stderr.decode(), rf"\d+ bytes of the file are no whole record, the first at byte {begin};")


class SerialLogs(CaptureFiles):
    def test_times_directions_and_comments(self):
        log = "# Micron, 21 November\n\n1637.25 > %s\n1637.5 < %s   # half\n1638.0 <%s\n" % (
            SEND_DATA.hex(), REBOOT.hex()[:10], REBOOT.hex(" ")[15:])
        found = self.messages(log.encode())
        self.assertEqual([(m["name"], m["line"], m["time"]) for m in found],
                         [("SendData", "serial line, received", 0), ("ReBoot", "serial line, sent", 0.75)])

    def test_what_is_wrong_is_named_with_its_line(self):
        for line, reason in (("2 < 4", "pairs of hexadecimal digits"), ("2 < 4x", "pairs of hexadecimal digits"),
                             ("soon < 40", "begins with a time"), ("-1 40", "begins with a time"),
                             ("3s 40", "a blank follows the time"), ("4 < " + "40" * (1 << 20), "longer than 1 MiB")):
            done = run("inspect", self.file(("1 < %s\n%s\n" % (REBOOT.hex(), line)).encode()))
            self.assertRegex(done.stderr.decode(), f"ends early: line 2: .*{reason}", line[:20])


class MakersFiles(CaptureFiles):
    def ports(self, path):
        return self.json("replay", path, "--list")["ports"]

    def test_shots_of_a_real_852(self):
        """917 shots on 18 November 2016; the .852 has a header and zeros around each reply of 513 bytes."""
        path = self.shared("imagenex852", "19_26_51-2016_11_18-sonar.852")
        data = path.read_bytes()
        self.assertEqual(len(data), 917 * 640)

        def seconds(shot):
            hours, minutes, rest = data[640 * shot + 20:640 * shot + 28].decode().split(":")
            return int(hours) * 3600 + int(minutes) * 60 + int(rest) + float(data[640 * shot + 29:640 * shot + 32])

        port, = self.ports(path)
        self.assertEqual(port["device"], {"pieces": 917, "bytes": 917 * 513})
        self.assertAlmostEqual(port["end"], seconds(916) - seconds(0), places=2)

    def test_packets_of_a_real_sonar_3d_15(self):
        port, = self.ports(self.shared("sonar-3d-15", "ship_short.sonar"))
        self.assertEqual(port["device"], {"pieces": 12, "bytes": 181002})
        self.assertAlmostEqual(port["end"], 5 / 6, delta=0.05)

    def test_pings_of_a_real_oculus(self):
        port, = self.ports(self.shared("oculus", "three_pings_8bit.raw"))
        self.assertEqual(port["device"], {"pieces": 3, "bytes": 546048})

    def test_a_svlog_without_the_remark_of_the_program(self):
        profile = struct.pack("<5I3HBB6f", 1, 0, 5000, 2000, 450000, 4, 2, 15000, 0, 0, 1e-4, 1, 0, -90, 0, 0)
        frames = [ping_frame(2198, profile[:12] + struct.pack("<I", 2000 + 100 * i) + profile[16:] + bytes(4), 1)
                  for i in range(5)]
        port, = self.ports(self.file(ping_frame(10, b'{"session_id": 1}', 0) + b"".join(frames), "a.svlog"))
        self.assertEqual(port["device"]["pieces"], 5)
        self.assertAlmostEqual(port["end"], 0.4, places=3)

    def test_a_file_without_times_wants_an_interval(self):
        path = self.file(b"".join(device_data(angle) for angle in range(5)))
        self.assertIn("holds no times; give --interval", self.bad(64, "replay", path, "udp://127.0.0.1:20999"))
        port, = self.json("replay", path, "--list", "--interval", 0.25)["ports"]
        self.assertAlmostEqual(port["end"], 1.0)

    def test_what_is_no_capture_is_refused(self):
        self.assertIn("no capture that can be read", self.bad(65, "replay", self.file(b"\xff" * 99), "pty:/tmp/x"))


if __name__ == "__main__":
    unittest.main()
