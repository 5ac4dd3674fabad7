"""An Imagenex 852 under the settings of a recording, above ground as hard and as even. docs/recordings.md has the table."""

import math
import unittest
from random import Random

from recorded_case import Case

import imagenex_wire
import words
from byte_line import open_line
from imagenex_host import Host as Sounder
from mesh_scene import grid_triangles, mesh_scene
from shared_data import needs_data


def waves(random, rms, period, times):
    """A swell of that standard deviation about a period in s, at the times: the sum of a dozen sines."""
    parts = [(2 * math.pi / (period * random.uniform(0.6, 1.6)), random.uniform(0, 2 * math.pi)) for _ in range(12)]
    return [rms * math.sqrt(2 / 12) * sum(math.sin(w * t + phase) for w, phase in parts) for t in times]


def boat(seconds=60, step=0.1, tilt=0.08, heave=0.03, speed=0.1):
    """A trajectory 8.5 m above the bottom; `tilt` (rad) and `heave` (m) are standard deviations. The recording's edge lies still
    within half a bin (0.1 m) for minutes, so it heaves by no more; how far it tilts is our own choice."""
    random = Random(3)
    times = [n * step for n in range(int(seconds / step))]
    lines = ["t,x,y,z,qw,qx,qy,qz"]
    for t, roll, pitch, z in zip(times, *(waves(random, rms, period, times) for rms, period in ((tilt, 2.5), (tilt, 3.0), (heave, 4.0)))):
        c, s, d, p = math.cos(roll / 2), math.sin(roll / 2), math.cos(pitch / 2), math.sin(pitch / 2)
        lines.append(f"{t:.2f},{speed * t:.3f},0,{z - 11.5:.3f},{c * d:.6f},{s * d:.6f},{c * p:.6f},{-s * p:.6f}")
    return "\n".join(lines) + "\n"


def rough_bottom(sonar, relief=0.03, wavelength=2, spacing=0.25, size=81):
    """Relief of that standard deviation (m) 20 m down, as the jitter of the recording's edge of 0.6 bins leaves room for."""
    random = Random(1)
    parts = [(2 * math.pi / (wavelength * random.uniform(0.6, 1.6)), random.uniform(0, 2 * math.pi), random.uniform(0, 2 * math.pi)) for _ in range(16)]
    places = [spacing * (n - size // 2) for n in range(size)]
    height = lambda x, y: relief * math.sqrt(2 / 16) * sum(math.sin(k * (x * math.cos(way) + y * math.sin(way)) + phase) for k, way, phase in parts)
    return mesh_scene([(x, y, height(x, y) - 20) for y in places for x in places], list(grid_triangles(size, size)), sonar)


class Imagenex852(Case):
    """hydroball.852: 177 shots over 50 m, 12 dB, 0.2 dB/m, 4 us; a bottom at 7.4 to 9.4 m."""

    def shots(self, count, surface="none"):
        emulator = self.start("scene: bottom.gltf\nseed: 1\nwater: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500, scattering: pure, surface: " + surface + "}\nvehicle: {trajectory: boat.csv}\ndevices:\n"
                              "  - {name: s, model: imagenex-852, mount: {rpy_deg: [0, 90, 0]}, endpoints: ['pty:{folder}/line']}\n",
                              {"boat.csv": boat(), "bottom.gltf": rough_bottom({"material": "rock"})})
        line = open_line(str(emulator.folder / "line"))
        self.addCleanup(line.close)
        host = Sounder(line)
        return [list(host.ask(imagenex_wire.sounder_command(range=50, pulse=4, gain=12, absorption=20)).data)
                for _ in range(count)]

    @staticmethod
    def bottom(shot):
        """The edge and what follows it within 1.2 m."""
        edge = next(i for i, word in enumerate(shot) if i > 10 and word > 63)
        return shot[edge : edge + 12]

    def test_words(self):
        real = [m["reply.data"] for m in words.messages(needs_data("imagenex852/hydroball.852"), "Shot852")]
        ours = self.shots(110)
        part = lambda shots, first, last: [w for shot in shots for w in shot[first:last]]
        self.alike(part(ours, 420, 499), part(real, 420, 499), "852, noise at 42 to 50 m")
        self.alike([w for s in ours for w in self.bottom(s)], [w for s in real for w in self.bottom(s)], "852, bottom")
        self.neither_is_constant_alone(needs_data("imagenex852/hydroball.852"), "Shot852", ".852", known=["time"])  # of that file: reply bytes
        for i in range(8):
            mean = lambda shots: sum(shot[i] for shot in shots) / len(shots)
            self.assertAlmostEqual(mean(ours), mean(real), delta=3, msg=f"sample {i}")

    @staticmethod
    def second_bottom(shots):
        """Mean words over all shots from 5 samples before twice the edge on."""
        edges = [next(i for i, word in enumerate(shot) if i > 10 and word > 63) for shot in shots]
        parts = [shot[2 * edge - 5 : 2 * edge + 25] for shot, edge in zip(shots, edges)]
        return [sum(words) / len(words) for words in zip(*parts)]

    def test_the_second_bottom(self):
        """By way of the surface, 0.3 m above the sounder. The sea of the recording is not known: with 7 m/s of wind the level is
        met, in a light air it is 7 dB higher. It fades as what the beam hears beside its axis comes later."""
        real = self.second_bottom([m["reply.data"] for m in words.messages(needs_data("imagenex852/hydroball.852"), "Shot852")])
        ours = self.second_bottom(self.shots(80, "{height: -11.2, wind: 7}"))
        print("852, second bottom, mean words from five samples before twice the edge on; real, ours", *([round(w, 1) for w in side] for side in (real, ours)))
        loudest = [side.index(max(side)) for side in (real, ours)]
        self.assertAlmostEqual(*loudest, delta=2)
        self.assertLess(abs(20 * math.log10(max(ours) / max(real))), 3.5)
        fading = [sum(side[at + 3 : at + 9]) / 6 for side, at in zip((real, ours), loudest)]
        self.assertLess(abs(20 * math.log10(fading[1] / fading[0])), 3, f"{fading}; noise alone is 8 dB less")


if __name__ == "__main__":
    unittest.main()
