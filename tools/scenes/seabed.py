"""The seabed around the manifold: undulating sand with a rippled field, gravel patches and rocks.

The detailed square is 60 m wide; a plain skirt carries the sand on to 300 m so that no picture shows its edge.
"""
import math

from .glb import Node
from .mesh import Mesh, add, scale, unit
from .noise import noise, smooth

HALF, CELLS, DEPTH = 30.0, 150, 10.0
SKIRT = 5.0  # the far edge is this many times as far out

# x, y, radius, seed
ROCKS = [(-6.5, 6.5, 0.75, 1), (-5.0, 7.6, 0.4, 2), (9.5, 8.0, 1.1, 3), (11.2, 7.0, 0.5, 4), (5.0, -13.0, 0.9, 5),
         (-9.0, -8.5, 0.55, 6), (-7.6, -9.3, 0.3, 7), (15.0, -4.0, 0.7, 8), (-3.0, 14.0, 1.2, 9), (12.0, 16.0, 0.8, 10),
         (17.0, 4.5, 0.5, 11), (-12.0, 2.5, 0.35, 12)]


def rim(x, y):
    """1 inside, falling to 0 at the edge of the square, where the plain skirt begins."""
    inside = (HALF - max(abs(x), abs(y))) / 8
    return smooth(min(max(inside, 0.0), 1.0))


def ripples(x, y):
    """Sand ripples 1.6 m apart and 0.12 m high, in patches, their crests bent by the slow noise."""
    field = min(max(4 * noise(x / 11, y / 11, 3) - 1.7, 0.0), 1.0)
    phase = 2 * math.pi * (0.55 * x + 0.3 * y + 1.6 * noise(x / 7, y / 7, 4))
    return 0.06 * field * math.sin(phase)


def height(x, y):
    """Seabed height in m, ENU."""
    swell = 0.9 * (noise(x / 14, y / 14, 1) - 0.5) + 0.25 * (noise(x / 4, y / 4, 2) - 0.5)
    return -DEPTH + rim(x, y) * (swell + ripples(x, y))


def slope_normal(x, y, step=0.05):
    dx = (height(x + step, y) - height(x - step, y)) / (2 * step)
    dy = (height(x, y + step) - height(x, y - step)) / (2 * step)
    return unit((-dx, -dy, 1.0))


def is_gravel(x, y):
    """In patches some metres wide with uneven edges, none of which follows the lattice of the noise."""
    a, b = (t + 5 * (noise(x / 4, y / 4, seed) - 0.5) for t, seed in ((x, 7), (y, 8)))
    much = noise((0.8 * a + 0.6 * b) / 6 + 40, (0.8 * b - 0.6 * a) / 6, 5)
    fringe = 0.16 * (noise(x / 1.6, y / 1.6, 9) - 0.5)
    return much + fringe > 0.7 + 0.4 * (1 - rim(x, y))


def square():
    mesh = Mesh()
    ticks = [-HALF + 2 * HALF * i / CELLS for i in range(CELLS + 1)]
    mesh.surface(CELLS, CELLS, lambda r, c: (ticks[c], ticks[r], height(ticks[c], ticks[r])),
                 lambda r, c: slope_normal(ticks[c], ticks[r]))
    return mesh


def middle(mesh, triangle):
    corners = [mesh.positions[i] for i in triangle]
    return sum(p[0] for p in corners) / 3, sum(p[1] for p in corners) / 3


def split(mesh, chosen):
    """The triangles whose middle is chosen(x, y), and the others, each with only the vertices it uses."""
    halves = (Mesh(), Mesh())
    index = ({}, {})
    for triangle in mesh.triangles:
        side = 0 if chosen(*middle(mesh, triangle)) else 1
        for i in triangle:
            if i not in index[side]:
                index[side][i] = halves[side].vertex(mesh.positions[i], mesh.normals[i])
        halves[side].triangles.append(tuple(index[side][i] for i in triangle))
    return halves


def skirt():
    """A ring of quads from the square's rim out to SKIRT times as far, vertex to vertex without cracks."""
    ticks = [-HALF + 2 * HALF * i / CELLS for i in range(CELLS)]
    loop = ([(t, -HALF) for t in ticks] + [(HALF, t) for t in ticks] +
            [(-t, HALF) for t in ticks] + [(-HALF, -t) for t in ticks])
    loop = loop[::-1] + loop[-1:]
    mesh = Mesh()
    mesh.surface(1, len(loop) - 1,
                 lambda r, c: (loop[c][0] * SKIRT ** r, loop[c][1] * SKIRT ** r, -DEPTH), lambda r, c: (0, 0, 1))
    return mesh


def rock(radius, seed):
    """A ball with dents, flattened, its middle at the origin."""
    mesh = Mesh()
    mesh.sphere((0, 0, 0), 1.0, columns=20, rows=10)
    for i, n in enumerate(mesh.positions):
        dent = 0.6 + 0.7 * noise(1.6 * n[0] + 1.1 * n[2] + 9 * seed, 1.6 * n[1] - 1.3 * n[2], 20 + seed)
        mesh.positions[i] = scale(radius * dent, (1.2 * n[0], n[1], 0.75 * n[2]))
    mesh.smooth()
    mesh.prune()
    return mesh


def nodes():
    gravel, sand = split(square(), is_gravel)
    result = [Node("seabed", [("sand", sand), ("gravel", gravel)]), Node("seabed_far", [("sand", skirt())])]
    for x, y, radius, seed in ROCKS:
        ground = add((x, y, height(x, y)), (0, 0, 0.2 * radius))
        result.append(Node(f"rock_{seed}", [("rock", rock(radius, seed))], position=ground, yaw=1.3 * seed))
    return result
