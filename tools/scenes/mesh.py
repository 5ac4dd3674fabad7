"""A triangle mesh that grows by simple solids; knows nothing of files, materials or scenes.

Coordinates are ENU metres (z up). Triangles are counter-clockwise seen from outside, one normal per vertex.
"""
import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(s, a):
    return (s * a[0], s * a[1], s * a[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return scale(1 / length, a) if length else a


class Mesh:
    def __init__(self):
        self.positions = []
        self.normals = []
        self.triangles = []

    def vertex(self, position, normal):
        self.positions.append(position)
        self.normals.append(normal)
        return len(self.positions) - 1

    def quad(self, a, b, c, d):
        """A flat face, corners counter-clockwise seen from outside."""
        normal = unit(cross(sub(b, a), sub(d, a)))
        i = len(self.positions)
        for corner in (a, b, c, d):
            self.vertex(corner, normal)
        self.triangles += [(i, i + 1, i + 2), (i, i + 2, i + 3)]

    def box(self, centre, size, yaw=0.0):
        """Six faces; `yaw` (rad) turns the box about the vertical through its centre."""
        c, s = math.cos(yaw), math.sin(yaw)

        def corner(i, j, k):
            x, y, z = i * size[0] / 2, j * size[1] / 2, k * size[2] / 2
            return (centre[0] + c * x - s * y, centre[1] + s * x + c * y, centre[2] + z)

        self.quad(corner(-1, -1, -1), corner(-1, -1, 1), corner(-1, 1, 1), corner(-1, 1, -1))
        self.quad(corner(1, -1, -1), corner(1, 1, -1), corner(1, 1, 1), corner(1, -1, 1))
        self.quad(corner(-1, -1, -1), corner(1, -1, -1), corner(1, -1, 1), corner(-1, -1, 1))
        self.quad(corner(-1, 1, -1), corner(-1, 1, 1), corner(1, 1, 1), corner(1, 1, -1))
        self.quad(corner(-1, -1, 1), corner(1, -1, 1), corner(1, 1, 1), corner(-1, 1, 1))
        self.quad(corner(-1, -1, -1), corner(-1, 1, -1), corner(1, 1, -1), corner(1, -1, -1))

    def surface(self, rows, columns, point, normal):
        """A lattice of rows x columns cells: point(r, c) and normal(r, c) for r <= rows, c <= columns.

        The outside is where (columns direction) x (rows direction) points.
        """
        base = len(self.positions)
        for r in range(rows + 1):
            for c in range(columns + 1):
                self.vertex(point(r, c), normal(r, c))
        for r in range(rows):
            for c in range(columns):
                i = base + r * (columns + 1) + c
                j = i + columns + 1
                self.triangles += [(i, i + 1, j + 1), (i, j + 1, j)]

    def disc(self, centre, normal, ring):
        """A fan from `centre` to the closed `ring` of points, counter-clockwise about `normal`."""
        i = self.vertex(centre, normal)
        for point in ring:
            self.vertex(point, normal)
        count = len(ring)
        for k in range(count):
            self.triangles.append((i, i + 1 + k, i + 1 + (k + 1) % count))

    def tube(self, path, radius, sides=16):
        """A round bar with closed ends along a polyline of at least two points."""
        frames = tube_frames(path)
        angles = [2 * math.pi * k / sides for k in range(sides)] + [0.0]

        def outward(k, c):
            u, v = frames[k]
            return add(scale(math.cos(angles[c]), u), scale(math.sin(angles[c]), v))

        def point(k, c):
            return add(path[k], scale(radius, outward(k, c)))

        last = len(path) - 1
        self.surface(last, sides, point, outward)
        first_ring = [point(0, c) for c in range(sides)]
        last_ring = [point(last, c) for c in range(sides)]
        self.disc(path[0], unit(sub(path[0], path[1])), first_ring[::-1])
        self.disc(path[last], unit(sub(path[last], path[last - 1])), last_ring)

    def smooth(self):
        """Normals anew from the faces around each place, after vertices were moved."""
        places = [tuple(round(v, 6) for v in p) for p in self.positions]
        sums = dict.fromkeys(places, (0.0, 0.0, 0.0))
        for triangle in self.triangles:
            a, b, c = (self.positions[i] for i in triangle)
            face = cross(sub(b, a), sub(c, a))
            for i in triangle:
                sums[places[i]] = add(sums[places[i]], face)
        self.normals = [unit(sums[place]) for place in places]

    def prune(self):
        """Drops the triangles without area, two corners of which are one place: those at the poles of a ball."""
        places = [tuple(round(v, 6) for v in p) for p in self.positions]
        self.triangles = [t for t in self.triangles if len({places[i] for i in t}) == 3]

    def sphere(self, centre, radius, columns=32, rows=16):
        """Keeps the flat triangles at its poles; see prune()."""
        def normal(c, r):
            theta, phi = math.pi * r / rows, 2 * math.pi * c / columns
            return (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))

        self.surface(columns, rows, lambda c, r: add(centre, scale(radius, normal(c, r))), normal)

    def revolve(self, profile, columns=24):
        """A solid about the x axis from (x, radius) pairs with x ascending; normals follow the profile."""
        def around(c, x, radius):
            phi = 2 * math.pi * c / columns
            return (x, radius * math.cos(phi), radius * math.sin(phi))

        def normal(r, c):
            before, after = profile[max(r - 1, 0)], profile[min(r + 1, len(profile) - 1)]
            return unit(around(c, before[1] - after[1], after[0] - before[0]))

        self.surface(len(profile) - 1, columns, lambda r, c: around(c, *profile[r]), normal)


def tube_frames(path):
    """Two unit vectors across the path at each point, with u x v along it, carried along without twist."""
    frames, u = [], (0.0, 0.0, 1.0)
    for k in range(len(path)):
        along = unit(sub(path[min(k + 1, len(path) - 1)], path[max(k - 1, 0)]))
        if k == 0 and abs(along[2]) > 0.9:
            u = (1.0, 0.0, 0.0)
        u = unit(sub(u, scale(dot(u, along), along)))
        frames.append((u, cross(along, u)))
    return frames
