"""The shading of TinyRenderer's pictures, against its rules in NumPy; PyBullet is not needed."""

import itertools

import numpy as np
import pytest
from compat import pybullet_rules as rules

import engine3d as e3d
from engine3d._native import pybullet as native
from engine3d.compat.pybullet._forms import BOX, CAPSULE, CYLINDER, PLANE, SPHERE, made_form
from engine3d.compat.pybullet._light import Light

PERSPECTIVE = (False, -0.2020202, -1.020202)
PARALLEL = (True, -1.5, -0.3)


def picture(seed, lens, *, shadows, size=None):
    """Return random arrays as `shade` takes them, with values that lie at every border."""
    random = np.random.default_rng(seed)
    height, width = size or random.integers(1, 60, 2)
    normals = random.normal(size=(height, width, 3))
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    shown = random.integers(-1, 6, (height, width)).astype(np.int32)
    depths = random.uniform(-1, 1, (height, width)).astype(np.float32)
    depths[shown < 0] = np.inf
    held = {
        "own": random.integers(0, 256, (height, width, 4), np.uint8),
        "normals": normals.astype(np.float32),
        "depths": depths,
        "shown": shown,
        "masks": np.array([7, 1 << 24, (3 << 24) + 5, 0, 2, -1], np.int32),
        "light": np.array(
            [*e3d.linalg.normalize(random.normal(size=3)), *random.uniform(0, 2, 6)], np.float32
        ),
        "lens": np.array(lens, np.float32),
    }
    if shadows:
        nearest = random.uniform(-1, 1, (height, width)).astype(np.float32)
        nearest[random.random((height, width)) < 0.3] = np.inf
        positions = random.normal(size=(height, width, 3)).astype(np.float32)
        positions[random.random((height, width)) < 0.1] = 0
        clip = random.normal(size=16).astype(np.float32)
        clip[[12, 13, 14, 15]] = (0, 0, -1, 0) if seed % 3 else clip[12:]
        held |= {"positions": positions, "shadows": nearest, "clip": clip}
    return held


def shade(held):
    shape = held["shown"].shape
    out = {
        "colors": np.full((*shape, 4), 99, np.uint8),
        "window_depths": np.full(shape, 99, np.float32),
        "shown_masks": np.full(shape, 99, np.int32),
    }
    native.shade(**held, **out)
    return out.values()


@pytest.mark.parametrize("lens", [PERSPECTIVE, PARALLEL])
@pytest.mark.parametrize("shadows", [False, True])
def test_pictures_follow_the_rules(lens, shadows):
    for seed in range(40):
        size = (133, 150) if seed == 0 else None  # by several threads
        held = picture(seed, lens, shadows=shadows, size=size)
        colors, depths, masks = shade(held)
        light = held["light"]
        parts = light[:3], light[3:6], *light[6:]
        share = 1.0
        if shadows:
            share = rules.share_of_light(held["positions"], held["shadows"], held["clip"], lens)
        expected = rules.shaded(held["own"], held["normals"], parts, share)
        is_there = (held["shown"] >= 0) & (held["shown"] < len(held["masks"]) - 1)
        expected[~is_there] = 255
        np.testing.assert_array_equal(colors, expected)
        np.testing.assert_array_equal(depths, rules.window_depths(held["depths"], lens))
        table = held["masks"]
        np.testing.assert_array_equal(masks, np.where(is_there, table[held["shown"]], -1))


def test_wrong_arrays_are_refused():
    sound = picture(3, PERSPECTIVE, shadows=True)
    for name in sound:
        held = {**sound, name: sound[name][:-1]}
        if name == "masks":
            continue  # of any length
        with pytest.raises((e3d.InvalidArgumentError, IndexError)):
            shade(held)


@pytest.mark.parametrize("kind", [SPHERE, BOX, CYLINDER, CAPSULE])
@pytest.mark.parametrize("sizes", [(0.3, 0.2, 0.5), (2.0, 0.05, 0.01), (0.02, 0.4, 3.0)])
def test_forms_are_closed_and_turned_outwards(kind, sizes):
    mesh = made_form(kind, sizes)
    points = mesh.positions[mesh.faces].astype(np.float64)
    volume = np.einsum("ij,ij->i", points[:, 0], np.cross(points[:, 1], points[:, 2])).sum() / 6
    length, radius = sizes[:2]
    low, high = {
        SPHERE: (3.0 * length**3, 4.19 * length**3),
        BOX: (0.999 * np.prod(sizes), 1.001 * np.prod(sizes)),
        CYLINDER: (2.2 * radius**2 * length, 3.2 * (radius + 0.002) ** 2 * (length + 0.004)),
        CAPSULE: (2.2 * radius**2 * length, 3.2 * (radius + 0.002) ** 2 * (length + 2.1 * radius)),
    }[kind]
    assert low <= volume <= high
    corners = np.unique(mesh.positions, axis=0, return_inverse=True)[1].ravel()[mesh.faces]
    edges = [tuple(e) for face in corners for e in itertools.pairwise((*face, face[0]))]
    assert sorted(edges) == sorted((b, a) for a, b in edges)  # each with its twin, the other way


def test_planes_have_one_square_of_checks_a_metre():
    mesh = made_form(PLANE, ())
    assert mesh.bounds.tolist() == [[-128, -128, 0], [128, 128, 0]]
    assert np.ptp(mesh.uvs, axis=0).tolist() == [128, 128]


def test_a_light_keeps_what_a_call_does_not_say():
    light = Light().changed(ambient=0.1, direction=(0, 0, 5)).changed(ambient=None, shadow=True)
    assert (light.ambient, light.shadow, light.unit.tolist()) == (0.1, True, [0, 0, 1])
    view = Light().view()
    np.testing.assert_allclose(view[:3, :3] @ view[:3, :3].T, np.eye(3), atol=1e-12)
    eye = -view[:3, :3].T @ view[:3, 3]
    np.testing.assert_allclose(eye, Light().unit * 2.0, atol=1e-12)
