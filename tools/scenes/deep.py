"""Open water over a seabed at about 120 m: sand, a ledge of rock, a small wreck, and a school of fish in mid water."""
import math

from .glb import Node
from .mesh import Mesh, unit
from .noise import lattice, noise
from .seabed import split

HALF, CELLS, DEPTH = 320.0, 64, 120.0
SCHOOL, FISH, FISH_STRENGTH = (0.0, -6.0, -62.0), 60, -38.0  # dB re 1 m^2: own choice, a fish of some 30 cm


def ledge(x, y):
    """m above the sand: rock to the south of the ship, steep on the side that looks at it."""
    along = -y - 60 - 25 * math.sin(x / 110)
    return 9.0 / (1 + math.exp(-along / 4)) * math.exp(-max(along, 0.0) / 60) * (0.6 + 0.8 * noise(x / 40, y / 40, 42))


def height(x, y):
    return -DEPTH - 0.015 * y + 3.0 * (noise(x / 120, y / 120, 41) - 0.5) + ledge(x, y)


def bed():
    ticks = [2 * HALF * i / CELLS - HALF for i in range(CELLS + 1)]

    def normal(r, c, step=2.0):
        x, y = ticks[c], ticks[r]
        return unit(((height(x - step, y) - height(x + step, y)) / (2 * step),
                     (height(x, y - step) - height(x, y + step)) / (2 * step), 1.0))

    mesh = Mesh()
    mesh.surface(CELLS, CELLS, lambda r, c: (ticks[c], ticks[r], height(ticks[c], ticks[r])), normal)
    return mesh


def wreck():
    """A coaster's hull of 30 x 7 m, and what is left of its bridge."""
    mesh = Mesh()
    mesh.box((0, 0, 2.0), (30.0, 7.0, 4.0))
    mesh.box((-10.5, 0, 5.2), (6.0, 6.0, 2.4))
    mesh.tube([(5, 0, 4.0), (5, 0, 9.0)], 0.3, sides=12)
    return mesh


def school():
    """Places on a jittered line of turns about the school's middle, in its own frame."""
    turn = [lattice(k, j, 43) for j in range(3) for k in range(FISH)]
    places = [(6 * (turn[k] - 0.5), 14 * (turn[k + FISH] - 0.5), 8 * (turn[k + 2 * FISH] - 0.5)) for k in range(FISH)]
    return [Node(f"fish_{k + 1}", position=place, strength=FISH_STRENGTH) for k, place in enumerate(places)]


def nodes():
    rock, sand = split(bed(), lambda x, y: ledge(x, y) > 2.5)
    x, y = 4.0, 45.0
    return [Node("seabed", [("seabed_sand", sand), ("stone", rock)]),
            Node("wreck", [("metal", wreck())], position=(x, y, height(x, y) - 0.5), yaw=0.9),
            Node("school", position=SCHOOL, children=school())]
