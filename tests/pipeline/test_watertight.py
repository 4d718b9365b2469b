"""Meshes without holes cover every pixel exactly once, whatever the order of anything."""

import itertools
import math

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d import linalg

SIZE = 128  # pixels a side; a power of two, so that clip space holds 1/256 pixel exactly
STEPS = 256 * SIZE


@pytest.fixture(params=e3d.backends())
def backend(request):
    return request.param


def jittered_grid(rng, cells):
    """Integer corners of a grid that reaches over the image, and its triangles."""
    ticks = np.linspace(-300, STEPS + 300, cells + 1).astype(int)
    corners = np.stack(np.meshgrid(ticks, ticks), axis=-1)
    room = (ticks[1] - ticks[0]) // 4
    corners[1:-1, 1:-1] += rng.integers(-room, room + 1, corners[1:-1, 1:-1].shape)
    snap = rng.random(corners.shape[:2]) < 0.3  # some on the centres of pixels
    snap[[0, -1]] = snap[:, [0, -1]] = False
    corners[snap] = corners[snap] // 256 * 256 + 128
    faces = []
    for row, column in itertools.product(range(cells), repeat=2):
        a = row * (cells + 1) + column
        b, c, d = a + 1, a + cells + 2, a + cells + 1
        halves = [(a, b, c), (a, c, d)] if rng.random() < 0.5 else [(a, b, d), (b, c, d)]
        faces.extend(halves)
    return [tuple(int(v) for v in corner) for corner in corners.reshape(-1, 2)], faces


def turn(a, b, c):
    """Twice the signed area of three integer points."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])


def split(rng, points, faces, times):
    """Put points into triangles, often close to an edge, so that slivers arise."""
    for _ in range(times):
        number = int(rng.integers(len(faces)))
        corners = [points[k] for k in faces[number]]
        weights = rng.dirichlet([0.3, 0.3, 0.3])
        inner = tuple(round(float(v)) for v in weights @ np.array(corners, float))
        sides = [turn(corners[k], corners[(k + 1) % 3], inner) for k in range(3)]
        if min(sides) > 0 or max(sides) < 0:  # strictly inside
            a, b, c = faces[number]
            points.append(inner)
            new = len(points) - 1
            faces[number] = (a, b, new)
            faces += [(b, c, new), (c, a, new)]


def clip_of(rng, points):
    """Clip positions of points in 1/256 pixel, at depth 0 and any distance."""
    ndc = np.array(points, float) / (STEPS / 2) - 1
    w = rng.uniform(0.2, 5, len(points))
    return np.stack([ndc[:, 0] * w, -ndc[:, 1] * w, 0 * w, w], axis=1).astype(np.float32)


@pytest.mark.parametrize("seed", range(6))
def test_random_meshes(backend, seed):
    """All at one depth, where the first in order wins: reversed, the same one must win."""
    rng = np.random.default_rng(seed)
    points, faces = jittered_grid(rng, int(rng.integers(1, 24)))
    split(rng, points, faces, 400)
    clip = clip_of(rng, points)
    faces = rng.permutation(np.array(faces))
    forward = e3d.rasterization.rasterize(clip, faces, (SIZE, SIZE), backend=backend)
    backward = e3d.rasterization.rasterize(clip, faces[::-1], (SIZE, SIZE), backend=backend)
    assert (forward.face_id >= 0).all(), "holes"
    assert (forward.depth == 0).all()
    assert np.array_equal(forward.face_id, len(faces) - 1 - backward.face_id), "twice"


@pytest.mark.parametrize("order", [(0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)])
def test_order_of_vertices(backend, order):
    """Random triangles at depths of their own: the same pixels in every order of their corners."""
    rng = np.random.default_rng(7)
    corners = rng.integers(-2000, STEPS + 2000, (150, 3, 2))
    corners[::3] = corners[::3] // 128 * 128
    clip = clip_of(rng, corners.reshape(-1, 2))
    clip[:, 2] = np.repeat(rng.permutation(150) / 200, 3).astype(np.float32) * clip[:, 3]
    faces = np.arange(450).reshape(-1, 3)
    plain = e3d.rasterization.rasterize(clip, faces, (SIZE, SIZE), backend=backend)
    turned = e3d.rasterization.rasterize(clip, faces[:, order], (SIZE, SIZE), backend=backend)
    assert np.array_equal(plain.face_id, turned.face_id)


def layers_color(count, backend):
    """What mode overdraw shows for so many layers."""
    scene = e3d.Scene()
    layer = e3d.primitives.quad((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0))
    for k in range(count):
        scene.add(layer, translation=(0, 0, k / 9))
    camera = (e3d.Camera(np.eye(4)), np.eye(4))
    return render(scene, camera, size=(1, 1), mode="overdraw", backend=backend).color[0, 0]


@pytest.mark.parametrize("mesh", [e3d.icosphere(2, 2), e3d.box(9), e3d.uv_sphere(2.5, (16, 8))])
def test_from_inside_a_closed_mesh(backend, mesh):
    """Turning inside a closed convex mesh, most of it behind the eye: one layer everywhere."""
    one = layers_color(1, backend)
    scene = e3d.Scene()
    scene.add(mesh)
    with Renderer((97, 61), backend=backend, threads=2) as renderer:
        for k in range(12):
            angle = 0.55 * k
            target = (math.cos(angle), 0.7 * math.sin(3 * angle), math.sin(angle))
            pose = e3d.look_at((0.1, -0.2, 0.15), target)
            for yfov in (0.7, 2.2):
                camera = e3d.PerspectiveCamera(yfov, znear=0.4, zfar=50)
                frame = renderer.render(scene, (camera, pose), mode="overdraw", cull="front")
                assert (frame.color == one).all()


def test_a_sheet_on_the_far_plane(backend):
    """Exactly at z_ndc = 1 it still shows, each pixel once."""
    sheet = e3d.plane((8, 8), 16)
    pose = linalg.rotation_x(math.pi / 2)  # faces the camera
    scene = e3d.Scene()
    scene.add(sheet, pose=pose)
    camera = e3d.OrthographicCamera(1, znear=0, zfar=4)
    frame = render(
        scene,
        (camera, linalg.translation((0, 0, 4))),
        size=(33, 29),
        mode="overdraw",
        backend=backend,
    )
    assert (frame.color == layers_color(1, backend)).all()
