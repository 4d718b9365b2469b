"""What drawings keep from view to view is made again once anything in the scene has changed."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.drawings import line_drawing

CAMERA = e3d.PerspectiveCamera(0.9), e3d.look_at((3.0, 2.0, 4.0), (0.0, 0.0, 0.0))


def scene_of(rng):
    scene = e3d.Scene()
    shared = e3d.box((1.0, 0.7, 0.4))
    for mesh in (shared, e3d.torus(0.5, 0.2), shared):
        scene.add(mesh, translation=rng.uniform(-0.5, 0.5, 3))
    return scene


def pieces(scene, **options):
    drawn = line_drawing(scene, CAMERA, size=(300, 300), **options)
    return [column.tolist() for column in drawn.pieces], drawn.parts


def move(scene):
    scene.nodes[1].translation = (0.3, 0.1, 0.2)


def stretch(scene):
    mesh = scene.nodes[0].object
    mesh.positions = mesh.positions * np.float32(1.5)


def smooth(scene):
    mesh = scene.nodes[2].object
    mesh.normals = np.tile(np.float32((0.0, 0.0, 1.0)), (len(mesh.positions), 1))


def conceal(scene):
    scene.nodes[0].visible = False


def rename(scene):
    scene.nodes[1].name = "another"


def add(scene):
    scene.add(e3d.icosphere(subdivisions=1), translation=(0.2, 0.4, 0.1))


@pytest.mark.parametrize("change", [move, stretch, smooth, conceal, rename, add])
@pytest.mark.parametrize("seed", range(3))
def test_changes_show(change, seed):
    changed = scene_of(np.random.default_rng(seed))
    before = pieces(changed)
    assert pieces(changed) == before
    change(changed)
    fresh = scene_of(np.random.default_rng(seed))
    change(fresh)
    after = pieces(changed)
    assert after == pieces(fresh) and after != before


def test_other_options_show():
    scene = scene_of(np.random.default_rng(9))
    for options in ({"crease_angle": 0.1}, {"intersections": False}, {"crease_angle": 3.0}, {}):
        assert pieces(scene, **options) == pieces(scene_of(np.random.default_rng(9)), **options)
