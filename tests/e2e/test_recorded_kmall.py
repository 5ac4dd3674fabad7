"""A Kongsberg multibeam in its demo scene beside what files of an EM 2040P and an EM 2042 hold: their levels, and which of
their fields vary from sounding to sounding. The files are public and not here; their figures stand in the specification
notes on survey records."""

import math
import socket
import tempfile
import unittest
from pathlib import Path

from ports import free_port
from program import ROOT, Emulator

import words
from mesh_scene import grid_triangles, mesh_scene

# Of the soundings that are valid. What a real one varies with its beam pattern, its sectors and its attitude is missing.
VARY = {"index", "method", "quality", "vertical_uncertainty", "horizontal_uncertainty", "window", "echo_length", "water_beam",
        "water_range", "water_angle", "reflectivity1", "reflectivity2", "sensitivity", "tvg", "angle", "time",
        "delta_latitude", "delta_longitude", "z", "y", "image_start", "image_samples"}
ONE_VALUE = {"sector": 0, "post_processing": 0, "detection_class": 0, "confidence": 12, "range_factor": 100,
             "angle_correction": 0, "incidence": 0}


def capture(case, scenario, pings, files=()):
    """The messages #MRZ and #MWC of a run of so many pings; the scenario is that of config/kmall.yaml, changed."""
    folder = tempfile.TemporaryDirectory()
    case.addClassCleanup(folder.cleanup)
    file = str(Path(folder.name) / "run.pcapng")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as host:
        host.bind(("127.0.0.1", 0))
        host.settimeout(20)
        scenario = scenario.replace("127.0.0.1:14002", f"127.0.0.1:{free_port(8)}")
        scenario = scenario.replace("127.0.0.1:6020", "127.0.0.1:%d" % host.getsockname()[1])
        with Emulator(scenario, "--record", file, files=files) as emulator:
            seen = 0
            while seen < pings:
                datagram = host.recv(65536)
                seen += datagram[4:8] == b"#MRZ" and datagram[22:24] == b"\1\0"
            emulator.stop()
    return words.messages(file, "MRZ"), words.messages(file, "MWC")


SCENARIO = (ROOT / "config" / "kmall.yaml").read_text()


class Recorded(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pings, cls.columns = capture(cls, SCENARIO.replace("scenes/", "{scenes}/"), 6)

    def valid(self, field):
        """Of all valid soundings."""
        return [v for ping in self.pings for v, kind in zip(ping[f"soundings.{field}"], ping["soundings.type"]) if kind == 0]

    def test_the_water_column_has_real_levels(self):
        self.assertTrue(self.columns, "inspect joins the parts of each")
        samples = [word / 2 for column in self.columns for name, value in column.items() if name.endswith(".amplitude")
                   for word in value]
        found = words.summary(samples, -64, 63.5)
        print("\n".join(words.table([found])))
        self.assertTrue(0.01 <= found["at lowest"] <= 0.35, "1.6 to 25 % of real samples")
        self.assertEqual(found["at highest"], 0)
        self.assertTrue(-58 <= found["50 %"] <= -25, "median -53 and -31 to -50 dB")
        self.assertTrue(-15 <= found["99 %"] <= 20, "+2 and +8 to +18 dB; here more is water and less bottom")
        self.assertTrue(10 <= found["max"] <= 42, "+18 to +23 and +24 to +39 dB")
        self.assertEqual({(c["rx.tvg"], c["rx.tvg_offset"]) for c in self.columns}, {(30, 30)})
        first = [value[:4] for column in self.columns for name, value in column.items() if name.endswith(".amplitude")]
        self.assertEqual({word for row in first for word in row}, {-128}, "the first samples of every beam")

    def test_reflectivities_lie_where_real_ones_do(self):
        levels = sorted(self.valid("reflectivity1"))
        print("\n".join(words.table([words.summary(levels)])))
        self.assertGreater(levels[len(levels) // 100], -58)
        self.assertLess(levels[len(levels) * 99 // 100], -10)
        for ping in self.pings:
            self.assertTrue(-40 < ping["rx.bs_normal"] < -10 and -40 < ping["rx.bs_oblique"] < -10, "-24 to -16 dB")

    def test_fields_of_soundings_vary_as_real_ones_do(self):
        for field in VARY:
            self.assertGreater(len(set(self.valid(field))), 1, field)
        for field, value in ONE_VALUE.items():
            self.assertEqual(set(self.valid(field)), {value}, field)
        for field in ("image", "rx.bs_normal", "rx.bs_oblique", "sectors.focus_range"):
            self.assertGreater(len({str(ping[field]) for ping in self.pings}), 1, f"{field}, from ping to ping")
        for ping in self.pings:
            self.assertEqual(ping["header.version"], 3)
            self.assertEqual(ping["rx.seabed_image_rate"], ping["rx.water_column_rate"])


def school():
    """A floor 8 m below the boat, uneven by 0.3 m, and above it things of 0.3 m at all heights, as fish or floats are."""
    places = [-30 + 0.5 * n for n in range(121)]
    points = [(x, y, -20 + 0.3 * math.sin(0.9 * x) * math.cos(0.7 * y)) for y in places for x in places]
    triangles = list(grid_triangles(121, 121))
    for n in range(30):
        x, y, z = -3 + 0.3 * n, -8 + (n * 37 % 160) / 10, -15 - (n * 53 % 46) / 10
        first, size = len(points), 0.15
        points += [(x + size, y, z), (x - size, y, z), (x, y + size, z), (x, y - size, z), (x, y, z + size), (x, y, z - size)]
        triangles += [tuple(first + k for k in face) for face in
                      ((0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5))]
    return mesh_scene(points, triangles, {"mu_db": -10})


def boat(seconds=30, step=0.05, depth=12, roll_deg=10, heave=0.1):
    """1 m/s to the east in waves: `heave` m up and down in 5 s, `roll_deg` of roll in 4 s."""
    lines = ["t,x,y,z,qw,qx,qy,qz"]
    for n in range(int(seconds / step)):
        t = n * step
        roll = math.radians(roll_deg) * math.sin(2 * math.pi * t / 4)
        lines.append(f"{t},{t - 3},0,{-depth + heave * math.sin(2 * math.pi * t / 5)},{math.cos(roll / 2)},{math.sin(roll / 2)},0,0")
    return "\n".join(lines) + "\n"


class ThingsInTheWater(unittest.TestCase):
    """An EM 2040P with extra detections on: 76 to 117 of them, 444 to 479 of 512 soundings valid, alarm 1 to 3, classes 103 to
    107, and a heave of its water columns that is new for each ping. Here beside a school, on a boat that heaves and rolls."""

    @classmethod
    def setUpClass(cls):
        scenario = SCENARIO.replace("scenes/flat.glb", "school.gltf").replace("range: 25,", "range: 16, power: -30, extra_detections: 512,")
        scenario = scenario.replace("pose: {position: [0, 0, -12], rpy_deg: [0, 0, 0]}", "trajectory: boat.csv")
        cls.pings, cls.columns = capture(cls, scenario, 12, {"school.gltf": school(), "boat.csv": boat()})

    def test_extra_detections_vary(self):
        def of_all(field):
            return [v for p in self.pings for v in p[f"soundings.{field}"][400:]]

        kinds, classes, factors = of_all("type"), of_all("detection_class"), of_all("range_factor")
        print("types", {k: kinds.count(k) for k in set(kinds)}, "classes", {k: classes.count(k) for k in set(classes)},
              "range factor", min(factors), max(factors), "confidence", min(of_all("confidence")), max(of_all("confidence")))
        self.assertEqual(set(kinds), {1, 2})
        self.assertTrue(set(classes) <= set(range(100, 108)) and len(set(classes)) > 2, set(classes))
        self.assertGreater(len(set(factors)), 100)
        self.assertGreater(len(set(of_all("confidence"))), 10)
        self.assertGreater(len(set(of_all("rejection2"))), 2)
        self.assertGreater(len({p["rx.extra_detections"] for p in self.pings}), 3)
        self.assertGreater(len({p["rx.alarm"] for p in self.pings}), 1)
        self.assertGreater(len({str(p["classes.detections"]) for p in self.pings}), 1)

    def test_lost_soundings_lower_the_count_of_valid_ones(self):
        print("valid", [p["rx.valid"] for p in self.pings], "extra", [p["rx.extra_detections"] for p in self.pings])
        self.assertGreater(len({p["rx.valid"] for p in self.pings}), 2)
        for ping in self.pings:
            self.assertEqual(ping["rx.valid"], ping["soundings.type"][:400].count(0))
            self.assertTrue(200 <= ping["rx.valid"] <= 400)

    def test_water_columns_tell_the_heave(self):
        heaves = [c["tx.heave"] for c in self.columns]
        print("heave", heaves)
        self.assertGreater(len(set(heaves)), 5)
        self.assertTrue(all(abs(h) < 0.35 for h in heaves))
        self.assertGreater(max(heaves) - min(heaves), 0.05)


class OneSecond(unittest.TestCase):
    """25 pings of an EM 2040P within 1.0 s, 3.3 m above a bottom (512 soundings 13 mm apart): 24 pings a second, edges at
    45.06 deg, 3 m of coverage to port and one sound speed at the head in all."""

    def test_coverage_and_sound_speed_stand_still(self):
        scenario = SCENARIO.replace("scenes/flat.glb", "{scenes}/flat.glb").replace("range: 25, water_column: true,", "range: 6, sector_width: 90.12, ping_rate: 24, probe_interval: 5,")
        scenario = scenario.replace("pose: {position: [0, 0, -12], rpy_deg: [0, 0, 0]}", "trajectory: boat.csv")
        pings, _ = capture(self, scenario, 25, {"boat.csv": boat(depth=16.7, roll_deg=1, heave=0.02)})
        pings = pings[:25]
        values = lambda field: {p[field] for p in pings}
        print("coverage", values("ping.port_coverage_m"), values("ping.starboard_coverage_m"), "deg", values("ping.port_coverage"), "speed", values("ping.sound_speed"))
        self.assertEqual(values("ping.port_coverage_m"), {-3}, "negative to port")
        self.assertEqual(len(values("ping.sound_speed")), 1)
        self.assertGreater(len(values("ping.port_coverage")), 5, "in degrees they vary")


if __name__ == "__main__":
    unittest.main()
