"""Self-test of the R2Sonic host: real BTH0 datagrams and datagrams put together here, field by field."""

import math
import statistics
import struct
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import r2sonic_host
import r2sonic_wire as wire
from r2sonic_reader import Reader, soundings
from shared_data import needs_data, udp_payloads


def section(name, body):
    body += bytes(-len(body) % 4)
    return name.encode() + struct.pack(">H", len(body) + 4) + body


def packet(name, *sections):
    body = b"".join(sections)
    return name.encode() + struct.pack(">II", len(body) + 12, 0) + body


def h0(points, ping=7, nanoseconds=0, sample_rate=60000.0):
    """H0 with a period of 50 ms, 1500 m/s and the fields that are not named below zero."""
    body = (
        b"2024".ljust(12, b"\0") + b"100017".ljust(12, b"\0") + struct.pack(">III", 1000, nanoseconds, ping)
    )
    body += struct.pack(">11f", 0.05, 1500, 400e3, 206, 35e-6, 0, 0, 0, 0, 0, 0)[:-8]
    body += struct.pack(">Hh", 0, -26) + struct.pack(">7f", 30e3, sample_rate, 20, 11, 15, 81, 0)
    return section("H0", body + struct.pack(">IHH", 3, 0, points))


def equi_angle(n=5, ping=7, nanoseconds=0, q=0x77777000, **more):
    """BTH0 of a flat floor 7.5 m below, n points from -40 to 40 deg, with R0 in units of 1 us."""
    angles = [math.radians(-40 + 80 * i / (n - 1)) for i in range(n)]
    times = [round(7.5 / math.cos(a) / 750 * 1e6) for a in angles]
    parts = [
        h0(n, ping, nanoseconds),
        section("R0", struct.pack(f">f{n}H", 1e-6, *times)),
        section("A0", struct.pack(">8f", angles[0], angles[-1], 0.01, 0, 0, 0, 0, 0)),
    ]
    parts += [more["i1"]] if "i1" in more else []
    parts += [section("G0", struct.pack(">3f", 0.001, 0.02, 0.1))]
    parts += [section("G1", struct.pack(f">f{2 * n}B", 1e-4, *range(2 * n)))] if "g1" in more else []
    return packet("BTH0", *parts, section("Q0", struct.pack(">I", q)))


class RealData(unittest.TestCase):
    """The facts measured on the Sonic 2026's recording."""

    def setUp(self):
        self.datagrams = [data for _, data in udp_payloads(needs_data("r2sonic/r2sonic_bth0_20.pcap"))]
        self.reader = Reader()
        self.events = [event for data in self.datagrams for event in self.reader.datagram(0, data)]
        self.pings = [event["ping"] for event in self.events]

    def test_all_pings_are_whole_and_without_fault(self):
        self.assertEqual({len(data) for data in self.datagrams}, {1864})
        self.assertEqual([event["faults"] for event in self.events], [[]] * 20)
        self.assertEqual(self.reader.lost, 0)
        self.assertEqual({tuple(p.order) for p in self.pings}, {("H0", "R0", "A2", "I1", "G0", "Q0")})

    def test_sections_stand_where_the_description_says(self):
        found, _ = wire.read_sections(self.datagrams[0], "BTH0")
        self.assertEqual([s.offset for s in found], [12, 128, 648, 1196, 1716, 1732])

    def test_header_values(self):
        for ping in self.pings:
            h = ping.header
            self.assertEqual(
                (h["model"], h["serial"], h["points"], h["reserved108"]), ("2026", "100996-2026", 256, 3)
            )
            for name, value in {
                "frequency": 400e3,
                "power": 206,
                "bandwidth": 30e3,
                "sample_rate": 65280,
                "gain": 11,
                "spreading": 15,
                "absorption": 81,
                "tilt": 0,
            }.items():
                self.assertAlmostEqual(h[name], value, places=2, msg=name)
            self.assertAlmostEqual(h["pulse"], 35e-6, delta=1e-9)
            self.assertAlmostEqual(h["period"], 2 * h["range"] / h["sound_speed"] + 0.010, delta=2e-4)
            self.assertAlmostEqual(math.degrees(h["beam_vertical"]), 1.0, places=3)
            self.assertAlmostEqual(math.degrees(h["beam_horizontal"]), 0.5, places=3)
            self.assertTrue(29100 <= h["temperature"] <= 29200 and -26 <= h["vtx"] <= -3)

    def test_scales_angles_and_flags(self):
        for ping in self.pings:
            self.assertAlmostEqual(ping.scales["R0"], 1 / (4 * 65280), delta=1e-12)
            self.assertTrue(7.0e-7 < ping.scales["A2"] < 7.06e-7)
            self.assertTrue(-66 <= math.degrees(ping.angles[0]) <= -58)
            self.assertAlmostEqual(ping.more[1], 0.119, places=5)
            self.assertTrue(-0.07301 <= ping.more[0] <= 0.064)
            self.assertAlmostEqual(ping.angles[0] - ping.more[0], -1.07788, places=4)
            self.assertEqual(ping.scales["I1"], 1.0)
            self.assertTrue(all(0 <= v <= 2493 for v in ping.intensity))
            self.assertEqual(set(ping.quality), {0xB, 0x7})

    def test_soundings_lie_015_m_apart_across_track(self):
        for ping in self.pings:
            across = [p["x"] for p in soundings(ping)]
            steps = [later - earlier for earlier, later in zip(across, across[1:])]
            self.assertTrue(0.14 < statistics.mean(steps) < 0.16, statistics.mean(steps))


class Bathymetry(unittest.TestCase):
    def test_flat_floor_in_equi_angle_mode(self):
        ping, faults = wire.read_bth0(equi_angle())
        self.assertEqual((faults, ping.mode, ping.quality), ([], "equi-angle", [7] * 5))
        for point, degrees in zip(soundings(ping), (-40, -20, 0, 20, 40)):
            self.assertAlmostEqual(math.degrees(point["angle"]), degrees, places=4)
            self.assertAlmostEqual(point["depth"], 7.5, places=3)
            self.assertAlmostEqual(point["x"], 7.5 * math.tan(math.radians(degrees)), places=3)

    def test_equi_distant_angles_include_the_step_of_their_own_point(self):
        a2 = section("A2", struct.pack(">8f3H", -0.5, 0.25, 0, 0, 0, 0, 0, 0, 0, 1, 3))
        data = packet(
            "BTH0",
            h0(3),
            section("R0", struct.pack(">f3H", 1e-6, 1, 2, 3)),
            a2,
            section("G0", bytes(12)),
            section("Q0", struct.pack(">I", 0x12300000)),
        )
        ping, faults = wire.read_bth0(data)
        self.assertEqual((faults, ping.angles, ping.quality), ([], [-0.5, -0.25, 0.5], [1, 2, 3]))

    def test_intensity_and_gates(self):
        i1 = section("I1", struct.pack(">f5H", 0.5, 2, 4, 6, 8, 10))
        ping, faults = wire.read_bth0(equi_angle(i1=i1, g1=True))
        self.assertEqual((faults, ping.intensity), ([], [1, 2, 3, 4, 5]))
        self.assertAlmostEqual(ping.gates[4][1], 9e-4)
        self.assertAlmostEqual(ping.gate[2], 0.1, places=6)

    def test_every_truncation_is_a_fault(self):
        data = equi_angle(i1=section("I1", struct.pack(">f5H", 0.5, 2, 4, 6, 8, 10)))
        for size in range(len(data)):
            ping, faults = wire.read_bth0(data[:size])
            self.assertTrue(faults, size)

    def test_what_is_wrong_is_said(self):
        good = equi_angle()
        for wrong, word in [
            (good[:4] + b"\0\0\0\1" + good[8:], "PacketSize"),
            (equi_angle(q=0x77777001), "Q0"),
            (good[:8] + b"\0\0\0\1" + good[12:], "DataStreamID"),
            (b"BTH1" + good[4:], "BTH0"),
            (equi_angle(n=4), "Q0"),
        ]:
            with self.subTest(word):
                self.assertIn(word, " ".join(wire.read_bth0(wrong)[1]) or "nothing")

    def test_lost_and_repeated_pings(self):
        reader = Reader()
        faults = [
            reader.datagram(0, equi_angle(ping=n, nanoseconds=at))[0]["faults"]
            for n, at in [(1, 0), (2, 50_000_000), (5, 200_000_000), (5, 200_000_000), (6, 290_000_000)]
        ]
        self.assertEqual(reader.lost, 2)
        self.assertEqual([len(f) for f in faults], [0, 0, 0, 1, 1])


class Images(unittest.TestCase):
    HEADER = packet("AID0", h0(4), section("A1", bytes(24) + struct.pack(">4f", -0.3, -0.1, 0.1, 0.3)))

    @staticmethod
    def part(first_bin, data, bins=2, ping=7, total=6):
        return packet(
            "AID0",
            section(
                "M0",
                struct.pack(">IfIIIHHHHI", ping, 0, 60, total, first_bin, bins, 4, 0, 4, 0) + bytes(data),
            ),
        )

    def read(self, *datagrams):
        reader = Reader()
        return reader, [event for data in datagrams for event in reader.datagram(3, data)]

    def test_an_image_comes_together_beam_after_beam(self):
        reader, events = self.read(
            self.HEADER, self.part(0, range(8)), self.part(2, range(8, 16)), self.part(4, range(16, 24))
        )
        self.assertEqual([e["event"] for e in events], ["image_header", "part", "part", "image"])
        image = events[-1]["image"]
        self.assertEqual([list(row) for row in image.rows][1], [2, 3, 10, 11, 18, 19])
        self.assertAlmostEqual(image.bin_metres(), 10 / 60000 * 750)
        self.assertEqual(reader.faults, 0)
        self.assertEqual(r2sonic_host.describe_image(image)["strongest_beam"], 3)

    def test_parts_of_another_ping_are_stale(self):
        reader, events = self.read(self.part(0, range(8)), self.HEADER, self.part(0, range(8), ping=8))
        self.assertEqual([e["event"] for e in events], ["stale", "image_header", "stale"])
        self.assertEqual(reader.stale, 2)

    def test_a_missing_part_is_told_with_the_next_header(self):
        _, events = self.read(self.HEADER, self.part(0, range(8)), self.HEADER)
        self.assertEqual(events[-1]["faults"], ["image 7 lacks 16 bins"])

    def test_bins_in_the_wrong_order_or_twice_are_faults(self):
        _, events = self.read(
            self.HEADER,
            self.part(4, range(8)),
            self.part(2, range(8)),
            self.part(2, range(8)),
            self.part(0, range(8)),
        )
        self.assertIn("before", events[3]["faults"][0])
        self.assertIn("too early", events[4]["faults"][0])

    def test_lies_about_sizes_are_faults(self):
        for data in (
            self.part(0, range(4)),
            self.part(5, range(8)),
            self.part(0, range(12), bins=3)[:-1],
            self.part(0, range(8), total=70),
        ):
            self.assertTrue(self.read(self.HEADER, data)[1][-1]["faults"])
