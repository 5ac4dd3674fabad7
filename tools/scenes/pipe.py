"""A sewer of concrete, 0.6 m wide inside, that runs from west to east 3 m below the surface and is full of water.

In its invert lies a deposit; a connection reaches too far into it on the southern side, above the middle.
"""
import math

from .glb import Node
from .mesh import Mesh, scale, unit

RADIUS, THICKNESS, LENGTH, AXIS = 0.3, 0.1, 6.0, -3.0  # m
SIDES, PARTS = 180, 6  # flats of 10 mm, which lie within 0.05 mm of the circle
DEPOSIT = 0.22         # m below the axis
CONNECTION, REACH, CLOCK = 0.05, 0.08, math.radians(60)  # m, its radius, how far it reaches in; from up to the south


def radial(c, turn=1):
    """Unit vector from the axis; rising c go from up to the north with turn = 1, to the south with -1."""
    angle = 2 * math.pi * c / SIDES * turn
    return (0.0, math.sin(angle), math.cos(angle))


def wall():
    """Inside, outside and both ends."""
    mesh, outer = Mesh(), RADIUS + THICKNESS

    def at(x, radius, direction):
        return (x, radius * direction[1], radius * direction[2])

    def along(r):
        return LENGTH * (r / PARTS - 0.5)

    mesh.surface(PARTS, SIDES, lambda r, c: at(along(r), RADIUS, radial(c)), lambda r, c: scale(-1, radial(c)))
    mesh.surface(PARTS, SIDES, lambda r, c: at(along(r), outer, radial(c, -1)), lambda r, c: radial(c, -1))
    for end in (-1, 1):
        mesh.surface(1, SIDES, lambda r, c: at(end * LENGTH / 2, RADIUS + r * THICKNESS, radial(c, end)),
                     lambda r, c: (float(end), 0.0, 0.0))
    return mesh


def deposit():
    """Its sides and its foot lie in the wall."""
    mesh, half, foot = Mesh(), math.sqrt(RADIUS ** 2 - DEPOSIT ** 2) + 0.005, RADIUS + 0.02
    mesh.box((0, 0, -(DEPOSIT + foot) / 2), (LENGTH - 0.02, 2 * half, foot - DEPOSIT))
    return mesh


def connection():
    mesh, out = Mesh(), unit((0.0, -math.sin(CLOCK), math.cos(CLOCK)))
    mesh.tube([scale(RADIUS + THICKNESS / 2, out), scale(RADIUS - REACH, out)], CONNECTION, sides=40)
    return mesh


def nodes():
    at = (0.0, 0.0, AXIS)
    return [Node("wall", [("rough_concrete", wall())], position=at),
            Node("deposit", [("gravel_bed", deposit())], position=at),
            Node("connection", [("plastic", connection())], position=at)]
