"""Self-test of the readers of R2Sonic's water column, snippets and TruePix, on datagrams put together here."""

import struct
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from r2sonic_reader import Reader
from r2sonic_water import read_sni0, read_tpx0, read_wcd0
from test_r2sonic_host import h0, packet, section


def long_h0(points):
    short = h0(points)
    return section("H0", short[4:] + struct.pack(">6f", 0.1, 0.119, 0, 0, 0, 0))


def column(first, values, kind="M1", total=4):
    head = struct.pack(">IfIIHHHHII", 7, 0, total, first, len(values[0]), 2, 0, 2, 0, 0)
    cells = b"".join(
        struct.pack(">H", v) if kind == "M1" else struct.pack(">Hh", *v) for row in values for v in row
    )
    return packet("WCD0", section(kind, head + cells))


def snippet(number, samples, first=100):
    head = struct.pack(">IHHIfffI", 7, number, len(samples), first, -0.5, 0, 0, 0)
    return section("S1", head + struct.pack(f">{len(samples)}H", *samples))


class WaterColumn(unittest.TestCase):
    HEADER = packet("WCD0", h0(2), section("A1", bytes(24) + struct.pack(">2f", -0.3, 0.3)))

    def test_parts_make_a_ping(self):
        reader = Reader()
        events = [
            e
            for data in (self.HEADER, column(0, [[1, 2], [3, 4]]), column(2, [[5, 6], [7, 8]]))
            for e in reader.datagram(5, data)
        ]
        self.assertEqual([e["event"] for e in events], ["column_header", "part", "column"])
        self.assertEqual(events[-1]["gathered"].rows, [[1, 2, 5, 6], [3, 4, 7, 8]])
        self.assertEqual(reader.faults, 0)

    def test_phases_are_signed(self):
        (_, part), faults = read_wcd0(column(0, [[(9, -5)], [(65535, 7)]], "M2"))
        self.assertEqual((part.magnitudes, part.phases, faults), ([(9,), (65535,)], [(-5,), (7,)], []))

    def test_gaps_and_lies_are_faults(self):
        reader = Reader()
        reader.datagram(5, self.HEADER)
        self.assertTrue(reader.datagram(5, column(2, [[5, 6], [7, 8]]))[0]["faults"])
        whole = column(0, [[1, 2], [3, 4]])
        for size in range(len(whole)):
            self.assertTrue(read_wcd0(whole[:size])[1], size)
        self.assertTrue(read_wcd0(column(3, [[1, 2], [3, 4]]))[1])


class Snippets(unittest.TestCase):
    def test_several_in_a_datagram(self):
        first = packet("SNI0", long_h0(3), snippet(0, [1, 2, 3]), snippet(1, [4]))
        (header, snippets), faults = read_sni0(first)
        self.assertEqual((header["points"], faults), (3, []))
        self.assertAlmostEqual(header["more"][1], 0.119, places=6)
        self.assertEqual([s.magnitudes for s in snippets], [(1, 2, 3), (4,)])
        reader = Reader()
        reader.datagram(6, first)
        reader.datagram(6, packet("SNI0", snippet(2, [9, 9])))
        told = reader.datagram(6, first)[0]
        self.assertEqual((told["event"], sorted(told["gathered"].snippets)), ("snippets", [0, 1, 2]))
        for size in range(len(first)):
            self.assertTrue(read_sni0(first[:size])[1], size)

    def test_a_number_twice_is_a_fault(self):
        reader = Reader()
        data = packet("SNI0", long_h0(1), snippet(0, [1]), snippet(0, [1]))
        self.assertTrue(reader.datagram(6, data)[-1]["faults"])


class TruePix(unittest.TestCase):
    def test_magnitude_and_direction(self):
        head = struct.pack(">IIIHH8f", 7, 3, 0, 2, 0, *[0] * 8)
        plain = packet("TPX0", long_h0(0), section("D0", head + struct.pack(">4H", 1, 2, 3, 4)))
        (header, part), faults = read_tpx0(plain)
        self.assertEqual((part.port, part.starboard, faults), ((1, 3), (2, 4), []))
        later = struct.pack(">IIIHH8f", 7, 3, 2, 1, 0, *[0] * 8)
        directed = packet("TPX0", section("D1", later + struct.pack(">fHhHh", 0.25, 5, -2, 6, 3)))
        (_, part), faults = read_tpx0(directed)
        self.assertEqual((part.angles, faults), (((-0.5,), (0.75,)), []))
        reader = Reader()
        events = reader.datagram(1, plain) + reader.datagram(1, directed)
        self.assertEqual([e["event"] for e in events], ["part", "truepix"])
        for size in range(len(plain)):
            self.assertTrue(read_tpx0(plain[:size])[1], size)


if __name__ == "__main__":
    unittest.main()
