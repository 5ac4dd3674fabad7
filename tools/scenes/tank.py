"""The tank: 12 x 8 m inside and 4 m deep, its middle at the origin, the water surface at z = 0.

The inner faces stand at x = +-6 and y = +-4, the floor at z = -4. A lattice, a ball and a post stand in it so that
no turn or mirror image of the picture looks like another.
"""
from .glb import Node
from .mesh import Mesh

LENGTH, WIDTH, DEPTH, THICKNESS = 12.0, 8.0, 4.0, 0.25


def slab(name, centre, size, material):
    mesh = Mesh()
    mesh.box((0.0, 0.0, 0.0), size)
    return Node(name, [(material, mesh)], position=centre)


def walls(length=LENGTH, width=WIDTH, depth=DEPTH, material="concrete"):
    """Four walls and a floor about the origin whose inner faces enclose length x width x depth, open at z = 0."""
    x, y, z = (length + THICKNESS) / 2, (width + THICKNESS) / 2, -depth / 2
    long_side = length + 2 * THICKNESS
    return [slab("wall_east", (x, 0, z), (THICKNESS, width, depth), material),
            slab("wall_west", (-x, 0, z), (THICKNESS, width, depth), material),
            slab("wall_north", (0, y, z), (long_side, THICKNESS, depth), material),
            slab("wall_south", (0, -y, z), (long_side, THICKNESS, depth), material),
            slab("floor", (0, 0, -depth - THICKNESS / 2), (long_side, width + 2 * THICKNESS, THICKNESS), material)]


def lattice(columns=6, rows=4, across=0.6, up=0.8, radius=0.04):
    """Bars in the plane x = 0 that make columns x rows openings of `across` x `up`, the lower edge at z = 0."""
    mesh = Mesh()
    width, height = columns * across, rows * up
    for c in range(columns + 1):
        y = c * across - width / 2
        mesh.tube([(0, y, 0), (0, y, height)], radius, sides=8)
    for r in range(rows + 1):
        mesh.tube([(0, -width / 2, r * up), (0, width / 2, r * up)], radius, sides=8)
    return mesh


def nodes():
    ball, post = Mesh(), Mesh()
    ball.sphere((0, 0, 0), 0.4)
    ball.prune()
    post.tube([(0, 0, 0), (0, 0, DEPTH)], 0.15, sides=24)
    return walls() + [
        Node("grid", [("steel", lattice())], position=(3.6, 0.9, -DEPTH), yaw=0.35),
        Node("ball", [("steel", ball)], position=(-3.0, 1.8, -2.0)),
        Node("post", [("steel", post)], position=(1.2, -2.6, -DEPTH))]
