"""Writes dfg_table.inc: what rough surfaces reflect of light that is 1 all around.

In: nothing. Out: tables of nodes (i, j) for roughness i/63 and a cosine v between normal and viewer
of (j/63)**2, in which the albedo near grazing angles is smooth (64 x 64 nodes lie within 0.0005 of
the integrals for roughness above 0.1, with v itself as coordinate within 0.02).

GGX: A and B of the albedo F0*A + B, with Smith's height-correlated visibility and Schlick's Fresnel
term, of glTF's Appendix B (alpha = roughness**2); the split sum of Karis, Real Shading in Unreal
Engine 4, 2013. Half vectors are taken over the distribution's own probability, and only where they
mirror the viewer above the surface: what is left to integrate is smooth.
SHEEN: the albedo of Charlie's distribution (Estevez and Kulla 2017) with the visibility of Neubelt
and Pettineo 2013, 1/(4*(l + v - l*v)), but no more than 1, which that visibility passes at grazing
angles; roughness below 0.07 counts as that.
"""

from pathlib import Path

import numpy as np

SIZE = 64
LEAST_SHEEN_ROUGHNESS = 0.07
LEAST_COSINE = 1e-9


def crowded(count):
    """Nodes and weights over [0, 1] for what has roots at the ends: Gauss's, by a quintic step."""
    x, w = np.polynomial.legendre.leggauss(count)
    x, w = (x + 1) / 2, w / 2
    return x**3 * (10 - 15 * x + 6 * x * x), w * 30 * (x * (1 - x)) ** 2


POLAR, AROUND = crowded(200), crowded(120)


def ggx(roughness, v):
    """Return A and B."""
    if roughness == 0:  # a mirror
        return 1 - (1 - v) ** 5, (1 - v) ** 5
    square = roughness**4
    angle, sine = np.arccos(v), np.sqrt(1 - v * v)

    def probability(theta):
        """Of a half vector within an angle of the normal."""
        return np.sin(theta) ** 2 / (square * np.cos(theta) ** 2 + np.sin(theta) ** 2)

    # All around a half vector is mirrored above the surface up to the first angle, none from the
    # second on.
    ends = [0, probability((np.pi / 2 - angle) / 2), probability((np.pi / 2 + angle) / 2)]
    total = np.zeros(2)
    for low, high in zip(ends[:-1], ends[1:], strict=True):
        p = low + (high - low) * POLAR[0]
        h = np.sqrt((1 - p) / (1 - p + square * p))
        sine_h = np.sqrt(np.maximum(1 - h * h, 0))
        with np.errstate(divide="ignore", invalid="ignore"):
            edge = (v / (2 * h) - v * h) / (sine * sine_h)
        reach = np.arccos(np.clip(np.where(np.isfinite(edge), edge, -1), -1, 1))
        h = h[:, None]
        toward = sine * sine_h[:, None] * np.cos(reach[:, None] * AROUND[0]) + v * h
        light = np.maximum(2 * toward * h - v, 1e-300)
        smith = light * np.sqrt(square + v * v * (1 - square))
        smith += v * np.sqrt(square + light * light * (1 - square))
        weight = (high - low) * np.outer(POLAR[1], AROUND[1]) * reach[:, None] / np.pi
        weight *= 2 * light * toward / (h * smith)
        fresnel = (1 - toward) ** 5
        total += (weight * (1 - fresnel)).sum(), (weight * fresnel).sum()
    return total


def sheen(roughness, v):
    alpha = max(roughness, LEAST_SHEEN_ROUGHNESS) ** 2
    light, around = POLAR[0][:, None], np.pi * POLAR[0]
    along = np.sqrt(1 - v * v) * np.sqrt(1 - light * light) * np.cos(around) + v * light
    h2 = (v + light) ** 2 / np.maximum(2 + 2 * along, 1e-300)
    sine = np.sqrt(np.maximum(1 - h2, 0))
    distribution = (2 + 1 / alpha) * sine ** (1 / alpha) / (2 * np.pi)
    visibility = 1 / (4 * (light + v - light * v))
    weight = np.outer(POLAR[1], POLAR[1]) * 2 * np.pi
    return min((weight * distribution * visibility * light).sum(), 1.0)


def tables():
    """Return A, B and the sheen's albedo, shape (3, SIZE, SIZE)."""
    nodes = np.arange(SIZE) / (SIZE - 1)
    cosines = np.maximum(nodes**2, LEAST_COSINE)
    rows = [[(*ggx(r, v), sheen(r, v)) for v in cosines] for r in nodes]
    return np.moveaxis(np.array(rows), -1, 0)


def constant(value):
    """Return a number as C writes it."""
    text = f"{value:.9g}"
    return f"{text}f" if "." in text or "e" in text else f"{text}.0f"


def written(values):
    """Return the text of dfg_table.inc, which dfg_table.c includes."""
    lines = ["/* Written by make_dfg_table.py, which says what is in it. */"]
    for table in values.astype(np.float32):
        rows = [" ".join(f"{constant(value)}," for value in row) for row in table.reshape(-1, 8)]
        lines += ["{", *(f"    {row}" for row in rows), "},"]
    return "\n".join([*lines, ""])


if __name__ == "__main__":
    Path(__file__).with_name("dfg_table.inc").write_text(written(tables()), "utf-8")
