"""What the canvas must draw, from its rules alone, in exact integers and plain Python or NumPy.

In:  positions as the caller gives them, the size of a canvas.
Out: masks (H, W) of bool, or values of pixels. Nothing here knows how the core does it: lines
     are evaluated column by column, and the top-left rule is a sample moved by an infinitesimal.
"""

import math
from fractions import Fraction

import numpy as np


def line_mask(x0, y0, x1, y1, width, height):
    """The one pixel wide line between two pixels: nearest to it at each major step, ties down."""
    mask = np.zeros((height, width), bool)
    if abs(y1 - y0) > abs(x1 - x0):
        return line_mask(y0, x0, y1, x1, height, width).T
    first, last = sorted((x0, x1))
    for x in range(max(first, 0), min(last, width - 1) + 1):
        exact = Fraction((x - x0) * (y1 - y0), (x1 - x0) or 1) + y0
        y = math.ceil(exact - Fraction(1, 2))
        if 0 <= y < height:
            mask[y, x] = True
    return mask


def thick_line_corners(x0, y0, x1, y1, line_width):
    """The corners, in 1/256 pixel, in order around the parallelogram of a thick line."""
    if abs(y1 - y0) > abs(x1 - x0):
        return [(x, y) for y, x in thick_line_corners(y0, x0, y1, x1, line_width)]
    if x1 < x0:
        x0, y0, x1, y1 = x1, y1, x0, y0
    slope = Fraction(y1 - y0, (x1 - x0) or 1)
    lead = math.floor(slope * 128 + Fraction(1, 2))
    run, rise = float(x1 - x0), float(y1 - y0)
    longer = 128.0 * line_width
    if run:
        longer = longer * math.sqrt(run * run + rise * rise) / run
    half = math.floor(longer + 0.5)
    start, end = 256 * y0 + 128 - lead, 256 * y1 + 128 + lead
    left, right = 256 * x0, 256 * (x1 + 1)
    return [
        (left, start - half),
        (right, end - half),
        (right, end + half),
        (left, start + half),
    ]


def snapped(positions):
    """Positions in 1/256 pixel, to the nearest, ties to even."""
    return np.rint(np.asarray(positions, np.float64) * 256).astype(np.int64)


def convex_masks(corners, width, height):
    """Which pixels each convex polygon covers.

    A pixel's sample is its centre, moved right by an infinitesimal and down by an infinitesimal of
    that: then none lies on an edge, and which are inside is what the top-left rule says.

    Parameters
    ----------
    corners : array of int64, or of object (Python integers), shape (N, K, 2)
        In 1/256 pixel; small enough for their products in the former case.

    Returns
    -------
    masks : ndarray of bool, shape (N, height, width)
    """
    corners = np.asarray(corners)
    x = (256 * np.arange(width) + 128).astype(corners.dtype)
    y = (256 * np.arange(height) + 128).astype(corners.dtype)[:, None]
    sides = []
    for k in range(corners.shape[1]):
        ax, ay = corners[:, k, 0, None, None], corners[:, k, 1, None, None]
        following = (k + 1) % corners.shape[1]
        bx, by = corners[:, following, 0, None, None], corners[:, following, 1, None, None]
        value = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        # Of the moved sample the sign is that of the value; if 0, of its change in x; then in y.
        side = np.where(value != 0, value, np.where(by != ay, ay - by, bx - ax))
        sides.append((side > 0).astype(np.int8) - (side < 0))
    total = np.sum(sides, axis=0)
    return np.abs(total) == corners.shape[1]


def blended(source, destination):
    """Source over destination, both (r, g, b, a) with straight alpha, rounded to nearest."""
    alpha, below = Fraction(source[3], 255), Fraction(destination[3], 255)
    out = alpha + below * (1 - alpha)
    if out == 0:
        return tuple(destination)
    channels = [
        (s * alpha + d * below * (1 - alpha)) / out
        for s, d in zip(source[:3], destination[:3], strict=True)
    ]
    return tuple(math.floor(value + Fraction(1, 2)) for value in [*channels, out * 255])
