"""A subsea production manifold, about 6 x 4 x 3 m, standing at z = 0 in its own frame, and the pipeline it feeds.

The size and the parts are those of common template structures: mudmat with skirt piles, base frame, two headers with
branches to eight hubs, valves with ROV buckets, panels, and an open roof frame.
"""
import math

from .glb import Node
from .mesh import Mesh
from .seabed import height

LENGTH, WIDTH, HEIGHT = 6.0, 4.0, 3.0
HEADER_Y, HEADER_Z, HEADER_RADIUS = 0.65, 1.0, 0.25
BRANCHES_X = (-2.1, -0.7, 0.7, 2.1)


def base():
    mesh = Mesh()
    mesh.box((0, 0, 0.05), (LENGTH + 0.6, WIDTH + 0.6, 0.1))
    for y in (-WIDTH / 2, -0.65, 0.65, WIDTH / 2):
        mesh.box((0, y, 0.27), (LENGTH, 0.25, 0.34))
    for x in (-LENGTH / 2, -1.0, 1.0, LENGTH / 2):
        mesh.box((x, 0, 0.3), (0.25, WIDTH + 0.25, 0.28))
    for x in (-LENGTH / 2, LENGTH / 2):
        for y in (-WIDTH / 2, WIDTH / 2):
            mesh.tube([(x, y, -0.5), (x, y, 0.75)], 0.32, sides=20)
    return mesh


def headers():
    """The two main pipes along x, their flanges, and a branch to a hub on either side at each of BRANCHES_X."""
    mesh = Mesh()
    for side in (-1, 1):
        y = side * HEADER_Y
        mesh.tube([(-3.2, y, HEADER_Z), (3.4, y, HEADER_Z)], HEADER_RADIUS, sides=20)
        for x in (-3.2, -2.95, 3.15, 3.4):
            mesh.tube([(x - 0.05, y, HEADER_Z), (x + 0.05, y, HEADER_Z)], 0.38, sides=20)
        for x in BRANCHES_X:
            mesh.tube([(x, y, HEADER_Z), (x, side * 1.75, HEADER_Z), (x, side * 1.75, HEADER_Z + 0.55)], 0.12, sides=12)
            mesh.tube([(x, side * 1.75, HEADER_Z + 0.4), (x, side * 1.75, HEADER_Z + 0.85)], 0.22, sides=16)
    return mesh


def valves():
    """A valve on each branch: body, stem and the bucket that a vehicle's torque tool enters."""
    mesh = Mesh()
    for side in (-1, 1):
        for x in BRANCHES_X:
            y = side * 1.2
            mesh.box((x, y, HEADER_Z), (0.45, 0.4, 0.45))
            mesh.tube([(x, y, HEADER_Z + 0.2), (x, y, HEADER_Z + 1.05)], 0.07, sides=10)
            mesh.tube([(x, y, HEADER_Z + 1.05), (x, y, HEADER_Z + 1.3)], 0.17, sides=16)
    return mesh


def panels():
    """Two control panels at the ends and a control pod between the headers."""
    mesh = Mesh()
    mesh.box((-LENGTH / 2 - 0.05, 0, 1.55), (0.08, 1.9, 1.2))
    mesh.box((LENGTH / 2 + 0.05, -1.35, 1.55), (0.08, 0.9, 1.2))
    mesh.box((0, 0, 0.9), (0.9, 0.7, 1.3))
    mesh.tube([(0, 0, 1.5), (0, 0, 2.0)], 0.25, sides=16)
    return mesh


def roof():
    """Four legs that lean inwards, the ring beam they carry, and hatch covers over half of it."""
    mesh = Mesh()
    x, y, lean = LENGTH / 2, WIDTH / 2, 0.45
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    tops = [(i * (x - lean), j * (y - lean), HEIGHT) for i, j in corners]
    for (i, j), top in zip(corners, tops):
        mesh.tube([(i * x, j * y, 0.3), top], 0.11, sides=12)
    for k in range(4):
        mesh.tube([tops[k], tops[(k + 1) % 4]], 0.1, sides=12)
    for beam in (-1.2, 0.0, 1.2):
        mesh.tube([(beam, -(y - lean), HEIGHT), (beam, y - lean, HEIGHT)], 0.07, sides=10)
    mesh.box((-1.85, 0, HEIGHT), (1.1, 2.6, 0.06))
    mesh.box((1.85, 0.8, HEIGHT), (1.1, 1.2, 0.06))
    return mesh


def pipeline(start, heading):
    """From `start` (world) down to the seabed and away in a wide bend, half sunk into the sand's waves."""
    points, (x, y, z) = [start], start
    for k in range(44):
        step = 0.35 if k < 12 else 0.8
        heading += 0.0 if k < 8 else 0.021
        x, y = x + step * math.cos(heading), y + step * math.sin(heading)
        bed = height(x, y) + 0.12
        z = max(bed, z - 0.12) if k > 1 else z
        points.append((x, y, z))
    mesh = Mesh()
    mesh.tube(points, HEADER_RADIUS * 0.9, sides=14)
    return mesh


def nodes(position, yaw):
    """The manifold at a world position, and the pipeline from the end of its port header, in world coordinates."""
    parts = [("base", base()), ("headers", headers()), ("valves", valves()), ("panels", panels()), ("roof", roof())]
    children = [Node(f"manifold_{name}", [("steel", mesh)]) for name, mesh in parts]
    c, s = math.cos(yaw), math.sin(yaw)
    start = (position[0] + c * 3.4 - s * HEADER_Y, position[1] + s * 3.4 + c * HEADER_Y, position[2] + HEADER_Z)
    return [Node("manifold", position=position, yaw=yaw, children=children),
            Node("pipeline", [("steel", pipeline(start, yaw))])]
