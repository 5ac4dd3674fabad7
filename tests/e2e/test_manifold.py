"""The manifold of demo.yaml, its shadow and the seabed in the images of a forward-looking Sonic and Norbit, end to end."""

import math
import statistics
import sys
import time
import unittest

from ports import free_port
from program import ROOT, Emulator

import norbit_host
from r2sonic_host import Host as SonicHost

sys.path.insert(0, str(ROOT / "tools"))
from scenes import manifold, seabed  # noqa: E402

SCENARIO = """
scene: {scenes}/manifold.glb
water: {temperature: 8, salinity: 35, ph: 8, sound_speed: 1482.5}
vehicle: {pose: {position: [-17.5, 0, -3.1]}}
devices:
  - name: sonar
    model: %s
    mount: {rpy_deg: [0, 20, 0]}
    endpoints: [%s]
    options: {%s}
"""
C = 1482.5
EYE, TILT, YAW = (-17.5, 0.0, -3.1), math.radians(20), 0.5


def seen(x, y, z):
    """(bearing in degrees, range) of a point of the manifold, in its own frame."""
    ground = min(seabed.height(a, b) for a in (-3, 0, 3) for b in (-2, 0, 2))
    c, s = math.cos(YAW), math.sin(YAW)
    dx, dy, dz = c * x - s * y - EYE[0], s * x + c * y - EYE[1], ground + z - EYE[2]
    ahead = dx * math.cos(TILT) - dz * math.sin(TILT)
    return math.degrees(math.atan2(-dy, ahead)), math.sqrt(dx * dx + dy * dy + dz * dz)


class Picture:
    """`angles` in degrees to starboard; `columns` of samples, one every `metres` from range `first` on."""

    def __init__(self, angles, columns, metres, first=0.0):
        self.angles, self.columns, self.metres, self.first = angles, columns, metres, first

    def beams(self, degrees):
        middle = min(range(len(self.angles)), key=lambda n: abs(self.angles[n] - degrees))
        return self.columns[max(0, middle - 2) : middle + 3]

    def rows(self, near, far):
        return slice(*(max(0, round((r - self.first) / self.metres)) for r in (near, far)))

    def level(self, degrees, near, far):
        """Mean sample between two ranges over five beams."""
        return statistics.mean(v for column in self.beams(degrees) for v in column[self.rows(near, far)])

    def front(self, degrees, beyond, share=0.3):
        """Metres to where these beams together first have `share` of the strongest that they have beyond a range."""
        start = self.rows(beyond, beyond).start
        sums = [sum(values) for values in zip(*(column[start:] for column in self.beams(degrees)))]
        hit = next(n for n, value in enumerate(sums) if value > share * max(sums))
        return self.first + (start + hit + 0.5) * self.metres


class Manifold:
    def run_on(self, model, endpoints, options):
        emulator = Emulator(SCENARIO % (model, ", ".join(f'"{e}"' for e in endpoints), options))
        self.addCleanup(emulator.__exit__, None, None, None)
        emulator.__enter__()

    def test_manifold_its_shadow_and_the_seabed_are_where_they_are(self):
        picture = self.picture()
        # The upper edge of the panel at the near end of the manifold.
        bearing, distance = seen(-manifold.LENGTH / 2 - 0.09, 0, 2.15)
        self.assertAlmostEqual(picture.front(bearing, 14), distance, delta=0.25)
        far_side = seen(manifold.LENGTH / 2, 0, 1)[1]
        on_sand = picture.level(-25, 18, 26)
        self.assertGreater(picture.level(bearing, distance, far_side), 1.4 * on_sand)
        # Behind its middle no sound reaches the sand.
        shadow = picture.level(0, far_side + 1, far_side + 5)
        self.assertLess(shadow, 0.5 * picture.level(24, far_side + 1, far_side + 5))
        # 7 m above the sand nothing is nearer than that.
        self.assertLess(picture.level(-25, 1.5, 6.3), on_sand / 4)


class Sonic(Manifold, unittest.TestCase):
    def picture(self):
        gui, head = free_port(8), free_port(8)
        host = SonicHost(("127.0.0.1", gui), ("127.0.0.1", head), None)
        self.addCleanup(host.close)
        ends = [f"udp-listen://127.0.0.1:{head}", f"udp://127.0.0.1:{gui}"]
        self.run_on("r2sonic-2024", ends, "projector: wide, range: 40, ping_rate: 2, image_height: 700")
        end = time.monotonic() + 30
        while time.monotonic() < end:
            for event in host.poll(0.5):
                self.assertEqual(event["faults"], [], event["event"])
                if event["event"] == "image":
                    image = event["image"]
                    angles = [math.degrees(a) for a in image.header["angles"]]
                    return Picture(angles, image.rows, image.bin_metres())
        self.fail("no image in 30 s")


class Norbit(Manifold, unittest.TestCase):
    def picture(self):
        ports = [free_port() for _ in range(3)]
        self.run_on("norbit-wbms", [f"tcp-listen://127.0.0.1:{p}" for p in ports], "system: forward-looking")
        line, stream = norbit_host.Line(ports[0]), norbit_host.Stream(ports[2], 2)
        self.addCleanup(line.close)
        self.addCleanup(stream.close)
        for command in ("set_range .5 40", "set_resolution 1024 256", "set_power 1"):
            line.set(command)
        image = stream.first(lambda w: w.ping > 5)
        columns = [image.column(n) for n in range(image.beams)]
        metres = image.c / (2 * image.rate)
        return Picture([math.degrees(a) for a in image.angles], columns, metres, image.range(0) - metres / 2)


if __name__ == "__main__":
    unittest.main()
