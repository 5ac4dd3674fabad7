"""Published formulas of other simulators, from their papers and the documentation and sources that they publish.

Each takes the pixels of a picture, (range in m, bearing in rad, cos of the incidence), and makes 8-bit words: a list of
rows, the nearest first, of one word for each beam. What the formulas have in common is the geometry of one reflection;
none has an echo that comes by way of a second surface (HoloOcean can, see docs/comparison.md), and none ring-down. The
parameters are the ones of the projects' own examples. Written anew from the formulas; no line of theirs is here.
"""
import math
import random
from dataclasses import dataclass


@dataclass
class Grid:
    rows: int
    step: float      # m of range in a row
    beams: int
    aperture: float  # rad, from the first beam to the last
    beam_width: float
    wanted: tuple = ()  # rows that are asked for, as ranges; none: all

    def asked(self, row):
        return not self.wanted or any(row in rows for rows in self.wanted)

    def place(self, distance, bearing):
        """(row, beam) of a pixel, or None outside."""
        row = int(distance / self.step)
        beam = round((bearing / self.aperture + 0.5) * (self.beams - 1))
        return (row, beam) if 0 <= row < self.rows and 0 <= beam < self.beams else None

    def empty(self, value=0.0):
        return [[value] * self.beams for _ in range(self.rows)]

    def sums(self, pixels, value):
        """Sum of value(range, cosine) and number of pixels for each row and beam."""
        total, count = self.empty(), self.empty(0)
        for distance, bearing, cosine in pixels:
            place = self.place(distance, bearing)
            if place:
                total[place[0]][place[1]] += value(distance, cosine)
                count[place[0]][place[1]] += 1
        return total, count

    def words(self, value):
        """8-bit words of value(row, beam), clamped to 0..1; rows that nobody asked for are empty."""
        return [[float(int(255 * min(max(value(r, b), 0.0), 1.0))) for b in range(self.beams)] if self.asked(r) else []
                for r in range(self.rows)]


def sigmoid(x):
    return 1 / (1 + math.exp(-18 * (x - 2 / 3)))


def mean_at(total, count, row, beam):
    return total[row][beam] / count[row][beam] if count[row][beam] else 0.0


def rayleigh(rng, scale):
    return scale * math.hypot(rng.gauss(0, 1), rng.gauss(0, 1))


def cerqueira(pixels, grid, _):
    """Cerqueira et al. 2016: the mean of a sigmoid of cos(incidence). No noise, no speckle."""
    total, count = grid.sums(pixels, lambda _, cosine: sigmoid(cosine))
    return grid.words(lambda r, b: mean_at(total, count, r, b))


def stonefish(pixels, grid, rng, multiplicative=0.01, additive=0.02):
    """Stonefish's forward-looking sonar: that sigmoid's mean over a Gaussian of five lines, times normal noise that a
    beam's bins share, plus normal noise, clamped. The deviations are those of its documentation's example."""
    total, count = grid.sums(pixels, lambda _, cosine: sigmoid(cosine))
    weights = [(k, math.exp(-k * k / 2)) for k in range(-2, 3)]
    gains = [rng.gauss(1, multiplicative) for _ in range(grid.beams)]

    def value(r, b):
        near = [(w, b + k) for k, w in weights if 0 <= b + k < grid.beams]
        weight = sum(w * count[r][n] for w, n in near)
        echo = sum(w * total[r][n] for w, n in near) / weight if weight else 0.0
        return echo * gains[b] + rng.gauss(0, additive)

    return grid.words(value)


def holoocean(pixels, grid, rng, multiplicative=0.2, additive=0.15):
    """HoloOcean's imaging sonar (Potokar et al. 2022) without its clusters of multipath: the mean of cos(incidence)
    times 0.5 + normal noise, plus Rayleigh noise that grows with the range squared and by half in the middle. The
    deviations are those of one user's configuration."""
    total, count = grid.sums(pixels, lambda _, cosine: cosine)
    degrees, spread = math.degrees(grid.aperture), math.degrees(grid.aperture) / 64

    def value(r, b):
        azimuth = (b / (grid.beams - 1) - 0.5) * degrees
        scale = (r / grid.rows) ** 2 * (1 + 0.5 * math.exp(-azimuth ** 2 / spread))
        return mean_at(total, count, r, b) * (0.5 + rng.gauss(0, multiplicative)) + rayleigh(rng, additive) * scale

    return grid.words(value)


def oceansim(pixels, grid, rng, attenuation=0.1, gaussian=0.2, additive=0.05, peak=2.0, spread=0.001):
    """OceanSim (Song et al. 2025): the sum of cos(incidence) exp(-a R), divided by the row's greatest, times 0.5 +
    normal noise, plus Rayleigh noise that grows with the range squared and threefold in the middle. The parameters are
    the defaults of its sensor."""
    total, _ = grid.sums(pixels, lambda distance, cosine: cosine * math.exp(-attenuation * distance))
    most = [max(row) or 1.0 for row in total]

    def value(r, b):
        azimuth = (b / (grid.beams - 1) - 0.5) * grid.aperture
        scale = (r / grid.rows) ** 2 * (1 + peak * math.exp(-azimuth ** 2 / spread))
        return total[r][b] / most[r] * (0.5 + rng.gauss(0, gaussian)) + rayleigh(rng, additive) * scale

    return grid.words(value)


def uuv_simulator(pixels, grid, rng):
    """UUV Simulator's image sonar: an excess in dB of 200 - 2 (5 dB a metre) - 30 + 100 cos(incidence), not below 0, scaled
    to its greatest, times normal noise of 0.1. (Its own angle is the one to the camera's axis; its smoothing along arcs
    at random places is left out.)"""
    total, count = grid.sums(pixels, lambda distance, cosine: max(200 - 10 * distance - 30 + 100 * cosine, 0.0))
    most = max(mean_at(total, count, r, b) for r in range(grid.rows) for b in range(grid.beams)) or 1.0
    return grid.words(lambda r, b: mean_at(total, count, r, b) / most * abs(rng.gauss(1, 0.1)))


def dave(pixels, grid, rng):
    """DAVE's multibeam (Choi et al. 2021): each ray adds a random complex amplitude of cos(incidence) / R, and a
    beam hears its neighbours by its pattern; words follow the amplitude. No noise but the speckle. Rays are as many as
    here are pixels; the pattern is a sinc of the beam's width."""
    real, imaginary = grid.empty(), grid.empty()
    for distance, bearing, cosine in pixels:
        place = grid.place(distance, bearing)
        if place:
            amplitude = cosine / distance
            real[place[0]][place[1]] += amplitude * rng.gauss(0, 1)
            imaginary[place[0]][place[1]] += amplitude * rng.gauss(0, 1)
    spacing = 0.886 * grid.aperture / (grid.beams - 1) / grid.beam_width

    def pattern(k):
        return 1.0 if k == 0 else math.sin(math.pi * k * spacing) / (math.pi * k * spacing)

    heard = [(k, pattern(k)) for k in range(-8, 9)]

    def amplitude(r, b):
        near = [(w, b + k) for k, w in heard if 0 <= b + k < grid.beams]
        return math.hypot(sum(w * real[r][n] for w, n in near), sum(w * imaginary[r][n] for w, n in near))

    levels = [[amplitude(r, b) for b in range(grid.beams)] if any(real[r]) else grid.empty()[0] for r in range(grid.rows)]
    most = max(max(row) for row in levels) or 1.0
    return grid.words(lambda r, b: levels[r][b] / most)


ALL = {"cerqueira2016": cerqueira, "Stonefish": stonefish, "HoloOcean": holoocean, "OceanSim": oceansim,
       "UUV Simulator": uuv_simulator, "DAVE": dave}


def pictures(pixels, grid, seed=1):
    return {name: formula(pixels, grid, random.Random(f"{seed} {name}")) for name, formula in ALL.items()}
