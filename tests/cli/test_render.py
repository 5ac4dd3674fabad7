"""echoloop render: pictures and tables, and that they appear whole or not at all."""
import array
import ast
import csv
import math
import os
import struct
import unittest

from program import DEMO, TANK, ProgramTest

SONAR = ("--device", "sonar")


def read_npy(path):
    """(shape, values) of a float32 NumPy file."""
    data = path.read_bytes()
    assert data[:8] == b"\x93NUMPY\x01\x00"
    (size,) = struct.unpack_from("<H", data, 8)
    header = ast.literal_eval(data[10:10 + size].decode())
    assert header["descr"] == "<f4" and not header["fortran_order"]
    return header["shape"], array.array("f", data[10 + size:])


class Render(ProgramTest):
    def left_over(self):
        return sorted(p.name for p in self.folder.iterdir())

    def test_a_turn_of_the_tank_shows_its_walls(self):
        out = self.folder / "turn.csv"
        self.good("render", TANK, "--out", out, "--range", "10", "--set", "effects.speckle=off",
                  "--set", "effects.multipath=off")  # or the corner at floor and surface, 6.32 m, is the strongest
        rows = list(csv.reader(out.read_text().splitlines()))
        ranges = [float(r) for r in rows[0][1:]]
        self.assertEqual(len(rows) - 1, 200)

        def strongest(bearing):
            row = min(rows[1:], key=lambda r: abs((float(r[0]) - bearing + 180) % 360 - 180))
            levels = {r: float(v) for r, v in zip(ranges, row[1:]) if r > 1}  # nearer, the head rings down
            return max(levels, key=levels.get)

        # Walls 6 m ahead and astern, 4 m to starboard; a bin is 20 mm. To port a lattice stands before the wall.
        self.assertAlmostEqual(strongest(0), 6, delta=0.05)
        self.assertAlmostEqual(strongest(180), 6, delta=0.05)
        self.assertLess(abs(ranges[-1] - 10), 0.05)

    def test_picture(self):
        out = self.folder / "fan.png"
        text = self.good("render", DEMO, *SONAR, "--out", out, "--width", "600")
        self.assertIn("256 beams", text)
        data = out.read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack_from(">I", data, 16), (600,))
        self.assertEqual(self.left_over(), ["fan.png"])

    def test_pictures_as_vectors(self):
        for ending, begin, end in (("svg", b"<?xml", b"</svg>\n"), ("pdf", b"%PDF-", b"%%EOF\n")):
            out = self.folder / f"fan.{ending}"
            self.good("render", DEMO, *SONAR, "--out", out)
            data = out.read_bytes()
            self.assertTrue(data.startswith(begin) and data.endswith(end), (data[:20], data[-20:]))

    def test_the_first_device_is_drawn_unless_another_is_named(self):
        report = self.json("render", DEMO, "--out", self.folder / "turn.npy", "--step", "0")
        self.assertEqual(report["device"], "micron")

    def test_array_and_report_agree(self):
        out = self.folder / "fan.npy"
        report = self.json("render", DEMO, *SONAR, "--out", out)
        shape, values = read_npy(out)
        self.assertEqual(shape, (report["beams"], report["bins"]))
        self.assertEqual(len(values), shape[0] * shape[1])
        self.assertGreater(max(values), 0)

    def test_the_same_scenario_gives_the_same_bytes_twice(self):
        first, second = self.folder / "1.npy", self.folder / "2.npy"
        self.good("render", TANK, "--out", first, "--step", "50")
        self.good("render", TANK, "--out", second, "--step", "50")
        self.assertEqual(first.read_bytes(), second.read_bytes())
        self.assertEqual(read_npy(first)[0][0], 1)

    def test_a_waterfall_draws_the_pings_of_a_head_one_below_the_other(self):
        out = self.folder / "turns.png"
        report = self.json("render", TANK, "--out", out, "--waterfall", "--pings", "450", "--width", "800")
        self.assertEqual(report["pings"], 450)
        width, height = struct.unpack_from(">II", out.read_bytes(), 16)
        self.assertEqual(width, 800)
        self.assertGreaterEqual(height, 450)

    def test_pings_go_on_in_time_and_round_the_turn(self):
        out = self.folder / "turns.npy"
        self.good("render", TANK, "--out", out, "--pings", "203", "--set", "effects.noise=off", "--set",
                  "effects.multipath=off", "--set", "effects.speckle=off")
        (lines, bins), values = read_npy(out)
        self.assertEqual(lines, 203)

        def differs(a, b):  # dB, of all that is heard behind the ring-down
            powers = [sum(values[k * bins + bins // 4:(k + 1) * bins]) for k in (a, b)]
            return abs(10 * math.log10(powers[0] / powers[1]))

        self.assertLess(differs(2, 202), 0.3)  # the same bearing, a turn later

    def test_a_waterfall_wants_one_beam_and_a_picture(self):
        out = self.folder / "x.png"
        self.assertIn("sonar has 256: leave it out to draw the fan",
                      self.bad(64, "render", DEMO, *SONAR, "--out", out, "--waterfall"))
        self.assertIn("end the name of --out with .png",
                      self.bad(64, "render", TANK, "--out", self.folder / "x.npy", "--waterfall"))
        self.assertIn("--pings: expected a whole number", self.bad(64, "render", TANK, "--out", out, "--pings", "1.5"))
        self.assertEqual(self.left_over(), [])

    def test_the_papers_rule_stays_between_0_and_1(self):
        out = self.folder / "paper.npy"
        report = self.json("render", DEMO, *SONAR, "--out", out, "--rule", "cerqueira2016")
        self.assertEqual(report["rule"], "cerqueira2016")
        _, values = read_npy(out)
        self.assertTrue(0 < max(values) <= 1)

    def test_the_papers_three_channels(self):
        out = self.folder / "channels.npy"
        self.good("render", DEMO, *SONAR, "--out", out, "--channels")
        (channels, height, width), values = read_npy(out)
        self.assertEqual(channels, 3)
        intensity = values[:height * width]
        ranges = [r for r in values[height * width:2 * height * width] if r == r]
        self.assertTrue(0 <= min(intensity) <= max(intensity) <= 1)
        self.assertTrue(0 < min(ranges))

    def test_an_opengl_of_2010_draws_the_same_if_it_can_set_its_range_of_depths(self):
        one, old = self.folder / "1.npy", self.folder / "old.npy"
        where = (DEMO, *SONAR, "--set", "render.context=egl-surfaceless", "--out")
        self.good("render", *where, one)
        self.good("render", *where, old, MESA_GL_VERSION_OVERRIDE="3.3")
        self.assertEqual(one.read_bytes(), old.read_bytes())
        self.assertIn("3.3 with GL_ARB_clip_control",
                      self.bad(69, "render", *where, self.folder / "x.npy", MESA_GL_VERSION_OVERRIDE="3.3",
                               MESA_EXTENSION_OVERRIDE="-GL_ARB_clip_control"))
        self.assertIn("no OpenGL 3.3 core", self.bad(69, "render", *where, self.folder / "x.npy",
                                                     MESA_GL_VERSION_OVERRIDE="3.2"))

    def test_wrong_usage(self):
        out = self.folder / "x.png"
        self.assertIn("did you mean 'micron'?", self.bad(64, "render", DEMO, "--out", out, "--device", "mircon"))
        self.assertIn(".png, .svg, .pdf, .csv or .npy", self.bad(64, "render", TANK, "--out", self.folder / "x.jpg"))
        self.assertIn("--step: expected a number, 0 to 199", self.bad(64, "render", TANK, "--out", out, "--step", "200"))
        self.assertIn("end the name of --out with .npy", self.bad(64, "render", TANK, "--out", out, "--channels"))
        self.assertIn("--out is required", self.bad(64, "render", TANK))
        self.assertEqual(self.left_over(), [])

    def test_a_place_that_cannot_be_written_ends_with_73_before_any_work(self):
        self.assertIn("cannot create '/proc/x.png'", self.bad(73, "render", TANK, "--out", "/proc/x.png"))
        self.assertIn("No such file or directory", self.bad(73, "render", TANK, "--out", self.folder / "no" / "x.png"))
        (self.folder / "d.png").mkdir()
        self.assertIn("it is a folder", self.bad(73, "render", TANK, "--out", self.folder / "d.png"))

    def test_an_older_file_is_replaced_only_by_a_whole_one(self):
        out = self.folder / "turn.csv"
        out.write_text("old")
        self.bad(64, "render", TANK, "--out", out, "--device", "none")
        self.assertEqual(out.read_text(), "old")
        self.good("render", TANK, "--out", out, "--step", "0")
        self.assertNotEqual(out.read_text(), "old")


if __name__ == "__main__":
    unittest.main()
