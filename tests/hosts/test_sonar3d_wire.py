"""The reader of Range Image Protocol packets against a real recording."""

import struct
import unittest

from shared_data import needs_data
from sonar3d_wire import Image, unsnappy


class Recording(unittest.TestCase):
    def test_real_shots_are_pairs_of_images_that_agree(self):
        data = needs_data("sonar-3d-15/ship_short.sonar").read_bytes()
        images = []
        while data:
            size = struct.unpack("<I", data[4:8])[0]
            images.append(Image(data[:size]))
            data = data[size:]
        self.assertEqual(len(images), 12)
        for ranges, strengths in zip(images[::2], images[1::2]):
            self.assertEqual((ranges.time, ranges.sequence), (strengths.time, strengths.sequence))
            self.assertEqual((ranges.width, ranges.height, *ranges.fov), (256, 64, 90, 40))
            self.assertEqual((ranges.range, ranges.sound_speed, ranges.frequency), (15, 1491, 5))
            self.assertEqual([m == 0 for m in ranges.metres], [s == 0 for s in strengths.strengths])

    def test_every_element_of_snappy(self):
        block = bytes.fromhex("150c6162636401040a04000f02000000f005787878787878")
        self.assertEqual(unsnappy(block), b"abcdabcdabcbcbcxxxxxx")


if __name__ == "__main__":
    unittest.main()
