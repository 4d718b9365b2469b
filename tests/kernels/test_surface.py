"""surface against R3, R18 and R25."""

import numpy as np
import pytest
from kernels.arithmetic import dot
from kernels.harness import POISON, all_backends, bits, hostile
from kernels.layouts import (
    BATCH_SURFACES,
    PAD,
    SURFACES,
    WANT_FLAT,
    WANT_LEVEL,
    WANT_NORMAL,
    WANT_POSITION,
)
from kernels.surfaces import bytes_of

FAR = 33280 * 256  # the guard band, and a line's width beyond it
COUNTS = [0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 63, BATCH_SURFACES - 1, BATCH_SURFACES]


def random_triangles(rng):
    """Corners (3, elements) of positive doubled area: small, thin, huge."""
    count = BATCH_SURFACES + PAD
    size = rng.choice([40, 300, 5000, 2 * FAR], count)
    x, y = (np.clip(rng.integers(-size, size + 1, (3, count)), -FAR, FAR) for _ in range(2))
    move = size < FAR
    x += np.where(move, rng.integers(-2000, 300000, count), 0)
    y += np.where(move, rng.integers(-2000, 300000, count), 0)
    area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    flat = area == 0
    x[:, flat], y[:, flat] = np.array([[0], [256], [0]]), np.array([[0], [0], [256]])
    for corners in (x, y):
        corners[1:, area < 0] = corners[2:0:-1, area < 0]
    return x, y


def random_surfaces(rng, count):
    """A poisoned record with everything that the kernel is given."""
    words = np.full(SURFACES.itemsize // 4, POISON, np.uint32)
    surfaces = words.view(np.uint8).view(SURFACES)[0]
    shape = surfaces["matrix"].shape
    surfaces["count"] = count
    surfaces["reach"] = 0
    surfaces["x"], surfaces["y"] = random_triangles(rng)
    surfaces["iw"] = 2.0 ** rng.uniform(-20, 20, surfaces["iw"].shape)
    surfaces["swapped"] = rng.integers(0, 2, shape)
    surfaces["back"] = rng.integers(0, 2, shape)
    surfaces["matrix"] = np.cumsum(rng.random(shape) < rng.choice([0, 0.1, 0.7]))
    surfaces["matrix"] -= surfaces["matrix"][0]
    surfaces["matrix"] = np.minimum(surfaces["matrix"], BATCH_SURFACES - 1)
    surfaces["matrix"][count:] = surfaces["matrix"][max(count - 1, 0)]
    for name in ("world", "normals", "position", "normal", "uv"):
        surfaces[name] = hostile(rng, surfaces[name].shape, 2.0, 0.02)
    surfaces["texels"] = rng.choice([1, 37, 1024, 16384], 2)
    return surfaces


def barycentric_planes(s, tile):
    """R18, without clipped pieces: p, px, py (3, elements), and the base in the tile."""
    x, y = s["x"].astype(np.int64), s["y"].astype(np.int64)
    base = [np.maximum(-((128 - v.min(axis=0)) // 256), 0) for v in (x, y)]
    area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    iw = s["iw"].astype(np.float64)
    inverse, most = 1.0 / area.astype(np.float64), 1.0 / iw.max(axis=0)
    planes = np.empty((3, 3, len(area)))
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        a, b = y[i] - y[j], x[j] - x[i]
        e = a * (256 * base[0] + 128 - x[i]) + b * (256 * base[1] + 128 - y[i])
        q = iw[k] * most
        planes[0, k] = (e.astype(np.float64) * inverse) * q
        planes[1, k] = ((256.0 * a.astype(np.float64)) * inverse) * q
        planes[2, k] = ((256.0 * b.astype(np.float64)) * inverse) * q
    swapped = planes[:, [0, 2, 1]]
    planes = np.where(s["swapped"] != 0, swapped, planes).astype(np.float32)
    return planes, [(base[k] - tile[k]).astype(np.float32) for k in range(2)]


def transformed(matrix, columns, vectors, vertices):
    """R3: rows of three columns, or of four with an offset."""
    result = vectors.copy()
    for row in range(3):
        for v in range(vertices):
            value = dot(matrix[columns * row : columns * row + 3], vectors[:, v])
            result[row, v] = value + matrix[columns * row + 3] if columns == 4 else value
    return result


def slopes(surfaces, planes):
    """R25: (coordinate, 3, elements)."""
    sums = [(w[0] + w[1]) + w[2] for w in planes]
    found = []
    for uv, size in zip(surfaces["uv"], surfaces["texels"], strict=True):
        a = [dot(w, uv) for w in planes]
        found.append(
            [
                (a[1] * sums[0] - a[0] * sums[1]) * size,
                (a[2] * sums[0] - a[0] * sums[2]) * size,
                (a[1] * sums[2] - a[2] * sums[1]) * size,
            ]
        )
    return np.array(found)


def check(name, got, expected, count):
    same = bits(got[..., :count]) == bits(expected[..., :count])
    if name == "p":
        same |= got[..., :count] == expected[..., :count]  # zero has either sign
    assert same.all(), name


def turned(normals, back, vertices):
    """R22: negated where the face looks away."""
    out, zero = normals.copy(), np.float32(0)
    some = normals[:, :vertices]
    out[:, :vertices] = np.where(back != 0, zero - some, zero + some)
    return out


@all_backends
@pytest.mark.parametrize("flat", [0, WANT_FLAT])
def test_surface(kernels, flat):
    wanted = WANT_POSITION | WANT_NORMAL | WANT_LEVEL | flat
    for seed in range(40):
        rng = np.random.default_rng(seed)
        count = COUNTS[seed % len(COUNTS)]
        surfaces = random_surfaces(rng, count)
        given = surfaces.copy()
        tile = [int(v) for v in rng.integers(0, 40, 2) * 64]
        kernels.surface(bytes_of(surfaces), *tile, wanted)
        planes, base = barycentric_planes(given, tile)
        matrix = given["matrix"]
        expected = {"p": planes[0], "px": planes[1], "py": planes[2]}
        expected["base_x"], expected["base_y"] = base
        expected["position"] = transformed(given["world"][:, matrix], 4, given["position"], 3)
        expected["normal"] = turned(
            transformed(given["normals"][:, matrix], 3, given["normal"], 1 if flat else 3),
            given["back"],
            1 if flat else 3,
        )
        expected["slope"] = slopes(given, planes)
        for name in SURFACES.names:
            if name in expected:
                check(name, surfaces[name], expected[name], count)
                beyond = slice(count + PAD, None)
                assert np.array_equal(
                    bits(surfaces[name][..., beyond]), bits(given[name][..., beyond])
                )
            else:
                assert np.array_equal(bits(surfaces[name]), bits(given[name])), name


@all_backends
def test_what_is_not_wanted_stays(kernels):
    rng = np.random.default_rng(0)
    surfaces = random_surfaces(rng, BATCH_SURFACES)
    given = surfaces.copy()
    kernels.surface(bytes_of(surfaces), 0, 0, 0)
    for name in ("position", "normal", "slope"):
        assert np.array_equal(bits(surfaces[name]), bits(given[name])), name
