"""Scenes of a known size for speed measurements: boxes, a ball and four walls on a square of seabed.

The 1,158 and 101,508 triangle scenes are the ones that other simulators were measured with.
"""
import math

from .glb import Node
from .mesh import Mesh, unit

CELLS = {"simple": (1, 0.0), "big100k": (224, 0.25), "big2m": (1000, 0.25), "one1m": (707, 0.25), "one2m": (1000, 0.25)}  # per side, height of the waves in m
HALF, FLOOR = 60.0, -6.0

# centre, size, yaw
BOXES = [((15, 0, -4.75), (2, 3, 2.5), 0.3), ((20, 7, -5), (2, 2, 2), 0.8), ((18, -8, -5), (1.5, 4, 2), -0.5),
         ((24, -3, -5), (3, 1.5, 2), 0.1), ((26, 12, -4.5), (2, 2, 3), 0.0), ((-14, 6, -2), (3, 3, 8), 0.4),
         ((-8, -16, -2), (2, 5, 8), 1.0)]
WALLS = [((30, 0, -1.5), (0.4, 60, 9)), ((-30, 0, -1.5), (0.4, 60, 9)),
         ((0, 30, -1.5), (60, 0.4, 9)), ((0, -30, -1.5), (60, 0.4, 9))]


def waves(amplitude):
    """Height above FLOOR and the upward normal, both as functions of x and y."""
    def height(x, y):
        return amplitude * (math.sin(0.9 * x) * math.cos(0.7 * y) + 0.4 * math.sin(2.3 * x + 1.7 * y))

    def normal(x, y):
        cross_swell = 0.4 * math.cos(2.3 * x + 1.7 * y)
        dx = amplitude * (0.9 * math.cos(0.9 * x) * math.cos(0.7 * y) + 2.3 * cross_swell)
        dy = amplitude * (-0.7 * math.sin(0.9 * x) * math.sin(0.7 * y) + 1.7 * cross_swell)
        return unit((-dx, -dy, 1.0))

    return height, normal


def seabed(cells, amplitude):
    height, normal = waves(amplitude)
    ticks = [-HALF + 2 * HALF * i / cells for i in range(cells + 1)]
    mesh = Mesh()
    mesh.surface(cells, cells, lambda r, c: (ticks[c], ticks[r], FLOOR + height(ticks[c], ticks[r])),
                 lambda r, c: normal(ticks[c], ticks[r]))
    return mesh


def nodes(name):
    """The nodes of one of CELLS; its objects are single-material, as in the measured scenes."""
    objects = Mesh()
    for centre, size, yaw in BOXES:
        objects.box(centre, size, yaw)
    objects.sphere((19, 3.0, -4.8), 1.2)
    for centre, size in WALLS:
        objects.box(centre, size)
    bed = seabed(*CELLS[name])
    if name.startswith("one"):  # as one mesh, as scanners and CAD programs export
        first = len(bed.positions)
        bed.positions += objects.positions
        bed.normals += objects.normals
        bed.triangles += [tuple(first + corner for corner in triangle) for triangle in objects.triangles]
        return [Node("seabed", [("sand", bed)])]
    return [Node("seabed", [("sand", bed)]), Node("objects", [("sand", objects)])]
