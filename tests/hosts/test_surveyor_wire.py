"""The Surveyor's frames by the description's own examples and by the golden frames of tests/data."""

import math
import unittest
from pathlib import Path

import surveyor_wire as wire

GOLDEN = Path(__file__).resolve().parents[1] / "data" / "cerulean"


def golden(name):
    lines = (GOLDEN / f"surveyor_{name}.hex").read_text().splitlines()
    digits = [line.split("#")[0] for line in lines if not line.startswith(("message", "field"))]
    return bytes.fromhex("".join(digits))


class Frames(unittest.TestCase):
    def test_the_descriptions_example(self):
        self.assertEqual(wire.request(5).hex(), "4252020006000000" + "0500" + "a100")

    def test_parameters_are_those_of_the_golden_frame(self):
        made = wire.ping_parameters(start_mm=1000, end_mm=0)
        self.assertEqual(made.hex(), golden("ping_parameters").hex())
        self.assertRaises(ValueError, wire.ping_parameters, end=5)

    def test_points_and_attitude(self):
        (frame,) = wire.Reader().feed(golden("atof_point_data"))
        ping = wire.read_atof(frame.payload)
        self.assertEqual((ping.number, ping.sound_speed, len(ping.points)), (42, 1500.0, 2))
        d = 1500 * 0.0078125 / 2
        self.assertAlmostEqual(ping.points[0][0], d * math.sin(0.5))
        self.assertAlmostEqual(ping.points[0][1], -d * math.cos(0.5))
        (frame,) = wire.Reader().feed(golden("yz_point_data"))
        ping = wire.read_yz(frame.payload)
        self.assertEqual(ping.points, [(-3.0, -5.0)])
        self.assertEqual((ping.header["bar"], ping.header["start"], ping.header["end"]), (-1000, 0.5, 10.0))
        (frame,) = wire.Reader().feed(golden("attitude_report"))
        roll, pitch, utc_msec, pwr_up_msec = wire.read_attitude(frame.payload)
        self.assertAlmostEqual(math.tan(roll), 0.5 / 0.875)
        self.assertEqual((pitch, utc_msec, pwr_up_msec), (0, 0, 61250))

    def test_pieces_noise_and_damage(self):
        data = golden("atof_point_data")
        reader = wire.Reader()
        self.assertEqual([frame.id for byte in data for frame in reader.feed(bytes([byte]))], [wire.ATOF_POINTS])
        self.assertRaises(ValueError, wire.Reader().feed, b"\0" + data)
        self.assertRaises(ValueError, wire.Reader().feed, data[:-1] + b"\0")
        self.assertRaises(ValueError, wire.read_atof, data[8:-4])

    def test_a_rolled_head_is_turned_level(self):
        y, z = wire.levelled((math.sin(0.3), -math.cos(0.3)), -0.3)
        self.assertAlmostEqual(y, 0)
        self.assertAlmostEqual(z, -1)


if __name__ == "__main__":
    unittest.main()
