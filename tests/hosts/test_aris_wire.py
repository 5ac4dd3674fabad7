"""The wire of the ARIS host against bytes worked out from the specification notes."""

import unittest

import aris_wire as wire


class ArisWire(unittest.TestCase):
    def test_commands_are_those_of_the_notes(self):
        acoustics = wire.message(7, 15.0, 1014, 2028, 10500, 8, 11, 3, True, 1, True, 18.0)
        expected = "00000025 0803 2a21 0807 1500007041 18f607 20ec0f 288452 3008 380b 4003 4801 5001 5801 6500009041"
        self.assertEqual(wire.command(wire.SET_ACOUSTICS, 5, acoustics), bytes.fromhex(expected))
        self.assertEqual(wire.command(wire.PING, 16, b""), bytes.fromhex("00000005 080e 820100"))
        self.assertEqual(wire.command(wire.SET_SALINITY, 6, wire.message(0)), bytes.fromhex("00000004 0804 3200"))

    def test_a_beacon_is_read(self):
        seen = wire.beacon(bytes.fromhex("08e907 1000 1a07080210081 8b345 2000".replace(" ", "")))
        self.assertEqual((seen["serial"], seen["type"], seen["state"]), (1001, 0, 0))
        self.assertEqual(seen["version"], {1: [2], 2: [8], 3: [8883]})

    def test_what_is_cut_is_no_message(self):
        for data in ("08", "0a05", "0b"):
            with self.assertRaises(ValueError):
                wire.fields(bytes.fromhex(data))

    def test_samples_are_put_in_order_by_ping_and_channel(self):
        # Two samples of 48 beams: the byte of ping 1, sample 1, channel 2 belongs to beam 1 + 14 * 3.
        data = bytearray(96)
        data[1 * 2 * 16 + 1 * 16 + 2] = 200
        image = wire.reorder({"ping_mode": 1, "reordered": 0}, bytes(data))
        self.assertEqual(image.index(200), 1 * 48 + 1 + 14 * 3)
        self.assertEqual(sum(image), 200)


if __name__ == "__main__":
    unittest.main()
