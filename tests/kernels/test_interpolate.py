"""interpolate and tint against R19, R20, R22, R24 and R26."""

import functools

import numpy as np
import pytest
from kernels.arithmetic import ONE, ZERO, dot, greatest, unit
from kernels.harness import all_backends, check_lanes, check_poisoned, hostile
from kernels.layouts import (
    TILE,
    WANT_FACET,
    WANT_FLAT,
    WANT_LEVEL,
    WANT_NORMAL,
    WANT_POSITION,
    WANT_SURFACE,
    WANT_UV,
    WANT_WEIGHTS,
)
from kernels.surfaces import ROUNDS, at, bytes_of, fill, planes, random_batches, random_surfaces

WANTED = [
    WANT_SURFACE,
    WANT_WEIGHTS,
    WANT_POSITION,
    WANT_NORMAL,
    WANT_UV,
    WANT_LEVEL,
    WANT_UV | WANT_LEVEL | WANT_NORMAL,
    WANT_NORMAL | WANT_FLAT,
    WANT_NORMAL | WANT_WEIGHTS,
    WANT_POSITION | WANT_NORMAL | WANT_UV,
    WANT_POSITION | WANT_NORMAL | WANT_FLAT | WANT_UV | WANT_WEIGHTS,
    WANT_POSITION | WANT_FACET,
    WANT_POSITION | WANT_FACET | WANT_NORMAL | WANT_FLAT,
]
LEAST_WEIGHT = np.float32(2.0**-64)


def weights(surface, sample):
    """R19: three arrays, and r."""
    dx = (sample % TILE - surface["base_x"]).astype(np.float32)
    dy = (sample // TILE - surface["base_y"]).astype(np.float32)
    w = []
    for k in range(3):
        plane = (surface["p"][..., k] + dx * surface["px"][..., k]) + dy * surface["py"][..., k]
        w.append(greatest(plane, ZERO if k else LEAST_WEIGHT))
    return w, ONE / ((w[0] + w[1]) + w[2])


def attribute(surface, name, component, w, r):
    """R20"""
    return dot(w, planes_of(surface[name], component)) * r


def middle(surface, component):
    """R153"""
    first, second, third = planes_of(surface["position"], component)
    return ((first + second) + third) * np.float32(1 / 3)


def normals(surface, w, flat):
    """R22, but for the turn."""
    return unit(
        [
            surface["normal"][..., k, 0] if flat else dot(w, planes_of(surface["normal"], k))
            for k in range(3)
        ]
    )


def level(surface, sample, r):
    """R26, of as many levels as there could be."""
    dx = (sample % TILE - surface["base_x"]).astype(np.float32)
    dy = (sample // TILE - surface["base_y"]).astype(np.float32)
    along, down, turn = (np.moveaxis(surface["slope"][..., k], -1, 0) for k in range(3))
    changes = (along + dy * turn, down - dx * turn)
    lengths = [change[0] * change[0] + change[1] * change[1] for change in changes]
    q = greatest((greatest(*lengths) * (r * r)) * (r * r), ONE)
    return (q.view(np.int32) - ONE.view(np.int32)) >> 16


def planes_of(words, component):
    return [words[..., component, vertex] for vertex in range(3)]


def check_components(name, got, expected, counts):
    for k, values in enumerate(expected):
        check_lanes(f"{name}[{k}]", got[:, k], values, counts)


@functools.lru_cache(maxsize=1)  # the backends of a seed follow each other
def random_round(seed):
    """Batches, the bytes of their surfaces, what is asked for of each, and what must come of it.

    That is, fields by name: the rows that are asked for it, and their values of each component.
    """
    rng = np.random.default_rng(seed)
    surfaces, batches = random_surfaces(rng), random_batches(rng)
    wanted = rng.choice(WANTED, len(batches.rows))
    surface = at(surfaces, batches.fields["surface"])
    expected = expectation(surface, batches.fields["sample"], wanted)
    return batches, bytes_of(surfaces), wanted, expected


def expectation(surface, sample, wanted):
    w, r = weights(surface, sample)
    levels = level(surface, sample, r)
    assert len(np.unique(levels)) > 100
    faceted = ((wanted & WANT_FACET) != 0)[:, None]
    places = [attribute(surface, "position", k, w, r) for k in range(3)]
    lit = [np.where(faceted, middle(surface, k), places[k]) for k in range(3)]
    values = {
        "r": (WANT_WEIGHTS, [r]),
        "weight": (WANT_WEIGHTS, w),
        "position": (WANT_POSITION, lit),
        "place": (WANT_FACET, places),
        "uv": (WANT_UV, [attribute(surface, "uv", k, w, r) for k in range(2)]),
        "lod": (WANT_LEVEL, [levels]),
    }
    asked = {name: (wanted & bit) != 0 for name, (bit, _) in values.items()}
    expected = {name: (asked[name], [v[asked[name]] for v in values[name][1]]) for name in values}
    facing = (wanted & WANT_NORMAL) != 0
    of_face = (wanted & WANT_FLAT) != 0
    smooth, flat = (normals(surface, w, is_flat) for is_flat in (0, WANT_FLAT))
    both = [np.where(of_face[:, None], f, s)[facing] for f, s in zip(flat, smooth, strict=True)]
    return {**expected, "normal": (facing, both)}


@all_backends
@pytest.mark.parametrize("seed", range(ROUNDS))
def test_interpolate(kernels, seed):
    template, surfaces, wanted, expected = random_round(seed)
    batches = template.copy()
    for row, want in zip(batches.rows, wanted, strict=True):
        kernels.interpolate(row, surfaces, int(want))
    fields = batches.fields
    for name in ("sample", "surface"):
        assert np.array_equal(fields[name], template.fields[name])
    for name, (asked, values) in expected.items():
        counts = fields["count"][asked]
        if len(values) == 1:
            check_lanes(name, fields[name][asked], values[0], counts)
        else:
            check_components(name, fields[name][asked], values, counts)
        check_poisoned(fields[~asked], [name])
    check_poisoned(fields, ["color", "energy", "shine"])
    batches.check_gaps()


@functools.lru_cache(maxsize=1)  # the backends of a case follow each other
def tint_rounds(by_vertex, by_instance):
    """Batches, the bytes of their surfaces, and the colours of them."""
    made = []
    for seed in range(ROUNDS // 3):
        rng = np.random.default_rng(seed)
        surfaces, batches = random_surfaces(rng), random_batches(rng)
        shape = batches.fields["color"].shape
        color, w = hostile(rng, shape), hostile(rng, shape, 1.0, 0.03)
        r = hostile(rng, (shape[0], shape[2]), 1.0, 0.03)
        fill(batches, "color", color)
        fill(batches, "weight", w)
        fill(batches, "r", r)
        surface = at(surfaces, batches.fields["surface"])
        expected = planes(color)
        if by_vertex:
            expected = [
                c * attribute(surface, "color", k, planes(w), r) for k, c in enumerate(expected)
            ]
        if by_instance:
            expected = [c * surface["instance_color"][..., k] for k, c in enumerate(expected)]
        made.append((batches, bytes_of(surfaces), expected))
    return made


@all_backends
@pytest.mark.parametrize("by_vertex", [False, True])
@pytest.mark.parametrize("by_instance", [False, True])
def test_tint(kernels, by_vertex, by_instance):
    for template, surfaces, expected in tint_rounds(by_vertex, by_instance):
        batches = template.copy()
        for row in batches.rows:
            kernels.tint(row, surfaces, by_vertex, by_instance)
        check_components("color", batches.fields["color"], expected, batches.fields["count"])
        unused = ["position", "normal", "uv", "lod", "energy", "shine"]
        check_poisoned(batches.fields, unused)
        batches.check_gaps()
