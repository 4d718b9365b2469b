"""add_small: triangles of a cluster, a bit each, are added to those that are there already."""

import numpy as np
from kernels.harness import Records, all_backends, check_lanes, hostile
from kernels.layouts import (
    CLUSTER_TRIANGLES,
    CLUSTER_VERTICES,
    SMALL_TRIANGLES,
    SMALLS,
    VERTICES,
)

CALLS = 600
NUMBER = np.arange(CLUSTER_TRIANGLES)


def random_vertices(rng):
    """Any numbers, in clusters of all sizes."""
    vertices = np.zeros(CALLS, VERTICES)
    vertices["count"] = np.arange(CALLS) % CLUSTER_VERTICES + 1
    for name in ("sx", "sy"):
        vertices[name] = rng.integers(-(2**31), 2**31, vertices[name].shape)
    vertices["zn"] = hostile(rng, vertices["zn"].size).reshape(vertices["zn"].shape)
    return vertices


def random_triangles(rng):
    """(calls, 64) bool: none, few, many, all."""
    rate = rng.choice([0, 0.05, 0.2, 0.8, 1], (CALLS, 1))
    return rng.random((CALLS, CLUSTER_TRIANGLES)) < rate


@all_backends
def test_add_small(kernels):
    rng = np.random.default_rng(7)
    vertices, chosen = random_vertices(rng), random_triangles(rng)
    indices = rng.integers(0, vertices["count"][:, None, None], (CALLS, 3, CLUSTER_TRIANGLES))
    there = rng.integers(0, SMALLS - CLUSTER_TRIANGLES + 1, CALLS)
    first, shift = rng.integers(0, 2**20, CALLS), rng.integers(0, 9, CALLS)
    out = Records(SMALL_TRIANGLES, CALLS)
    out.fields["count"] = there
    for n in range(CALLS):
        kernels.add_small(
            vertices[n : n + 1].view(np.uint8),
            indices[n].astype(np.uint8).ravel(),
            int((chosen[n].astype(np.uint64) << NUMBER.astype(np.uint64)).sum()),
            int(first[n]),
            int(shift[n]),
            out.rows[n],
        )
    out.check_gaps()
    assert np.array_equal(out.fields["count"], there + chosen.sum(axis=1))
    for n in range(CALLS):
        end = there[n] + chosen[n].sum()
        rows = [("id", out.fields["id"][n], first[n] + (NUMBER << shift[n]))]
        for name, source in (("x", "sx"), ("y", "sy"), ("zn", "zn")):
            corners = vertices[source][n][indices[n]]
            rows += [(name, out.fields[name][n, k], corners[k]) for k in range(3)]
        for name, got, values in rows:
            expected = got.copy()  # what is there stays: poison
            expected[there[n] : end] = values[chosen[n]]
            check_lanes(name, got[None], expected[None], [end])
