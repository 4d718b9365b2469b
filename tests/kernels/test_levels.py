"""surface and interpolate together: levels of detail against derivatives in float64 (R25, R26)."""

import numpy as np
from kernels.harness import all_backends
from kernels.layouts import (
    BATCH_RECORD,
    BATCH_SURFACES,
    SURFACES,
    TILE,
    WANT_LEVEL,
)
from kernels.surfaces import bytes_of

# log2(1 + m) - m at most: levels are straight between powers of two.
BELOW = 0.0861


def triangles(rng):
    """Corners in 1/256 sample, (3, n), that lie in the tile and turn the right way."""
    while True:
        x, y = rng.integers(0, 256 * TILE, (2, 3, 50 * BATCH_SURFACES))
        area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
        large = np.flatnonzero(area > 400 * 256 * 256)[:BATCH_SURFACES]
        if len(large) == BATCH_SURFACES:
            return x[:, large], y[:, large]


def perspective_surfaces(rng):
    """Triangles of some depth, with texture coordinates of a texture of 512 x 256 texels."""
    surfaces = np.zeros((), SURFACES)
    surfaces["count"] = BATCH_SURFACES
    surfaces["x"][:, :BATCH_SURFACES], surfaces["y"][:, :BATCH_SURFACES] = triangles(rng)
    for name in ("x", "y"):
        surfaces[name][:, BATCH_SURFACES:] = surfaces[name][:, :1]
    surfaces["iw"] = 2.0 ** rng.uniform(-3, 0, surfaces["iw"].shape)
    scale = 2.0 ** rng.uniform(-5, 2, surfaces["uv"].shape[-1])
    surfaces["uv"] = rng.uniform(-1, 1, surfaces["uv"].shape) * scale
    surfaces["texels"] = 512, 256
    return surfaces


def inner_samples(rng, surfaces):
    """A sample of each triangle, where its corners' mean lies."""
    x, y = (surfaces[name][:, :BATCH_SURFACES].mean(axis=0) // 256 for name in ("x", "y"))
    return x.astype(np.int32), y.astype(np.int32)


def squared_lengths(s, column, row):
    """Of texels from a sample to the next, of the axis where they are more, in float64."""
    x, y, iw = (s[name][:, :BATCH_SURFACES].astype(np.float64) for name in ("x", "y", "iw"))
    px, py = 256.0 * column + 128, 256.0 * row + 128
    weights, along, down = np.empty((3, *x.shape))
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        a, b = y[i] - y[j], x[j] - x[i]
        weights[k] = iw[k] * (a * (px - x[i]) + b * (py - y[i]))
        along[k], down[k] = iw[k] * 256 * a, iw[k] * 256 * b
    total = weights.sum(axis=0)
    lengths = np.zeros((2, BATCH_SURFACES))
    for uv, size in zip(s["uv"][..., :BATCH_SURFACES].astype(np.float64), s["texels"], strict=True):
        value = (weights * uv).sum(axis=0) / total
        for axis, change in enumerate((along, down)):
            slope = ((change * uv).sum(axis=0) - value * change.sum(axis=0)) / total
            lengths[axis] += (slope * size) ** 2
    return lengths.max(axis=0)


@all_backends
def test_levels_are_the_logarithm_of_the_longer_axis(kernels):
    for seed in range(20):
        rng = np.random.default_rng(seed)
        surfaces = perspective_surfaces(rng)
        column, row = inner_samples(rng, surfaces)
        batch = np.zeros(1, BATCH_RECORD)
        batch["count"] = BATCH_SURFACES
        each = np.minimum(np.arange(batch["surface"].shape[1]), BATCH_SURFACES - 1)
        batch["surface"][0] = each
        batch["sample"][0] = (row * TILE + column)[each]
        kernels.surface(bytes_of(surfaces), 0, 0, WANT_LEVEL)
        kernels.interpolate(batch.view(np.uint8), bytes_of(surfaces), WANT_LEVEL)
        exact = np.log2(np.maximum(squared_lengths(surfaces, column, row), 1.0))
        found = batch["lod"][0, :BATCH_SURFACES] / 128
        assert (found <= exact + 0.001).all()
        assert (found >= exact - BELOW - 1 / 128 - 0.001).all()
        assert np.ptp(exact) > 5 and (exact == 0).any()
