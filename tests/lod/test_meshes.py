"""Meshes at their places: the level that the nearest point needs, without flicker, one id."""

import math

import numpy as np
import pytest
from plain_picture import render

import engine3d as e3d
from engine3d.errors import InvalidArgumentError

SIZE = (320, 240)
CAMERA = e3d.PerspectiveCamera(yfov=1.0, znear=0.1, zfar=4000.0)
FOCAL = 120 / math.tan(0.5)  # pixels of a unit at distance 1
ERRORS = (0.0, 0.1, 0.5)


def levels(places=((0, 0, 0), (0, 0, -100), (0, 0, -400))):
    rows = []
    for detail, error in zip((3, 2, 1), ERRORS, strict=True):
        ball = e3d.icosphere(1.0, detail)
        meshes = [e3d.Mesh(ball.positions + np.float32(place), ball.faces) for place in places]
        rows.append((meshes, error))
    return rows


def look(z):
    return e3d.look_at((0, 0, z), (0, 0, -1000))


def expected(z, place, limit=1.0):
    distance = z - place - 1.0  # of the box
    return sum(error * FOCAL / distance <= limit for error in ERRORS[1:])


def test_the_nearest_point_decides():
    balls = e3d.detail.DetailedMeshes(levels(), hysteresis=0.0)
    scene = e3d.Scene()
    group = balls.add_to(scene, name="balls")
    assert len(group.children) == 3
    for z in (10.0, 40.0, 80.0, 200.0, 60.0, 5.0):
        before = balls.level.tolist()
        changed = balls.update(CAMERA, look(z), SIZE)
        assert balls.level.tolist() == [expected(z, place) for place in (0, -100, -400)]
        assert changed == (balls.level.tolist() != before)
        for place, level in zip(group.children, balls.level, strict=True):
            assert [node.visible for node in place.children] == [k == level for k in range(3)]
            assert place.children[level].object is balls.levels[level][0][place.id // 4]
    assert not balls.update(CAMERA, e3d.look_at((0, 0, 0.5), (0, 0, -9)), SIZE)  # inside


def test_a_group_that_is_scaled():
    balls = e3d.detail.DetailedMeshes(levels(), hysteresis=0.0)
    other = e3d.detail.DetailedMeshes(levels(), hysteresis=0.0)
    scene = e3d.Scene()
    balls.add_to(scene, parent=scene.add(scale=3.0, translation=(0, 0, 7)))
    balls.update(CAMERA, look(3.0 * 30 + 7), SIZE)
    other.update(CAMERA, look(30.0), SIZE)
    assert balls.level.tolist() == other.level.tolist() != [0, 0, 0]


def test_levels_do_not_flicker_at_the_limit():
    balls = e3d.detail.DetailedMeshes(levels([(0, 0, 0)]), hysteresis=0.3)
    limit = 1.0 + ERRORS[1] * FOCAL
    assert not any(balls.update(CAMERA, look(limit + 0.1 * (-1) ** k), SIZE) for k in range(10))
    assert balls.update(CAMERA, look(1.0 + ERRORS[1] * FOCAL / 0.69), SIZE)
    assert not balls.update(CAMERA, look(limit + 0.1), SIZE) and balls.level.tolist() == [1]
    assert balls.update(CAMERA, look(limit - 0.1), SIZE) and balls.level.tolist() == [0]


def test_ids_and_picking():
    balls = e3d.detail.DetailedMeshes(levels())
    scene = e3d.Scene()
    group = balls.add_to(scene)
    outputs = ("object_id", "instance_id", "face_id")
    view = CAMERA, look(30.0)
    fine = render(scene, view, size=SIZE, outputs=outputs)
    assert balls.update(*view, SIZE)
    coarse = render(scene, view, size=SIZE, outputs=outputs)
    assert len(set(balls.level)) == 3
    assert set(np.unique(coarse.object_id)) == {-1, group.children[0].id}
    assert (fine.object_id == coarse.object_id).mean() > 0.99
    hit = scene.pick(coarse, 160, 120)
    assert hit.node is group.children[0] and abs(hit.position[2] - 1.0) < 0.1


def test_nothing_and_errors():
    assert not e3d.detail.DetailedMeshes([((), 0.0)]).update(CAMERA, look(3.0), SIZE)
    ball = e3d.icosphere(1.0, 1)
    for wrong in ([], [([ball], 1.0)], [([ball], 0.0), ([], 1.0)], [(["ball"], 0.0)], [ball], 3):
        with pytest.raises(InvalidArgumentError):
            e3d.detail.DetailedMeshes(wrong)
    for options in ({"pixels": 0}, {"hysteresis": 1.0}):
        with pytest.raises(InvalidArgumentError):
            e3d.detail.DetailedMeshes([([ball], 0.0)], **options)
    balls, scene = e3d.detail.DetailedMeshes([([ball], 0.0)]), e3d.Scene()
    balls.add_to(scene)
    with pytest.raises(InvalidArgumentError, match="before"):
        balls.add_to(scene)
