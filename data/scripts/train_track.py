"""What the train stands on, and the smoke above it.

Out: surfaces, z up: rails along x, sleepers, a bed of gravel, a base; puffs of smoke.
"""

import numpy as np
from noise import value_noise
from surfaces import Surface, grid
from train_shapes import (
    ACROSS,
    CREAM,
    GRASS,
    GRAVEL,
    STEEL,
    UPRIGHT,
    WOOD,
    block,
    prism,
    turned,
)

RAIL_TOP, GAUGE = 4.2, 8.0  # height of the rails' upper face; their distance from the middle


def rails():
    profile = [
        (-1.3, 1.9),
        (1.3, 1.9),
        (1.3, 2.3),
        (0.35, 2.6),
        (0.35, 3.5),
        (0.8, 3.7),
        (0.8, RAIL_TOP),
    ]
    profile += [(-x, z) for x, z in profile[:0:-1]]
    parts = []
    for side in (-GAUGE, GAUGE):
        rail = prism([(x + side, z) for x, z in profile], -42.0, 66.0, STEEL)
        parts.append(rail.moved(ACROSS))
    return parts


def sleepers():
    return [
        block((x - 1.6, -13.0, 0.6), (x + 1.6, 13.0, 1.95), WOOD)
        for x in np.arange(-62.0, 41.0, 7.2)
    ]


def ballast():
    """A bed of gravel, its top uneven between the sleepers."""
    t, s = np.arange(53) / 52.0, np.arange(13) / 12.0
    u, v = np.meshgrid(t, s)
    across = np.abs(2.0 * v - 1.0)
    slope = np.minimum(1.0, 4.0 * (1.0 - across))
    x, y = -68.0 + 112.0 * u, -18.0 + 36.0 * v
    z = -1.4 + 2.3 * slope + 0.55 * value_noise(0.9 * x, 0.9 * y, 0.0, seed=8) * slope
    return grid(np.stack((x, y, z), axis=-1), np.stack((8.0 * u, 2.0 * v), axis=-1)).labelled(
        GRAVEL
    )


def base():
    return [
        block((-70.0, -26.0, -3.6), (46.0, 26.0, -1.2), GRASS),
        block((-71.5, -27.5, -7.0), (47.5, 27.5, -3.6), WOOD),
    ]


def smoke():
    """Puffs that grow as they drift back."""
    parts = []
    puffs = (
        (28.4, 45.0, 3.0),
        (24.8, 49.4, 4.0),
        (19.2, 53.6, 5.0),
        (11.6, 57.2, 6.2),
        (1.5, 60.0, 7.4),
    )
    ball = [
        (0.0, -1.0),
        (0.5, -0.866),
        (0.866, -0.5),
        (1.0, 0.0),
        (0.866, 0.5),
        (0.5, 0.866),
        (0.0, 1.0),
    ]
    for k, (x, z, radius) in enumerate(puffs):
        puff = turned(ball, 12, (0.0, 0.0, 0.0), UPRIGHT, CREAM)
        p = puff.positions
        push = 1.0 + 0.25 * value_noise(*(1.6 * p.T + 5.3 * k), seed=k)
        centre = (x, 0.8 * (k % 2) - 0.4, z)
        cloud = Surface(p * push[:, np.newaxis] * radius + centre, puff.uvs, puff.polygons)
        parts.append(cloud.labelled(CREAM))
    return parts
