"""A harbour basin: a concrete quay to the north, sheet piling to the west, a pier's piles to the east, a barge, and mud.

Nothing of it stands out of the water, whose surface is z = 0: what is above does not scatter sound.
"""
import math

from .glb import Node
from .mesh import Mesh, unit
from .noise import noise
from .seabed import rock

WEST, EAST, SOUTH, QUAY = -30.0, 50.0, -50.0, 8.0  # m; the bed reaches from WEST to EAST and from SOUTH to QUAY
CELL, BOTTOM = 1.6, 11.0                           # m: of the bed's mesh; how deep the walls go into it
PILE_ROWS, PILE_STEP, PILE_COUNT = (11.0, 15.0), 4.0, 7
STONES = [(-28.6, -3.0, 0.55, 1), (-28.9, -9.5, 0.7, 2), (-28.2, -15.0, 0.45, 3), (-4.0, -18.0, 0.6, 4)]


def depth(x, y):
    """m below the surface: 7.5 at the quay, 5 at the southern end, with what ships and currents left."""
    channel = 5.0 + 2.5 * min(max((y - SOUTH) / 45, 0.0), 1.0)
    scour = 0.5 * math.exp(-((x - 13) / 5) ** 2) * min(max((y + 24) / 6, 0.0), 1.0)
    return channel + scour + 0.5 * (noise(x / 9, y / 9, 31) - 0.5) + 0.16 * (noise(x / 2.3, y / 2.3, 32) - 0.5)


def bed():
    mesh = Mesh()
    columns, rows = round((EAST - WEST) / CELL), round((QUAY - SOUTH) / CELL)
    xs = [WEST + (EAST - WEST) * c / columns for c in range(columns + 1)]
    xs[0] -= 1.0  # under the sheet piling
    ys = [SOUTH + (QUAY - SOUTH) * r / rows for r in range(rows + 1)]

    def normal(r, c, step=0.2):
        x, y = xs[c], ys[r]
        return unit(((depth(x + step, y) - depth(x - step, y)) / (2 * step),
                     (depth(x, y + step) - depth(x, y - step)) / (2 * step), 1.0))

    mesh.surface(rows, columns, lambda r, c: (xs[c], ys[r], -depth(xs[c], ys[r])), normal)
    return mesh


def sheet_piling(pan=0.45, depth_of_pan=0.35):
    """A wall from SOUTH to QUAY whose face, x = WEST, goes back by `depth_of_pan` once every four pans."""
    fronts, y, k = [], SOUTH, 0
    while y < QUAY - 1e-9:
        fronts.append((WEST - (depth_of_pan if k % 4 in (2, 3) else 0.0), y))
        y, k = min(y + pan, QUAY), k + 1
    fronts.append((fronts[-1][0], QUAY))
    back, mesh = WEST - 1.5, Mesh()
    for (x0, y0), (x1, y1) in zip(fronts, fronts[1:]):
        mesh.quad((x0, y0, -BOTTOM), (x1, y1, -BOTTOM), (x1, y1, 0), (x0, y0, 0))
        mesh.quad((back, y1, -BOTTOM), (back, y0, -BOTTOM), (back, y0, 0), (back, y1, 0))
        mesh.quad((back, y0, 0), (x0, y0, 0), (x1, y1, 0), (back, y1, 0))
        mesh.quad((back, y1, -BOTTOM), (x1, y1, -BOTTOM), (x0, y0, -BOTTOM), (back, y0, -BOTTOM))
    (x0, y0), (x1, y1) = fronts[0], fronts[-1]
    mesh.quad((back, y0, -BOTTOM), (x0, y0, -BOTTOM), (x0, y0, 0), (back, y0, 0))
    mesh.quad((x1, y1, -BOTTOM), (back, y1, -BOTTOM), (back, y1, 0), (x1, y1, 0))
    return mesh


def box(size, material, name, centre, yaw=0.0):
    mesh = Mesh()
    mesh.box((0, 0, 0), size)
    return Node(name, [(material, mesh)], position=centre, yaw=yaw)


def piles():
    mesh = Mesh()
    mesh.tube([(0, 0, -BOTTOM), (0, 0, 0)], 0.3, sides=20)
    places = [(x, QUAY - 3 - PILE_STEP * k) for x in PILE_ROWS for k in range(PILE_COUNT)]
    return [Node(f"pile_{i + 1}", [("metal", mesh)], position=(x, y, 0)) for i, (x, y) in enumerate(places)]


def nodes():
    quay = box((EAST - WEST, 4.0, BOTTOM), "rough_concrete", "quay", ((EAST + WEST) / 2, QUAY + 2.0, -BOTTOM / 2))
    fenders = [box((0.4, 0.3, 1.6), "rubber", f"fender_{k + 1}", (WEST + 6 + 8 * k, QUAY - 0.15, -0.8)) for k in range(5)]
    stones = [Node(f"stone_{n}", [("stone", rock(radius, n))], position=(x, y, 0.2 * radius - depth(x, y)), yaw=1.3 * n)
              for x, y, radius, n in STONES]
    return [Node("seabed", [("mud", bed())]), quay, Node("sheet_piling", [("metal", sheet_piling())]),
            box((20.0, 5.0, 1.8), "metal", "barge", (-13.0, QUAY - 3.0, -0.9)), *fenders, *piles(), *stones]
