"""What `--dataset` writes: the wall, the ball before it and the half hidden board of a scene with known geometry stand where
they are, in levels, pictures and labels."""

import hashlib
import math
import os
import re
import subprocess
import sys
import unittest

from datasets import BALL, BOARD, FACETS, FAN, HEAD, RADIUS, ROOT, ROWS, SCREEN, SOUNDER, WALL, DatasetCase

import numpy as np


class Contents(DatasetCase):
    def test_the_wall_is_at_its_range_in_levels_pictures_and_labels(self):
        data = self.made("fan", FAN)
        self.assertGreater(len(data.index), 1)
        line = data.index[-1]
        levels, about = data.array(line, "levels")
        self.assertEqual(about["units"], "dB re 1 uPa")
        self.assertEqual(levels.dtype, np.float32)
        ranges, bearings = np.array(about["range_m"]), np.array(about["bearings_rad"])
        self.assertEqual(levels.shape, (len(bearings), len(ranges)))
        step = ranges[1] - ranges[0]
        ahead = int(np.abs(bearings).argmin())
        far = ranges > 3
        loudest = int(np.where(far, levels[ahead], -np.inf).argmax())
        self.assertAlmostEqual(ranges[loudest], WALL, delta=0.06)
        objects, _ = data.array(line, "objects")
        wall = data.numbers["wall"]
        at_wall = np.flatnonzero(objects[ahead] == wall)
        self.assertLessEqual(np.abs(ranges[at_wall] - WALL).min(), step)

        polar, file = data.picture(line, "polar")
        self.assertEqual(polar.shape, levels.T.shape)
        self.assertEqual(int(np.where(far, polar[:, ahead], 0).argmax()), loudest)
        scale = line["pictures"]
        heard = np.isfinite(levels.T)
        np.testing.assert_allclose(scale["at_0"] + scale["per_count"] * polar[heard], levels.T[heard], atol=0.003)
        mask, label = data.masks(file)["wall"]
        np.testing.assert_array_equal(mask, objects.T == wall)
        self.assertEqual(label["area"], mask.sum())
        x, y, width, height = label["bbox"]
        self.assertTrue(mask[y, x:x + width].any() and mask[y:y + height, x].any())
        self.assertEqual(mask.sum(), mask[y:y + height, x:x + width].sum())

        metres, (origin_x, origin_y) = (line["pictures"]["cartesian"][k] for k in ("metres_per_pixel", "origin"))
        above, file = data.picture(line, "cartesian")
        column = above[:, int(origin_x)]
        rows = np.arange(len(column))
        away = (origin_y - rows - 0.5) * metres
        brightest = int(np.where(away > 3, column, 0).argmax())
        self.assertAlmostEqual(away[brightest], WALL, delta=metres + 0.06)
        labelled = np.flatnonzero(data.masks(file)["wall"][0][:, int(origin_x)])
        self.assertLessEqual(np.abs(away[labelled] - WALL).min(), metres)

    def test_the_ball_has_its_bins_and_hides_the_wall(self):
        data = self.made("fan", FAN)
        for line in data.index:
            objects, about = data.array(line, "objects")
            ranges, bearings = np.array(about["range_m"]), np.array(about["bearings_rad"])
            centre, distance = math.atan2(-BALL[1], BALL[0]), math.hypot(BALL[0], BALL[1])
            half = math.asin(RADIUS / distance)
            width = data.truth[1 + line["truth"]]["shot"]["beam_width"]
            off, step = np.abs(bearings - centre), ranges[1] - ranges[0]
            ball = objects == data.numbers["ball"]
            at = np.argwhere(ball)
            facet = 2 * math.pi * RADIUS / FACETS
            self.assertTrue((off[at[:, 0]] <= half + 1.3 * width).all(), "to its sides there is no ball")
            self.assertGreaterEqual(ranges[at[:, 1]].min(), distance - RADIUS - 2.5 * step)
            self.assertLessEqual(ranges[at[:, 1]].max(), math.sqrt(distance**2 - RADIUS**2) + facet + 2.5 * step)
            behind = off < half - 2 * width
            self.assertTrue(ball[behind].any(axis=1).all(), "each beam that meets the ball has its label")
            nearest = ranges[np.argmax(ball[int(off.argmin())])]
            self.assertAlmostEqual(nearest, distance - RADIUS, delta=2.5 * step)
            wall = (objects == data.numbers["wall"]).any(axis=1)
            self.assertFalse(wall[behind].any(), "what the ball hides is not wall")
            free = (bearings < centre - half - 2 * width) & (bearings > -0.9)
            self.assertTrue(wall[free].all())

    def test_a_half_hidden_board_has_its_share(self):
        data = self.made("fan", FAN)
        line = data.index[0]
        masks = data.masks(data.picture(line, "polar")[1])
        x, y_far, y_near = BOARD
        edge = SCREEN[1] / SCREEN[0]
        whole = math.atan(y_near / x) - math.atan(y_far / x)
        share = (math.atan(edge) - math.atan(y_far / x)) / whole
        self.assertAlmostEqual(masks["board"][1]["visible_share"], share, delta=0.04)
        for name in ("ball", "screen"):
            self.assertEqual(masks[name][1]["visible_share"], 1)
        visible = dict(data.truth[1 + line["truth"]]["visible"])
        self.assertAlmostEqual(visible[data.numbers["board"]], share, delta=0.04)

    def test_truth_and_bytes_are_those_of_the_ping(self):
        data = self.made("fan", FAN)
        self.assertEqual(data.truth[0]["water"]["sound_speed"], 1500)
        wire = (data.folder / "wire" / "fan.bin").read_bytes()
        end = 0
        for line in data.index:
            truth = data.truth[1 + line["truth"]]
            self.assertEqual((truth["ping"], truth["t"]), (line["ping"], line["t"]))
            self.assertEqual(truth["world_from_sonar"]["position"], [1, 2, -30])
            levels, about = data.array(line, "levels")
            objects, _ = data.array(line, "objects")
            self.assertEqual(truth["shot"]["bins"], levels.shape[1])
            np.testing.assert_allclose(truth["beams"], about["bearings_rad"], atol=1e-6)
            at = line["wire"]
            self.assertEqual(at["offset"], end)
            end += at["bytes"]
            self.assertEqual(sum(m["bytes"] for m in at["messages"]), at["bytes"])
            reply = wire[at["offset"]:end]
            self.assertEqual(hashlib.sha256(levels.tobytes() + objects.tobytes() + reply).hexdigest(), line["sha256"])
            # BTH0 has the number of the ping at byte 48, big endian, in its section H0.
            bathymetry = reply.index(b"BTH0")
            self.assertEqual(reply[bathymetry + 12:bathymetry + 14], b"H0")
            self.assertEqual(int.from_bytes(reply[bathymetry + 48:bathymetry + 52], "big"), line["ping"])
        self.assertEqual(end, len(wire))
        for kind in ("levels", "objects"):
            self.assertEqual(len({line[kind] for line in data.index}), 1, "one array for the same settings")

    def test_a_head_has_pictures_of_whole_turns(self):
        data = self.made("head", HEAD, seconds=50)
        self.assertEqual(len(data.index), 430)
        pictures = [line["pictures"]["polar"]["file"] for line in data.index]
        self.assertEqual(len(set(pictures)), 2, "a turn of 400 pings, and its next part")
        columns = [line["pictures"]["polar"]["column"] for line in data.index]
        self.assertEqual(columns, [*range(columns.index(0, 1)), *range(430 - columns.index(0, 1))])
        pan = np.array([line["pan"] for line in data.index])
        ahead = int(np.abs(np.angle(np.exp(1j * pan[:columns.index(0, 1)]))).argmin())
        line = data.index[ahead]
        levels, about = data.array(line, "levels")
        ranges = np.array(about["range_m"])
        found = ranges[np.where(ranges > 0.7, levels[0], -np.inf).argmax()]
        self.assertAlmostEqual(found, WALL - 10.6, delta=0.05)
        polar, file = data.picture(line, "polar")
        np.testing.assert_allclose(polar[:, ahead] * 0.005 - 60, levels[0], atol=0.003)
        mask = data.masks(file)["wall"][0]
        self.assertLessEqual(np.abs(ranges[mask[:, ahead]] - found).min(), 0.02)
        above, file = data.picture(line, "cartesian")
        place = line["pictures"]["cartesian"]
        y, x = np.argwhere(data.masks(file)["wall"][0]).T
        east = (place["origin"][1] - y - 0.5) * place["metres_per_pixel"]  # the head's zero is ahead, east here
        self.assertAlmostEqual(east[x == int(place["origin"][0])].min(), WALL - 10.6, delta=0.02)
        self.assertEqual(above.shape[0], above.shape[1])

    def test_an_echosounder_and_rows_of_beams(self):
        data = self.made("others", SOUNDER, ROWS)
        sounder = [line for line in data.index if line["sonar"] == "sounder"]
        self.assertEqual(set(sounder[0]["pictures"]) & {"polar", "cartesian", "front"}, {"polar"})
        self.assertEqual([line["pictures"]["polar"]["column"] for line in sounder], list(range(len(sounder))))
        rows = next(line for line in data.index if line["sonar"] == "rows")
        levels, about = data.array(rows, "levels")
        self.assertEqual(levels.shape[:2], (len(about["elevations_rad"]), len(about["bearings_rad"])))
        ranges, _ = data.picture(rows, "range")
        front, file = data.picture(rows, "front")
        self.assertEqual(front.shape, levels.shape[:2])
        bearings, elevations = np.array(about["bearings_rad"]), np.array(about["elevations_rad"])[::-1]
        mask = data.masks(file)["wall"][0]
        expected = WALL / np.outer(np.cos(elevations), np.cos(bearings))
        found = ranges * rows["pictures"]["range"]["metres_per_count"]
        self.assertGreater(mask.sum(), mask.size / 4)
        self.assertLess(np.median(np.abs(found - expected)[mask]), 0.1)

    def test_the_example_of_the_documentation_runs(self):
        data = self.made("fan", FAN)
        code = re.search(r"```python\n(.*?)```", (ROOT / "docs" / "datasets.md").read_text(), re.S)[1]
        packages = next((ROOT / "build" / "drivers" / "dataset").glob("lib/python3*/site-packages"))
        done = subprocess.run([sys.executable, "-c", code, str(data.folder)], capture_output=True, text=True,
                              env=os.environ | {"PYTHONPATH": str(packages)}, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"fan 1 at \[1, 2, -30\] hears")
        self.assertRegex(done.stdout, r"polar/fan/000000.png ball \[")


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # numpy warns of pycocotools
