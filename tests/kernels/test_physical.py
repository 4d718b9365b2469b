"""Light on physically based materials (R49 to R57): glTF's appendix B in float64, the furnace."""

import json

import numpy as np
import pytest
from kernels.harness import all_backends
from kernels.layouts import BATCH_RECORD, LIGHT, TEXTURE_BATCH
from kernels.test_light import DIRECTIONAL, reach_of
from shared_corpus import GLTF, needs_gltf

PLAIN = {
    "metallic": [0],
    "roughness": [1],
    "reflectance": [0.04] * 3,
    "specular": [1],
    "emissive": [0] * 3,
    "coat": [0],
    "coat_roughness": [0],
    "sheen": [0] * 3,
    "sheen_roughness": [0],
    "transmission": [0],
    "thickness": [0],
    "absorption": [0] * 3,
    "anisotropy": [0],
    "anisotropy_turn": [1, 0],
    "iridescence": [0],
    "iridescence_thickness": [0],
    "iridescence_ior": [1.3],
}


def unit(v):
    return np.asarray(v) / np.linalg.norm(v, axis=-1, keepdims=True)


def shown(kernels, *arguments, **numbers):
    """What one sample shows, (3,), seen along ``view`` under a light from ``light`` of 1 lux."""
    return seen(kernels, *arguments, **numbers)[0]


def seen(
    kernels,
    normal,
    view,
    albedo,
    light=None,
    ambient=0.0,
    coat_normal=None,
    depth=1,
    tangent=(0, 0, 0, 0),
    **numbers,
):
    """What one sample shows, and which shares of light pass through it."""
    batch, textures = np.zeros(1, BATCH_RECORD), np.zeros(1, TEXTURE_BATCH)
    batch["count"] = 1
    for name, value in (("normal", normal), ("position", np.negative(view)), ("color", albedo)):
        batch[name][0] = np.reshape(value, (3, 1))
    textures["depth"][0] = depth
    textures["tangent"][0] = np.reshape(tangent, (4, 1))
    textures["shading_normal"][0] = np.reshape(
        normal if coat_normal is None else coat_normal, (3, 1)
    )
    lights = np.zeros(0 if light is None else 1, LIGHT)
    if light is not None:
        lights["kind"], lights["to_light"], lights["lux"] = DIRECTIONAL, light, 1.0
    kernels.physical(
        batch.view(np.uint8),
        {name: np.array(value, np.float32) for name, value in {**PLAIN, **numbers}.items()},
        lights.view(np.uint8),
        reach_of(lights),
        np.full(3, ambient, np.float32),
        np.array([0, 0, 0, 1], np.float32),
        textures.view(np.uint8),
    )
    return batch["color"][0, :, 0], textures["through"][0, :, 0]


def ggx(n, v, to, roughness):
    """Appendix B's D times V."""
    h, square = unit(to + v), max(roughness, 0.045) ** 4
    nl, nv, nh = n @ to, abs(n @ v), n @ h
    distribution = square / (np.pi * (nh * nh * (square - 1) + 1) ** 2)
    smith = nv * np.sqrt(square + (1 - square) * nl * nl)
    smith += nl * np.sqrt(square + (1 - square) * nv * nv)
    return distribution * 0.5 / smith if nh > 0 else 0.0


def charlie(n, v, to, roughness):
    """The sheen's D times V, as KHR_materials_sheen has them."""
    h, inverse = unit(to + v), 1 / roughness**2
    nl, nv = n @ to, abs(n @ v)
    distribution = (2 + inverse) * (1 - (n @ h) ** 2) ** (inverse / 2) / (2 * np.pi)
    return distribution / (4 * (nl + nv - nl * nv))


def directions(count, seed):
    """Normals, views and lights in front of them."""
    rng = np.random.default_rng(seed)
    n = unit(rng.normal(size=(count, 3)))
    v, to = unit(n + 0.7 * unit(rng.normal(size=(2, count, 3))))
    return n, v, to


@needs_gltf
@all_backends
def test_appendix_b(kernels):
    truth = json.loads((GLTF / "truth/brdf_truth.json").read_text())
    count, names = len(truth["normal"]), ("normal", "view", "baseColor", "light")
    for k in range(count):
        roughness = truth["roughness"][k]
        vectors = [truth[name][k] for name in names]
        got = shown(kernels, *vectors, metallic=[truth["metallic"][k]], roughness=[roughness])
        expected = np.array(truth["brdf_times_cos"][k])
        # The narrower the highlight, the more a normal that is rounded to float32 counts.
        allowed = 1e-5 + 1e-5 * expected + 4e-7 / max(roughness, 0.045) ** 2 * expected
        assert (abs(got - expected) <= allowed).all(), (k, got, expected)


@all_backends
def test_the_furnace_is_white(kernels):
    """Under light that is 1 all around, what absorbs nothing shows 1."""
    for angle in (0.05, 0.7, 1.2, 1.5):
        view = np.array([np.sin(angle), 0, np.cos(angle)])
        for metallic in (0, 0.25, 0.5, 1):
            for roughness in (0, 0.2, 0.5, 0.8, 1):
                look = {"metallic": [metallic], "roughness": [roughness]}
                for more in ({}, {"coat": [1], "coat_roughness": [0.5]}):
                    got = shown(kernels, (0, 0, 1), view, [1] * 3, ambient=1, **look, **more)
                    assert abs(got - 1).max() < 0.01, (angle, metallic, roughness, more, got)


@all_backends
def test_a_coat_hides_what_it_reflects(kernels):
    for n, v, to in zip(*directions(40, 1), strict=True):
        coat_normal = unit(n + [0.1, 0.2, 0])
        base = shown(kernels, n, v, (0.9, 0.5, 0.1), to, roughness=[0.4])
        coated = {"coat": [0.7], "coat_roughness": [0.3], "emissive": [0.1, 0.2, 0.3]}
        got = shown(kernels, n, v, (0.9, 0.5, 0.1), to, 0, coat_normal, roughness=[0.4], **coated)
        fresnel = 0.7 * (0.04 + 0.96 * (1 - abs(coat_normal @ v)) ** 5)
        light = ggx(coat_normal, v, to, 0.3) * max(coat_normal @ to, 0)
        expected = (base + [0.1, 0.2, 0.3]) * (1 - fresnel) + fresnel * light
        assert np.allclose(got, expected, rtol=2e-5, atol=1e-5)


@all_backends
def test_sheen_adds_and_dims(kernels):
    for n, v, to in zip(*directions(40, 2), strict=True):
        sheen = np.array([0.3, 0.2, 0.1])
        base = shown(kernels, n, v, (0.9, 0.5, 0.1), to, roughness=[0.9])
        got = shown(
            kernels, n, v, (0.9, 0.5, 0.1), to, roughness=[0.9], sheen=sheen, sheen_roughness=[0.4]
        )
        added = got - sheen * charlie(n, v, to, 0.4) * (n @ to)
        kept = added / base
        assert np.allclose(kept, kept[0], rtol=1e-4) and 0.7 < kept[0] < 1


@all_backends
def test_what_is_neither_shown_nor_absorbed_passes(kernels):
    """The furnace of glass: what it shows, and what passes of light that is 1, are 1."""
    for angle in (0.05, 0.7, 1.2, 1.5):
        view = np.array([np.sin(angle), 0, np.cos(angle)])
        for roughness in (0, 0.3, 1):
            for transmission in (0.3, 1):
                look = {"roughness": [roughness], "transmission": [transmission]}
                for more in ({}, {"coat": [1]}, {"sheen": [0.4] * 3, "sheen_roughness": [0.5]}):
                    args = kernels, (0, 0, 1), view, [1] * 3, None, 1
                    own, passing = seen(*args, **look, **more)
                    assert abs(own + passing - 1).max() < 0.01, (angle, roughness, more)
                    assert 0 < passing.max() <= 1


@all_backends
def test_transmittance_of_glass(kernels):
    """Base colour, what Fresnel leaves, and Beer's and Lambert's law, in float64."""
    for n, v, to in zip(*directions(40, 3), strict=True):
        albedo, depth, transmission = np.array([0.9, 0.5, 0.1]), 0.7, 0.8
        left = np.array([0.1, 0.5, 0.9]) ** (1.5 * depth)
        volume = {"thickness": [1.5], "absorption": np.log2([0.1, 0.5, 0.9]), "depth": depth}
        look = {"metallic": [0.25], "roughness": [0], "transmission": [transmission]}
        own, passing = seen(kernels, n, v, albedo, to, **look, **volume)
        clear = seen(kernels, n, v, albedo, to, **look)[1]
        assert np.allclose(passing, clear * left, rtol=1e-5)
        # Very smooth, a lobe is Schlick's term, but for the table between its nodes.
        fresnel = 0.04 + 0.96 * (1 - abs(n @ v)) ** 5
        assert np.allclose(clear, albedo * (1 - fresnel) * transmission * 0.75, rtol=2e-3)
        opaque = seen(kernels, n, v, albedo, to, **{**look, "transmission": [0]})[0]
        shine = seen(kernels, n, v, albedo, to, **{**look, "transmission": [1]})[0]
        mixed = shine * transmission + opaque * (1 - transmission)
        assert np.allclose(own, mixed, rtol=1e-5, atol=1e-6)


@all_backends
def test_nothing_comes_from_behind(kernels):
    behind = shown(kernels, (0, 0, 1), unit([0, 1, 1]), [1] * 3, unit([0, 0, -1]), coat=[1])
    assert (behind == 0).all()


@all_backends
@pytest.mark.parametrize("ior", [1.0, 1.5, 2.4])
def test_reflectance_is_what_is_seen_from_above(kernels, ior):
    """A smooth black surface mirrors F0 of light all around."""
    f0 = ((1 - ior) / (1 + ior)) ** 2
    got = shown(
        kernels, (0, 0, 1), (0, 0, 1), [0] * 3, ambient=1, roughness=[0], reflectance=[f0] * 3
    )
    assert np.allclose(got, f0, atol=2e-3)
