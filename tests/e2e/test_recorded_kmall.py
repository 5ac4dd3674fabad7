"""A Kongsberg multibeam in its demo scene beside what files of an EM 2040P and an EM 2042 hold: their levels, and which of
their fields vary from sounding to sounding. The files are public and not here; their figures stand in the specification
notes on survey records."""

import socket
import tempfile
import unittest
from pathlib import Path

from ports import free_port
from program import ROOT, Emulator

import words

# Of the soundings that are valid. What a real one varies with its beam pattern, its sectors and its attitude is missing.
VARY = {"index", "method", "quality", "vertical_uncertainty", "horizontal_uncertainty", "window", "echo_length", "water_beam",
        "water_range", "water_angle", "reflectivity1", "reflectivity2", "sensitivity", "tvg", "angle", "time",
        "delta_latitude", "delta_longitude", "z", "y", "image_start", "image_samples"}
ONE_VALUE = {"sector": 0, "post_processing": 0, "detection_class": 0, "confidence": 12, "range_factor": 100,
             "angle_correction": 0, "incidence": 0}


class Recorded(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        capture = str(Path(folder.name) / "run.pcapng")
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as host:
            host.bind(("127.0.0.1", 0))
            host.settimeout(20)
            scenario = (ROOT / "config" / "kmall.yaml").read_text().replace("scenes/", "{scenes}/")
            scenario = scenario.replace("127.0.0.1:14002", f"127.0.0.1:{free_port(8)}")
            scenario = scenario.replace("127.0.0.1:6020", "127.0.0.1:%d" % host.getsockname()[1])
            with Emulator(scenario, "--record", capture) as emulator:
                seen = 0
                while seen < 6:
                    seen += host.recv(65536)[4:8] == b"#MRZ"
                emulator.stop()
        cls.pings = words.messages(capture, "MRZ")
        cls.columns = words.messages(capture, "MWC")

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


if __name__ == "__main__":
    unittest.main()
