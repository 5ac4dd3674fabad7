"""The messages of the Omniscan 450 and the S500 by the golden frames of tests/data."""

import unittest
from pathlib import Path

import cerulean_wire as wire
from surveyor_wire import Reader

GOLDEN = Path(__file__).resolve().parents[1] / "data" / "cerulean"


def golden(name):
    lines = (GOLDEN / f"{name}.hex").read_text().splitlines()
    digits = [line.split("#")[0] for line in lines if not line.startswith(("message", "field"))]
    return bytes.fromhex("".join(digits))


def payload(name):
    (frame,) = Reader().feed(golden(name))
    return frame.payload


class Messages(unittest.TestCase):
    def test_parameters_are_those_of_the_golden_frames(self):
        self.assertEqual(wire.os_ping_params(length_mm=10000, msec_per_ping=50).hex(), golden("os_ping_params").hex())
        self.assertEqual(
            wire.s500_ping_params(length_mm=0, msec_per_ping=-1, chirp=1).hex(), golden("s500_ping_params").hex()
        )
        self.assertRaises(ValueError, wire.os_ping_params, length=5)

    def test_an_omniscan_profile(self):
        profile = wire.read_omniscan(payload("os_mono_profile"))
        self.assertEqual((profile.number, profile.start, profile.length, profile.gain), (7, 0.5, 15.0, 4))
        for level, expected in zip(profile.levels(), (-72.5, -12.5, -42.5)):
            self.assertAlmostEqual(level, expected, places=2)
        self.assertAlmostEqual(profile.range_of(1), 8.0)
        self.assertAlmostEqual(profile.edge(10), 8.0)
        self.assertAlmostEqual(profile.edge(1, beyond=9), 13.0)

    def test_an_s500_profile_and_distance(self):
        sounding = wire.read_s500(payload("profile6"))
        self.assertEqual((sounding.depth, sounding.smooth_depth, sounding.confidence), (2.25, 2.5, 99))
        self.assertEqual((sounding.hertz, sounding.decimation), ((450000, 550000), 2))
        self.assertEqual([round(level, 3) for level in sounding.profile.levels()], [-3.5, -93.5])
        self.assertEqual(wire.read_distance2(payload("distance2")), (2.01, 2.0, 100, 95, 60000))

    def test_a_lying_count_is_a_fault(self):
        self.assertRaises(ValueError, wire.read_omniscan, payload("os_mono_profile")[:-2])
        self.assertRaises(ValueError, wire.read_s500, payload("profile6") + b"\0\0")


if __name__ == "__main__":
    unittest.main()
