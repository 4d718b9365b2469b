"""The kernels of a material's textures against R45 to R48."""

import numpy as np
import pytest
from kernels import layouts
from kernels.arithmetic import ONE, ZERO, dot, unit
from kernels.calls import record
from kernels.harness import all_backends, bits, kernels_of
from kernels.kernels import texture_view
from kernels.layouts import (
    BATCH,
    BATCH_RECORD,
    BATCH_SURFACES,
    PAD,
    SURFACES,
    TEXTURE_BATCH,
    WANT_LEVEL,
    WANT_NORMAL,
    WANT_UV,
    WANT_WEIGHTS,
)
from kernels.test_surface import random_surfaces

from engine3d._native.rasterizer import FILTERS, WRAPS

LANES = BATCH + PAD
TWO = np.float32(2)


@all_backends
def test_varying(kernels):
    rng = np.random.default_rng(0)
    lanes, factor = rng.random(LANES, np.float32), np.float32(0.7)
    for count in (1, 7, BATCH):
        out = np.full(LANES, 7, np.float32)
        kernels.varying(record("varying", factor=factor), count, out)
        assert (out[:count] == factor).all() and (out[count + PAD :] == 7).all()
        kernels.varying(record("varying", lanes=lanes, factor=factor), count, out)
        assert np.array_equal(out[:count], lanes[:count] * factor)


def turned(negative, values):
    return np.where(negative, ZERO - values, values)


def face_tangents(surfaces, uv, back, round_too):
    """R47 of faces: tangents (3, elements), and the signs of the bitangents."""
    (u, v), p = uv, surfaces["position"]
    a, b, c, d = u[1] - u[0], v[1] - v[0], u[2] - u[0], v[2] - v[0]
    mirrored = (a * d - c * b) < 0
    sign = np.where(mirrored, -ONE, ONE)
    e, f = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    tangents = turned(mirrored, e * d - f * b)
    return turned(back, tangents), turned(back, turned(round_too, sign))


def texture_surfaces_of(rng, surfaces, places):
    made = record("texture_surfaces")
    made["uv"][0, :places] = rng.uniform(-2, 2, made["uv"][0, :places].shape)
    made["uv"][0, 0] = surfaces["uv"]
    made["tangent"] = rng.uniform(-1, 1, made["tangent"].shape)
    made["sign"] = rng.choice([-1, 1], made["sign"].shape)
    made["turned_round"] = rng.integers(0, 2, made["turned_round"].shape)
    return made


@all_backends
@pytest.mark.parametrize("vertex_tangents", [False, True])
def test_texture_surfaces(kernels, vertex_tangents):
    """Tangents of faces by the rule; those of vertices, and slopes, have the bytes of one lane."""
    rng, plain = np.random.default_rng(1), kernels_of("portable")
    for count in (1, 2, 5, 17, BATCH_SURFACES):
        surfaces = random_surfaces(rng, count)
        for name in ("position", "uv", "world"):
            surfaces[name] = rng.uniform(-2, 2, surfaces[name].shape)
        surfaces = surfaces.reshape(1)
        given = texture_surfaces_of(rng, surfaces[0], 2)
        textures = record(
            "read_textures", place_count=2, tangent_place=1, vertex_tangents=vertex_tangents
        )
        textures["places"]["has_level"][0, 1], textures["places"]["texels"][0, 1] = 1, (64, 32)
        got, expected = given.copy(), given.copy()
        for some in (kernels, plain):
            some.surface(surfaces.copy(), 0, 0, WANT_LEVEL)
        kernels.texture_surfaces(surfaces, textures, got)
        plain.texture_surfaces(surfaces, textures, expected)
        for name in ("tangent", "sign", "slope", "uv"):
            here, there = (one[name][0, ..., :count] for one in (got, expected))
            assert np.array_equal(bits(here), bits(there)), name
        if not vertex_tangents:
            back, round_too = surfaces["back"][0] != 0, given["turned_round"][0] != 0
            rule = face_tangents(surfaces[0], given["uv"][0, 1], back, round_too)
            assert np.array_equal(got["sign"][0, :count], rule[1][:count])
            tangents = got["tangent"][0, ..., :count]
            assert np.array_equal(tangents, np.repeat(rule[0][:, None, :count], 3, axis=1))


def random_textures(rng):
    """Two views: of a texture that is blended, and of one with levels."""
    for filter, sides in (("bilinear", [16]), ("trilinear", [32, 16, 8])):
        sizes = np.array([(side, side) for side in sides], np.int32)
        room = 8 * sum((side + 2) ** 2 for side in sides) + 16
        texels = rng.integers(0, 2**15, room // 2, np.uint16).view(np.uint8)
        yield texels, 16, sizes, FILTERS[filter], (WRAPS["repeat"], WRAPS["clamp"])


def shaded(kernels, surfaces, batch, textures, of_surfaces):
    """What the kernel finds, in a batch that has weights and normals by the same backend."""
    batch, out = batch.copy(), np.zeros(1, TEXTURE_BATCH)
    kernels.interpolate(batch, surfaces, WANT_UV | WANT_NORMAL | WANT_WEIGHTS)
    kernels.read_textures(batch, surfaces, textures, of_surfaces, out)
    return batch, out


@all_backends
def test_read_textures(kernels):
    """Coordinates are interpolated, texels as a base colour's; the bytes are those of one lane."""
    rng, plain = np.random.default_rng(2), kernels_of("portable")
    given = list(random_textures(rng))
    views = [texture_view(*one) for one in given]
    for count in (1, 3, 16, 100, BATCH):
        surfaces = np.zeros(1, SURFACES)
        for name in ("p", "position", "normal", "uv"):
            surfaces[name] = rng.uniform(0.1, 1, surfaces[name].shape)
        for name in ("px", "py"):
            surfaces[name] = rng.uniform(-1e-3, 1e-3, surfaces[name].shape)
        batch = np.zeros(1, BATCH_RECORD)
        batch["count"], batch["sample"] = count, np.minimum(np.arange(LANES), count - 1)
        batch["surface"] = batch["sample"] // 3
        of_surfaces = texture_surfaces_of(rng, surfaces[0], 2)
        of_surfaces["slope"] = rng.uniform(-1e-2, 1e-2, of_surfaces["slope"].shape)
        textures = record("read_textures", place_count=2, count=2, tangent_place=0)
        textures["places"]["has_level"][0, 1] = 1
        textures["read"]["view"][0, :2] = [view.ctypes.data for view in views]
        textures["read"]["place"][0, :2] = [0, 1]
        shown, got = shaded(kernels, surfaces, batch, textures, of_surfaces)
        _, expected = shaded(plain, surfaces, batch, textures, of_surfaces)
        for name, part in (("uv", 2), ("lod", 2), ("texel", 2), ("tangent", 4)):
            here, there = (one[name][0, :part, ..., :count] for one in (got, expected))
            assert np.array_equal(bits(here), bits(there)), name
        assert np.array_equal(got["uv"][0, 0, :, :count], shown["uv"][0, :, :count])
        tangents = got["tangent"][0, :3, :count].astype(float)
        assert np.abs((tangents**2).sum(axis=0) - 1).max() < 1e-5
        assert np.abs((tangents * shown["normal"][0, :, :count]).sum(axis=0)).max() < 1e-4
        for k, texture in enumerate(given):
            one = shown.copy()
            one["uv"], one["lod"] = got["uv"][0, k], got["lod"][0, k]
            kernels.texture(one, *texture, np.ones(3, np.float32))
            texels, color = (a[..., :count] for a in (got["texel"][0, k, :3], one["color"][0]))
            factor = color.max() / texels.max()
            assert np.allclose(texels * factor, color, rtol=1e-5)
            assert len(np.unique(color)) > count


@all_backends
def test_map_normals(kernels):
    """R48: along the tangent, the bitangent and the normal; the coat's go elsewhere."""
    rng = np.random.default_rng(3)
    texels = rng.random((2, 3, LANES), np.float32)
    batch, textures = np.zeros(1, BATCH_RECORD), np.zeros(1, TEXTURE_BATCH)
    normals = rng.uniform(-1, 1, (3, LANES)).astype(np.float32)
    batch["count"], batch["normal"] = BATCH, normals
    textures["tangent"] = rng.uniform(-1, 1, textures["tangent"].shape)
    textures["tangent"][0, 3] = rng.choice([-1, 1], LANES)
    scales = np.float32([0.8, 1.5])
    given = [
        record("normal_texture", texels=texels[k].ravel(), unit=1, scale=scales[k])
        for k in range(2)
    ]
    kernels.map_normals(batch, *given, textures)
    t = textures["tangent"][0]
    across = [normals[1] * t[2] - normals[2] * t[1], normals[2] * t[0] - normals[0] * t[2]]
    across.append(normals[0] * t[1] - normals[1] * t[0])
    for k, got in enumerate((batch["normal"][0], textures["coat_normal"][0])):
        along = texels[k] * TWO - ONE
        x, y = along[0] * scales[k], along[1] * scales[k]
        mapped = [(t[c] * x + (across[c] * t[3]) * y) + normals[c] * along[2] for c in range(3)]
        assert np.array_equal(bits(got[:, :BATCH]), bits(np.array(unit(mapped))[:, :BATCH]))
    assert np.array_equal(textures["shading_normal"][0, :, :BATCH], normals[:, :BATCH])
    before = batch["normal"].copy()
    none = record("normal_texture")
    kernels.map_normals(batch, none, none, textures)
    assert np.array_equal(batch["normal"], before)
    assert dot(t[:3], t[:3]).max() > 1  # nothing expects tangents of unit length
    assert layouts.MOST_PLACES == layouts.TEXTURE_SLOTS + 1
