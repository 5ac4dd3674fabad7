"""Self-test of the rangefinder's parser: its quirks are those that the description of BLPing names."""

import struct
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from blping_host import CONTINUOUS_START, DISTANCE_SIMPLE, Parser, frame

DISTANCE = frame(DISTANCE_SIMPLE, struct.pack("<IB", 3210, 97))


def heard(data):
    """Numbers of the messages, once for every byte behind which the parser has one."""
    parser = Parser()
    return [parser.number for byte in data if parser.feed(byte)]


class Frames(unittest.TestCase):
    def test_are_those_of_the_definition(self):
        self.assertEqual(frame(CONTINUOUS_START, b"\xbb\x04").hex(), "4252020078050001bb04d301")

    def test_a_distance_is_heard(self):
        parser = Parser()
        self.assertEqual([parser.feed(b) for b in DISTANCE], [False] * 14 + [True])
        self.assertEqual(struct.unpack("<IB", parser.payload), (3210, 97))

    def test_a_long_payload_is_summed_and_cut(self):
        parser = Parser()
        self.assertTrue([parser.feed(b) for b in frame(1300, bytes(range(226)))][-1])
        self.assertEqual(parser.payload, bytes(range(20)))


class Quirks(unittest.TestCase):
    def test_an_empty_payload_loses_the_next_frame(self):
        self.assertEqual(heard(frame(1300, b"") + DISTANCE + DISTANCE), [DISTANCE_SIMPLE])

    def test_a_stray_byte_behind_a_good_frame_counts_again(self):
        self.assertEqual(len(heard(DISTANCE + b"x" + DISTANCE)), 3)
        self.assertEqual(len(heard(DISTANCE + b"B" + DISTANCE)), 1, "and a B loses the next")

    def test_a_flipped_byte_is_no_distance(self):
        self.assertEqual(heard(DISTANCE[:9] + b"\x01" + DISTANCE[10:]), [])


if __name__ == "__main__":
    unittest.main()
