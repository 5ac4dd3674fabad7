"""The Imagenex hosts prove themselves on the published examples and on recordings of a real 852."""

import unittest

import imagenex_wire as wire
from shared_data import needs_data


class Words(unittest.TestCase):
    def test_the_command_of_a_known_host(self):
        made = wire.command(range=5, train=60, sector=20, step=8)
        self.assertEqual(made.hex(), "fe441005000043001401143c1408060000000032080600000064fd")
        with self.assertRaises(ValueError):
            wire.command(delay=253)

    def test_the_header_of_a_real_reply(self):
        reply = wire.parse(bytes.fromhex("49475811 45780A0A 40037403") + bytes(500) + b"\xfc")
        self.assertEqual((reply.letter, reply.range, reply.profile, len(reply.data)), ("G", 10, 448, 500))
        for at in (0, 2, 10, 11, 512):
            bad = bytearray(bytes.fromhex("49475811 45780A0A 40037403") + bytes(500) + b"\xfc")
            bad[at] ^= 1
            with self.assertRaises(AssertionError):
                wire.parse(bytes(bad))


class Files(unittest.TestCase):
    def test_recordings_of_a_real_852(self):
        for name, shots in (("19_26_51-2016_11_18-sonar.852", 917), ("hydroball.852", 177)):
            read = wire.read_file(needs_data(f"imagenex852/{name}").read_bytes())
            self.assertEqual(len(read), shots)
            self.assertEqual({shot.sound_speed for shot in read}, {1460.0})
            for shot in read:
                self.assertLessEqual(max(wire.parse(shot.reply).data), 127)


if __name__ == "__main__":
    unittest.main()
