"""What the core's environments must agree with: look-ups and integrals in float64."""

import functools

import numpy as np

from engine3d._native.rasterizer import NativeEnvironment


@functools.cache
def directions(width, height):
    """The directions of an equirectangular picture's pixels, (H, W, 3), and their solid angles."""
    azimuth = ((np.arange(width) + 0.5) / width - 0.5) * 2 * np.pi
    edges = (0.5 - np.arange(height + 1) / height) * np.pi
    elevation = (edges[:-1] + edges[1:]) / 2
    level = np.cos(elevation)[:, None]
    d = np.stack(
        [
            level * np.cos(azimuth),
            np.broadcast_to(np.sin(elevation)[:, None], (height, width)),
            level * np.sin(azimuth),
        ],
        axis=-1,
    )
    bands = (np.sin(edges[:-1]) - np.sin(edges[1:])) * 2 * np.pi / width
    return d, np.broadcast_to(bands[:, None], (height, width))


def levels_of(pixels, threads=1):
    """The levels of an environment, (6, size + 2, size + 2, 4) each."""
    native = NativeEnvironment(np.ascontiguousarray(pixels, np.float32), threads)
    return [np.array(native.level(number)) for number in range(9)]


def looked_up(level, d):
    """What a level shows in directions, (N, 3)."""
    x, y, z = np.asarray(d, float).T
    axis = np.argmax(np.abs([x, y, z]), axis=0)
    longest = np.choose(axis, [x, y, z])
    negative = longest < 0
    p = np.choose(axis, [np.where(negative, z, -z), x, np.where(negative, -x, x)])
    q = np.choose(axis, [-y, np.where(negative, -z, z), -y])
    half = (level.shape[1] - 2) / 2
    u, v = (k / np.abs(longest) * half + half + 0.5 for k in (p, q))
    j, i = u.astype(int), v.astype(int)
    f, g = (u - j)[:, None], (v - i)[:, None]
    t = level[:, :, :, :3].astype(float)
    face = 2 * axis + negative
    upper = t[face, i, j] * (1 - f) + t[face, i, j + 1] * f
    lower = t[face, i + 1, j] * (1 - f) + t[face, i + 1, j + 1] * f
    return upper * (1 - g) + lower * g


def prefiltered(pixels, roughness, normals):
    """The integral of D(h) (n.l) times the light over all pixels, over that without the light."""
    height, width, _ = pixels.shape
    d, area = directions(width, height)
    square = roughness**4
    found = []
    for n in normals:
        cosine = d @ n
        t = (1 + cosine) / 2 * (square - 1) + 1
        weight = np.where(cosine > 0, area * cosine / t**2, 0)
        found.append((weight[:, :, None] * pixels).sum((0, 1)) / weight.sum())
    return np.array(found)
