"""The kernels of refraction against R163 to R165."""

import numpy as np
import pytest
from kernels.arithmetic import ONE, ZERO, clamp, dot, exp2, greatest, least, log2, round_even, unit
from kernels.calls import record
from kernels.harness import all_backends, bits
from kernels.layouts import BATCH_RECORD, PAD, layout

HALF, QUARTER, LIMIT = np.float32([0.5, 0.25, 2.0**20])
TILE = 64
PLANES = {"normal": "normal", "position": "position", "lit_position": "position"}


def single(*values):
    return np.array(values, np.float32)


def frame_of(rng):
    """What the samples of a frame share."""
    return {
        "rows": rng.uniform(-2, 2, (3, 4)).astype(np.float32),
        "depth_row": rng.uniform(-2, 2, 4).astype(np.float32),
        "width": np.float32(rng.integers(1, 400)),
        "height": np.float32(rng.integers(1, 400)),
        "x": TILE * int(rng.integers(0, 5)),
        "y": TILE * int(rng.integers(0, 5)),
        "pixels_a_sample": np.float32(1 / rng.choice([1, 2, 4])),
        "index": single(1.2, 1.5, 1.9),
        "is_body": int(rng.integers(0, 2)),
        "blur_share": np.float32(rng.uniform(0, 1)),
        "blur_width": np.float32(rng.integers(1, 400)),
        "blur_area": np.float32(rng.choice([1, 4, 6.1])),
    }


def shifted(batch, of, count, eye, scale, thickness, index):
    """R164 for one index: across and down."""
    n, p = batch["normal"][0][:, :count], batch["position"][0][:, :count]
    v = (
        unit([eye[k] - p[k] for k in range(3)])
        if eye[3]
        else [np.broadcast_to(e, count) for e in eye[:3]]
    )
    c, e = dot(n, v), ONE / index
    a = abs(c)
    k = greatest(ONE - (e * e) * (ONE - a * a), ZERO)
    g = e * a - np.sqrt(k)
    g = np.where(c < 0, ZERO - g, g)
    q = [(n[r] * g - v[r] * e) * (thickness * scale[:count]) for r in range(3)]
    x, y, z = (dot(row[:3], q) for row in of["rows"])
    w = dot(of["rows"][2][:3], p) + of["rows"][2][3]
    h = greatest(w + z, w * QUARTER)
    sample = batch["sample"][0][:count]
    column = (sample % TILE + of["x"]).astype(np.float32) + HALF
    row = (sample // TILE + of["y"]).astype(np.float32) + HALF
    two = np.float32(2)
    across = (column * of["pixels_a_sample"]) * (two / of["width"]) - ONE
    down = ONE - (row * of["pixels_a_sample"]) * (two / of["height"])
    found = (
        ((x - across * z) / h) * (np.float32(128) * of["width"]),
        ((down * z - y) / h) * (np.float32(128) * of["height"]),
    )
    return [round_even(np.where((s > -LIMIT) & (s < LIMIT), s, ZERO)) for s in found]


def blurred(of, scale, roughness):
    """R165."""
    most = log2(of["blur_width"]) * of["blur_share"]
    level = clamp(roughness, ZERO, ONE) * most
    area = (exp2(level + level) - ONE) * of["blur_area"]
    blur = round_even(least(area, LIMIT) * np.float32(256))
    return np.where((scale == 0) & bool(of["is_body"]), 0, blur)


@all_backends
@pytest.mark.parametrize("dispersive", [False, True])
def test_shifts_and_blurs(kernels, dispersive):
    rng = np.random.default_rng(dispersive)
    for count in (1, 5, 16, 17, 200, 256):
        batch, of = np.zeros(1, BATCH_RECORD), frame_of(rng)
        batch["count"] = count
        batch["sample"] = rng.integers(0, TILE * TILE, batch["sample"].shape)
        batch["normal"] = rng.normal(size=batch["normal"].shape)
        batch["position"] = rng.uniform(-3, 3, batch["position"].shape)
        lanes = batch["alpha"].shape[-1]
        scale = rng.choice(single(0, 1, 0.7), lanes)
        roughness = rng.uniform(-0.2, 1.2, lanes).astype(np.float32)
        eye = single(0.3, 4, 2, rng.integers(0, 2))
        thickness = np.float32(0.6)
        given = {
            **of,
            "eye": eye,
            "sample": batch["sample"][0],
            **{name: [*batch[of][0]] for name, of in PLANES.items()},
            "is_dispersive": dispersive,
            "thickness": record("varying", factor=thickness),
            "roughness": record("varying", factor=1, lanes=roughness),
        }
        out = np.zeros(1, layout("e3d_bend_batch"))
        kernels.bend(record("bending", **given), scale, count, out)
        for c in range(3):
            index = of["index"][c if dispersive else 0]
            expected = shifted(batch, of, count, eye, scale, thickness, index)
            for got, wanted in zip(out["shift"][0, c, :, :count], expected, strict=True):
                assert np.array_equal(got, wanted)
        expected = blurred(of, scale[:count], roughness[:count])
        assert np.array_equal(out["blur"][0, :count], expected)
        position = batch["position"][0][:, :count]
        depth = ZERO - (dot(of["depth_row"][:3], position) + of["depth_row"][3])
        assert np.array_equal(bits(out["depth"][0, :count]), bits(depth))


def levels_of(rng, width, height):
    """Random levels of a picture: their texels, and the records of their places."""
    places, first = [], 0
    while True:
        places.append((width, height, first))
        first += 4 * width * height
        if max(width, height) <= 4 or len(places) == 12:
            break
        width, height = (width + 1) // 2, (height + 1) // 2
    return rng.uniform(0, 3, first).astype(np.float32), places


def mixed(a, b, weight):
    return a + (b - a) * weight


def sharp(level, x, y):
    """R163, level 0: (4,)."""
    height, width = level.shape[:2]
    u, v = clamp(x, ZERO, np.float32(width - 1)), clamp(y, ZERO, np.float32(height - 1))
    i, j = int(u), int(v)
    f, g = u - np.float32(i), v - np.float32(j)
    right, below = min(i + 1, width - 1), min(j + 1, height - 1)
    top = mixed(level[j, i], level[j, right], f)
    return mixed(top, mixed(level[below, i], level[below, right], f), g)


def spline(x, number, side):
    u = clamp((x + HALF) * np.float32(2.0**-number) - HALF, ZERO, np.float32(side - 1))
    i = int(u + HALF)
    d = u - np.float32(i)
    a, c = HALF - d, HALF + d
    weights = (a * a) * HALF, np.float32(0.75) - d * d, (c * c) * HALF
    return np.clip([i - 1, i, i + 1], 0, side - 1), weights


def smooth(level, number, x, y):
    columns, across = spline(x, number, level.shape[1])
    rows, down = spline(y, number, level.shape[0])
    return dot([dot([level[row, i] for i in columns], across) for row in rows], down)


def looked_up(levels, x, y, at):
    number = int(at)
    f = at - np.float32(number)
    fine = smooth(levels[number], number, x, y) if number else sharp(levels[0], x, y)
    if f == 0:
        return fine
    return mixed(fine, smooth(levels[number + 1], number + 1, x, y), f)


@all_backends
@pytest.mark.parametrize("size", [(1, 1), (4, 3), (37, 20), (130, 5)])
def test_places_are_looked_up(kernels, size):
    rng = np.random.default_rng(size[0])
    texels, places = levels_of(rng, *size)
    whole = {"whole_count": 7, "whole_share": np.float32(0.3)}
    view = record("behind_view", texels=texels, count=len(places), **whole)
    levels = []
    for number, (width, height, first) in enumerate(places):
        view["level"][0, number] = width, height, first
        levels.append(texels[first : first + 4 * width * height].reshape(height, width, 4))
    for dispersive in (0, 1):
        batch = np.zeros(1, layout("e3d_behind_batch"))
        count = 40
        batch["count"], batch["is_dispersive"] = count, dispersive
        batch["x"] = rng.uniform(-9, size[0] + 9, batch["x"].shape)
        batch["y"] = rng.uniform(-9, size[1] + 9, batch["y"].shape)
        batch["blur"] = np.where(
            rng.random(batch["blur"].shape) < 0.4, 0, 2 ** rng.integers(0, 28, batch["blur"].shape)
        )
        batch["blur"][0, 5] = -7  # of a sum that wrapped
        kernels.behind(view, batch)
        blur = greatest(batch["blur"][0].astype(np.float32), ZERO) * np.float32(2.0**-8)
        wanted = least(log2(ONE + blur) * HALF, np.float32(len(places) - 1))
        assert np.array_equal(bits(batch["level"][0, :count]), bits(wanted[:count]))
        of_whole = least(log2(ONE + blur * whole["whole_share"]) * HALF, np.float32(6))
        assert np.array_equal(bits(batch["whole_level"][0, :count]), bits(of_whole[:count]))
        for n in range(count):
            for channel in range(4):
                c = channel if dispersive and channel < 3 else 1
                at = batch["x"][0, c, n], batch["y"][0, c, n], wanted[n]
                expected = looked_up(levels, *at)[channel]
                assert batch["light"][0, channel, n] == expected


def test_a_batch_has_room_for_whole_vectors():
    assert np.zeros(1, layout("e3d_behind_batch"))["blur"].shape[-1] == 256 + PAD
