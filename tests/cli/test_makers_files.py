"""The makers' own recordings are taken by inspect, replay and diff: .kmall, .s7k, .aris, .oculus, .xtf with R2Sonic, and
all of them packed by gzip. Files are made from their descriptions around bytes that real sonars said."""
import bz2
import gzip
import json
import lzma
import random
import socket
import struct
import sys
import unittest

import makers_files as made
from program import ROOT, ProgramTest, run

sys.path.insert(0, str(ROOT / "tests" / "hosts"))
import reson_wire  # noqa: E402


class Makers(ProgramTest):
    def file(self, data, name):
        path = self.folder / name
        path.write_bytes(data)
        return path

    def inspected(self, path, warning=""):
        done = run("inspect", path, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr.decode(), warning or r"^$")
        return json.loads(done.stdout)["messages"]

    def port(self, path):
        port, = self.json("replay", path, "--list")["ports"]
        return port

    def replayed(self, path, count):
        """Datagrams that a replay sends."""
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as listener:
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
            listener.bind(("127.0.0.1", 0))
            listener.settimeout(20)
            done = run("replay", path, "udp://127.0.0.1:%d" % listener.getsockname()[1], "--start", "now", "--speed", 50)
            self.assertEqual(done.returncode, 0, done.stderr)
            return [listener.recv(65536) for _ in range(count)]

    def equal(self, a, b):
        self.assertTrue(json.loads(run("diff", a, b, "--everything", "--json").stdout)["equal"])

    @staticmethod
    def value(message, name):
        return next(field["value"] for field in message["fields"] if field["name"] == name)

    def recorded_pings(self):
        """BTH0 datagrams of a real R2Sonic 2026: Ethernet, IPv4 and UDP in a pcap."""
        data = self.shared("r2sonic", "r2sonic_bth0_20.pcap").read_bytes()
        at, out, pending = 24, [], {}
        while at < len(data):
            size = struct.unpack_from("<I", data, at + 8)[0]
            packet, at = data[at + 16:at + 16 + size], at + 16 + size
            flags, = struct.unpack_from(">H", packet, 20)
            length, identification = struct.unpack_from(">HH", packet, 16)
            body = packet[34:14 + length]
            pending.setdefault(identification, {})[flags & 0x1FFF] = body
            if not flags & 0x2000:
                out.append(b"".join(part for _, part in sorted(pending.pop(identification).items()))[8:])
        return out

    def recorded_results(self):
        """Three results of a real Oculus M750d as on TCP: a header of 16 bytes tells the length."""
        data = self.shared("oculus", "three_pings_8bit.raw").read_bytes()
        out = []
        while data:
            size = 16 + struct.unpack_from("<I", data, 10)[0]
            out.append(data[:size])
            data = data[size:]
        return out


class Kmall(Makers):
    def whole(self):
        return [made.installation(), made.installation(b"#IOP"), made.profile(),
                *(made.kmall(b"#SPO", bytes(100), 1700000000 + i) for i in range(1, 6))]

    def test_datagrams_with_their_times(self):
        found = self.inspected(self.file(b"".join(self.whole()), "a.kmall"))
        self.assertEqual(len(found), 8)
        self.assertEqual([m["time"] for m in found[3:]], [1, 2, 3, 4, 5])
        self.assertEqual({m["line"] for m in found}, {"kmall, sent"})

    def test_a_replay_sends_each_as_it_is(self):
        self.assertEqual(self.replayed(self.file(b"".join(self.whole()), "a.kmall"), 8), self.whole())

    def test_what_no_datagram_can_hold_goes_in_parts(self):
        body = struct.pack("<HH", 1, 1) + bytes(range(250)) * 400
        large = made.kmall(b"#MWC", body, 1700000001)
        parts = self.replayed(self.file(made.installation() + large, "a.kmwcd"), 3)[1:]
        self.assertEqual([struct.unpack_from("<HH", part, 20) for part in parts], [(2, 1), (2, 2)])
        self.assertTrue(all(struct.unpack_from("<I", part)[0] == len(part) for part in parts))
        self.assertEqual(b"".join(part[24:-4] for part in parts), body[4:])

    def test_reading_goes_on_behind_damage(self):
        good = self.whole()
        cut = good[3][:50] + good[3][70:]
        lying = b"\xFF\xFF\x0F\x00" + good[4][4:]
        for damaged, lost in ((cut, 1), (lying, 1), (good[3] + b"noise #SPO noise", 0)):
            data = b"".join([*good[:3], damaged, *good[4:]])
            found = self.inspected(self.file(data, "a.kmall"), r"the first at byte %d; reading went on" % (
                len(b"".join(good[:3])) + (0 if lost else len(good[3]))))
            self.assertEqual(len(found), 8 - lost)
        self.inspected(self.file(b"".join(good)[:-10], "a.kmall"), r"ends early: the last 114 bytes, from byte \d+ on")


class Xtf(Makers):
    def test_bathymetry_is_what_the_sounder_sent(self):
        pings = self.recorded_pings()
        packets = []
        for i, ping in enumerate(pings):
            packets += [made.attitude(), made.xtf_ping(65 if i % 2 else 68, ping, hundredths=5 * i)]
        path = self.file(made.xtf(packets), "a.xtf")
        found = self.inspected(path)
        self.assertEqual([m["name"] for m in found], 20 * ["BTH0"])
        self.assertAlmostEqual(found[-1]["time"], 0.95, places=5)
        self.assertEqual(self.replayed(path, 20), pings)
        # A capture of the same sounder holds the same messages.
        self.equal(path, self.shared("r2sonic", "r2sonic_bth0_20.pcap"))

    def test_many_channels_have_headers_of_their_own_and_damage_is_passed_over(self):
        ping = self.recorded_pings()[0]
        file = made.xtf([made.xtf_ping(65, ping, second=i) for i in range(5)], channels=9)
        data = file[:1024] + bytes(1024) + file[1024:]
        self.assertEqual(len(self.inspected(self.file(data, "a.xtf"))), 5)
        hurt = bytearray(data)
        hurt[2048 + len(file[1024:]) // 5:][:2] = b"xx"
        begin = 2048 + len(file[1024:]) // 5
        hurt[begin:begin + 2] = b"xx"
        self.assertEqual(len(self.inspected(self.file(bytes(hurt), "a.xtf"), f"the first at byte {begin};")), 4)


    def test_without_a_sounder_of_that_maker_it_says_what_is_missing(self):
        path = self.file(made.xtf([made.xtf_packet(0, bytes(50)), made.attitude()]), "side.xtf")
        text = self.bad(65, "inspect", path)
        self.assertIn("(types 65, 66, 68, 69) are read, and none of its 2 packets is one", text)


class Oculus(Makers):
    def file_of(self, compressed=0):
        return made.oculus([item for i, result in enumerate(self.recorded_results()) for item in (
            (2, 1700000000 + i, b"$HCHDT,1.0,T*11\r\n", 0), (10, 1700000000.5 + i, result, compressed))])

    def test_messages_as_on_tcp_with_the_times_of_the_file(self):
        for compressed in (0, 1):
            found = self.inspected(self.file(self.file_of(compressed), "a.oculus"))
            self.assertEqual([(m["name"], m["time"]) for m in found], [("Result", 0), ("Result", 1), ("Result", 2)])
        self.assertEqual(self.port(self.folder / "a.oculus")["device"], {"pieces": 3, "bytes": 546048})
        self.equal(self.folder / "a.oculus", self.shared("oculus", "three_pings_8bit.raw"))

    def test_damage_and_what_cannot_be_read(self):
        data = self.file_of(1)
        second = data.index(b"\xDD\xCC\xBB\xAA", 48 + 40 + 17 + 40 + 100)
        hurt = data[:second + 30] + b"\xFF\xFF\xFF\xFF" + data[second + 34:]
        self.assertEqual(len(self.inspected(self.file(hurt, "b.oculus"), f"the first at byte {second};")), 3)
        middle = data[:second - 500] + data[second - 400:]
        self.assertEqual(len(self.inspected(self.file(middle, "c.oculus"), "are no whole record")), 2)
        path = self.file(made.oculus([], encryption=1), "d.oculus")
        self.assertIn("encrypted", self.bad(65, "inspect", path))


class Aris(Makers):
    def whole(self, count=5):
        return made.aris([made.aris_frame(i, 1700000000_000000 + 100000 * i) for i in range(count)])

    def test_frames_with_their_headers_and_times(self):
        path = self.file(self.whole(), "a.aris")
        found = self.inspected(path)
        self.assertEqual([m["name"] for m in found], 5 * ["FramePart"])
        self.assertEqual([round(m["time"], 6) for m in found], [0, 0.1, 0.2, 0.3, 0.4])
        self.assertEqual(self.value(found[3], "header.index"), 3)
        self.equal(path, path)

    def test_a_replay_sends_parts_that_make_the_frame_again(self):
        """Protobuf as the maker's description has it: 1 index, 2 size, 3 header, 4 data, 5 offset."""
        import aris_wire
        parts = [aris_wire.fields(part) for part in self.replayed(self.file(self.whole(2), "a.aris"), 16)]
        for frame in (1, 2):
            mine = [part for part in parts if part[1] == [frame]]
            self.assertEqual(mine[0][3][0], made.aris_frame(frame - 1, 1700000000_000000 + 100000 * (frame - 1))[:744])
            self.assertEqual(b"".join(part[4][0] for part in mine), made.aris_frame(0, 0)[1024:])

    def test_damage(self):
        data = self.whole()
        begin, size = 1024 + 2 * (1024 + 9600), 1024 + 9600
        cut = data[:begin + 300] + data[begin + 400:]
        self.assertEqual(len(self.inspected(self.file(cut, "a.aris"), "the first at byte")), 4)
        cut = data[:begin + 3000] + data[begin + 4000:]
        self.assertEqual(len(self.inspected(self.file(cut, "c.aris"), f"{size - 1000} bytes .* at byte {begin};")), 4)
        hurt = data[:begin + 436] + b"\x07" + data[begin + 437:]
        self.assertEqual(len(self.inspected(self.file(hurt, "b.aris"), f"{size} bytes .* the first at byte {begin};")), 4)


class S7k(Makers):
    def whole(self):
        settings = [reson_wire.Record(reson_wire.record(7610, struct.pack("<f", 1480 + i), when=(2026, 1, i * 0.5, 0, 0)))
                    for i in range(6)]
        return settings, reson_wire.file_of(settings)

    def test_header_and_catalogue_are_named_and_records_read(self):
        records, data = self.whole()
        names = [m["name"] for m in self.inspected(self.file(data, "a.s7k"))]
        self.assertEqual((names[0], names[-1], len(names)), ("FileHeader", "FileCatalogue", len(records) + 2))

    def test_a_replay_sends_the_records_in_packets_without_what_only_files_hold(self):
        records, data = self.whole()
        path = self.file(data, "a.s7k")
        self.assertAlmostEqual(self.port(path)["end"], 2.5, places=5)
        sent = self.replayed(path, len(records))
        self.assertEqual([packet[36:] for packet in sent], [record.data for record in records])
        self.assertEqual({struct.unpack_from("<HH", packet) for packet in sent}, {(5, 36)})
        self.equal(path, path)

    def test_damage(self):
        records, data = self.whole()
        at = data.index(records[2].data)
        hurt = data[:at + 3] + data[at + 9:]
        names = [m["name"] for m in self.inspected(self.file(hurt, "a.s7k")) if m["name"]]
        self.assertEqual(len(names), len(records) + 1)


class Packed(Makers):
    def test_gzip_is_read_as_if_it_were_not(self):
        whole = b"".join(Kmall.whole(self))
        plain = self.file(whole, "a.kmall")
        expected = self.inspected(plain)
        for name, packed in (("a.kmall.gz", gzip.compress(whole)),
                             ("two members.gz", gzip.compress(whole[:500]) + gzip.compress(whole[500:]))):
            self.assertEqual(self.inspected(self.file(packed, name)), expected)
        self.equal(plain, self.folder / "a.kmall.gz")
        self.assertEqual(self.replayed(self.folder / "a.kmall.gz", 8), Kmall.whole(self))
        pcap = self.shared("r2sonic", "r2sonic_bth0_20.pcap")
        self.equal(pcap, self.file(gzip.compress(pcap.read_bytes()), "a.pcap.gz"))
        done = run("inspect", "-", "--summary", stdin=gzip.compress(pcap.read_bytes()))
        self.assertIn(b"messages: BTH0 20;", done.stdout)

    def test_what_is_cut_or_packed_otherwise_is_told(self):
        whole = b"".join(Kmall.whole(self)) + made.kmall(b"#IIP", bytes(6) + random.Random(1).randbytes(20000))
        packed = gzip.compress(whole)
        found = self.inspected(self.file(packed[:-5000], "cut.gz"), "ends early: .*")
        self.assertEqual(len(found), 8)
        hurt = packed[:-3000] + bytes(200) + packed[-2800:]
        self.inspected(self.file(hurt, "hurt.gz"), "ends early: .*")
        for name, other in (("bzip2", bz2.compress(whole)), ("xz", lzma.compress(whole))):
            self.assertIn(f"is compressed by {name}; unpack it first", self.bad(65, "inspect", self.file(other, "x." + name)))


if __name__ == "__main__":
    unittest.main()
