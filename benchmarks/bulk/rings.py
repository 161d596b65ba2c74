"""Meshes of revolution about z, as OBJ files."""

from math import cos, pi, sin

SIDES = 72


def widened(radius):
    """Of the polygon whose mean radius is `radius`: the radius of its corners."""
    return radius / (1 - (pi / SIDES) ** 2 / 3)


def write_rings(path, rings):
    """Sheets between rings (radius, height), one after the other; a radius of 0 is a point."""
    vertices = [(radius * cos(2 * pi * k / SIDES), radius * sin(2 * pi * k / SIDES), height) for radius, height in rings for k in range(SIDES)]
    facets = []
    for ring in range(len(rings) - 1):
        for k in range(SIDES):
            a, b = ring * SIDES + k + 1, ring * SIDES + (k + 1) % SIDES + 1
            if rings[ring][0] > 0:
                facets.append((a, b, b + SIDES))
            if rings[ring + 1][0] > 0:
                facets.append((a, b + SIDES, a + SIDES))
    path.write_text("".join(f"v {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in vertices) + "".join(f"f {a} {b} {c}\n" for a, b, c in facets))
