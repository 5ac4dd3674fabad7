"""A small test basin of painted concrete, 5 x 3.6 m inside and 2.6 m deep, its middle at the origin, full to z = 0.

Echoes go to and fro between its walls several times before they fade, as in real ones. A ladder, a drain pipe in a
corner, a block on the floor and a ball that hangs freely tell its sides apart.
"""
from .glb import Node
from .mesh import Mesh
from .tank import walls

LENGTH, WIDTH, DEPTH = 5.0, 3.6, 2.6


def ladder(width=0.4, height=2.0, rung=0.28):
    """Two rails and rungs in the plane y = 0, from z = 0 downwards."""
    mesh = Mesh()
    for x in (-width / 2, width / 2):
        mesh.tube([(x, 0, -height), (x, 0, 0)], 0.022, sides=10)
    for k in range(1, int(height / rung) + 1):
        mesh.tube([(-width / 2, 0, -k * rung), (width / 2, 0, -k * rung)], 0.015, sides=8)
    return mesh


def nodes():
    ball, block, drain = Mesh(), Mesh(), Mesh()
    ball.sphere((0, 0, 0), 0.12, columns=24, rows=12)
    ball.prune()
    block.box((0, 0, 0.175), (0.5, 0.4, 0.35))
    drain.tube([(0, 0, -DEPTH), (0, 0, 0)], 0.08, sides=20)
    return walls(LENGTH, WIDTH, DEPTH, "painted_concrete") + [
        Node("ladder", [("metal", ladder())], position=(-1.5, -WIDTH / 2 + 0.15, 0)),
        Node("drain", [("plastic", drain)], position=(LENGTH / 2 - 0.12, WIDTH / 2 - 0.12, 0)),
        Node("block", [("rough_concrete", block)], position=(-1.3, 0.8, -DEPTH), yaw=0.4),
        Node("ball", [("metal", ball)], position=(1.3, -0.8, -1.1))]
