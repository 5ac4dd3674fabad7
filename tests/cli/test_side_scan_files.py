"""Side-scans in files: `echoloop convert` writes .jsf and .xtf of what an EdgeTech said, .xtf of what an Imagenex 872 said, and
inspect, replay and diff read both. Messages and files are made and read here by the offsets of their descriptions."""
import csv
import json
import struct
import unittest

import makers_files as made
from captures import RTAC_SERIAL, Pcapng, rtac
from program import ProgramTest, run
from test_convert_recordings import Convert, line


def message(kind, body, command=0, subsystem=21, channel=0):
    return struct.pack("<HBBHBBBBHI", 0x1601, 13, 0, kind, command, subsystem, channel, 0, 0, len(body)) + body


def side(ping, channel, samples, weighting=4, subsystem=21):
    """One side of a ping to 30 m, 0.25 s behind each other from 22:13:20 on."""
    head = bytearray(240)
    milliseconds = 80000000 + 250 * ping
    for at, form, value in ((0, "i", 1700000000 + ping // 4), (8, "I", ping), (28, "h", 1), (30, "H", 0x4029), (80, "i", 6300000),
                            (84, "i", 35640000), (88, "h", 2), (114, "H", len(samples)), (116, "I", 40000000 // len(samples)),
                            (126, "H", 39000), (128, "H", 43000), (148, "f", 1500), (168, "h", weighting), (172, "H", 9000),
                            (174, "h", -182), (176, "h", 364), (200, "I", milliseconds), (220, "H", 1)):
        struct.pack_into("<" + form, head, at, value)
    return message(80, bytes(head) + struct.pack("<%dH" % len(samples), *samples), subsystem=subsystem, channel=channel)


PORT, STARBOARD = list(range(100, 1100, 10)), list(range(2000, 1000, -10))
LINE = [part for ping in range(1, 6) for part in ((side(ping, 0, PORT), True), (side(ping, 1, STARBOARD, 5), True))]


def captured(messages):
    return line(messages, b"sonar data")


def fields(messages):
    return [{f["name"]: f["value"] for f in m["fields"]} for m in messages]


class Jsf(Convert):
    def test_data_behind_what_the_system_is_and_without_answers(self):
        answer = message(128, struct.pack("<I", 30000), command=2)
        moved = message(2020, bytes(44))
        data = self.converted(captured([(answer, True), *LINE, (moved, True), (message(120, bytes(4)), False)]), ".jsf")
        system, rest = data[:16 + 24 + 8], data[16 + 24 + 8:]
        self.assertEqual(struct.unpack_from("<H", system, 4)[0], 182)
        self.assertEqual(system[-8:], b"echoloop")
        self.assertEqual(rest, b"".join(data for data, _ in LINE) + moved)
        found = self.reopened(".jsf")
        self.assertEqual([m["name"] for m in found], ["SystemInformation"] + 10 * ["SonarData"] + ["PitchRoll"])
        first = {f["name"]: f["value"] for f in found[1]["fields"]}
        self.assertEqual((first["ping"], first["weighting"], first["samples"]), (1, 4, 100))

    def test_a_file_is_replayed_by_its_times_and_compared(self):
        path = self.folder / "a.jsf"
        path.write_bytes(b"".join(data for data, _ in LINE))
        table = self.folder / "a.csv"
        self.assertEqual(run("convert", path, table).returncode, 0)
        times = [float(row["time"]) for row in csv.DictReader(table.read_text().splitlines())]
        self.assertAlmostEqual(times[-1] - times[0], 1.0, places=3)
        other = self.folder / "b.jsf"
        other.write_bytes(b"".join(data for data, _ in LINE[:4]) + side(3, 0, PORT[::-1]) + b"".join(data for data, _ in LINE[5:]))
        self.assertTrue(json.loads(run("diff", path, path, "--everything", "--json").stdout)["equal"])
        self.assertFalse(json.loads(run("diff", path, other, "--everything", "--json").stdout)["equal"])

    def test_of_other_sonars_there_is_none(self):
        source = self.folder / "capture"
        source.write_bytes(captured([(message(128, bytes(4), command=2), True)]))
        self.assertIn("no data of an EdgeTech side-scan", self.bad(65, "convert", source, self.folder / "out.jsf"))


class Xtf(Convert):
    def packets(self, data):
        """(header, [(channel header, samples)]) of each."""
        at, out = 1024, []
        while at < len(data):
            mark, kind, _, channels, size = struct.unpack_from("<HBBH4xI", data, at)
            self.assertEqual((mark, kind, size % 64), (0xFACE, 0, 0))
            place, sides = at + 256, []
            for _ in range(channels):
                count = struct.unpack_from("<I", data, place + 42)[0]
                sides.append((data[place:place + 64], struct.unpack_from("<%dH" % count, data, place + 64)))
                place += 64 + 2 * count
            out.append((data[at:at + 256], sides))
            at += size
        return out

    def test_a_packet_for_each_ping_with_both_sides(self):
        data = self.converted(captured(LINE), ".xtf")
        self.assertEqual(data[0], 0x7B)
        self.assertEqual(struct.unpack_from("<HHH", data, 164), (3, 2, 0), "latitude and longitude, two channels")
        for number, kind in ((0, 1), (1, 2)):
            info = data[256 + 128 * number:]
            self.assertEqual((info[0], info[1], struct.unpack_from("<H", info, 6)[0], info[74]), (kind, number, 2, 3))
            self.assertEqual(struct.unpack_from("<f", info, 32)[0], 410)
        found = self.packets(data)
        self.assertEqual(len(found), 5)
        head, sides = found[1]
        self.assertEqual(struct.unpack_from("<H8B", head, 14), (2023, 11, 14, 22, 13, 20, 50, 318 % 256, 318 // 256))
        self.assertEqual(struct.unpack_from("<I", head, 28)[0], 2)
        latitude, longitude = struct.unpack_from("<dd", head, 160)
        self.assertAlmostEqual(latitude, 59.4, places=6)
        self.assertAlmostEqual(longitude, 10.5, places=6)
        pitch, roll, heading = struct.unpack_from("<fff", head, 204)
        self.assertEqual([round(v, 2) for v in (pitch, roll, heading)], [-1, 2, 90])
        for number, (channel, _) in enumerate(sides):
            self.assertEqual(struct.unpack_from("<H", channel)[0], number)
            self.assertAlmostEqual(struct.unpack_from("<f", channel, 4)[0], 30, places=4)
            self.assertEqual(struct.unpack_from("<h", channel, 58)[0], 0, "a weight is applied in whole numbers by readers")
        # One scale for all: the strongest of the run, 1090 / 16, is full scale; port begins far away.
        scale = 65535 / (1090 / 16)
        self.assertEqual(sides[0][1], tuple(round(scale * v / 16) for v in reversed(PORT)))
        self.assertEqual(sides[1][1], tuple(round(scale * v / 32) for v in STARBOARD))

    def test_a_side_without_the_other_is_a_packet_of_its_own(self):
        messages = [m for i, m in enumerate(LINE) if i != 4]
        found = self.packets(self.converted(captured(messages), ".xtf"))
        self.assertEqual([len(sides) for _, sides in found], [2, 2, 1, 2, 2])
        self.assertEqual(struct.unpack_from("<H", found[2][1][0][0])[0], 1)

    def test_two_frequencies_have_four_channels(self):
        low = [(side(1, channel, PORT, subsystem=20), True) for channel in (0, 1)]
        found = self.packets(self.converted(captured([*LINE[:2], *low, *LINE[2:]]), ".xtf"))
        self.assertEqual([[struct.unpack_from("<H", head)[0] for head, _ in sides] for _, sides in found][:3], [[2, 3], [0, 1], [2, 3]])
        names = [(f["subsystem"], f["channel"]) for f in fields(self.reopened(".xtf"))][:4]
        self.assertEqual(names, [(21, 0), (21, 1), (20, 0), (20, 1)])

    def test_what_was_written_is_read_as_it_was(self):
        self.converted(captured(LINE), ".xtf")
        found = fields(self.reopened(".xtf"))
        self.assertEqual([(f["ping"], f["channel"]) for f in found], [(p, c) for p in range(1, 6) for c in (0, 1)])
        for name, value in (("samples", 100), ("interval", 400000), ("heading", 9000), ("pitch", -182), ("roll", 364), ("x", 6300000),
                            ("y", 35640000), ("subsystem", 21), ("start_frequency", 41000)):
            self.assertEqual(found[0][name], value, name)
        self.assertEqual(found[4]["milliseconds"], 80000750)

    def test_bytes_and_lying_counts_of_other_programs(self):
        """8 bits, as many programs write; then a channel that claims more samples than its packet has."""
        header = bytearray(made.xtf([]))
        struct.pack_into("<HH", header, 166, 2, 0)
        for number in (0, 1):
            struct.pack_into("<BBHHH", header, 256 + 128 * number, number + 1, number, 1, 1, 1)
        def channel(number, samples, count=None):
            head = bytearray(64)
            struct.pack_into("<HHf", head, 0, number, 0, 75)
            struct.pack_into("<H", head, 26, 100)
            struct.pack_into("<I", head, 42, len(samples) if count is None else count)
            return bytes(head) + samples
        good = made.xtf_ping(0, channel(0, bytes(range(200))) + channel(1, bytes(range(200))))
        lying = made.xtf_ping(0, channel(0, bytes(200)) + channel(1, bytes(200), 0xFFFFFFFF), second=16)
        packets = [bytearray(good), bytearray(lying)]
        for packet in packets:
            struct.pack_into("<H", packet, 4, 2)
        path = self.folder / "b.xtf"
        path.write_bytes(bytes(header) + b"".join(packets))
        found = fields(json.loads(run("inspect", path, "--json").stdout)["messages"])
        self.assertEqual([(f["channel"], f["samples"], f["subsystem"]) for f in found], [(0, 200, 20), (1, 200, 20), (0, 200, 20)])
        self.assertEqual(found[0]["interval"], 500000)


class Xtf872(Convert):
    """An Imagenex 872 is asked for one side after the other; its reply has no frequency, the host's command has one."""
    NEAR_TO_FAR = bytes(i // 4 for i in range(1000))

    @staticmethod
    def asked(packet, frequency=2, range_=30):
        command = bytearray(27)
        command[:2], command[3], command[7], command[8], command[18], command[26] = b"\xfeD", range_, frequency, 40, packet, 0xFD
        return bytes(command), False

    @staticmethod
    def reply(side, samples, range_=30):
        header = bytes([0x49, 0x47, 0x58, 0x10, 0x40, 0, side, range_, 0, 0, 1000 % 128, 1000 // 128])
        return header + samples + b"\xfc", True

    def pair(self, **settings):
        """Port from near to far, starboard the other way round."""
        far = {k: v for k, v in settings.items() if k == "range_"}
        return [self.asked(0, **settings), self.reply(2, self.NEAR_TO_FAR, **far),
                self.asked(2, **settings), self.reply(1, self.NEAR_TO_FAR[::-1], **far)]

    def packets(self, data):
        """As of an EdgeTech, with samples of one byte each."""
        at, out = 1024, []
        while at < len(data):
            channels, size = struct.unpack_from("<H4xI", data, at + 4)
            self.assertEqual((data[at:at + 3], size % 64), (b"\xce\xfa\0", 0))
            sides = [(data[at + 256 + 1064 * i:][:64], data[at + 320 + 1064 * i:][:1000]) for i in range(channels)]
            out.append((data[at:at + 256], sides))
            at += size
        return out

    def test_a_packet_for_each_ping_with_both_sides(self):
        data = self.converted(line(self.pair() + self.pair(range_=50)), ".xtf")
        self.assertEqual((data[0], data[18:30]), (0x7B, b"Imagenex 872"))
        self.assertEqual(struct.unpack_from("<HHH", data, 164), (3, 2, 0))
        for number, kind in ((0, 1), (1, 2)):
            info = data[256 + 128 * number:]
            self.assertEqual((info[0], info[1], struct.unpack_from("<H", info, 6)[0], info[74]), (kind, number, 1, 8))
            self.assertEqual(struct.unpack_from("<f", info, 32)[0], 800)
        found = self.packets(data)
        self.assertEqual([struct.unpack_from("<I", head, 28)[0] for head, _ in found], [1, 2])
        # Four messages each, 0.25 s apart from 1000 s on: the ping was when its port side was asked for.
        self.assertEqual([struct.unpack_from("<H6B", head, 14) for head, _ in found],
                         [(1970, 1, 1, 0, 16, 40, 0), (1970, 1, 1, 0, 16, 41, 0)])
        for (head, sides), range_ in zip(found, (30, 50)):
            self.assertEqual(struct.unpack_from("<f", head, 72)[0], 1500)
            for number, (channel, samples) in enumerate(sides):
                self.assertEqual((struct.unpack_from("<H", channel)[0], struct.unpack_from("<I", channel, 42)[0]), (number, 1000))
                self.assertAlmostEqual(struct.unpack_from("<f", channel, 4)[0], range_)
                self.assertAlmostEqual(struct.unpack_from("<f", channel, 20)[0], 2 * range_ / 1500)
                self.assertEqual(struct.unpack_from("<H", channel, 26)[0], 800)
                self.assertEqual(samples, self.NEAR_TO_FAR[::-1], "port begins far away")

    def test_a_side_without_the_other_is_a_packet_of_its_own(self):
        first, second = self.pair(frequency=0), self.pair(frequency=1)
        data = self.converted(line(first[:2] + second + first[2:]), ".xtf")
        found = self.packets(data)
        self.assertEqual([[(struct.unpack_from("<H", head)[0], struct.unpack_from("<H", head, 26)[0]) for head, _ in sides]
                          for _, sides in found], [[(0, 260)], [(0, 330), (1, 330)], [(1, 260)]])

    def test_two_frequencies_have_two_channels(self):
        self.assertEqual(struct.unpack_from("<H", self.converted(line(self.pair(frequency=0) + self.pair()), ".xtf"), 166)[0], 2)

    def test_what_was_written_is_read_as_it_was(self):
        self.converted(line(self.pair() * 3), ".xtf")
        found = fields(self.reopened(".xtf"))
        self.assertEqual([(f["ping"], f["channel"]) for f in found], [(p, c) for p in (1, 2, 3) for c in (0, 1)])
        for name, value in (("samples", 1000), ("interval", 40000), ("subsystem", 21),
                            ("start_frequency", 80000 - 65536)):  # the upper bits stand elsewhere
            self.assertEqual(found[0][name], value, name)

    def test_without_the_host_the_frequency_is_not_known(self):
        found = self.packets(self.converted(line([m for m in self.pair() if m[1]]), ".xtf"))
        self.assertEqual([struct.unpack_from("<H", head, 26)[0] for head, _ in found[0][1]], [0, 0])
        self.assertEqual(struct.unpack_from("<H6B", found[0][0], 14), (1970, 1, 1, 0, 16, 40, 0), "the time of the reply")

    def test_other_heads_have_no_sides(self):
        source = self.folder / "capture"
        source.write_bytes(line([(bytes([0x49, 0x47, 0x58, 0x10, 0x40, 0, 2, 30, 0, 0, 500 % 128, 500 // 128]) + bytes(500) + b"\xfc", True)]))
        self.assertIn("no data of an EdgeTech side-scan and no replies of an Imagenex 872", self.bad(65, "convert", source, self.folder / "a.xtf"))

    def test_of_two_side_scans_one_is_chosen(self):
        source, out = self.folder / "capture", self.folder / "a.xtf"
        capture = Pcapng()
        for number, (name, messages) in enumerate(((b"yellow", self.pair()), (b"edge", LINE))):
            capture.interface(RTAC_SERIAL, name)
            for i, (data, sent) in enumerate(messages):
                capture.packet(number, rtac(data, 1 if sent else 2), round((1000 + 10 * number + i) * 1e9))
        source.write_bytes(capture.data)
        self.assertRegex(self.bad(64, "convert", source, out), "several lines.*edge.*yellow|several lines.*yellow.*edge")
        for name, sonar in (("yellow", b"Imagenex"), ("edge", b"EdgeTech")):
            self.assertEqual(run("convert", source, out, "--line", name).returncode, 0)
            self.assertEqual(out.read_bytes()[18:26], sonar)


if __name__ == "__main__":
    unittest.main()
