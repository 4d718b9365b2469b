"""What the core makes of a picture: faces, levels, borders, against integrals in float64."""

import hashlib
import json

import numpy as np
import pytest
from environments.oracles import directions, levels_of, looked_up, prefiltered
from shared_corpus import SHARED

import engine3d as e3d

TRUTH = SHARED / "gltf" / "truth" / "env_truth.json"
ENVIRONMENTS = SHARED / "gltf" / "env"


def some_normals(count=40):
    normals = np.random.default_rng(1).normal(size=(count, 3))
    return normals / np.linalg.norm(normals, axis=1)[:, None]


def smooth_picture():
    """A few wide lights over a gradient."""
    d, _ = directions(256, 128)
    light = 0.3 + 0.2 * d[:, :, 1]
    for toward, color in (((1, 1, 0), 6.0), ((-1, 0.2, 0.5), 3.0)):
        unit = np.array(toward) / np.linalg.norm(toward)
        light = light + color * np.maximum(d @ unit, 0) ** 40
    return light[:, :, None] * np.array([1.0, 0.8, 0.6])


@pytest.mark.parametrize("value", [1.0, 0.7, 1 / 3, 1234.5, 1e-6])
def test_a_constant_environment_stays_constant(value):
    for level in levels_of(np.full((32, 64, 3), value)):
        assert np.abs(level[:, :, :, :3] / np.float32(value) - 1).max() <= 1e-6
        assert (level[:, :, :, 3] == 0).all()


def test_any_number_of_threads_gives_the_same_bytes():
    pixels = np.random.default_rng(0).random((64, 128, 3)) ** 9 * 100
    one = levels_of(pixels, 1)
    for threads in (2, 3, 8):
        for level, other in zip(one, levels_of(pixels, threads), strict=True):
            assert level.tobytes() == other.tobytes()


def test_every_machine_gives_the_same_bytes():
    digest = hashlib.sha256()
    for level in levels_of(e3d.Environment.studio().pixels, 2):
        digest.update(level.tobytes())
    assert digest.hexdigest()[:16] == "65c9f56e6771c812"


@pytest.mark.parametrize("number", range(1, 9))
def test_levels_are_the_integrals_of_the_lobe(number):
    pixels, normals = smooth_picture(), some_normals()
    expected = prefiltered(pixels, number / 8, normals)
    got = looked_up(levels_of(pixels)[number], normals)
    assert np.abs(got / expected - 1).max() < 0.01


def test_the_first_level_is_the_picture():
    pixels = smooth_picture()
    d, _ = directions(256, 128)
    some = d[::5, ::7].reshape(-1, 3)
    got = looked_up(levels_of(pixels)[0], some)
    assert np.abs(got - pixels[::5, ::7].reshape(-1, 3)).max() < 0.12


@pytest.mark.parametrize("row", [0, 1, 16, 33, 63])
def test_small_suns_keep_their_light(row):
    pixels = np.zeros((64, 128, 3))
    pixels[row, 37] = 1e5
    d, area = directions(128, 64)
    sun, energy = d[row, 37], 1e5 * area[row, 37]
    normals = some_normals(200)
    expected = np.maximum(normals @ sun, 0) * energy / np.pi
    got = looked_up(levels_of(pixels)[8], normals)[:, 0]
    assert np.abs(got - expected).max() < 0.03 * energy / np.pi


def test_faces_meet_at_their_edges():
    """Both sides of each edge, and all three of each corner, show the same there."""
    rng = np.random.default_rng(2)
    level = levels_of(rng.random((64, 128, 3)))[0]
    edges = np.array([(1, 1, t) for t in rng.uniform(-0.95, 0.95, 50)])
    for turn in range(3):
        for sign in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            d = np.roll(edges * (*sign, 1), turn, axis=1)
            first, second = np.roll([1e-9, 0, 0], turn), np.roll([0, 1e-9, 0], turn)
            one = looked_up(level, d * (1 + first))
            other = looked_up(level, d * (1 + second))
            assert np.abs(one - other).max() < 1e-6


def test_what_is_no_light_counts_as_none():
    pixels = np.full((32, 64, 3), 0.5, np.float32)
    clean = pixels.copy()
    for place, value in enumerate((np.nan, np.inf, -np.inf, -3.0)):
        pixels[5, place * 9] = value
        clean[5, place * 9] = 0.0
    for level, other in zip(levels_of(pixels), levels_of(clean), strict=True):
        assert level.tobytes() == other.tobytes()
    assert np.isfinite(levels_of(np.full((2, 4, 3), 3e38))[3]).all()


@pytest.mark.parametrize("size", [(1, 1), (1, 2), (2, 1), (3, 5), (1, 300), (300, 1), (7, 9)])
def test_pictures_of_any_size(size):
    levels = levels_of(np.random.default_rng(0).random((*size, 3)))
    assert all(np.isfinite(level).all() and level[..., :3].min() >= 0 for level in levels)


@pytest.mark.skipif(not TRUTH.exists(), reason="there is no shared/gltf/truth")
@pytest.mark.parametrize("name", ["old_depot", "spiaggia_di_mondello_1k"])
def test_against_integrals_of_real_pictures(name):
    truth = json.loads(TRUTH.read_text("utf-8"))["files"][f"open/env/{name}.hdr"]
    environment = e3d.Environment.load(ENVIRONMENTS / f"{name}.hdr")
    levels, d = levels_of(environment.pixels), np.array(truth["directions"])
    irradiance = looked_up(levels[8], d) / truth["irradiance_over_pi"]
    assert np.abs(irradiance - 1).max() < 0.01
    assert np.abs(irradiance - 1).mean() < 0.003
    for roughness, expected in truth["prefiltered"].items():
        got = looked_up(levels[round(float(roughness) * 8)], d) / expected
        # A picture of 128 x 64 pixels is sharper than its faces: there, pixels have edges.
        assert np.abs(got - 1).mean() < (0.03 if name == "old_depot" else 0.005)
