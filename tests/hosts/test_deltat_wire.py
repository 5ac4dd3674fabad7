"""The reader of 83P against bytes that were worked out by hand."""

import unittest

import deltat_wire as wire


def profile(beams=120, intensity=True):
    data = bytearray(256 + (4 if intensity else 2) * beams)
    data[0:4] = b"83P\x0a"
    data[4:6] = len(data).to_bytes(2, "big")
    data[8:20], data[20:29], data[29:33] = b"21-NOV-2026\0", b"22:05:07\0", b".12\0"
    data[64:66], data[66:68], data[68:70] = b"\x83\x75", b"\x83\x9b", b"\x8a\x99"  # 885, 923, 2713
    data[70:72], data[74:76], data[76:78], data[78] = bytes([0, beams]), b"\0\x78", b"\x2e\xe0", 100
    data[79:81], data[81:83], data[83:85], data[85:87] = b"\0\x14", b"\x01\x04", b"\xb9\xe7", b"\0\x28"
    data[89:91] = b"\0\xb4"
    data[112:117], data[117] = b".123\0", int(intensity)
    data[256 + 2 * 60 : 258 + 2 * 60] = b"\0\xc8"  # 200 x 40 mm straight down
    return data


class Reader(unittest.TestCase):
    def test_fields(self):
        p = wire.read_83p(bytes(profile()))
        self.assertEqual((p.pitch, p.roll, p.heading, p.sound_speed), (-1.5, 2.3, 271.3, 1482.3))
        self.assertEqual((p.start, p.angle(119), p.range, p.frequency, p.tilt), (-60, 59, 20, 260, 0))
        self.assertEqual(p.points(), [(0, 8)])
        self.assertEqual(p.time, "2026-11-21T22:05:07.123")
        self.assertEqual(len(p.intensities), 120)
        self.assertEqual(wire.read_83p(bytes(profile(intensity=False))).intensities, [])

    def test_faults(self):
        for at, value in ((0, 0x39), (5, 1), (71, 119), (117, 0), (10, 0x78), (12, 0x6F), (200, 1), (6, 0x23), (32, 1)):
            data = profile()
            data[at] = value
            with self.subTest(at), self.assertRaises(ValueError):
                wire.read_83p(bytes(data))

    def test_control(self):
        data = wire.control(range=40, sector=90, beams=120, sound_speed=1480, little=True)
        self.assertEqual((len(data), data[:2], data[3], data[7], data[11], data[13]), (256, b"EC", 1, 6, 2, 2))
        self.assertEqual(data[17:19], b"\xd0\x39")


if __name__ == "__main__":
    unittest.main()
