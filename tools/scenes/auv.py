"""A torpedo-shaped AUV, 4 m long, its middle at the origin and its nose along x."""
import math

from .mesh import Mesh

LENGTH, RADIUS = 4.0, 0.27


def hull_profile():
    """(x, radius) pairs from the tail cone over the cylinder to the round nose."""
    tail, nose, steps = 1.1, 0.7, 8
    quarter = [math.pi / 2 * k / steps for k in range(steps + 1)]
    cone = [(-LENGTH / 2 + tail * k / steps, RADIUS * (0.25 + 0.75 * math.sin(a))) for k, a in enumerate(quarter)]
    dome = [(LENGTH / 2 - nose + nose * math.sin(a), RADIUS * math.cos(a)) for a in quarter]
    return [(-LENGTH / 2, 0.0)] + cone + dome


def fin(mesh, angle):
    """A flat plate 0.4 m along the hull that stands 0.35 m out, turned by `angle` about x."""
    c, s = math.cos(angle), math.sin(angle)

    def turned(x, out, side):
        return (x, c * out - s * side, s * out + c * side)

    t, inner, outer, back, front = 0.015, 0.1, 0.55, -1.75, -1.35
    a, b = ([turned(x, out, side) for x, out in ((back, inner), (front, inner), (front - 0.12, outer), (back, outer))]
            for side in (t, -t))
    mesh.quad(*a)
    mesh.quad(*b[::-1])
    for k in range(4):
        n = (k + 1) % 4
        mesh.quad(a[n], a[k], b[k], b[n])


def duct(mesh):
    """The ring around the propeller: an open tube with a wall of 2 cm."""
    profile = [(-1.98, 0.2), (-1.78, 0.2), (-1.78, 0.22), (-1.98, 0.22)]
    for (x0, r0), (x1, r1) in zip(profile, profile[1:] + profile[:1]):
        ring(mesh, x0, r0, x1, r1)


def ring(mesh, x0, r0, x1, r1, sides=16):
    """One band of flat faces about x; walking the profile clockwise keeps the outside outside."""
    for k in range(sides):
        p, q = 2 * math.pi * k / sides, 2 * math.pi * (k + 1) / sides
        mesh.quad((x0, r0 * math.cos(p), r0 * math.sin(p)), (x1, r1 * math.cos(p), r1 * math.sin(p)),
                  (x1, r1 * math.cos(q), r1 * math.sin(q)), (x0, r0 * math.cos(q), r0 * math.sin(q)))


def auv():
    mesh = Mesh()
    mesh.revolve(hull_profile(), columns=20)
    mesh.prune()
    for k in range(4):
        fin(mesh, math.pi / 4 + k * math.pi / 2)
    duct(mesh)
    mesh.box((0.5, 0, RADIUS + 0.08), (0.35, 0.05, 0.25))
    return mesh
