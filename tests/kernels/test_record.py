"""record against R9, R10, R12 and R13: the records of a cluster's triangles, and their tiles.

The oracle works in 64 bits from the vertices. What it drops besides what the rules drop, where tiny
ones are told from the others: triangles of at most 2 x 2 samples (and sides of at most 32767 steps)
that cover none of them; the records of the others of that size carry their cover.
"""

import functools

import numpy as np
import pytest
from kernels import layouts
from kernels.arithmetic import greatest, least
from kernels.harness import POISON, Records, all_backends, bits, every_count, hostile
from kernels.layouts import (
    CLUSTER_TRIANGLES,
    CLUSTER_VERTICES,
    PAD,
    RECORD,
    TILE,
    TILE_RECT,
    VERTICES,
    viewport_of,
)

CALLS = 3000  # of each kind; with KINDS: 10^6 triangles and more
SIZES = [(1, 1), (2, 2), (16, 16), (640, 480), (65536, 65536), (1, 4096), (37, 23)]
TABLES = [32, 33, 64, 65, CLUSTER_VERTICES]  # vertices at and beyond what a table's parts hold
STEPS = 32767  # of 1/256 sample: larger triangles never carry their cover
OUT = np.dtype([("rows", RECORD, CLUSTER_TRIANGLES)])
SPANS = np.dtype([("rows", TILE_RECT, CLUSTER_TRIANGLES)])


# ---- vertices ----


def everywhere(rng, size, shape):
    """Over the whole guard band, which ends 2^23 steps from the centre, and a bit beyond."""
    spread = 2 ** rng.integers(1, 24, (CALLS, 1))
    return 128 * size + rng.integers(-spread, spread + 1, shape)


def tiny(rng, size, shape):
    """A few samples about a place in the viewport or at its edge, often on centres."""
    at = (256 * size * rng.random((CALLS, 1))).astype(np.int64)
    at = np.where(rng.random((CALLS, 1)) < 0.3, rng.choice([0, 1], (CALLS, 1)) * 256 * size, at)
    spread = rng.choice([100, 200, 300, 380, 3000], (CALLS, 1))
    grid = rng.choice([1, 1, 64, 128], (CALLS, 1))
    return (at + rng.integers(-spread, spread + 1, shape)) // grid * grid


def steps(rng, size, shape):
    """Sides about as long as what 32 bits hold, of which the viewport may leave a sample."""
    reach = rng.choice([STEPS - 1, STEPS, STEPS + 1, 2**20], (CALLS, 1))
    at = rng.choice([0, 256], (CALLS, 1)) * size + rng.integers(-600, 600, (CALLS, 1))
    return at + rng.choice([-1, 0, 1], (CALLS, 1)) * reach * rng.integers(0, 2, shape)


KINDS = {"everywhere": everywhere, "tiny": tiny, "steps": steps}


def make_vertices(rng, kind, viewport):
    vertices = np.zeros(CALLS, VERTICES)
    shape = (CALLS, CLUSTER_VERTICES)
    x, y = (
        KINDS[kind](rng, viewport[name][:, None].astype(np.int64), shape)
        for name in ("width", "height")
    )
    # Some are slivers along a diagonal, or lines.
    aside = rng.choice([0, 1, 3], (CALLS, 1))
    sliver = rng.random((CALLS, 1)) < (0.05 if kind == "tiny" else 0.3)
    y = np.where(sliver, x + rng.integers(-aside, aside + 1, shape), y)
    vertices["sx"], vertices["sy"] = (
        v.clip(128 * viewport[name][:, None] - 2**23 - 4, 128 * viewport[name][:, None] + 2**23 + 4)
        for v, name in ((x, "width"), (y, "height"))
    )
    rate = rng.choice([0, 0, 0.02, 0.5], (CALLS, 1))
    special = hostile(rng, shape, 1.5, rate=1.0)
    depth = rng.uniform(-1.5, 1.5, shape).astype(np.float32)
    depth = np.where(rng.random((CALLS, 1)) < 0.2, depth[:, :1], depth)  # all alike
    vertices["zn"] = np.where(rng.random(shape) < rate, special, depth)
    vertices["iw"] = hostile(rng, shape, 10.0)
    counts = rng.integers(3, CLUSTER_VERTICES + 1, CALLS)
    vertices["count"] = np.where(rng.random(CALLS) < 0.5, rng.choice(TABLES, CALLS), counts)
    return vertices


# ---- what the rules say ----


def corners_of(vertices, indices, triangles):
    """{field: (3, calls, 64)} of the listed triangles."""
    corners = {}
    for name in ("sx", "sy", "zn", "iw"):
        planes = [np.take_along_axis(plane, triangles, 1) for plane in indices.swapaxes(0, 1)]
        corners[name] = np.stack([np.take_along_axis(vertices[name], at, 1) for at in planes])
    corners["sx"], corners["sy"] = corners["sx"].astype(np.int64), corners["sy"].astype(np.int64)
    return corners


def area_of(x, y):
    return (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])


def exchange(c, swapped):
    """R9: vertices 1 and 2 of the triangles with a negative area."""
    for name, values in c.items():
        second = np.where(swapped, values[2], values[1])
        third = np.where(swapped, values[1], values[2])
        c[name] = np.stack([values[0], second, third])


def sample_span(v, size):
    """R10 along one axis: first and last sample."""
    first = np.maximum(-((128 - v.min(axis=0)) // 256), 0)
    return first, np.minimum((v.max(axis=0) - 128) // 256, size[:, None] - 1)


def cover_of(x, y, across, down):
    """R12 at the 2 x 2 samples that begin a box, and of these the bits that are in the box."""
    cover = np.zeros(x.shape[1:], np.int64)
    for bit in range(4):
        column, row = across[0] + bit % 2, down[0] + bit // 2
        inside = (column <= across[1]) & (row <= down[1])
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            a, b = y[i] - y[j], x[j] - x[i]
            edge = a * (256 * column + 128 - x[i]) + b * (256 * row + 128 - y[i])
            inside &= (edge > 0) | ((edge == 0) & ((a > 0) | ((a == 0) & (b > 0))))
        cover |= inside.astype(np.int64) << bit
    return cover


def plane_of(c, area, across, down):
    """R13: z0, gx, gy as float32."""
    x, y, zn = c["sx"].astype(float), c["sy"].astype(float), c["zn"].astype(float)
    ax, ay, cx, cy = x[1] - x[0], y[1] - y[0], x[2] - x[0], y[2] - y[0]
    d1, d2, r = zn[1] - zn[0], zn[2] - zn[0], 256 / area.astype(float)
    gx, gy = (d1 * cy - d2 * ay) * r, (d2 * ax - d1 * cx) * r
    ex = (256 * across[0] + 128 - c["sx"][0]) / 256
    ey = (256 * down[0] + 128 - c["sy"][0]) / 256
    z0 = (zn[0] + ex * gx) + ey * gy
    return [v.astype(np.float32) for v in (z0, gx, gy)]


def expectation(c, viewport, told, cull, mirrored, order):
    """Records and spans (calls, 64) of all triangles, and which of them there are.

    Whether tiny ones are told from the others is each call's own.
    """
    area = area_of(c["sx"], c["sy"])
    swapped, keep = area < 0, (area != 0) & (np.sign(area) != np.where(cull == 0, 9, cull)[:, None])
    exchange(c, swapped)
    x, y, zn = c["sx"], c["sy"], c["zn"]
    across, down = (
        sample_span(v, viewport[name].astype(np.int64)) for v, name in ((x, "width"), (y, "height"))
    )
    keep &= (across[0] <= across[1]) & (down[0] <= down[1])
    small = (across[1] - across[0] <= 1) & (down[1] - down[0] <= 1)
    small &= told[:, None]
    small &= np.maximum(np.ptp(x, axis=0), np.ptp(y, axis=0)) <= STEPS
    cover = cover_of(x, y, across, down)
    plane = plane_of(c, np.abs(area), across, down)
    keep &= ~(small & (cover == 0)) & np.isfinite(plane).all(axis=0)
    front = swapped ^ mirrored[:, None]
    records, spans = np.zeros(area.shape, RECORD), np.zeros(area.shape, TILE_RECT)
    for k in range(3):
        records["x"][..., k], records["y"][..., k], records["iw"][..., k] = x[k], y[k], c["iw"][k]
    records["z0"], records["gx"], records["gy"] = plane
    records["zmin"] = least(least(zn[0], zn[1]), zn[2])
    records["zmax"] = greatest(greatest(zn[0], zn[1]), zn[2])
    records["order"] = order
    records["meta"] = layouts.RECORD_FACE + layouts.RECORD_BACK * ~front
    records["meta"] += (layouts.RECORD_SWAPPED * swapped).astype(np.uint32)
    shown = layouts.RECORD_TINY + (cover << layouts.RECORD_SHIFT)
    records["meta"] += np.where(small, shown, 0).astype(np.uint32)
    for k, name in enumerate(("first", "last")):
        spans[name] = (down[k] // TILE << 16) + across[k] // TILE
    return records, spans, keep


def check_rows(got, expected, keep, counts):
    """The expected rows in the triangles' order; no vector is written behind the last one's."""
    made = keep.sum(axis=1)
    order = np.argsort(~keep, axis=1, kind="stable")
    listed = np.arange(CLUSTER_TRIANGLES) < made[:, None]
    expected = np.take_along_axis(expected, order, 1)[listed]
    for name in expected.dtype.names:
        wrong = bits(got[name][listed]) != bits(expected[name])
        if wrong.any():
            at = np.argwhere(wrong)[0][0]
            raise AssertionError(
                f"{name}: {wrong.sum()} differ; {got[listed][at]}, not {expected[at]}"
            )
    beyond = np.arange(CLUSTER_TRIANGLES) >= -(-counts[:, None] // PAD) * PAD
    words = got.view(np.uint32).reshape(*got.shape, -1)
    assert (words[beyond] == POISON).all(), "written beyond the end"


# ---- tests ----


@functools.lru_cache(maxsize=1)  # the backends of a case follow each other
def random_calls(kind, seed):
    """The arguments of each call but what is written; numbers of triangles; the expected rows."""
    rng = np.random.default_rng(seed)
    choice = SIZES[:3] if kind == "steps" else SIZES
    sizes = np.array(choice)[rng.integers(0, len(choice), CALLS)]
    viewport = np.concatenate([viewport_of(*size) for size in sizes])
    vertices = make_vertices(rng, kind, viewport)
    shape = (CALLS, 3, CLUSTER_TRIANGLES)
    indices = rng.integers(0, vertices["count"][:, None, None], shape).astype(np.uint8)
    triangles = rng.integers(0, CLUSTER_TRIANGLES, (CALLS, CLUSTER_TRIANGLES + PAD), np.uint8)
    counts = every_count(rng, CLUSTER_TRIANGLES, CALLS)
    cull = rng.integers(-1, 2, CALLS).astype(np.int32)
    mirrored, told = rng.random(CALLS) < 0.5, rng.random(CALLS) < 0.8
    faces = rng.integers(0, 2**31, (CALLS, CLUSTER_TRIANGLES)).astype(np.int32)
    base = rng.integers(0, 2**32, CALLS, np.uint32)
    arguments = [
        (
            vertices[n : n + 1].view(np.uint8),
            indices[n].ravel(),
            triangles[n],
            int(counts[n]),
            bool(told[n]),
            int(cull[n]),
            bool(mirrored[n]),
            int(base[n]),
            faces[n],
            viewport[n : n + 1].view(np.uint8),
        )
        for n in range(CALLS)
    ]
    asked = triangles[:, :CLUSTER_TRIANGLES].astype(np.int64)
    order = base[:, None] + np.take_along_axis(faces, asked, 1).astype(np.uint32)
    corners = corners_of(vertices, indices, asked)
    records, tiles, keep = expectation(corners, viewport, told, cull, mirrored, order)
    keep &= np.arange(CLUSTER_TRIANGLES) < counts[:, None]
    assert keep.sum() > 2 * CALLS
    covers = np.bincount(records["meta"][keep] >> layouts.RECORD_SHIFT, minlength=16)
    assert kind != "tiny" or (covers[1:] > 0).all()  # each comes up
    assert kind != "steps" or covers[15] > 0
    return arguments, counts, records, tiles, keep


@all_backends
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", [0, 1])
def test_record(kernels, kind, seed):
    arguments, counts, records, tiles, keep = random_calls(kind, seed)
    out, spans = Records(OUT, CALLS), Records(SPANS, CALLS)
    calls = zip(arguments, out.rows, spans.rows, strict=True)
    made = [kernels.record(*given, *written) for given, *written in calls]
    assert np.array_equal(made, keep.sum(axis=1))
    check_rows(out.fields["rows"], records, keep, counts)
    check_rows(spans.fields["rows"], tiles, keep, counts)
    out.check_gaps()
    spans.check_gaps()
