"""Writes area_table.inc: the linearly transformed cosines that stand for GGX under area lights.

In: nothing. Out: four tables of nodes (i, j) for roughness i/31 and a cosine c between normal and
viewer of (j/31)**2: along, across, skew and rise of R234, docs/exactness. They are smooth, since
alpha, the angle and the mirrored direction are taken out of them.

Source of the method: Heitz, Dupuy, Hill and Neubelt, Real-Time Polygonal-Light Shading with
Linearly Transformed Cosines, 2016. The numbers are fitted here: at each node, rise turns the cosine
to the mean direction of GGX with Smith's height-correlated visibility (alpha = roughness**2); the
other three minimise, by Levenberg's and Marquardt's method, the integral of (p - q)**2/(p + q),
p and q scaled to integrals of 1. Sums run over half vectors, by the distribution's probability.
"""

from pathlib import Path

import numpy as np

SIZE = 32
LEAST_ROUGHNESS = 0.045  # the least that materials have (R49)
LEAST_COSINE = 2e-4
MOST_COSINE = 0.9995  # at 1 itself, skew and rise have no effect
STEPS = 60


def _points(alpha, c, count=64):
    """Return directions to the light in the frame of R233, GGX there, and the weights of a sum.

    ``alpha`` is a column; there is a row for each.
    """
    nodes, weights = np.polynomial.legendre.leggauss(count)
    p, w = (nodes + 1) / 2, weights / 2
    p, w = p**2 * (3 - 2 * p), w * 6 * p * (1 - p)
    p = (p[:, None] * np.ones(count)).ravel()
    turn = (np.pi * (nodes + 1) / 2 * np.ones((count, 1))).ravel()
    weight = np.outer(w, weights / 2).ravel()  # half of the circle stands for all of it
    square, s = alpha * alpha, np.sqrt(1 - c * c)
    h = np.sqrt((1 - p) / (1 - p + square * p))
    sine = np.sqrt(np.maximum(1 - h * h, 0))
    half = np.stack([sine * np.cos(turn), sine * np.sin(turn), h])
    toward = c * h - s * half[0]
    light = 2 * toward * half - np.array([-s, 0, c])[:, None, None]
    lit = (toward > 0) & (light[2] > 0)
    up = np.where(lit, light[2], 1.0)
    smith = up * np.sqrt(square + c * c * (1 - square)) + c * np.sqrt(square + up**2 * (1 - square))
    distribution = square / (np.pi * (h * h * (square - 1) + 1) ** 2)
    value = np.where(lit, distribution * up / (2 * smith), 0.0)
    weight = np.where(lit, weight * 4 * toward / (distribution * h), 0.0)
    return light, value / (value * weight).sum(1, keepdims=True), weight


def _rises(c, light, value, weight):
    """Return the normal's share of the mean direction, beside that of the mirrored one."""
    mean = (light * (value * weight)).sum(2)
    s = np.sqrt(1 - c * c)
    rise = np.maximum(mean[2] * s / np.maximum(mean[0], 1e-3 * s) - c, 0.0)
    return rise / (1 + rise)


def _density(numbers, rise, alpha, c, light):
    """Return the transformed cosine's density along directions."""
    wide, high = alpha * numbers[:, :1], alpha * numbers[:, 1:2]
    skew = numbers[:, 2:3]
    s, rise = np.sqrt(1 - c * c), rise[:, None]
    zs, zc = s * (1 - rise), c * (1 - rise) + rise
    zs, zc = zs / np.hypot(zs, zc), zc / np.hypot(zs, zc)
    x, y, z = light
    lx, lz = zc * x - zs * z, zs * x + zc * z
    u, v = lx / wide - lz * (skew * s), y / high
    square = u * u + v * v + lz * lz
    return np.maximum(lz, 0) / (wide * high * np.pi * square**2)


def _fit(alpha, c, start, points):
    """Return along, across and skew for each alpha, and how far off they are."""
    light, value, weight = points
    rise = _rises(c, *points)

    def residual(numbers):
        found = _density(numbers, rise, alpha, c, light)
        return (found - value) * np.sqrt(weight / (found + value + 1e-12))

    numbers, damping = start.copy(), np.full(len(start), 1e-2)
    error = residual(numbers)
    total = (error**2).sum(1)
    for _ in range(STEPS):
        slopes = []
        for k in range(3):
            moved = numbers.copy()
            small = 1e-5 * (abs(moved[:, k]) + 1e-3)
            moved[:, k] += small
            slopes.append((residual(moved) - error) / small[:, None])
        jacobian = np.stack(slopes, 1)
        normal = np.einsum("nki,nli->nkl", jacobian, jacobian)
        diagonal = np.einsum("nkk->nk", normal)
        matrix = normal + np.eye(3) * (damping[:, None] * (diagonal + 1e-9))[:, None]
        step = np.linalg.solve(matrix, -np.einsum("nki,ni->nk", jacobian, error)[..., None])[..., 0]
        tried = numbers + np.clip(step, -0.5, 0.5)
        tried[:, :2] = np.maximum(tried[:, :2], numbers[:, :2] / 4)
        error_tried = residual(tried)
        total_tried = (error_tried**2).sum(1)
        better = total_tried < total
        numbers[better], error[better] = tried[better], error_tried[better]
        total = np.where(better, total_tried, total)
        damping = np.where(better, damping / 3, np.minimum(damping * 4, 1e8))
    return np.column_stack([numbers, rise]), total


def tables():
    """Return along, across, skew and rise, shape (4, SIZE, SIZE)."""
    nodes = np.arange(SIZE) / (SIZE - 1)
    alpha = np.maximum(nodes, LEAST_ROUGHNESS)[:, None] ** 2
    numbers = np.tile([2.0, 2.0, 0.0], (SIZE, 1))
    columns = []
    for c in np.maximum(nodes**2, LEAST_COSINE)[::-1]:
        c = min(c, MOST_COSINE)
        points = _points(alpha, c)
        wide = np.column_stack([numbers[:, 0], 2 * np.maximum(c, alpha[:, 0]), numbers[:, 2]])
        fits = [_fit(alpha, c, start, points) for start in (numbers, wide)]
        best = fits[0][1] <= fits[1][1]
        found = np.where(best[:, None], fits[0][0], fits[1][0])
        numbers = found[:, :3]
        columns.append(found)
    return np.moveaxis(np.array(columns[::-1]), (2, 1), (0, 1))


def constant(value):
    """Return a number as C writes it."""
    text = f"{value:.6g}"
    return f"{text}f" if "." in text or "e" in text else f"{text}.0f"


def written(values):
    """Return the text of area_table.inc, which area_table.c includes."""
    lines = ["/* Written by make_area_table.py, which says what is in it. */"]
    for table in values.astype(np.float32):
        rows = [" ".join(f"{constant(value)}," for value in row) for row in table.reshape(-1, 8)]
        lines += ["{", *(f"    {row}" for row in rows), "},"]
    return "\n".join([*lines, ""])


if __name__ == "__main__":
    Path(__file__).with_name("area_table.inc").write_text(written(tables()), "utf-8")
