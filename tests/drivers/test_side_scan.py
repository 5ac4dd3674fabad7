"""Public readers of side-scan files, pyjsf and pyxtf, draw what an EdgeTech and an Imagenex 872 heard: a vehicle passes a low wall to
port on a flat floor. Floor, wall and the wall's shadow lie in all pictures where geometry puts them, on the right side and in the
right pings."""

import subprocess
import tempfile
import unittest
from math import hypot
from pathlib import Path

from public_driver import ROOT, use

use("sidescan", "pyxtf")

import sys

sys.path.insert(0, str(ROOT / "tests" / "hosts"))

import numpy as np
import pyjsf
import pyxtf
from mesh_scene import mesh_scene
from program import PROGRAM

ALTITUDE, WALL, HEIGHT, HALF = 5, 15, 1, 3  # m: of the sonar; the wall's distance, height and half its length
RANGE, SPEED, SOUND = 30, 4, 1500
SCENARIO = """
scene: wall.gltf
seed: 3
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
origin: {latitude: 59.4, longitude: 10.5}
vehicle: {trajectory: way.csv}
clock: {mode: free, duration: 5}
effects: {sensor_noise: off, ping_jitter: off}
devices:
"""
EDGETECH = """
  - name: sidescan
    model: edgetech-2205
    endpoints: ["tcp-listen://127.0.0.1:1700", "tcp-listen://127.0.0.1:1701"]
    options: {start: high}
    driver: [{at: 0, port: commands, hex: "01160d00 8000 00 15 00 00 0000 04000000 30750000"}]
"""
# Both sides of a ping to 30 m at 260 kHz, whose beam is the highest, asked for every 60 ms.
PACE_872, SPAN_872 = 0.06, 60  # s; dB between the samples 0 and 255
IMAGENEX = f"""
  - name: yellow
    model: imagenex-872
    endpoints: ["tcp-listen://127.0.0.1:4040"]
    driver:
      - {{at: 0, every: {PACE_872}, hex: "FE44001E0000000028001E000000000000000000000000000000FD"}}
      - {{at: 0.055, every: {PACE_872}, hex: "FE44001E0000000028001E000000000000000200000000000000FD"}}
"""
FLOOR = [(-80, -80, -10), (80, -80, -10), (80, 80, -10), (-80, 80, -10)]
BOX = [(x, y, z) for z in (-10, HEIGHT - 10) for x, y in ((-HALF, WALL), (HALF, WALL), (HALF, WALL + 0.2), (-HALF, WALL + 0.2))]
SIDES = [(0, 1, 5), (0, 5, 4), (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6), (3, 0, 4), (3, 4, 7), (4, 5, 6), (4, 6, 7)]
TRIANGLES = [(0, 1, 2), (0, 2, 3)] + [tuple(4 + corner for corner in triangle) for triangle in SIDES]


def setUpModule():
    global folder, temporary
    temporary = tempfile.TemporaryDirectory(prefix="echoloop-")
    folder = Path(temporary.name)
    (folder / "wall.gltf").write_text(mesh_scene(FLOOR + BOX, TRIANGLES, {"mu_db": -20}))
    ends = ((0, -10), (5, -10 + 5 * SPEED))
    rows = [f"{t},{x},0,{ALTITUDE - 10},1,0,0,0" for t, x in ends]
    (folder / "way.csv").write_text("\n".join(["t,x,y,z,qw,qx,qy,qz", *rows]) + "\n")
    for name, device in (("line", EDGETECH), ("yellow", IMAGENEX)):
        (folder / "run.yaml").write_text(SCENARIO + device)
        command("run", "run.yaml", "--record", f"{name}.pcapng", "--record-truth")
    for out in ("line.jsf", "line.xtf", "yellow.xtf"):
        command("convert", Path(out).with_suffix(".pcapng"), out)


def tearDownModule():
    temporary.cleanup()


def command(*arguments):
    done = subprocess.run([PROGRAM, *arguments], cwd=folder, capture_output=True, text=True, timeout=100)
    if done.returncode != 0:
        raise AssertionError(done.stderr)


def by_pyjsf():
    """Port and starboard, rows of pings, near to far, in V."""
    sides = [[], []]
    for header, _, trace in pyjsf.jsf_read(folder / "line.jsf", message_types=["sonar_data_message"]):
        sides[header.channel_number].append(np.asarray(trace.data, float))
    return np.array(sides)


def by_pyxtf(file="line.xtf"):
    """The same in counts of one scale; port begins far away in such files."""
    header, packets = pyxtf.xtf_read(str(folder / file))
    pings = packets[pyxtf.XTFHeaderType.sonar]
    port, starboard = (
        pyxtf.concatenate_channel(pings, file_header=header, channel=n, weighted=True).astype(float)[::-1] for n in (0, 1)
    )
    return np.array([port[:, ::-1], starboard])


class Picture(unittest.TestCase):
    def check(self, sides, pace=2 * RANGE / SOUND + 0.005):
        pings = sides.shape[1]
        self.assertGreater(pings, 0.9 * 5 / pace)
        metres = RANGE / sides.shape[2]
        x = -10 + SPEED * pace * np.arange(pings)
        beside, past = np.abs(x) < HALF - 0.5, np.abs(x) > HALF + 1
        power = sides**2

        def level(side, rows, near, far):
            """dB"""
            return 10 * np.log10(power[side][rows][:, round(near / metres) : round(far / metres)].mean())

        for side in (0, 1):
            profile = power[side].mean(axis=0)
            water = round(3 / metres)  # before it the water itself is loud
            first = water + np.argmax(profile[water:] > 10 * profile[water : round(4.8 / metres)].mean())
            self.assertAlmostEqual(first * metres, ALTITUDE, delta=0.1)
            self.assertGreater(level(side, past, ALTITUDE, ALTITUDE + 0.2), level(side, past, 4.5, 4.9) + 10)

        # The wall's front is heard from its top to its foot; behind it lies its shadow, as far as its top hides the floor.
        top, foot = hypot(WALL, ALTITUDE - HEIGHT), hypot(WALL, ALTITUDE)
        end = hypot((WALL + 0.2) * ALTITUDE / (ALTITUDE - HEIGHT), ALTITUDE)
        floor = level(0, past, top, foot)
        self.assertGreater(level(0, beside, top, foot), floor + 6)
        self.assertLess(level(0, beside, foot + 0.3, end - 0.3), level(0, past, foot + 0.3, end - 0.3) - 12)
        self.assertAlmostEqual(level(0, beside, end + 0.2, end + 2), level(0, past, end + 0.2, end + 2), delta=1.5)
        # Both ends of the shadow, where its level is half way in dB.
        ratio = 10 * np.log10(power[0][beside].mean(axis=0) / power[0][past].mean(axis=0))
        dark = np.convolve(ratio, np.ones(5) / 5, "same") < -6
        inside = np.flatnonzero(dark[round(top / metres) : round((end + 1) / metres)]) + round(top / metres)
        self.assertAlmostEqual(inside.min() * metres, foot, delta=0.15)
        self.assertAlmostEqual(inside.max() * metres, end, delta=0.15)
        # Nothing of it to starboard.
        self.assertAlmostEqual(level(1, beside, top, end), level(1, past, top, end), delta=1)

    def test_pyjsf(self):
        self.check(by_pyjsf())

    def test_pyxtf(self):
        self.check(by_pyxtf())

    def test_pyxtf_of_an_872(self):
        """Its samples are decibels."""
        sides = 10 ** (by_pyxtf("yellow.xtf") / 255 * SPAN_872 / 20)
        self.check(sides, PACE_872)
        _, packets = pyxtf.xtf_read(str(folder / "yellow.xtf"))
        for ping in packets[pyxtf.XTFHeaderType.sonar]:
            self.assertEqual([head.Frequency for head in ping.ping_chan_headers], [260, 260])
            self.assertEqual([head.SlantRange for head in ping.ping_chan_headers], [RANGE, RANGE])

    def test_pyxtf_finds_the_track(self):
        self.check_track("line.xtf")

    def test_pyxtf_finds_the_track_of_an_872(self):
        """It says nothing of its place; the recording does."""
        for ping in self.check_track("yellow.xtf"):
            self.assertAlmostEqual(ping.SensorPrimaryAltitude, ALTITUDE, delta=0.001)

    def check_track(self, file):
        _, packets = pyxtf.xtf_read(str(folder / file))
        pings = packets[pyxtf.XTFHeaderType.sonar]
        for ping in pings[1:]:
            self.assertAlmostEqual(ping.SensorHeading, 90, delta=0.01)
            self.assertAlmostEqual(ping.SensorDepth, 10 - ALTITUDE, delta=0.001)
            self.assertAlmostEqual(ping.SensorSpeed, SPEED / 0.514444, delta=0.1)
            self.assertAlmostEqual(ping.ping_chan_headers[0].SlantRange, RANGE, delta=0.01)
        east = (pings[-1].SensorXcoordinate - pings[0].SensorXcoordinate) * 111320 * np.cos(np.radians(59.4))
        seconds = (pings[-1].get_time() - pings[0].get_time()) / np.timedelta64(1, "s")
        self.assertAlmostEqual(east / seconds, SPEED, delta=0.05)
        return pings

    def test_both_hold_the_same(self):
        volts, counts = by_pyjsf(), by_pyxtf()
        scale = (volts * counts).sum() / (volts * volts).sum()
        self.assertLess(np.abs(counts - scale * volts).max(), 4)


if __name__ == "__main__":
    unittest.main()
