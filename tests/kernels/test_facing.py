"""face_away: what it leaves out has no triangle that shows, whatever snapping does to it (R9).

Patches of triangles, most of them bent, some of a sample or less, get cones in 64 bits; where their
corners are on the screen the transform kernel tells.
"""

import functools

import numpy as np
import pytest
from kernels.harness import all_backends, kernels_of
from kernels.layouts import CLUSTER, FACING, VERTICES, viewport_of

from engine3d._native import rasterizer

TRIANGLES = 40
PATCHES = 16  # a scene
SCENES = 250
WIDTH, HEIGHT = 640, 480


def random_rotation(rng):
    q = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    return q * np.sign(np.linalg.det(q))


def random_patch(rng, scale):
    """(triangles, 3, 3): on a piece of a bowl, before the camera, or beside it."""
    at, side = rng.uniform(-0.6, 0.6, (TRIANGLES, 1, 2)), rng.choice([0.01, 0.1, 0.4])
    angles = rng.uniform(0, 7, (TRIANGLES, 1)) + [0, 2, 4]
    round_ones = np.stack([np.cos(angles), np.sin(angles)], axis=2)
    flat = at + side * round_ones * [1, rng.choice([0.05, 0.5, 1])]
    bent = rng.choice([0, 0.1, 0.5]) * (flat**2).sum(axis=2, keepdims=True)
    place = rng.normal(0, 1, 3) + [0, 0, -rng.choice([2, 6, 30])]
    return (np.concatenate([flat, bent], axis=2) @ random_rotation(rng) + place) * scale


def cluster_of(patch):
    """Its box, and a cone that holds its normals."""
    cluster = np.zeros((), CLUSTER)
    corners = patch.reshape(-1, 3)
    edges = patch - np.roll(patch, 1, axis=1)
    normals = np.cross(edges[:, 1], edges[:, 2])
    doubled = np.linalg.norm(normals, axis=1)
    normals /= doubled[:, None]
    cluster["lo"], cluster["hi"] = corners.min(axis=0), corners.max(axis=0)
    axis = normals.mean(axis=0)
    cluster["axis"] = axis / np.linalg.norm(axis)
    cluster["cosine"] = min((normals @ cluster["axis"].astype(float)).min(), 1) - 1e-6
    cluster["radius"] = 0.501 * np.linalg.norm(cluster["hi"] - cluster["lo"])
    if cluster["cosine"] > 0.1:
        longest = np.linalg.norm(edges, axis=2).max(axis=1)
        cluster["altitude"] = 0.999 * (doubled / longest).min()
    return cluster


def random_camera(rng, scale):
    """A clip matrix for things of about this size, float32."""
    near, far = 0.05 * scale, 100 * scale
    x, y = rng.uniform(0.5, 3, 2) * rng.choice([-1, 1], 2)
    rows = [(x, 0, 0, 0), (0, y, 0, 0), (0, 0, -(far + near) / (far - near), 0), (0, 0, -1, 0)]
    clip = np.array(rows, float)
    clip[2, 3] = -2 * far * near / (far - near)
    clip[:2, 3] = rng.normal(0, 0.2, 2) * scale
    return clip.astype(np.float32)


def facing_of(clip, viewport):
    facing, linear = np.zeros((), FACING), clip[[0, 1, 3]].astype(float)
    lengths = np.linalg.norm(clip[[0, 1, 3, 2], :3].astype(float), axis=1)
    determinant = np.linalg.det(linear[:, :3])
    facing["eye"] = np.linalg.solve(linear[:, :3], -linear[:, 3])
    facing["sign"] = 1 if determinant < 0 else -1
    facing["length"] = lengths
    screen = float(viewport["scale_x"][0]) * float(viewport["scale_y"][0])
    facing["scale"] = abs(determinant) / lengths[:3].prod() * screen
    return facing


def areas_of(kernels, patch, clip, viewport):
    """Twice the area of each triangle on the screen, and whether all of them are in the frustum."""
    corners, stride = patch.reshape(-1, 3).astype(np.float32), 128
    planes = np.zeros((3, stride), np.float32)
    planes[:, : len(corners)] = corners.T
    out = np.zeros(1, VERTICES)
    arguments = (planes.ravel(), stride, len(corners), clip.ravel(), viewport.view(np.uint8), False)
    kernels.transform(*arguments, out.view(np.uint8))
    x, y = (out[name][0, : len(corners)].reshape(-1, 3).astype(np.int64) for name in ("sx", "sy"))
    areas = (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0])
    return areas, (out["code"][0, : len(corners)] == 0).all()


def bytes_of(struct):
    return np.ascontiguousarray(struct).reshape(-1).view(np.uint8)


@functools.cache
def scenes():
    """Each scene's patches, their clusters, the clip matrix, its facing and the viewport."""
    return list(random_scenes())


def random_scenes():
    rng = np.random.default_rng(11)
    viewport = viewport_of(WIDTH, HEIGHT)
    for _ in range(SCENES):
        scale = rng.choice([1, 1e-9, 1e7])
        patches = [random_patch(rng, scale) for _ in range(rng.integers(1, PATCHES + 1))]
        clip = random_camera(rng, scale)
        clusters = np.array([cluster_of(patch) for patch in patches])
        yield patches, clusters, clip, facing_of(clip, viewport), viewport


@all_backends
def test_what_faces_away(kernels):
    """None of it has an area of the other sign; nearly all that is surely away is found."""
    found = missed = 0
    for patches, clusters, clip, facing, viewport in scenes():
        drop = 1 if len(patches) % 2 else -1
        arguments = bytes_of(facing), drop, clip.ravel(), viewport.view(np.uint8)
        away = kernels.face_away(bytes_of(clusters), *arguments)
        assert away >> len(patches) == 0
        for k, patch in enumerate(patches):
            alone = kernels.face_away(bytes_of(clusters[k]), *arguments)
            assert alone == away >> k & 1
            areas, inside = areas_of(kernels, patch, clip, viewport)
            assert not alone or (areas * drop >= 0).all()
            sure = inside and clusters["cosine"][k] > 0.99 and (areas * drop > 256 * 256).all()
            found += alone
            missed += sure and not alone
    assert found > 150 and missed < 0.1 * found


@all_backends
def test_nothing_is_left_out_where_it_is_not_asked_for(kernels):
    """No side is culled; the eye is not known; no cone; numbers that are none."""
    for _, clusters, clip, facing, viewport in scenes():
        screen = clip.ravel(), viewport.view(np.uint8)
        assert kernels.face_away(bytes_of(clusters), bytes_of(facing), 0, *screen) == 0
        unknown = facing.copy()
        unknown["sign"] = 0
        assert kernels.face_away(bytes_of(clusters), bytes_of(unknown), 1, *screen) == 0
        for name, value in (("altitude", 0), ("radius", np.nan), ("lo", np.inf), ("axis", np.nan)):
            none = clusters.copy()
            none[name] = value
            assert kernels.face_away(bytes_of(none), bytes_of(facing), 1, *screen) == 0


@pytest.mark.parametrize("name", [name for name in rasterizer.BACKENDS if name != "scalar"])
def test_backends_agree(name):
    """So that counts of clusters do."""
    kernels, portable = kernels_of(name), kernels_of("portable")
    for _, clusters, clip, facing, viewport in scenes():
        arguments = bytes_of(facing), -1, clip.ravel(), viewport.view(np.uint8)
        expected = portable.face_away(bytes_of(clusters), *arguments)
        assert kernels.face_away(bytes_of(clusters), *arguments) == expected
