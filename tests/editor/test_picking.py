"""What pixels point at: nodes, faces, materials; lights and cameras by where they stand."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.editor.picking import enclosed, pick

OUTPUTS = ("color", "object_id", "instance_id", "face_id")
SIZE = (120, 90)


@pytest.fixture(scope="module")
def picture():
    scene = e3d.Scene()
    red, blue = e3d.Material(name="red"), e3d.Material(name="blue")
    wall = e3d.primitives.quad((-3, -2, 0), (3, -2, 0), (3, 2, 0), (-3, 2, 0))
    wall.materials, wall.material_ids = [red, blue], [0, 1]
    scene.add(wall, name="wall")
    scene.add(e3d.InstancedMesh(e3d.box(0.5), [(-1, 0, 1, 1), (1, 0, 1, 1)]), name="crowd")
    lamp = scene.add(e3d.PointLight(), translation=(0, 1, 2), name="lamp")
    scene.add(e3d.PointLight(), translation=(0, 0, 20), name="behind")
    hidden = scene.add(e3d.PointLight(), translation=(0, -1, 2), name="hidden")
    hidden.visible = False
    camera = scene.add(e3d.PerspectiveCamera(), pose=e3d.look_at((0, 0, 6), (0, 0, 0)))
    frame = e3d.render(scene, camera, size=SIZE, outputs=OUTPUTS)
    return scene, frame, lamp


def pixel(frame, point):
    return tuple(np.floor(frame.project(point)[0]).astype(int).tolist())


def test_faces_are_found_with_their_materials(picture):
    scene, frame, _ = picture
    found = {
        pick(scene, frame, *pixel(frame, point)).material.name for point in ((2, -1, 0), (-2, 1, 0))
    }
    assert found == {"red", "blue"}
    crowd = pick(scene, frame, *pixel(frame, (1, 0, 1.25)))
    assert crowd.node.name == "crowd" and crowd.hit.instance_id == 1
    assert crowd.material is crowd.node.object.mesh.materials[0]
    assert pick(scene, frame, 0, 0) is None


def test_lights_are_found_near_their_places(picture):
    scene, frame, lamp = picture
    x, y = pixel(frame, (0, 1, 2))
    assert pick(scene, frame, x, y) == (lamp, None, None)
    assert pick(scene, frame, x + 6, y, reach=8).node is lamp
    assert pick(scene, frame, x + 6, y, reach=4).node.name == "wall"
    assert pick(scene, frame, *pixel(frame, (0, -1, 2))).node.name == "wall"


def test_a_rectangle_encloses_what_shows_in_it(picture):
    scene, frame, _ = picture

    def names(first, last):
        return [node.name for node in enclosed(scene, frame, first, last)]

    assert names((-50, -50), (500, 500)) == ["wall", "crowd", "lamp"]
    assert names((500, 500), (-50, -50)) == ["wall", "crowd", "lamp"]
    x, y = pixel(frame, (0, 1, 2))
    assert names((x - 3, y - 3), (x + 3, y + 3)) == ["wall", "lamp"]
    assert names((0, 0), (3, 3)) == names((-9, -9), (-3, -3)) == []
