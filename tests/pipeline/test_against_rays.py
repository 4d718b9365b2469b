"""Whole pictures against rays cast in float64: what is nearest, where, and how far away.

Near edges and crossings of surfaces snapping decides, so these pixels are left out.
"""

import numpy as np
import pytest
from plain_picture import render

import engine3d as e3d

WIDTH, HEIGHT = 96, 64
FOCAL = 60.0
ZNEAR, ZFAR = 0.5, 30.0
MARGIN = 0.03  # of barycentrics
CAMERA = (
    e3d.IntrinsicsCamera(FOCAL, FOCAL, WIDTH / 2, HEIGHT / 2, znear=ZNEAR, zfar=ZFAR),
    np.eye(4),
)


@pytest.fixture(params=e3d.backends())
def backend(request):
    return request.param


def rays():
    """(H * W, 3) directions through the centres of the pixels, with z = -1."""
    x, y = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    flat = [(x - WIDTH / 2) / FOCAL, (HEIGHT / 2 - y) / FOCAL, -np.ones_like(x)]
    return np.stack(flat, axis=-1).reshape(-1, 3)


def cast(triangles):
    """Nearest triangle and distance along the axis for each ray, and where that is certain.

    A point of the triangle's plane is v0·b0 + v1·b1 + v2·b2 = ray·d with Σb = 1, so the inverse of
    the matrix of the vertices gives b / d.
    """
    over_distance = np.linalg.solve(triangles.transpose(0, 2, 1)[:, None], rays()[None, :, :, None])
    over_distance = over_distance[..., 0]  # (triangles, rays, 3)
    inverse = over_distance.sum(axis=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = 1 / inverse
        share = over_distance / inverse[..., None]
    visible = (distance > ZNEAR) & (distance < ZFAR)
    inside = visible & (share > 0).all(axis=-1)
    distance = np.where(inside, distance, np.inf)
    nearest = distance.argmin(axis=0)
    best = distance.min(axis=0)
    return (
        np.where(np.isfinite(best), nearest, -1),
        best,
        certain(share, 1 / inverse, best, nearest),
    )


def certain(share, distance, best, nearest):
    """Rays that pass no edge of a triangle which could be seen, and no crossing of two."""
    edge = (np.abs(share).min(axis=-1) < MARGIN) & (share > -MARGIN).all(axis=-1)
    plane = (np.abs(distance - ZNEAR) < 0.03) | (np.abs(distance - ZFAR) < 1)
    close = (distance > 0.8 * ZNEAR) & (distance < 1.1 * best + 0.1)
    doubtful = close & (edge | (plane & (share > -MARGIN).all(axis=-1)))
    other = np.arange(len(share))[:, None] != nearest
    inside = (share > -MARGIN).all(axis=-1)
    ties = other & inside & (np.abs(distance - best) < 0.02 * best)
    return ~(doubtful | ties).any(axis=0)


@pytest.mark.parametrize("seed", range(4))
def test_random_triangles_around_the_eye(backend, seed):
    """Many pass through the near plane and beside the eye; some are behind it."""
    rng = np.random.default_rng(seed)
    triangles = rng.uniform(-6, 6, (14, 3, 3)) + [0, 0, -2]
    expected, distance, sure = cast(triangles)
    mesh = e3d.Mesh(triangles.reshape(-1, 3), np.arange(42).reshape(-1, 3))
    scene = e3d.Scene()
    scene.add(mesh)
    outputs = ("face_id", "depth", "world_position")
    size = (WIDTH, HEIGHT)
    frame = render(scene, CAMERA, size=size, cull="none", outputs=outputs, backend=backend)
    seen = frame.face_id.ravel()
    assert sure.mean() > 0.5 and (expected[sure] >= 0).mean() > 0.3
    assert np.array_equal(seen[sure], expected[sure])
    hit = sure & (expected >= 0)
    np.testing.assert_allclose(frame.depth.ravel()[hit], distance[hit], rtol=2e-3)
    position = rays()[hit] * distance[hit][:, None]
    error = np.abs(frame.world_position.reshape(-1, 3)[hit] - position).max(axis=-1)
    assert np.median(error) < 1e-3 and error.max() < 0.1


def layered_scene(rng, count):
    """Triangles with ranges of depth that do not overlap, in random order."""
    depth = -2.0 - 0.2 * np.arange(count)
    triangles = rng.uniform(-5, 5, (count, 1, 3)) + rng.uniform(-1.5, 1.5, (count, 3, 3))
    triangles[..., 2] = depth[:, None] + rng.uniform(-0.09, 0.09, (count, 3))
    triangles = triangles[rng.permutation(count)]
    scene = e3d.Scene()
    positions = triangles.reshape(-1, 3)
    scene.add(e3d.Mesh(positions, np.arange(3 * count).reshape(-1, 3)))
    return scene


@pytest.mark.parametrize("seed", range(3))
def test_the_painter_agrees_where_nothing_intersects(backend, seed):
    scene = layered_scene(np.random.default_rng(seed), 60)
    outputs = ("color", "face_id", "depth", "ndc_depth")
    frames = [
        render(
            scene,
            CAMERA,
            size=(WIDTH, HEIGHT),
            backend=backend,
            cull="none",
            mode="random",
            hidden_surfaces=hidden_surfaces,
            outputs=outputs,
        )
        for hidden_surfaces in ("zbuffer", "painter")
    ]
    assert len(np.unique(frames[0].face_id)) > 20
    for name in outputs:
        assert getattr(frames[0], name).tobytes() == getattr(frames[1], name).tobytes(), name
