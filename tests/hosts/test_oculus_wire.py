"""Self-test of the Oculus host's reader: three real pings, and messages put together here, byte by byte."""

import math
import struct
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import oculus_wire as wire
from shared_data import needs_data


def result(rows=2, beams=2, image_size=None, offset=136, bearings=(-3000, 3000)):
    """A v1 result of 8-bit samples 0, 1, 2, .. behind a gap."""
    image = bytes(range(rows * beams))
    size = offset + len(image)
    head = struct.pack("<HHHHHIH", 0x4F53, 7, 0, 0x23, 0, size - 16, 0)
    head += struct.pack("<BBBBBdddd", 1, 0, 255, 127, 9, 10.0, 50.0, 0.0, 35.0)
    head += struct.pack("<IIdddd", 5, 0, 750e3, 8.0, 0.3, 1480.0)
    head += struct.pack("<IBdHH", 1000, 0, 0.01, rows, beams)
    head += struct.pack("<III", offset, len(image) if image_size is None else image_size, size)
    return (head + struct.pack(f"<{len(bearings)}h", *bearings)).ljust(offset, b"\0") + image


class Reader(unittest.TestCase):
    def test_a_fire_has_the_bytes_of_the_description(self):
        v1 = wire.fire(mode=2, rate=0, gamma=127, flags=0x0D, range=2.54)
        self.assertEqual(v1[:21].hex(), "534f000000001500000025000000" + "0000" + "0200ff7f0d")
        self.assertEqual((len(v1), len(wire.fire(version=2))), (53, 89))
        self.assertEqual(wire.fire(version=2, ext_flags=wire.BITS32)[53:57], b"\0\2\0\0")

    def test_a_result_is_read_row_by_row(self):
        ping, faults = wire.read_result(result())
        self.assertEqual(faults, [])
        self.assertEqual((ping.ping, ping.row(0), ping.row(1), ping.column(1)), (5, (0, 1), (2, 3), [1, 3]))
        self.assertEqual((ping.beam(25), ping.metres(1)), (1, 0.015))

    def test_what_contradicts_itself_is_a_fault(self):
        self.assertEqual(wire.read_result(result(image_size=5))[1][0][:16], "image of 5 bytes")
        self.assertIsNone(wire.read_result(result(offset=124))[0])
        self.assertIn("bearings do not ascend", wire.read_result(result(bearings=(30, 20)))[1])
        linear = [-3000 + 600 * i for i in range(11)]
        self.assertTrue(wire.read_result(result(beams=11, offset=160, bearings=linear))[1])
        self.assertEqual(wire.read_status(bytes(141))[0], None)

    def test_real_pings_have_no_faults(self):
        data, at, seen = needs_data("oculus/three_pings_8bit.raw").read_bytes(), 0, []
        while at < len(data):
            size = 16 + wire.read_header(data[at:])["size"]
            ping, faults = wire.read_result(data[at : at + size])
            self.assertEqual(faults, [])
            seen.append(ping.ping)
            self.assertEqual((ping.ranges, ping.beams, ping.sample_bytes), (703, 256, 1))
            self.assertAlmostEqual(ping.bearings[1], math.degrees(math.asin(-0.5 + 1 / 255)), delta=0.01)
            at += size
        self.assertEqual(seen, [415323, 415324, 415325])


if __name__ == "__main__":
    unittest.main()
