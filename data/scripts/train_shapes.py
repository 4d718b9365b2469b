"""Shapes and colours of which the train is made.

In: profiles, corners, outlines, z up. Out: surfaces with a material. Materials are named by their
colours, the only properties that names in a 3D Studio ASCII file can tell.
"""

import numpy as np
from surfaces import Surface, box, lathe

from engine3d import linalg

GREEN, DARK_GREEN, RED = "r34g98b58a0", "r22g66b40a0", "r178g42b34a0"
BLACK, STEEL, BRASS = "r44g44b48a0", "r168g172b178a0", "r214g168b72a0"
COPPER, GLASS, WOOD = "r190g112b64a0", "r150g196b214a0", "r122g84b52a0"
GRAVEL, COAL, CREAM, GRASS = "r150g142b130a0", "r30g30b33a0", "r240g230b205a0", "r96g142b66a0"

UPRIGHT = linalg.rotation_x(np.pi / 2.0)  # the axis of turned shapes: y to z
LENGTHWISE = linalg.rotation_z(-np.pi / 2.0)  # y to x
CROSSWISE = np.eye(4)
BACKWARD = linalg.rotation_z(np.pi / 2.0)  # y to -x
# Turns a prism's outline from (x, z) to (y, z), its length to -x.
ACROSS = np.array([(0, -1, 0, 0), (1, 0, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)], np.float64)


def turned(profile, columns, place, axis, material):
    """A turned profile, points (radius, distance along the axis), at a place."""
    return (
        lathe(profile, columns)
        .moved(linalg.multiply(linalg.translation(place), axis))
        .labelled(material)
    )


def block(low, high, material):
    """An upright box between two corners."""
    low, high = np.array(low, np.float64), np.array(high, np.float64)
    return box(high - low, 0.5 * (low + high)).labelled(material)


def both_sides(part):
    """A part and its mirror image on the other side of the engine."""
    return [part, part.moved(linalg.scaling((1.0, -1.0, 1.0)))]


def prism(outline, low, high, material):
    """A solid with an outline in (x, z), counter-clockwise seen from -Y, from y = low to high."""
    count = len(outline)
    points = [(x, y, z) for y in (low, high) for x, z in outline]
    sides = [(k, k + count, (k + 1) % count + count, (k + 1) % count) for k in range(count)]
    ends = [tuple(range(count)), tuple(range(2 * count - 1, count - 1, -1))]
    uvs = [(0.5 + 0.01 * x, 0.01 * z) for _ in (low, high) for x, z in outline]
    return Surface(points, uvs, sides + ends, material=material)


def bar(start, end, half_height, y, material):
    """A flat rod between two points (x, z), `y` its outer face."""
    (ax, az), (bx, bz) = start, end
    dx, dz = bx - ax, bz - az
    long = np.sqrt(dx * dx + dz * dz)
    nx, nz = -dz / long * half_height, dx / long * half_height
    outline = [(ax - nx, az - nz), (bx - nx, bz - nz), (bx + nx, bz + nz), (ax + nx, az + nz)]
    return prism(outline, y, y + 0.6, material)
