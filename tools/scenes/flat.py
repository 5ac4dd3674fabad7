"""A flat floor at z = -20 m, 400 x 400 m, for depths that can be worked out by hand."""
from .glb import Node
from .mesh import Mesh

HALF, DEPTH, CELLS = 200.0, 20.0, 20


def nodes():
    floor = Mesh()
    step = 2 * HALF / CELLS
    floor.surface(CELLS, CELLS, lambda r, c: (c * step - HALF, r * step - HALF, -DEPTH), lambda r, c: (0, 0, 1))
    return [Node("floor", [("sand", floor)])]
