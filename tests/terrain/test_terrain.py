"""Surveys of the bottom become scenes: what is in them is where the grid has it, and what the file does not say is
told or refused."""

import os
import subprocess
import unittest

import grids
import scene_file

ECHOLOOP = os.environ["ECHOLOOP"]


class ImportCase(unittest.TestCase):
    def setUp(self):
        missing = grids.tools_are_missing()
        if missing and not os.environ.get("CI"):
            self.skipTest(f"{missing} are not here")
        self.folder = grids.folder_of(self)
        self.out = self.folder / "out.glb"

    def run_import(self, *words):
        return subprocess.run([ECHOLOOP, "import", *map(str, words), "--out", self.out], capture_output=True, text=True)

    def scene_of(self, *words):
        done = self.run_import(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.told = done.stdout
        return scene_file.read(self.out)

    def refused(self, *words):
        self.out.unlink(missing_ok=True)
        done = self.run_import(*words)
        self.assertEqual(done.returncode, 65, done.stdout + done.stderr)
        self.assertFalse(self.out.exists(), "nothing half written")
        self.assertNotIn("warning", done.stderr)
        return done.stderr


def local_places():
    """Of the samples, with write_asc's cells of 2 m from 0, 0."""
    return {(2 * c + 1, 2 * (grids.ROWS - 1 - r) + 1): (c, r) for r in range(grids.ROWS) for c in range(grids.COLUMNS)}


def in_hole(column, row):
    return row in grids.HOLE[0] and column in grids.HOLE[1]


class Shape(ImportCase):
    def local(self, *words, rows=None):
        grids.write_asc(self.folder / "bottom.asc", rows or grids.samples())
        return self.scene_of(self.folder / "bottom.asc", "--local", *words)

    def worst(self, scene):
        """m, and whether the hole is a hole: each sample measured apart from the program."""
        places = local_places()
        worst = 0
        for place, heights in scene_file.heights_at(scene, list(places)).items():
            if in_hole(*places[place]):
                self.assertEqual(heights, [], "a hole is bridged")
                continue
            self.assertTrue(heights, f"nothing at {place}")
            worst = max(worst, *(abs(z - grids.height(*places[place])) for z in heights))
        return worst

    def test_no_sample_is_farther_off_than_the_error(self):
        sizes = []
        for error in (0.5, 0.05):
            scene = self.local("--error", error)
            self.assertLessEqual(self.worst(scene), error + 1e-5)
            sizes.append(len(scene["triangles"]))
        self.assertLess(sizes[0] * 3, sizes[1], "a larger error makes fewer triangles")
        self.assertLess(sizes[1], 2 * grids.COLUMNS * grids.ROWS / 2)

    def test_the_number_of_triangles_is_kept_and_what_it_costs_is_told(self):
        scene = self.local("--error", 0.01, "--triangles", 500)
        self.assertLessEqual(len(scene["triangles"]), 500)
        self.assertIn("ran out", self.told)
        self.assertLess(self.worst(scene), 2)
        self.assertIn("edges of its holes", self.refused(self.folder / "bottom.asc", "--local", "--triangles", 20))

    def test_names_and_materials(self):
        scene = self.local("--material", "mud")
        self.assertEqual((scene["names"], scene["origin"]), (["bottom"], None))
        self.assertEqual(scene["material"]["extras"]["sonar"], {"material": "mud"})
        curve = self.local("--material", "gravel-200khz")
        self.assertEqual(curve["material"]["extras"]["sonar"], {"seabed": "gravel-200khz"})

    def test_a_hole_is_no_spike_where_the_file_does_not_say_what_means_nothing(self):
        rows = grids.samples()
        grids.write_asc(self.folder / "bare.asc", rows, nothing=None)
        scene = self.scene_of(self.folder / "bare.asc", "--local")
        self.assertGreater(min(z for _, _, z in scene["points"]), -40)
        self.assertIn("-9999", self.told)
        rows = [[12345.5 if z == grids.NOTHING else z for z in row] for row in rows]
        grids.write_asc(self.folder / "odd.asc", rows, nothing=None)
        scene = self.scene_of(self.folder / "odd.asc", "--local", "--positive", "up")
        self.assertLess(max(z for _, _, z in scene["points"]), 0)
        rows = [[777 if z == 12345.5 else z for z in row] for row in rows]
        grids.write_asc(self.folder / "said.asc", rows, nothing=None)
        scene = self.scene_of(self.folder / "said.asc", "--local", "--nodata", "777")
        self.assertLess(max(z for _, _, z in scene["points"]), 0)


class Meaning(ImportCase):
    def extremes(self, scene):
        z = [z for _, _, z in scene["points"]]
        return min(z), max(z)

    def grid(self, factor=1.0, name="grid.asc"):
        rows = [[z if z == grids.NOTHING else factor * z for z in row] for row in grids.samples()]
        grids.write_asc(self.folder / name, rows)
        return self.folder / name

    def expect_bottom(self, scene):
        low, high = self.extremes(scene)
        self.assertAlmostEqual(low, min(grids.height(c, r) for c in range(160) for r in range(120)), delta=0.1)
        self.assertLess(high, -20)

    def test_depths(self):
        self.expect_bottom(self.scene_of(self.grid(-1), "--local"))
        self.assertIn("positive down (a guess", self.told)
        self.expect_bottom(self.scene_of(self.grid(-1), "--local", "--positive", "down"))
        low, high = self.extremes(self.scene_of(self.grid(-1), "--local", "--positive", "up"))
        self.assertGreater(low, 20)
        self.expect_bottom(self.scene_of(self.grid(1), "--local"))
        self.assertIn("positive up (a guess", self.told)

    def test_water_level(self):
        rows = [[350 + z if z != grids.NOTHING else z for z in row] for row in grids.samples()]
        grids.write_asc(self.folder / "lake.asc", rows)
        self.expect_bottom(self.scene_of(self.folder / "lake.asc", "--local", "--water-level", 350))

    def test_feet(self):
        self.expect_bottom(self.scene_of(self.grid(1 / 0.3048), "--local", "--units", "ft"))
        self.assertIn("converted from ft", self.told)
        # As GDAL writes them: the unit is in the file.
        grids.run("gdal_translate", "-q", "-of", "netCDF", self.grid(3937 / 1200), self.folder / "feet.nc")
        grids.run("gdal_translate", "-q", "-a_srs", "EPSG:32632+6360", self.grid(3937 / 1200), self.folder / "feet.tif")
        self.expect_bottom(self.scene_of(self.folder / "feet.tif"))
        self.assertIn("0.3048006", self.told)
        self.assertIn("parsec", self.refused(self.grid(), "--local", "--units", "parsec"))

    def test_no_projection(self):
        text = self.refused(self.grid())
        self.assertIn("no projection", text)
        self.assertIn("--crs EPSG:", text)
        self.assertIn("--local", text)
        self.assertIn("EPSG:1", self.refused(self.grid(), "--crs", "EPSG:1"))
        self.assertIn("100 km", self.refused(self.grid(), "--crs", "EPSG:32632", "--origin", "59,10"))

    def test_units_and_places_that_cannot_be(self):
        for words in (["--origin", "91,0"], ["--origin", "here"], ["--error", "-1"], ["--error", "nan"],
                      ["--triangles", "1"], ["--triangles", "99999999999"], ["--positive", "sideways"],
                      ["--nodata", "x"], ["--material", "cheese"], ["--water-level", "1e9"]):
            done = self.run_import(self.grid(), "--local", *words)
            self.assertEqual(done.returncode, 64, f"{words}: {done.stderr}")
            self.assertIn(words[0], done.stderr)
            self.assertFalse(self.out.exists())


class Formats(ImportCase):
    def test_each_gives_the_same_bottom(self):
        tif = grids.write_geotiff(self.folder, grids.samples())
        grids.run("gdalwarp", "-q", "-t_srs", "EPSG:32632", "-tr", 2, 2, "-r", "bilinear", "-dstnodata", -9999, tif,
                  self.folder / "utm.tif")
        expected = self.scene_of(self.folder / "utm.tif", "--error", 0.02)
        for name, form in (("a.asc", "AAIGrid"), ("a.nc", "netCDF"), ("binary.grd", "GSBG"), ("text.grd", "GSAG"),
                           ("seven.grd", "GS7BG"), ("a.xyz", "XYZ")):
            grids.run("gdal_translate", "-q", "-of", form, self.folder / "utm.tif", self.folder / name)
            crs = ["--crs", "EPSG:32632"] if form == "XYZ" else []
            scene = self.scene_of(self.folder / name, "--error", 0.02, *crs)
            self.assertEqual(scene["origin"], expected["origin"], name)
            self.assertEqual(len(scene["triangles"]), len(expected["triangles"]), name)
            for a, b in zip(scene["points"], expected["points"]):
                self.assertLess(max(abs(p - q) for p, q in zip(a, b)), 1e-3, name)

    def test_soundings_left_out_of_an_xyz_are_a_hole(self):
        tif = grids.write_geotiff(self.folder, grids.samples())
        grids.run("gdal_translate", "-q", "-of", "XYZ", tif, self.folder / "all.xyz")
        lines = [line for line in (self.folder / "all.xyz").read_text().splitlines(True) if "-9999" not in line]
        (self.folder / "some.xyz").write_text("".join(lines))
        scene = self.scene_of(self.folder / "some.xyz", "--crs", "EPSG:4326")
        self.assertEqual(len(scene["triangles"]), len(self.scene_of(tif)["triangles"]))

    def test_netcdf_with_axes_in_degrees_and_several_layers(self):
        rows = grids.samples(hole=False)[::-1]
        latitudes = [grids.LATITUDE + grids.STEP_NORTH * (r - (grids.ROWS - 1) / 2) for r in range(grids.ROWS)]
        longitudes = [grids.LONGITUDE + grids.STEP_EAST * (c - (grids.COLUMNS - 1) / 2) for c in range(grids.COLUMNS)]
        expected = self.scene_of(grids.write_geotiff(self.folder, grids.samples(hole=False)))
        ones = [[1.0] * grids.COLUMNS] * grids.ROWS
        file = self.folder / "gebco.nc"
        grids.write_netcdf(file, {"tid": (ones, {}), "elevation": (rows, {"units": "m"})}, latitudes, longitudes)
        same = self.scene_of(file)
        self.assertEqual(same["origin"], expected["origin"])
        self.assertEqual(len(same["triangles"]), len(expected["triangles"]))
        depths = [[-z for z in row] for row in rows]
        said = {"units": "m", "positive": "down"}
        grids.write_netcdf(file, {"tid": (ones, {}), "soundings": (depths, said)}, latitudes, longitudes)
        text = self.refused(file)
        self.assertIn("--layer", text)
        self.assertIn("soundings", text)
        same = self.scene_of(file, "--layer", "soundings")
        self.assertIn("positive down (as the file says)", self.told)
        self.assertEqual(len(same["triangles"]), len(expected["triangles"]))
        self.assertIn("tid, soundings", self.refused(file, "--layer", "depths"))

    def test_degrees_taken_for_metres(self):
        tif = grids.write_geotiff(self.folder, grids.samples())
        grids.run("gdal_translate", "-q", "-of", "XYZ", tif, self.folder / "all.xyz")
        self.assertIn("EPSG:4326", self.refused(self.folder / "all.xyz", "--local"))
        self.assertIn("look like degrees", self.refused(self.folder / "all.xyz"))

    def test_the_origin_is_the_middle_or_as_told(self):
        tif = grids.write_geotiff(self.folder, grids.samples())
        middle = self.scene_of(tif)
        self.assertAlmostEqual(middle["origin"]["latitude"], 59.4, delta=1e-6)
        self.assertAlmostEqual(middle["origin"]["longitude"], 10.5, delta=1e-6)
        self.assertIn("59.4000000", self.told)
        told = self.scene_of(tif, "--origin", "59.41,10.48")
        self.assertEqual(told["origin"], {"latitude": 59.41, "longitude": 10.48, "height": 0})
        # PROJ 9.1, +proj=ortho +ellps=WGS84 about 59.41, 10.48: the middle is at 1136.146, -1113.850.
        x = [(min(p[i] for p in s["points"]) + max(p[i] for p in s["points"])) / 2 for s in (told, middle) for i in (0, 1)]
        self.assertAlmostEqual(x[0] - x[2], 1136.146, delta=0.5)
        self.assertAlmostEqual(x[1] - x[3], -1113.850, delta=0.5)


class WithAWorld(ImportCase):
    WORLD = """<sdf version="1.7"><world name="sea">
<spherical_coordinates><surface_model>EARTH_WGS84</surface_model><latitude_deg>59.41</latitude_deg>
<longitude_deg>10.48</longitude_deg><elevation>0</elevation><heading_deg>%s</heading_deg></spherical_coordinates>
<model name="box"><static>true</static><link name="l"><visual name="v"><geometry><box><size>1 1 1</size></box></geometry>
</visual></link></model></world></sdf>"""

    def test_survey_lies_about_the_worlds_origin(self):
        (self.folder / "sea.sdf").write_text(self.WORLD % 0)
        tif = grids.write_geotiff(self.folder, grids.samples())
        scene = self.scene_of(self.folder / "sea.sdf", tif)
        self.assertEqual((scene["origin"]["latitude"], scene["origin"]["longitude"]), (59.41, 10.48))
        self.assertIn("box", scene["names"])
        self.assertEqual(scene["names"][-1], "bottom")
        middle = [(min(p[i] for p in scene["points"]) + max(p[i] for p in scene["points"])) / 2 for i in (0, 1)]
        self.assertAlmostEqual(middle[0], 1136.146, delta=2)  # PROJ 9.1, as above
        self.assertAlmostEqual(middle[1], -1113.850, delta=2)

    def test_survey_lies_about_the_origin_of_a_world_that_is_turned(self):
        (self.folder / "sea.sdf").write_text(self.WORLD % 30)
        tif = grids.write_geotiff(self.folder, grids.samples())
        scene = self.scene_of(self.folder / "sea.sdf", tif)
        self.assertEqual(scene["origin"]["latitude"], 59.41)
        self.assertIn("turned by its heading of 30 deg", self.told)


class Hostile(ImportCase):
    def test_damaged_files(self):
        tif = grids.write_geotiff(self.folder, grids.samples())
        data = tif.read_bytes()
        (self.folder / "half.tif").write_bytes(data[: len(data) // 2])
        self.assertIn("half.tif", self.refused(self.folder / "half.tif"))
        for name, content in (("text.tif", b"no grid"), ("empty.nc", b""), ("zeros.grd", bytes(5000)),
                              ("lies.asc", b"ncols 2000000000\nnrows 2000000000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2"),
                              ("words.xyz", b"1 2 three\n4 5 six\n"), ("few.xyz", b"1 2 -3\n"),
                              ("scattered.xyz", b"1 2 -3\n1.7 2.3 -4\n9 1 -3\n2.2 8 -1\n")):
            (self.folder / name).write_bytes(content)
            self.assertIn(name, self.refused(self.folder / name, "--local"))

    def test_a_file_that_names_other_files_is_none(self):
        (self.folder / "bottom.tif").write_text(
            '<VRTDataset rasterXSize="2" rasterYSize="2"><VRTRasterBand dataType="Byte" band="1"><SimpleSource>'
            "<SourceFilename>/etc/passwd</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>")
        self.assertIn("no grid that can be read", self.refused(self.folder / "bottom.tif", "--local"))

    def test_a_grid_larger_than_any(self):
        grids.write_asc(self.folder / "one.asc", [[1.0, 2.0], [3.0, 4.0]], nothing=None)
        grids.run("gdal_translate", "-q", "-outsize", 30000, 30000, "-co", "SPARSE_OK=TRUE", "-co", "COMPRESS=DEFLATE",
                  "-co", "TILED=YES", "-ot", "Byte", self.folder / "one.asc", self.folder / "huge.tif")
        self.assertIn("30000 x 30000", self.refused(self.folder / "huge.tif", "--local"))

    def test_pictures_and_nothing_at_all(self):
        rows = [[grids.NOTHING] * 4] * 4
        grids.write_asc(self.folder / "none.asc", rows)
        self.assertIn("no sample with a value", self.refused(self.folder / "none.asc", "--local"))
        rows = [[-1 if (r + c) % 2 else grids.NOTHING for c in range(4)] for r in range(4)]
        grids.write_asc(self.folder / "lone.asc", rows)
        self.assertIn("four neighbouring", self.refused(self.folder / "lone.asc", "--local"))


if __name__ == "__main__":
    unittest.main()
