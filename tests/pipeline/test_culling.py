"""Culling leaves out what nobody sees and nothing else: every output, with it and without."""

import numpy as np
import pytest

import engine3d as e3d

OUTPUTS = ("color", "depth", "ndc_depth", "object_id", "instance_id", "triangle_id", "barycentric")
EYES = [(0.5, 0.3, 9), (6, 5, 7), (0.2, 0.1, 0.4), (-3, 0, -2), (0, 14, 0.1)]


def crowd():
    """Spheres in a grid, walls between them, lines and points at the picture's edge."""
    scene = e3d.Scene(background=(10, 20, 30))
    axis = np.arange(-2.0, 2.5)
    places = np.stack(np.meshgrid(axis, axis, axis), -1).reshape(-1, 3)
    poses = np.c_[places, np.full(len(places), 0.45)].astype(np.float32)
    scene.add(e3d.InstancedMesh(e3d.uv_sphere(1.0, (24, 16)), poses))
    for x in (-1.5, 1.5):
        scene.add(e3d.box((0.05, 4, 4)), translation=(x, 0, 0))
    corners = np.float32([[-9, 0, 0], [9, 0.1, 0], [0, -9, 0], [0, 9, 0]])
    scene.add(e3d.Mesh(corners, np.empty((0, 3), int), lines=[[0, 1], [2, 3]], points=[0, 1, 2, 3]))
    return scene


def pictures(renderer, scene, eye, **options):
    camera = e3d.PerspectiveCamera(yfov=0.9, znear=0.05, zfar=60)
    pose = e3d.look_at(eye, (0, 0, 0), (0, 1, 0.01))
    frame = renderer.render(
        scene, (camera, pose), outputs=OUTPUTS, line_width=9, point_size=30, **options
    )
    return frame.stats, [getattr(frame, name).tobytes() for name in OUTPUTS]


@pytest.mark.parametrize("samples", [1, 4])
@pytest.mark.parametrize("threads", [1, 2, 3])
def test_no_culling_changes_a_byte(samples, threads):
    scene = crowd()
    with e3d.Renderer(200, 150, threads=threads, samples=samples) as renderer:
        for eye in EYES:
            stats, expected = pictures(renderer, scene, eye, culling="none")
            assert stats["clusters_culled"] == stats["clusters_occluded"] == 0
            for culling in ("frustum", "all", "always", "always"):  # the last one remembers
                stats, got = pictures(renderer, scene, eye, culling=culling)
                assert got == expected, culling
                assert (stats["rounds"] > 1) >= (culling == "always")


def test_a_turning_camera_loses_nothing():
    """What the last frame showed is drawn first, and is not what this one shows."""
    scene = crowd()
    with e3d.Renderer(160, 120) as renderer:
        for angle in np.linspace(0, 6, 25):
            eye = (5 * np.sin(angle), np.cos(3 * angle), 5 * np.cos(angle))
            _, expected = pictures(renderer, scene, eye, culling="none")
            assert pictures(renderer, scene, eye, culling="always")[1] == expected


def test_what_is_hidden_is_left_out():
    """Behind a wall that fills the view almost nothing is set up."""
    scene = crowd()
    scene.add(e3d.quad(), translation=(0, 0, 5), scale=40)
    with e3d.Renderer(320, 240) as renderer:
        stats, _ = pictures(renderer, scene, EYES[0], culling="none")
        for _ in range(2):
            fewer, _ = pictures(renderer, scene, EYES[0], culling="always")
        assert fewer["clusters_occluded"] > 0.9 * stats["clusters"]
        assert fewer["triangles_setup"] < 0.05 * stats["triangles_setup"]


def test_culling_camera_leaves_out_what_is_not_in_its_frustum():
    scene = e3d.Scene()
    seen = scene.add(e3d.icosphere(), translation=(0, 0, -6))
    scene.add(e3d.icosphere(), translation=(0, 0, 6))
    above = e3d.PerspectiveCamera(yfov=1.0), e3d.look_at((0, 25, 0.1), (0, 0, 0), (0, 1, 0))
    ahead = e3d.PerspectiveCamera(yfov=1.0), e3d.look_at((0, 0, 0), (0, 0, -1), (0, 1, 0))
    with e3d.Renderer(100, 100) as renderer:
        everything = renderer.render(scene, above, outputs=("object_id",)).object_id
        frozen = renderer.render(scene, above, outputs=("object_id",), culling_camera=ahead)
    assert len(np.unique(everything)) == 3
    assert np.array_equal(frozen.object_id, np.where(everything == seen.id, seen.id, -1))
