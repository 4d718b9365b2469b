"""Maps of shadows in light, against R90 … R93 written out in NumPy."""

import functools

import numpy as np
import pytest
from kernels.arithmetic import ONE, ZERO, clamp, dot, greatest
from kernels.harness import all_backends, check_lanes, hostile
from kernels.kernels import shown_of
from kernels.layouts import LIGHT, SHADOW_MAP
from kernels.surfaces import fill, planes, random_batches
from kernels.test_light import DIRECTIONAL, POINT, random_lights, random_normals, reach_of, towards

import engine3d as e3d
from engine3d._native.rasterizer import (
    find_shadow_ranges,
    find_soft_ranges,
    shadow_ranges_side,
)

SPOT = 2
CORNER, SLACK = np.float32(float.fromhex("0x1.6a09e6p+0")), np.float32(0.25)
SIDE = 48
#: To the right and down of the faces +x, -x, +y, -y, +z, -z: axes and signs.
RIGHT = [(2, 1), (2, -1), (0, 1), (0, 1), (0, -1), (0, 1)]
DOWN = [(1, -1), (1, -1), (2, -1), (2, 1), (1, -1), (1, -1)]


def shift_of(shadow, texel, sine):
    across = np.float32(shadow["step"] * (shadow["taps"] - 1)) * np.float32(1 / 512)
    reach = (across + ONE) * CORNER
    return shadow["normal_bias"] + (reach * texel) * (sine + SLACK)


def inside(shadow, x, y):
    low, high = shadow["margin"], np.float32(shadow["size"]) - shadow["margin"]
    return (x >= low) & (high >= x) & (y >= low) & (high >= y)


def place_directional(shadow, maps, position, normal, sine):
    at = [dot(position, axis) for axis in shadow["axes"]]
    along = [dot(normal, axis) for axis in shadow["axes"]]
    found = np.full(at[0].shape, -1)
    x = y = z = np.zeros(at[0].shape, np.float32)
    for number, place in enumerate(maps):
        column, row = at[0] * place["scale"] + place["x"], at[1] * place["scale"] + place["y"]
        here = (found < 0) & inside(shadow, column, row)
        shift = shift_of(shadow, place["texel"], sine)
        ahead = at[2] + along[2] * shift
        depth = (ahead * shadow["depth"][0] + shadow["depth"][1]) + shadow["bias"]
        x = np.where(here, column + (along[0] * shift) * place["scale"], x)
        y = np.where(here, row + (along[1] * shift) * place["scale"], y)
        z, found = np.where(here, depth, z), np.where(here, number, found)
    return x, y, z, found


def project(shadow, place, at, number):
    near = ONE / greatest(at[2], np.float32(2.0**-100))
    x = (at[0] * near) * place["scale"] + place["x"]
    y = (at[1] * near) * place["scale"] + place["y"]
    z = (shadow["depth"][0] + shadow["depth"][1] * near) + shadow["bias"]
    return x, y, z, np.where((at[2] > 0) & inside(shadow, x, y), number, -1)


def sine_of(cosine):
    return np.sqrt(greatest(ONE - cosine * cosine, ZERO))


def axis_of(q):
    """Which component is the greatest, x before y before z."""
    a, b, c = map(np.abs, q)
    return np.where((a >= b) & (a >= c), 0, np.where(b >= c, 1, 2))


def place_spot(shadow, maps, q, normal, sine):
    at = [dot(q, axis) for axis in shadow["axes"]]
    along = [dot(normal, axis) for axis in shadow["axes"]]
    shift = shift_of(shadow, at[2] * maps[0]["texel"], greatest(sine, sine_of(along[2])))
    moved = [a + n * shift for a, n in zip(at, along, strict=True)]
    return project(shadow, maps[0], moved, 0)


def place_point(shadow, maps, q, normal, sine):
    most = greatest(greatest(np.abs(q[0]), np.abs(q[1])), np.abs(q[2]))
    tilt = sine_of(np.choose(axis_of(q), normal))
    shift = shift_of(shadow, most * maps[0]["texel"], greatest(sine, tilt))
    p = [a + n * shift for a, n in zip(q, normal, strict=True)]
    axis = axis_of(p)
    face = 2 * axis + (np.choose(axis, p) < 0)
    signed = {1: p, -1: [ZERO - component for component in p]}
    right = np.choose(face, [signed[sign][axis] for axis, sign in RIGHT])
    down = np.choose(face, [signed[sign][axis] for axis, sign in DOWN])
    return project(shadow, maps[0], [right, down, np.abs(np.choose(axis, p))], face)


def compare(shadow, depths, x, y, z, number):
    """R93, texel by texel."""
    step, taps, size = (int(shadow[name]) for name in ("step", "taps", "size"))
    across = step * (taps - 1)

    def first(at):
        whole = np.rint(clamp(at, ZERO, np.float32(size)) * np.float32(256)).astype(np.int64)
        return np.clip(whole - (128 + across // 2), 0, 256 * size - 257 - across)

    u, v = first(x), first(y)
    maps = depths.reshape(-1, size, size)
    total = np.zeros(x.shape, np.int64)
    for i in range(taps):
        for j in range(taps):
            across_, down = u + i * step, v + j * step
            for right in (0, 1):
                for below in (0, 1):
                    weight = np.where(right, across_ & 255, 256 - (across_ & 255))
                    weight = weight * np.where(below, down & 255, 256 - (down & 255))
                    texel = maps[np.maximum(number, 0), (down >> 8) + below, (across_ >> 8) + right]
                    total += np.where(texel >= z, weight, 0)
    share = total.astype(np.float32) / np.float32(65536 * taps * taps)
    return np.where(number < 0, ONE, share)


def reached_by(light, maps, depths, position, normal, direction):
    shadow = light["shadow"]["maps"]
    of = maps[shadow["first"] : shadow["first"] + shadow["count"]]
    used = depths[: shadow["count"] * shadow["size"] ** 2]
    sine = sine_of(dot(normal, direction))
    if light["kind"] == DIRECTIONAL:
        place = place_directional(shadow, of, position, normal, sine)
    else:
        q = [position[k] - light["position"][k] for k in range(3)]
        where = place_spot if light["kind"] == SPOT else place_point
        place = where(shadow, of, q, normal, sine)
    return compare(shadow, used, *place)


def shadowed(lights, maps, depths, position, normal):
    """R31 and R90 under lights that have maps: the energy, three arrays; and what they reach."""
    shares, energy = [], [np.full(position[0].shape, ZERO) for _ in range(3)]
    for light, shown in zip(lights, shown_of(lights), strict=True):
        direction, attenuation, near = towards(light, position)
        if light["kind"] == SPOT:
            cone = dot(direction, light["to_light"]) - light["cone"][0]
            t = clamp(cone * light["cone"][1], ZERO, ONE)
            attenuation = attenuation * (t * t)
        facing = dot(normal, direction)
        reached = reached_by(light, maps, depths, position, normal, direction)
        shares.append(reached)
        attenuation = np.where(facing > 0, attenuation * reached, attenuation)
        amount = attenuation * greatest(facing, ZERO)
        for k in range(3):
            energy[k] = np.where(near, energy[k] + shown[k] * amount, energy[k])
    return energy, np.stack(shares)


def random_maps(rng, lights):
    """Gives lights maps of patches, and returns these and the lights' places in them."""
    patches = rng.choice([-0.4, 0.0, 0.3, np.inf, np.nan], (6 * SIDE * SIDE // 8, 1))
    depths = np.ascontiguousarray(np.repeat(patches, 8, axis=1).ravel().astype(np.float32))
    maps = []
    for number, light in enumerate(lights):
        shadow = light["shadow"]["maps"]
        count = {DIRECTIONAL: int(rng.integers(1, 4)), POINT: 6, SPOT: 1}[int(light["kind"])]
        taps = (1, 3, 5)[number % 3]
        axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        light["shadow"]["kind"] = 1
        shadow["first"], shadow["count"] = len(maps), count
        shadow["size"], shadow["taps"] = rng.integers(40, SIDE + 1), taps
        shadow["step"] = 256 if rng.random() < 0.6 else rng.integers(0, 700)
        shadow["bias"], shadow["normal_bias"] = rng.uniform(-0.1, 0.1, 2)
        shadow["margin"] = rng.choice([1.5, 4.0])
        shadow["axes"], shadow["depth"] = axes, rng.uniform(-0.5, 0.5, 2)
        if number % 2:  # all at the depth of a patch, or the next beside it
            near = np.nextafter(np.float32(0.3), np.float32(rng.choice([-1, 0.3, 1])))
            shadow["depth"], shadow["bias"] = 0, near
        shadow["depths"] = depths.ctypes.data
        scale = rng.uniform(3, 9, count) * np.float32(2.0) ** np.arange(0, -count, -1)
        middle = np.float32(shadow["size"]) * np.float32(0.5) + rng.uniform(-2, 2, (2, count))
        rows = np.stack([scale, *middle, scale, scale]).T.astype(np.float32)
        rows[:, 3] = ONE / rows[:, 0]
        maps += [tuple(row) for row in rows]
    return np.array(maps, SHADOW_MAP), depths


def give_ranges(lights, depths):
    """Gives the maps of lights their ranges, which are returned."""
    held = []
    for light in lights:
        shadow = light["shadow"]["maps"]
        size, count = int(shadow["size"]), int(shadow["count"])
        side = shadow_ranges_side(size)
        ranges = np.empty((count, side, side), np.uint32)
        for k, of in enumerate(depths[: count * size * size].reshape(count, size, size)):
            find_shadow_ranges(of, int(shadow["taps"]), int(shadow["step"]), ranges[k])
        shadow["ranges"] = ranges.ctypes.data
        held.append(ranges)
    return held


@functools.lru_cache(maxsize=1)  # the backends follow each other, with ranges and without
def shadowed_batches(kind):
    made = []
    for seed in range(2):
        rng = np.random.default_rng(10 * kind + seed)
        batches = random_batches(rng)
        position = hostile(rng, batches.fields["position"].shape, 3.0, 0.02)
        normal = random_normals(rng, batches)
        lights = random_lights(rng, 3)
        lights["kind"] = kind
        lights["range"] = np.where(np.isinf(lights["range"]), np.inf, np.float32(1e20))
        lights["falloff"] = 0
        lights["cone"] = (-1.0, 0.5)
        maps, depths = random_maps(rng, lights)
        fill(batches, "position", position)
        fill(batches, "normal", normal)
        batches.fields["unmapped_normal"] = 0
        reach = reach_of(lights)
        if kind == SPOT:
            alike = lights.copy()
            alike["kind"] = POINT
            reach = reach_of(alike)
        black, free = np.zeros(3, np.float32), np.float32([0, np.inf])
        eye = np.float32([0, 0, 1, 0])
        arguments = lights.view(np.uint8), reach, black, free, eye, 0.0, maps.view(np.uint8)
        energy, shares = shadowed(lights, maps, depths, planes(position), planes(normal))
        # Some samples are lit, some are not, and some are half.
        shares_of = shares == 0, (shares > 0) & (shares < 1), shares == 1
        assert min(share.mean() for share in shares_of) > 0.002
        made.append((batches, arguments, depths, [clamp(e, *free) for e in energy]))
    return made


@all_backends
@pytest.mark.parametrize("ranged", [False, True])
@pytest.mark.parametrize("kind", [DIRECTIONAL, POINT, SPOT])
def test_shadow(kernels, kind, ranged):
    for template, (lights, *arguments), depths, energy in shadowed_batches(kind):
        batches = template.copy()
        if ranged:
            lights = lights.copy()
            held = give_ranges(lights.view(LIGHT), depths)
        for row in batches.rows:
            kernels.light(row, lights, *arguments)
        for k in range(3):
            got = batches.fields["energy"][:, k]
            check_lanes(f"energy[{k}]", got, energy[k], batches.fields["count"])
        batches.check_gaps()
        assert not ranged or len(held) == 3


@pytest.mark.parametrize(
    ("size", "taps", "step"), [(9, 1, 0), (16, 3, 256), (17, 5, 256), (13, 5, 300), (12, 3, 1279)]
)
def test_ranges(size, taps, step):
    """A block's codes are those of the least and the greatest depth that is compared from it on."""
    rng = np.random.default_rng(size)
    depths = rng.choice([-0.5, 0.1, 0.1 + 1e-6, 0.9, 2.0, np.inf, -np.inf, np.nan], (size, size))
    depths = depths.astype(np.float32)
    side = shadow_ranges_side(size)
    ranges = np.empty((side, side), np.uint32)
    find_shadow_ranges(depths, taps, step, ranges)
    limit = np.float32(32767)
    codes = np.trunc(np.clip(depths * np.float32(32000), -limit, limit))
    codes = np.where(np.isnan(depths), -32768, codes).astype(np.int64)
    far = (255 + step * (taps - 1)) // 256 + 1  # texels from the first to the last
    for (row, column), word in np.ndenumerate(ranges):
        of = codes[2 * row : 2 * row + far + 2, 2 * column : 2 * column + far + 2]
        assert np.int16(word & 0xFFFF) == of.min() and np.int16(word >> 16) == of.max()


@pytest.mark.parametrize(("size", "widest"), [(9, 1.0), (33, 5.5), (64, 12.0), (40, 64.0)])
def test_ranges_of_soft_lights(size, widest):
    """A block's codes are those of the least depths as many blocks around it as each window has."""
    depths = np.random.default_rng(size).uniform(-1.2, 1.2, (size, size)).astype(np.float32)
    side = shadow_ranges_side(size)
    ranges = np.empty((2, side, side), np.uint32)
    find_soft_ranges(depths, 3, 256, widest, ranges)
    limit = np.float32(32767)
    codes = np.trunc(np.clip(depths * np.float32(32000), -limit, limit)).astype(np.int64)
    for window, blocks in enumerate((1, 2, 8, int(np.float32(1.16) * np.float32(widest)) // 2 + 1)):
        words = (ranges[window // 2] >> (16 * (window % 2)) & 0xFFFF).astype(np.uint16)
        reach = min(blocks, side)
        for (row, column), code in np.ndenumerate(words.view(np.int16)):
            # At the begin a window is as wide as anywhere.
            rows, columns = (
                slice(2 * max(at - reach, 0), 2 * (max(at, reach) + reach + 1))
                for at in (row, column)
            )
            assert code == codes[rows, columns].min()


@pytest.mark.parametrize(
    ("depths", "step", "side", "message"),
    [((8, 8), 256, 3, "ranges"), ((8, 7), 256, 4, "square"), ((8, 8), 800, 4, "leave the map")],
)
def test_bad_ranges(depths, step, side, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        find_shadow_ranges(np.zeros(depths, np.float32), 3, step, np.empty((side, side), np.uint32))
