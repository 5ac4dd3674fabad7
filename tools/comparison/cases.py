"""The cases of docs/comparison.md: rows of (metric, figure of the recording or None, {simulator: figure}).

A simulator's figure is None where it has no such echo at all, and infinite where a ratio has no denominator.
"""
import math
import pathlib
import tempfile

from . import formulas
from .program import ROOT, measured, pixels, turn
from .statistics import decibels, likeness, mean, variation

OURS = "echoloop"

# An M1200d's high mode, 2 m, as recorded: 256 beams, rows of 2.842 mm; 0.8 m above a flat floor, looking 60 deg down.
# The field is 30 deg high, so that the rows below lie wholly on the floor.
OCULUS = """scene: {scenes}/flat.glb
water: {{temperature: 12, salinity: 0, ph: 7, sound_speed: 1490.66}}
render: {{pixels: 16}}
vehicle: {{pose: {{position: [0, 0, -19.2], rpy_deg: [0, 60, 0]}}}}
devices:
  - name: oculus
    model: oculus-m1200d
    endpoints: ["tcp-listen://127.0.0.1:52100", "udp://127.255.255.255:52102"]
    profile: {{low_aperture: 60, low_fan_height: 30, low_beam_width: 0.4, low_frequency: 2098880.6}}
"""
LIT, DARK, MIDDLE = range(310, 370), range(600, 700), slice(64, 192)  # rows and beams wholly on the floor, rows beyond it
GRID = formulas.Grid(703, 2.8421889710794315e-3, 256, math.radians(60), math.radians(0.4), (range(8), LIT, DARK))
FIRST_ROWS = (40, 42, 12, 17, 19, 19, 14, 10)  # means of that recording

# A sounder 8.3 m above a sandy bottom, 0.2 m below the surface, in a light air.
SOUNDER = """scene: {scenes}/flat.glb
water: {{sound_speed: 1500, surface: {{height: -11.5}}}}
vehicle: {{pose: {{position: [0, 0, -11.7], rpy_deg: [0, 90, 0]}}}}
devices:
  - {{name: sounder, model: imagenex-852, endpoints: ["pty:/tmp/echoloop/imagenex-852"]}}
"""

# A Micron in the basin: the wall that it faces to port, and the corner of that wall with the one astern.
BASIN = """scene: {scenes}/basin.glb
water: {{temperature: 18, salinity: 0, ph: 7, sound_speed: 1500, surface: {{roughness: 0.0001}}}}
vehicle: {{pose: {{position: [0.3, 0.2, -1.2], rpy_deg: [0, 0, 0]}}}}
effects: {{speckle: off, ring_down: off, interference: off}}
devices:
  - {{name: micron, model: tritech-micron, endpoints: ["pty:/tmp/echoloop/micron"]}}
"""
WALL, CORNER = -90.0, -150.3  # bearings in deg
WALL_RANGE, CORNER_RANGE = 1.6, math.hypot(2.8, 1.6)


class AtLeast(float):
    """A recorded figure that is a bound."""


def scenario(folder, text):
    path = folder / "scenario.yaml"
    path.write_text(text.format(scenes=ROOT / "config" / "scenes"))
    return path


def rows_of(image, limits):
    return [image[row][MIDDLE] if limits is LIT else image[row] for row in limits]


def rms(found, wanted):
    return math.sqrt(mean([(f - w) ** 2 for f, w in zip(found, wanted)]))


def imaging(folder):
    """The texture of a lit floor and of noise, in words."""
    ours = measured("R2")
    images = formulas.pictures(pixels(folder, scenario(folder, OCULUS), "--range", "2"), GRID)
    figures = [
        ("lit floor: coefficient of variation", "lit echo, coefficient of variation", LIT, variation),
        ("lit floor: correlation of neighbouring beams", "lit echo, correlation of neighbouring beams", LIT,
         lambda i: likeness(i, 0, 1)),
        ("lit floor: two beams apart", "lit echo, two beams apart", LIT, lambda i: likeness(i, 0, 2)),
        ("lit floor: correlation of neighbouring rows", "lit echo, correlation of neighbouring rows", LIT,
         lambda i: likeness(i, 1, 0)),
        ("noise: mean word", "noise, mean word", DARK, lambda i: mean([w for row in i for w in row])),
        ("noise: coefficient of variation", "noise, coefficient of variation", DARK, variation),
        ("noise: correlation of neighbouring beams", "noise, correlation of neighbouring beams", DARK,
         lambda i: likeness(i, 0, 1)),
        ("noise: correlation of neighbouring rows", "noise, correlation of neighbouring rows", DARK,
         lambda i: likeness(i, 1, 0))]
    rows = []
    for title, quantity, limits, figure in figures:
        real, mine = ours[quantity]
        rows.append((title, real, {OURS: mine, **{n: figure(rows_of(i, limits)) for n, i in images.items()}}))
    near = {n: rms([mean(row) for row in i[:8]], FIRST_ROWS) for n, i in images.items()}
    rows.append(("near field: distance of the first 8 rows from the recording's, rms words", 0.0,
                 {OURS: ours["mean of rows 0 to 7, rms distance"][1], **near}))
    return rows


def level_about(ranges, levels, distance, reach):
    return max(level for r, level in zip(ranges, levels) if abs(r - distance) <= reach)


def second_bottom(folder):
    """The mean of ten speckles: single ones lie from 25 to 38 dB."""
    found = []
    for seed in range(1, 11):
        ranges, pings = turn(folder, scenario(folder, f"seed: {seed}\n" + SOUNDER), "--range", "50", "--pings", "1")
        levels = next(iter(pings.values()))
        found.append(decibels(level_about(ranges, levels, 8.5, 0.5) / level_about(ranges, levels, 17, 0.6)))
    ours = mean(found)
    return [("second bottom below the first, dB", AtLeast(12.8), {OURS: ours, **dict.fromkeys(formulas.ALL)})]


def wall_and_corner(folder):
    file = scenario(folder, BASIN)
    ranges, turned = turn(folder, file, "--range", "5")
    bearings = list(turned)  # in the order of the steps
    grid = formulas.Grid(500, 0.01, 3, math.radians(3), math.radians(3))

    def step_at(bearing):
        return min(range(len(bearings)), key=lambda k: abs((bearings[k] - bearing + 180) % 360 - 180))

    def ours(bearing, distance):
        return level_about(ranges, turned[bearings[step_at(bearing)]], distance, 0.1)

    def theirs(bearing, distance):
        """The mean level of ten draws of their noise, in dB: single ones lie up to 1 dB apart."""
        seen = pixels(folder, file, "--range", "5", "--step", step_at(bearing))
        draws = [formulas.pictures(seen, grid, seed) for seed in range(1, 11)]
        at = round(distance / grid.step)
        return {name: mean([decibels(max(w for row in draw[name][at - 10:at + 11] for w in row)) for draw in draws])
                for name in formulas.ALL}

    facing, corner = theirs(WALL, WALL_RANGE), theirs(CORNER, CORNER_RANGE)
    found = {name: 2 * (facing[name] - corner[name]) for name in formulas.ALL}
    mine = decibels(ours(WALL, WALL_RANGE) / ours(CORNER, CORNER_RANGE))
    return [("the wall that is faced above the corner, dB", None, {OURS: mine, **found})]


def rows():
    """All rows; takes some ten seconds."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        return imaging(folder) + wall_and_corner(folder) + second_bottom(folder)
