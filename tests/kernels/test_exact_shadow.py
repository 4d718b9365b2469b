"""Exact shadows: receivers against R100, exact_shadows against rays in float64 (R98 to R101)."""

import numpy as np
import pytest
from kernels.calls import record
from kernels.harness import all_backends, kernels_of
from kernels.kernels import lighting_of
from kernels.layouts import (
    BATCH,
    BATCH_RECORD,
    BATCH_SURFACES,
    CASTER_BOX,
    CASTER_LIGHT,
    LIGHT,
    PAD,
    SURFACES,
)
from kernels.test_light import POINT, reach_of

F = np.float32
SLACK = F(2.0**-20)
CASTERS = 30
LANES = BATCH + PAD
FACES = 6


@all_backends
def test_receivers(kernels):
    rng = np.random.default_rng(0)
    for count in (1, 4, 9, BATCH_SURFACES):
        surfaces, got = np.zeros(1, SURFACES), record("receivers")
        surfaces["count"], surfaces["position"] = (
            count,
            rng.normal(0, 9, surfaces["position"].shape),
        )
        kernels.receivers(surfaces, got)
        p = surfaces["position"][0]
        e, f = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
        most, total = np.abs(p).max(axis=1), np.abs(e) + np.abs(f)
        after, last = [1, 2, 0], [2, 0, 1]
        m = e[after] * f[last] - e[last] * f[after]
        over = F(1) / np.abs(m).max(axis=0)
        slack = most[after] * total[last] + most[last] * total[after]
        normal = m * over
        limit = np.abs(normal) * most
        expected = {"normal": normal, "slack": (slack * over) * SLACK}
        expected["limit"] = ((limit[0] + limit[1]) + limit[2]) * SLACK
        for name, values in expected.items():
            assert np.array_equal(got[name][0, ..., :count], values[..., :count]), name


def floor_and_casters(rng):
    """Samples of the plane y = 0, whose surface is 0, and triangles (casters, 3, 3) above it."""
    batch = np.zeros(1, BATCH_RECORD)
    batch["count"] = BATCH
    batch["position"][0, ::2] = rng.uniform(-3, 3, (2, LANES))
    batch["normal"][0, 1] = 1
    centre = rng.uniform(-3, 3, (CASTERS, 1, 3))
    centre[..., 1] = rng.uniform(0.9, 2, (CASTERS, 1))
    corners = (centre + rng.uniform(-0.8, 0.8, (CASTERS, 3, 3))).astype(F)
    surfaces, receivers = np.zeros(1, SURFACES), record("receivers")
    surfaces["count"], surfaces["position"][0, :, :, 0] = 1, np.eye(3) * [[1], [0], [1]]
    kernels_of("portable").receivers(surfaces, receivers)
    return batch, corners, receivers


def grid_of(boxes):
    """All casters in one cell, the near ones first."""
    boxes = boxes[np.argsort(boxes["near"])].copy()
    low, high = boxes["low"].min(axis=0), boxes["high"].max(axis=0)
    starts = np.array([0, len(boxes)], np.uint32)
    grid = record("caster_grid", low=low, high=high, scale=(1, 1), near=boxes["near"].min())
    grid["levels"], grid["filled"], grid["boxes"] = 1, 1, boxes.ctypes.data
    grid["starts"][0, 0] = starts.ctypes.data
    grid.kept += [boxes, starts]
    return grid


def boxes_of(places, depths):
    """Of (casters, 2, corners) places and (casters, corners) depths."""
    boxes = np.zeros(len(places), CASTER_BOX)
    boxes["near"], boxes["caster"] = depths.min(axis=1), np.arange(len(places))
    boxes["low"], boxes["high"] = places.min(axis=2), places.max(axis=2)
    return boxes


def directional(corners, light):
    """R98: the caster's corners as the light's plane has them, and one grid."""
    k = int(np.argmax(np.abs(light["to_light"])))
    after, last = (k + 1) % 3, (k + 2) % 3
    slope = light["to_light"][[after, last]] / light["to_light"][k]
    z = -corners[..., k] if light["to_light"][k] > 0 else corners[..., k]
    pairs = zip((after, last), slope, strict=True)
    places = [corners[..., c] - s * corners[..., k] for c, s in pairs]
    grid = grid_of(boxes_of(np.stack(places, axis=1), z))
    return np.stack([*places, z], axis=1), [grid] * FACES, {"axis": k, "slope": slope}


def local(corners, light):
    """R98: corners from the light on; each face of the cube holds every caster, wherever it is."""
    places = (corners - light["position"]).transpose(0, 2, 1)
    everywhere = np.broadcast_to(F([-1e30, 1e30])[:, None], (CASTERS, 2, 2)).transpose(0, 2, 1)
    boxes = boxes_of(np.ascontiguousarray(everywhere), np.zeros((CASTERS, 1), F))
    boxes["low"], boxes["high"] = -1e30, 1e30
    return places, [grid_of(boxes)] * FACES, {}


def hits(origin, towards, corners):
    """In float64: whether triangles (casters, 3, 3) are crossed before all of `towards` is gone."""
    a, b, c = corners.astype(float).transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    ahead = towards @ normal.T
    t = ((a * normal).sum(axis=1) - origin @ normal.T) / ahead
    point = origin[:, None] + t[..., None] * towards[:, None]
    inside = [
        (np.cross(q - p, point - p) * normal).sum(axis=-1) >= 0 for p, q in ((a, b), (b, c), (c, a))
    ]
    return (np.all(inside, axis=0) & (t > 0)), t


@all_backends
@pytest.mark.parametrize("is_point", [False, True])
def test_exact_shadows(kernels, is_point):
    shares = []
    for seed in range(20):
        rng = np.random.default_rng(seed)
        batch, corners, receivers = floor_and_casters(rng)
        lights = np.zeros(1, LIGHT)
        lights["color"], lights["range"], lights["kind"] = 1, np.inf, POINT if is_point else 0
        lights["position"] = rng.uniform([-2, 3, -2], [2, 5, 2])
        way = rng.uniform([-0.8, 0.5, -0.8], [0.8, 1, 0.8])
        lights["to_light"] = way / np.linalg.norm(way)
        world = np.ascontiguousarray(corners.reshape(CASTERS, 9))
        of_light, grids, more = (local if is_point else directional)(corners, lights[0])
        of_light = np.ascontiguousarray(of_light.reshape(CASTERS, 9), F)
        caster_light = record("caster_light", corners=of_light, grids=np.concatenate(grids), **more)
        assert caster_light.dtype == CASTER_LIGHT
        given = {"lights": caster_light, "light_count": 1, "world": world}
        index = record("caster_index", may_be_open=np.zeros(CASTERS, np.uint8), **given)
        lighting = lighting_of(lights, reach_of(lights), (0, 0, 0), (0, 1), (0, 0, 5, 1))
        got, expected = batch.copy(), batch.copy()
        kernels.exact_shadows(got, lighting, index, receivers)
        kernels_of("portable").exact_shadows(expected, lighting, index, receivers)
        found = got["shadowed_lights"][0, :BATCH]
        assert np.array_equal(found, expected["shadowed_lights"][0, :BATCH])
        origin = batch["position"][0, :, :BATCH].T.astype(float)
        towards = np.tile(lights["to_light"], (BATCH, 1)).astype(float)
        if is_point:
            towards = lights["position"] - origin
        crossed, t = hits(origin, towards, corners)
        shaded = (crossed & (t < 1 if is_point else True)).any(axis=1)
        assert (shaded != found).mean() < 0.01
        shares.append(shaded.mean())
    assert 0.03 < np.mean(shares) < 0.95
