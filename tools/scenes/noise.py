"""Smooth repeatable noise from an integer hash; the same on every machine and Python."""


def lattice(x, y, seed):
    """0..1 for each lattice point."""
    h = (x * 374761393 + y * 668265263 + seed * 2147483647) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 0xFFFF) / 65535


def smooth(t):
    return t * t * (3 - 2 * t)


def noise(x, y, seed):
    """0..1, smooth over the plane with features one unit wide."""
    i, j = int(x // 1), int(y // 1)
    u, v = smooth(x - i), smooth(y - j)
    low = lattice(i, j, seed) * (1 - u) + lattice(i + 1, j, seed) * u
    high = lattice(i, j + 1, seed) * (1 - u) + lattice(i + 1, j + 1, seed) * u
    return low * (1 - v) + high * v
