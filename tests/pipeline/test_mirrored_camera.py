"""A camera whose pose mirrors (negative determinant) shows what the same camera shows, reversed."""

import numpy as np
import pytest
from plain_picture import render

import engine3d as e3d

SIZE = (96, 64)
#: What is mirrored along x shows the same in these, left and right exchanged.
OUTPUTS = ("color", "depth", "face_id", "object_id", "world_normal", "barycentric")


def scene_of_a_kind():
    """Closed meshes, one of which its own node mirrors, one with two sides, under a light."""
    scene = e3d.Scene(background=(20, 24, 30))
    ball = e3d.uv_sphere(0.6, (24, 12))
    scene.add(ball, translation=(-0.9, 0.1, 0))
    scene.add(ball, translation=(0.7, 0, 0.2), scale=(-0.8, 0.8, 0.8), rotation=(0, 0.3, 0, 0.95))
    open_box = e3d.primitives.quad((-2, -1, -1), (2, -1, -1), (2, 1, -1), (-2, 1, -1))
    open_box.materials = [e3d.Material(two_sided=True, color=e3d.linear(0.3, 0.7, 0.5))]
    scene.add(open_box, rotation=(0, 1, 0, 0), translation=(0, 0, -2))
    scene.add(e3d.DirectionalLight((-0.4, -0.6, -0.7)))
    return scene


def poses():
    pose = e3d.look_at((0.4, 0.7, 3.2), (0, 0, 0))
    mirrored = pose.copy()
    mirrored[:3, 0] = -mirrored[:3, 0]
    return pose, mirrored


@pytest.mark.parametrize(
    "options", [{}, {"cull": "front"}, {"normals": "flat"}, {"mode": "normal"}]
)
@pytest.mark.parametrize("backend", e3d.backends())
def test_it_shows_the_same_reversed(backend, options):
    """Snapped positions and ties may differ by a sample at the edges, never a side of a face."""
    scene, camera = scene_of_a_kind(), e3d.PerspectiveCamera(0.8)
    options = {"backend": backend, "size": SIZE, "outputs": OUTPUTS, **options}
    plain, mirrored = (render(scene, (camera, pose), **options) for pose in poses())
    same = plain.face_id == mirrored.face_id[:, ::-1]
    assert same.mean() > 0.98 and (plain.face_id >= 0).mean() > 0.3
    for name in ("world_normal", "depth"):
        a, b = getattr(plain, name)[same], getattr(mirrored, name)[:, ::-1][same]
        assert np.allclose(a, b, atol=1e-3), name
    if options.get("mode") != "normal":  # which is in view space
        difference = plain.color.astype(int) - mirrored.color[:, ::-1]
        assert np.abs(difference[same]).max() <= 2


@pytest.mark.parametrize("outputs", [("color",), ("color", "object_id", "instance_id", "face_id")])
def test_picking_finds_what_shows(outputs):
    scene, camera = scene_of_a_kind(), e3d.PerspectiveCamera(0.8)
    known = ("object_id", "face_id")
    for pose in poses():
        frame = render(scene, (camera, pose), size=SIZE, outputs=outputs)
        shown = render(scene, (camera, pose), size=SIZE, outputs=known)
        picked = 0
        for y in range(5, SIZE[1], 9):
            for x in range(3, SIZE[0], 7):
                hit, number = scene.pick(frame, x, y), shown.object_id[y, x]
                assert (hit is None) == (number < 0), (x, y)
                if hit is not None:
                    assert (hit.node.id, hit.face_id) == (number, shown.face_id[y, x])
                    picked += 1
        assert picked > 20
