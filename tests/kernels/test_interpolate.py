"""interpolate and tint against R19, R20, R22 and R24."""

import numpy as np
import pytest
from kernels.arithmetic import ONE, ZERO, dot, greatest, least, unit
from kernels.harness import all_backends, check_lanes, check_poisoned, hostile
from kernels.layouts import TILE, WANT_FLAT, WANT_NORMAL, WANT_POSITION, WANT_UV
from kernels.surfaces import ROUNDS, at, bytes_of, fill, planes, random_batches, random_surfaces

WANTED = [
    0,
    WANT_POSITION,
    WANT_NORMAL,
    WANT_UV,
    WANT_NORMAL | WANT_FLAT,
    WANT_POSITION | WANT_NORMAL | WANT_UV,
    WANT_POSITION | WANT_NORMAL | WANT_FLAT | WANT_UV,
]


def barycentrics(surface, sample):
    """R19: three arrays, and r."""
    dx = (sample % TILE - surface["base_x"]).astype(np.float32)
    dy = (sample // TILE - surface["base_y"]).astype(np.float32)
    p = []
    for k in range(3):
        plane = (surface["p"][..., k] + dx * surface["px"][..., k]) + dy * surface["py"][..., k]
        p.append(greatest(plane, ZERO))
    total = (p[0] + p[1]) + p[2]
    usable = total >= np.float32(2.0**-126)
    r = np.where(usable, ONE / total, ZERO)
    nothing = (ONE, ZERO, ZERO)
    return [np.where(usable, least(p[k] * r, ONE), nothing[k]) for k in range(3)], r


def normals(surface, b, flat):
    """R22"""
    n = [
        surface["normal"][..., k, 0] if flat else dot(b, planes_of(surface["normal"], k))
        for k in range(3)
    ]
    return unit([np.where(surface["back"] != 0, ZERO - v, v) for v in n])


def planes_of(words, component):
    return [words[..., component, vertex] for vertex in range(3)]


def check_components(name, got, expected, counts):
    for k, values in enumerate(expected):
        check_lanes(f"{name}[{k}]", got[:, k], values, counts)


@all_backends
def test_interpolate(kernels):
    for seed in range(ROUNDS):
        rng = np.random.default_rng(seed)
        surfaces, batches = random_surfaces(rng), random_batches(rng)
        wanted = rng.choice(WANTED, len(batches.rows))
        given = batches.fields["sample"].copy(), batches.fields["surface"].copy()
        for row, want in zip(batches.rows, wanted, strict=True):
            kernels.interpolate(row, bytes_of(surfaces), int(want))
        check_interpolated(batches, at(surfaces, given[1]), given, wanted)


def check_interpolated(batches, surface, given, wanted):
    fields, counts = batches.fields, batches.fields["count"]
    assert np.array_equal(fields["sample"], given[0])
    assert np.array_equal(fields["surface"], given[1])
    b, r = barycentrics(surface, given[0])
    check_components("b", fields["b"], b, counts)
    check_lanes("r", fields["r"], r, counts)
    expected = {
        "position": (WANT_POSITION, [dot(b, planes_of(surface["position"], k)) for k in range(3)]),
        "uv": (WANT_UV, [dot(b, planes_of(surface["uv"], k)) for k in range(2)]),
    }
    for name, (bit, values) in expected.items():
        asked = (wanted & bit) != 0
        check_components(name, fields[name][asked], [v[asked] for v in values], counts[asked])
        check_poisoned(fields[~asked], [name])
    for flat in (0, WANT_FLAT):
        asked = (wanted & (WANT_NORMAL | WANT_FLAT)) == WANT_NORMAL | flat
        chosen = {name: words[asked] for name, words in surface.items()}
        values = normals(chosen, [v[asked] for v in b], flat)
        check_components("normal", fields["normal"][asked], values, counts[asked])
    check_poisoned(fields[(wanted & WANT_NORMAL) == 0], ["normal"])
    check_poisoned(fields, ["color", "lod", "energy", "shine"])
    batches.check_gaps()


@all_backends
@pytest.mark.parametrize("by_vertex", [False, True])
@pytest.mark.parametrize("by_instance", [False, True])
def test_tint(kernels, by_vertex, by_instance):
    for seed in range(ROUNDS // 3):
        rng = np.random.default_rng(seed)
        surfaces, batches = random_surfaces(rng), random_batches(rng)
        shape = batches.fields["color"].shape
        color, b = hostile(rng, shape), hostile(rng, shape, 1.0, 0.03)
        fill(batches, "color", color)
        fill(batches, "b", b)
        for row in batches.rows:
            kernels.tint(row, bytes_of(surfaces), by_vertex, by_instance)
        surface = at(surfaces, batches.fields["surface"])
        expected = planes(color)
        if by_vertex:
            expected = [
                c * dot(planes(b), planes_of(surface["color"], k)) for k, c in enumerate(expected)
            ]
        if by_instance:
            expected = [c * surface["instance_color"][..., k] for k, c in enumerate(expected)]
        check_components("color", batches.fields["color"], expected, batches.fields["count"])
        unused = ["r", "position", "normal", "uv", "lod", "energy", "shine"]
        check_poisoned(batches.fields, unused)
        batches.check_gaps()
