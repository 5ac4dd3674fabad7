"""`echoloop convert` writes makers' recordings and tables: what a sonar sent in a capture made here is what the file holds,
read by offsets of the files' descriptions."""
import csv
import json
import struct
import sys
import unittest

import makers_files as made
from captures import ETHERNET, RTAC_SERIAL, Pcapng, ethernet, ipv4, rtac, udp
from program import ROOT, ProgramTest, run
from test_capture_files import device_data, ping_frame
from test_clock_steps import svlog

sys.path.insert(0, str(ROOT / "tests" / "hosts"))
import aris_wire  # noqa: E402
import reson_wire  # noqa: E402


def datagrams(payloads, step=0.1):
    capture = Pcapng().interface(ETHERNET, b"eth0")
    for i, payload in enumerate(payloads):
        capture.packet(0, ethernet(ipv4(udp(payload))), round((1000 + i * step) * 1e9))
    return capture.data


def line(messages, name=b"head line", step=0.25):
    """`messages`: (bytes, sent by the device)."""
    capture = Pcapng().interface(RTAC_SERIAL, name)
    for i, (data, sent) in enumerate(messages):
        capture.packet(0, rtac(data, 1 if sent else 2), round((1000 + i * step) * 1e9))
    return capture.data


class Convert(ProgramTest):
    def converted(self, capture, ending, *arguments, warning=""):
        source, out = self.folder / "capture", self.folder / ("out" + ending)
        source.write_bytes(capture)
        done = run("convert", source, out, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr.decode(), warning or "^$")
        return out.read_bytes()

    def reopened(self, ending):
        """What the program itself finds in the file it wrote."""
        return self.json("inspect", self.folder / ("out" + ending))["messages"]


class Kmall(Convert):
    def parts(self, body, count, seconds):
        """A datagram on the wire: each part with header and numbers of its own and the same time."""
        size = -(-len(body) // count)
        return [made.kmall(b"#MWC", struct.pack("<HH", count, i + 1) + body[i * size:(i + 1) * size], seconds)
                for i in range(count)]

    def test_datagrams_whole_with_what_a_file_begins_with(self):
        body = bytes(range(200)) * 6
        sent = [made.kmall(b"#SPO", bytes(60), 1), *self.parts(body, 3, 2), made.installation(), made.kmall(b"#SVT", bytes(48), 3),
                made.installation(b"#IOP"), made.profile()]
        data = self.converted(datagrams(sent), ".kmall")
        whole = made.kmall(b"#MWC", struct.pack("<HH", 1, 1) + body, 2)
        self.assertEqual(data, b"".join([sent[4], sent[6], sent[7], sent[0], whole, sent[5]]))

    def test_a_missing_part_costs_its_datagram_and_is_told(self):
        first, second = self.parts(bytes(600), 3, 2), self.parts(bytes(range(250)) * 2, 2, 3)
        data = self.converted(datagrams([first[0], first[2], *second, made.installation()]), ".kmwcd", warning="1 message of which parts")
        self.assertEqual(len(data), len(made.installation()) + 24 + 4 + 500)


class S7k(Convert):
    def test_records_between_header_and_catalogue(self):
        records = [reson_wire.record(7610, struct.pack("<f", 1500 + i), device=7125 if i % 2 else 20, when=(2026, 1, i / 4, 0, 0))
                   for i in range(9)]
        talk = [reson_wire.record(7501, bytes(16), 7000)]
        data = self.converted(datagrams([reson_wire.packet(r, i) for i, r in enumerate(records[:4] + talk + records[4:])]), ".s7k")
        at, found = 0, []
        while at < len(data):
            size, = struct.unpack_from("<I", data, at + 8)
            found.append((at, reson_wire.Record(data[at:at + size])))
            at += size
        header, catalogue = found[0][1], found[-1][1]
        self.assertEqual([r.kind for _, r in found], [7200] + 9 * [7610] + [7300])
        self.assertEqual([r.data for _, r in found[1:-1]], records)
        self.assertEqual(header.get("I", 40), 2, "two devices spoke")
        optional, = struct.unpack_from("<I", header.data, 12)
        self.assertEqual(struct.unpack_from("<IQ", header.data, optional), (48 * 10, found[-1][0]))
        self.assertEqual(catalogue.get("IHII", 0), (14, 1, 10, 0))
        for i, (place, record) in enumerate(found[:-1]):
            size, offset, kind, device = catalogue.get("IQHH", 14 + 48 * i)
            self.assertEqual((size, offset, kind, device), (len(record.data), place, record.kind, record.device & 0xFFFF))
        self.assertEqual(self.reopened(".s7k")[-1]["name"], "FileCatalogue")


class Frames(Convert):
    def test_a_log_of_ping_viewer(self):
        frames = [device_data(i) for i in range(4)]
        data = self.converted(line([(frame, True) for frame in frames] + [(ping_frame(2601, bytes(14), 0), False)]), ".bin")

        def text(at):
            size, = struct.unpack_from(">I", data, at)
            return data[at + 4:at + 4 + size].decode("utf-16-be"), at + 4 + size

        title, at = text(0)
        self.assertEqual((title, struct.unpack_from(">I", data, at)[0]), ("PingViewer sensor log file", 1))
        at += 4
        for _ in range(5):
            _, at = text(at)
        self.assertEqual(struct.unpack_from(">II", data, at), (1, 2), "family Ping, a Ping360")
        at += 8
        for i, frame in enumerate(frames):
            time, at = text(at)
            size, = struct.unpack_from(">I", data, at)
            self.assertEqual((time, data[at + 4:at + 4 + size]), (f"00:00:00.{250 * i:03d}", frame))
            at += 4 + size
        self.assertEqual(at, len(data))

    def test_a_svlog(self):
        frames = svlog([5 + 0.1 * i for i in range(6)])
        wrapper = 10 + struct.unpack_from("<H", frames, 2)[0]
        size = (len(frames) - wrapper) // 6
        cut = [frames[wrapper + i * size:wrapper + (i + 1) * size] for i in range(6)]
        data = self.converted(line([(frame, True) for frame in cut]), ".svlog")
        length, number = struct.unpack_from("<HH", data, 2)
        self.assertEqual((data[:2], number), (b"BR", 10))
        self.assertEqual(json.loads(data[8:8 + length])["timestamp"], "1970-01-01T00:16:40Z")
        self.assertEqual(struct.unpack_from("<H", data, 8 + length)[0], sum(data[:8 + length]) & 0xFFFF)
        self.assertEqual(data[10 + length:], b"".join(cut))

    def test_one_of_several_lines_is_chosen(self):
        capture = Pcapng().interface(RTAC_SERIAL, b"port").interface(RTAC_SERIAL, b"starboard")
        for i in range(6):
            capture.packet(i % 2, rtac(device_data(i), 1), round((1000 + i) * 1e9))
        source = self.folder / "two"
        source.write_bytes(capture.data)
        self.assertIn("choose one with --line: 'port', 'starboard'", self.bad(64, "convert", source, self.folder / "a.bin"))
        self.converted(capture.data, ".bin", "--line", "starboard")
        self.assertEqual([field["value"] for m in self.reopened(".bin") for field in m["fields"] if field["name"] == "angle"],
                         [1, 3, 5])


class Aris(Convert):
    def parts(self, frame, size=1300):
        samples, out = frame[1024:], []
        for at in range(0, len(samples), size):
            part = aris_wire.field(1, struct.unpack_from("<I", frame)[0] + 1) + aris_wire.field(2, len(samples))
            part += aris_wire.field(3, frame[:744]) if at == 0 else b""
            part += aris_wire.field(4, samples[at:at + size])
            out.append(part + (aris_wire.field(5, at) if at else b""))
        return out

    def test_frames_in_the_order_of_files(self):
        frames = [made.aris_frame(i, 1700000000_000000 + 100000 * i, reordered=i % 2) for i in range(4)]
        parts = [self.parts(frame) for frame in frames]
        del parts[2][3]
        data = self.converted(datagrams([part for frame in parts for part in frame], 0.001), ".aris", warning="1 message of which")
        frame_size = 1024 + 48 * 200
        self.assertEqual(len(data), 1024 + 3 * frame_size)
        self.assertEqual(struct.unpack_from("<II", data), (0x05464444, 3))
        self.assertEqual(struct.unpack_from("<IfI", data, 16)[0::2], (48, 200))
        self.assertEqual(struct.unpack_from("<Q", data, 424)[0], len(data))
        for i, frame in enumerate([frames[0], frames[1], frames[3]]):
            written = data[1024 + i * frame_size:1024 + (i + 1) * frame_size]
            order = {"ping_mode": 1, "reordered": struct.unpack_from("<I", frame, 516)[0]}
            self.assertEqual(written[1024:], aris_wire.reorder(order, frame[1024:]))
            self.assertEqual(struct.unpack_from("<I", written)[0], i)
            self.assertEqual(struct.unpack_from("<I", written, 516)[0], 1)
            self.assertEqual(written[4:516], frame[4:516])


class Table(Convert):
    def test_a_row_for_each_message(self):
        self.converted(line([(device_data(i), True) for i in range(5)]), ".csv", "--message", "DeviceData")
        with open(self.folder / "out.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([(float(row["time"]), row["message"], int(row["angle"]), row["data"]) for row in rows],
                         [(0.25 * i, "DeviceData", i, f"1 2 3 {i}") for i in range(5)])
        self.assertEqual({row["direction"] for row in rows}, {"head line, sent"})

    def test_what_cannot_be_written_is_told(self):
        source = self.folder / "capture"
        source.write_bytes(line([(device_data(1), True)]))
        for out, status, why in (("a.kmall", 65, "no KMALL datagrams"), ("a.xyz", 64, "end it in .852, .81A, .31l, .kmall"),
                                 ("a.aris", 65, "no frames of an ARIS")):
            self.assertIn(why, self.bad(status, "convert", source, self.folder / out))
            self.assertFalse((self.folder / out).exists())
        self.assertIn("called Nothing", self.bad(65, "convert", source, self.folder / "a.csv", "--message", "Nothing"))
        self.assertIn("read twice", self.bad(64, "convert", "-", self.folder / "a.bin"))


if __name__ == "__main__":
    unittest.main()
