"""A scene of four things, one of them cut off by the picture's edge and one hidden in part."""

import pytest

import engine3d as e3d
from engine3d.datasets import Sample

WIDTH, HEIGHT = 60, 40


@pytest.fixture
def make_samples():
    with e3d.Renderer((WIDTH, HEIGHT), samples=4, threads=1) as renderer:
        yield lambda writer, count=1: (
            sample(renderer, writer.outputs, index) for index in range(count)
        )


def sample(renderer, outputs, index):
    scene = e3d.Scene(background=(30, 60, 90))
    scene.add(e3d.plane((4, 4)), translation=(0, -0.6, 0), name="ground")
    turn = e3d.linalg.quaternion_from_axis_angle((1, 2, 3), 0.4 + index)
    box = scene.add(e3d.box(0.8), translation=(-1.3, 0, 0), rotation=turn, name="box")
    near = scene.add(e3d.icosphere(0.4, 2), translation=(0.2, 0, 0.8), name="near")
    far = scene.add(e3d.icosphere(0.6, 2), translation=(0.1, 0, -0.8), name="far")
    group = scene.add(None, name="pair", translation=(0.9, 0.1, 0))
    for k in (0, 1):
        scene.add(e3d.box(0.2), translation=(0.2 * k, 0.2 * k, 0), parent=group)
    camera = e3d.PerspectiveCamera(0.7, znear=0.5, zfar=20.0)
    pose = e3d.look_at((0.3, 0.9, 3.0), (0, 0, 0))
    frame = renderer.render(scene, (camera, pose), outputs=outputs)
    labels = {far: "ball", near: "ball", box: "box", group: "pair"}
    return Sample(f"p{index}", index, frame, scene, camera, pose, renderer, labels, seed=40 + index)
