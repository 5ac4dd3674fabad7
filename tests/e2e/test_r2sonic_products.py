"""The Sonics' bathymetry of slopes and steps, their water column, snippets and TruePix, end to end over UDP."""

import math
import statistics
import sys
import tempfile
import unittest
from pathlib import Path

from program import ROOT
from test_r2sonic import R2SonicCase

from r2sonic_reader import soundings

sys.path.insert(0, str(ROOT / "tools"))
from scenes.glb import Node, glb  # noqa: E402
from scenes.materials import SONAR  # noqa: E402
from scenes.mesh import Mesh  # noqa: E402

HEAD_Z, FLOOR_Z, RAISED_Z, EDGE_Y = -6.0, -20.0, -18.0, -6.0  # the raised floor lies south, to starboard


def step_scene():
    floor = Mesh()
    floor.quad((-50, EDGE_Y, FLOOR_Z), (50, EDGE_Y, FLOOR_Z), (50, 100, FLOOR_Z), (-50, 100, FLOOR_Z))
    floor.quad((-50, EDGE_Y, RAISED_Z), (50, EDGE_Y, RAISED_Z), (50, EDGE_Y, FLOOR_Z), (-50, EDGE_Y, FLOOR_Z))
    floor.quad((-50, -100, RAISED_Z), (50, -100, RAISED_Z), (50, EDGE_Y, RAISED_Z), (-50, EDGE_Y, RAISED_Z))
    return [Node("floor", [("sand", floor)])]


class Shapes(R2SonicCase):
    def inner(self, ping):
        points = [p for p in soundings(ping) if abs(p["angle"]) <= math.radians(60)]
        self.assertGreater(len(points), 150)
        for p in points:
            self.assertTrue(p["quality"] & 0xC, f"no bottom at {math.degrees(p['angle']):.1f} deg")
        return points

    def test_a_slope_of_15_degrees(self):
        depth = 10.0
        host, _ = self.start(z=FLOOR_Z + depth, options=", range: 50, power: 215", roll=15.0)
        for ping in self.pings(host, 2):
            for p in self.inner(ping):
                truth = depth / math.cos(p["angle"] - math.radians(15))
                self.assertLess(abs(p["range"] - truth) / truth, 0.005, f"at {math.degrees(p['angle']):.1f} deg")

    def test_a_step_of_two_metres(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "step.glb"
            file.write_bytes(glb(step_scene(), SONAR))
            host, _ = self.start(z=HEAD_Z, options=", range: 40, power: 200", scene=str(file))
            low, high = HEAD_Z - FLOOR_Z, HEAD_Z - RAISED_Z
            foot, top = math.atan(-EDGE_Y / low), math.atan(-EDGE_Y / high)
            for ping in self.pings(host, 2):
                for p in self.inner(ping):
                    if foot - math.radians(0.7) < p["angle"] < top + math.radians(0.7):
                        self.assertTrue(high - 0.1 < p["depth"] < low + 0.1, "on the wall")
                        continue
                    truth = low if p["angle"] < foot else high
                    self.assertLess(abs(p["depth"] - truth) / truth, 0.005, f"at {math.degrees(p['angle']):.1f} deg")

    def test_every_model_finds_the_floor(self):
        for model, beam in (("r2sonic-2020", 2.0), ("r2sonic-2022", 1.0), ("r2sonic-2026", 0.5)):
            with self.subTest(model):
                host, emulator = self.start(z=HEAD_Z, options=", range: 40, power: 205", model=model)
                ping = self.pings(host, 1)[0]
                self.assertEqual(ping.header["model"], model[-4:])
                self.assertAlmostEqual(math.degrees(ping.header["beam_horizontal"]), beam, places=3)
                for p in self.inner(ping):
                    self.assertLess(abs(p["depth"] - 14) / 14, 0.005, p["angle"])
                emulator.stop()

    def test_points_of_an_empty_gate_are_bad_and_noise_is_not_believed(self):
        host, _ = self.start(z=HEAD_Z, options=", range: 40, power: 0")
        ping = self.pings(host, 1)[0]
        good = sum(1 for p in soundings(ping) if p["quality"] & 0xC)
        self.assertLess(good, 8, "a head that does not transmit has no bottom")


class Products(R2SonicCase):
    def gathered(self, event, options):
        host, _ = self.start(z=HEAD_Z, options=", range: 30, " + options)
        found = self.collect(host, lambda events: any(e["event"] == event for e in events))
        return next(e["gathered"] for e in found if e["event"] == event)

    def test_the_water_column_is_empty_above_the_floor(self):
        ping = self.gathered("column", "water_column: phase")
        self.assertEqual(len(ping.rows), 256)
        for beam in (64, 128, 192):
            angle = ping.header["angles"][beam]
            row = ping.rows[beam]
            strongest = max(range(len(row)), key=row.__getitem__)
            self.assertAlmostEqual(ping.metres(strongest) * math.cos(angle), 14.0, delta=0.25)
            above = row[100 : int(0.6 * strongest)]
            self.assertLess(max(above), max(row) / 5)
        self.assertEqual({len(p) for p in ping.phases}, {ping.total})

    def test_snippets_hold_the_floor(self):
        ping = self.gathered("snippets", "snippets: true")
        self.assertGreater(len(ping.snippets), 240)
        for snippet in ping.snippets.values():
            begin = ping.metres(snippet.first_sample)
            end = ping.metres(snippet.first_sample + len(snippet.magnitudes))
            truth = 14.0 / math.cos(snippet.angle)
            self.assertTrue(begin < truth < end, f"{begin:.2f} {truth:.2f} {end:.2f}")
            self.assertGreater(max(snippet.magnitudes), 3 * min(snippet.magnitudes))

    def test_truepix_sees_both_sides_where_they_are(self):
        ping = self.gathered("truepix", "truepix: direction")
        for side, sign in ((0, -1), (1, 1)):
            errors = [
                abs(ping.angles[side][n] - sign * math.acos(14.0 / ping.metres(n)))
                for n in range(ping.total)
                if 16.0 < ping.metres(n) < 26.0
            ]
            self.assertLess(statistics.median(errors), math.radians(1))
            quiet = max(ping.rows[side][n] for n in range(ping.total) if 3 < ping.metres(n) < 12)
            self.assertGreater(max(ping.rows[side]), 5 * quiet)


if __name__ == "__main__":
    unittest.main()
