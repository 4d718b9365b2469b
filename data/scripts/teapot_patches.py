"""The Utah teapot of Martin Newell (1975): its 32 bicubic Bezier patches.

Out: control points, shape (strips, patches around, 4, 4, 3), of each part, y up, in Newell's unit.
His 306 control points repeat much. The body, lid and bottom are profiles turned about the axis
with the same four control points each quarter; handle and spout are symmetric sections. So the
figures are kept as those profiles and sections; the axis of his data (z up) is turned upright.
"""

import numpy as np

# Of a quarter turn, the control points beside its ends are this far along, in radii.
QUARTER = 0.56
# Newell's knob, and it alone, is a little rounder.
KNOB_QUARTER = 0.5625

# Points (radius, height) of strips that share their end points, from the bottom upwards.
BODY = (
    ((0.0, 0.0), (1.425, 0.0), (1.5, 0.075), (1.5, 0.15)),  # bottom (added after Newell)
    ((1.5, 0.15), (1.5, 0.225), (2.0, 0.45), (2.0, 0.9)),
    ((2.0, 0.9), (2.0, 1.35), (1.75, 1.875), (1.5, 2.4)),
    ((1.5, 2.4), (1.4375, 2.53125), (1.3375, 2.53125), (1.4, 2.4)),  # rim
)
LID = (
    ((1.3, 2.4), (1.3, 2.55), (0.4, 2.55), (0.2, 2.7)),
    ((0.2, 2.7), (0.0, 2.85), (0.8, 3.15), (0.0, 3.15)),  # knob
)

# Sections: (x, height) of the point on the inner side, the same on the outer side, half the width.
HANDLE = (
    (
        ((-1.6, 2.025), (-1.5, 2.25), 0.3),
        ((-2.3, 2.025), (-2.5, 2.25), 0.3),
        ((-2.7, 2.025), (-3.0, 2.25), 0.3),
        ((-2.7, 1.8), (-3.0, 1.8), 0.3),
    ),
    (
        ((-2.7, 1.8), (-3.0, 1.8), 0.3),
        ((-2.7, 1.575), (-3.0, 1.35), 0.3),
        ((-2.5, 1.125), (-2.65, 0.9375), 0.3),
        ((-2.0, 0.9), (-1.9, 0.6), 0.3),
    ),
)
SPOUT = (
    (
        ((1.7, 1.425), (1.7, 0.6), 0.66),
        ((2.6, 1.425), (3.1, 0.825), 0.66),
        ((2.3, 2.1), (2.4, 2.025), 0.25),
        ((2.7, 2.4), (3.3, 2.4), 0.25),
    ),
    (
        ((2.7, 2.4), (3.3, 2.4), 0.25),
        ((2.8, 2.475), (3.525, 2.49375), 0.25),
        ((2.9, 2.475), (3.45, 2.5125), 0.15),
        ((2.8, 2.4), (3.2, 2.4), 0.15),
    ),
)


def revolved(strips):
    """Return the patches of profiles turned about the Y axis, eastward from -X by +Z."""
    directions = np.array([(-1, 0, 0), (0, 0, 1), (1, 0, 0), (0, 0, -1), (-1, 0, 0)], np.float64)
    patches = np.empty((len(strips), 4, 4, 4, 3))
    for strip, profile in enumerate(strips):
        for row, (radius, height) in enumerate(profile):
            inset = KNOB_QUARTER if (radius, height) == (0.8, 3.15) else QUARTER
            for quarter in range(4):
                a, b = directions[quarter], directions[quarter + 1]
                ring = np.array((a, a + inset * b, inset * a + b, b)) * radius
                patches[strip, quarter, row] = ring + (0.0, height, 0.0)
    return patches


def swept(strips):
    """Return the two patches around of a tube of symmetric sections."""
    patches = np.empty((len(strips), 2, 4, 4, 3))
    for strip, sections in enumerate(strips):
        for row, (inner, outer, width) in enumerate(sections):
            near = [(*inner, 0.0), (*inner, width), (*outer, width), (*outer, 0.0)]
            patches[strip, 0, row] = near
            patches[strip, 1, row] = [(x, y, -z) for x, y, z in near[::-1]]
    return patches


def _bernstein(t):
    s = 1.0 - t
    values = np.stack((s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t))
    slopes = np.stack(
        (-3.0 * s * s, 3.0 * s * s - 6.0 * s * t, 6.0 * s * t - 3.0 * t * t, 3.0 * t * t)
    )
    return values, slopes


def evaluate(patches, rows, columns):
    """Sample a part as one grid of points.

    Parameters
    ----------
    patches : ndarray, shape (strips, around, 4, 4, 3)
    rows, columns : int
        Quads a patch.

    Returns
    -------
    points, along, across : ndarray, shape (strips * rows + 1, around * columns + 1, 3)
        Positions, and their derivatives from row to row and from column to column.
    """
    strips, around = patches.shape[:2]
    shape = (strips * rows + 1, around * columns + 1, 3)
    points, along, across = np.zeros(shape), np.zeros(shape), np.zeros(shape)
    (row, row_slope), (column, column_slope) = (
        _bernstein(np.arange(count + 1) / count) for count in (rows, columns)
    )
    for i in range(strips):
        for j in range(around):
            block = np.s_[i * rows : (i + 1) * rows + 1, j * columns : (j + 1) * columns + 1]
            for target, a, b in (
                (points, row, column),
                (along, row_slope, column),
                (across, row, column_slope),
            ):
                target[block] = 0.0
                for k in range(16):
                    weight = a[k // 4][:, np.newaxis] * b[k % 4]
                    target[block] += weight[..., np.newaxis] * patches[i, j, k // 4, k % 4]
    return points, along, across
