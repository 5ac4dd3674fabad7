"""From a survey to soundings: what a multibeam finds at several places, told in latitude and longitude, is what the grid
has there, within half a per cent. The places come from the datagrams, the heights from our own reading of the grid."""

import json
import os
import socket
import subprocess
import sys
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / "e2e"), str(ROOT / "tests" / "hosts")]

import grids
import kmall_wire as wire
from ports import free_port
from program import PROGRAM, Emulator

SCENARIO = """
scene: "%s"
seed: 3
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500, depth: 3}
effects: {sensor_noise: off, ping_jitter: off}
vehicle: {input: stdin}
devices:
  - name: multibeam
    model: kongsberg-kmall
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["udp-listen://127.0.0.1:%d", "udp://127.0.0.1:%d"]
    options: {range: 60, sector_width: 90}
"""
PLACES = [(59.4, 10.5), (59.4004, 10.4992), (59.39955, 10.5011)]


class Soundings(unittest.TestCase):
    def setUp(self):
        missing = grids.tools_are_missing()
        if missing and not os.environ.get("CI"):
            self.skipTest(f"{missing} are not here")
        self.folder = grids.folder_of(self)

    def start(self, survey, *words):
        done = subprocess.run([PROGRAM, "import", survey, *words, "--error", "0.02", "--out", self.folder / "bottom.glb"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.joiner = wire.Joiner()
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(self.socket.close)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
        self.socket.bind(("127.0.0.1", 0))
        self.emulator = Emulator(SCENARIO % (self.folder / "bottom.glb", free_port(8), self.socket.getsockname()[1]),
                                 stdin=subprocess.PIPE)
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.emulator.__enter__()

    def mrz_at(self, latitude, longitude):
        line = {"latitude": latitude, "longitude": longitude, "depth": 3, "rpy_deg": [0, 0, 20]}
        end = time.monotonic() + 60
        while time.monotonic() < end:
            self.emulator.process.stdin.write((json.dumps(line) + "\n").encode())
            self.emulator.process.stdin.flush()
            self.socket.settimeout(max(0.01, end - time.monotonic()))
            found = self.joiner.take(self.socket.recv(65536))
            if not found or found[0]["kind"] != "#MRZ":
                continue
            ping = wire.read_mrz(found[1])
            if abs(ping["latitude"] - latitude) < 1e-7 and abs(ping["longitude"] - longitude) < 1e-7:
                return ping
        self.fail("the multibeam never said that it is there")

    def check(self):
        worst = 0
        for place in PLACES:
            ping = self.mrz_at(*place)
            found = 0
            for s in ping["soundings"]:
                grid = grids.height_at(ping["latitude"] + s["dlat"], ping["longitude"] + s["dlon"])
                if s["type"] != 0 or grid is None:
                    continue
                found += 1
                depth = s["z"] - ping["water_level"]
                worst = max(worst, abs(depth + grid) / -grid)
                self.assertLess(abs(depth + grid), 0.005 * -grid, f"at {s['angle']:.1f} deg, {place}")
            self.assertGreater(found, 0.9 * len(ping["soundings"]))
        print(f"worst sounding: {100 * worst:.3f} % of the depth", file=sys.stderr)

    def test_geotiff_in_degrees(self):
        self.start(grids.write_geotiff(self.folder, grids.samples(hole=False)))
        self.check()

    def test_xyz_of_the_same_bottom(self):
        tif = grids.write_geotiff(self.folder, grids.samples(hole=False))
        grids.run("gdal_translate", "-q", "-of", "XYZ", tif, self.folder / "bottom.xyz")
        self.start(self.folder / "bottom.xyz", "--crs", "EPSG:4326")
        self.check()


if __name__ == "__main__":
    unittest.main()
