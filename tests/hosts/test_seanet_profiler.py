"""The profiler's host against bytes worked out by hand."""

import unittest
from pathlib import Path

import seanet_profiler as profiler
import seanet_wire as wire

DATA = Path(__file__).resolve().parents[1] / "data" / "seanet"


def frame_of(name):
    lines = (DATA / name).read_text().splitlines()
    digits = "".join(l.split("#")[0] for l in lines if not l.startswith(("#", "message", "field")))
    framer = wire.Framer()
    framer.feed(bytes.fromhex(digits))
    return framer.next()


class Profiler(unittest.TestCase):
    def test_reply_of_three_pings(self):
        reply = profiler.read_pass(frame_of("profiler_data.hex"))
        self.assertEqual(reply, profiler.Pass(True, 2399, 3999, 88, 203, [8000, 0, 2570]))
        bearings, ranges = zip(*reply.echoes())
        self.assertAlmostEqual(ranges[0], 6.0)
        self.assertEqual(ranges[1], 0)
        self.assertAlmostEqual(bearings[1], (2487 - 3200) * 3.141592653589793 / 3200)

    def test_command_has_the_bytes_of_the_notes(self):
        sent = profiler.Command(left=2399, right=3999, step=88, nearest=1.0).encode()
        expected = frame_of("profiler_command.hex").raw
        self.assertEqual(len(sent), 82)
        self.assertEqual(sent[:17].hex(), expected[:17].hex())
        self.assertEqual(sent[33:65].hex(), expected[33:65].hex())

    def test_an_imaging_sonars_reply_is_refused(self):
        with self.assertRaises(ValueError):
            profiler.read_pass(frame_of("head_data_8bit.hex"))


if __name__ == "__main__":
    unittest.main()
