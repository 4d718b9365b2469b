"""Things that hold nothing yet are drawn, saved and asked about as nothing."""

import warnings

import numpy as np
import pytest

import engine3d as e3d

SIZE = 24, 16
NOWHERE = np.zeros((0, 4, 4))
NO_POINTS = np.zeros((0, 3), np.float32)
EMPTY = {
    "no instances": lambda: e3d.InstancedMesh(e3d.box(), NOWHERE),
    "no colored instances": lambda: e3d.InstancedMesh(e3d.box(), NOWHERE, colors=NO_POINTS),
    "instances of nothing": lambda: e3d.InstancedMesh(e3d.Mesh(NO_POINTS), [np.eye(4)]),
    "no vertices": lambda: e3d.Mesh(NO_POINTS),
    "no faces": lambda: e3d.Mesh(NO_POINTS, np.zeros((0, 3), np.int32)),
    "no lines": lambda: e3d.Mesh(NO_POINTS, lines=np.zeros((0, 2), np.int32)),
    "no points": lambda: e3d.Mesh(NO_POINTS, points=np.zeros(0, np.int32)),
    "a face without area": lambda: e3d.Mesh(np.zeros((3, 3)), [[0, 1, 2]]),
    "a line without length": lambda: e3d.Mesh(np.zeros((2, 3)), lines=[[0, 1]]),
}
ASKED = {
    "bounds": lambda scene, path: scene.bounds,
    "rays": lambda scene, path: scene.raycast((0, 0, 5), (0, 0, -1)),
    "balls": lambda scene, path: scene.overlap_sphere((0, 0, 0), 1.0),
    "measures": lambda scene, path: e3d.measuring.measure(scene),
    "faults": lambda scene, path: e3d.measuring.check(scene),
    "drawing": lambda scene, path: e3d.drawings.line_drawing(scene),
    "sheet": lambda scene, path: e3d.sheets.contact_sheet(scene, views="top", size=(320, 240)),
    "glTF": lambda scene, path: e3d.save_scene(scene, path / "empty.glb"),
    "scene file": lambda scene, path: e3d.save_scene(scene, path / "empty.e3d.json"),
}


@pytest.fixture(autouse=True)
def quiet():
    """That nothing shows is told, too."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", e3d.Engine3DWarning)
        yield


@pytest.mark.parametrize("options", [{}, {"edges": True}, {"wireframe": "overlay"}], ids=str)
@pytest.mark.parametrize("make", EMPTY.values(), ids=EMPTY)
def test_empty_things_are_drawn_alone(make, options):
    assert e3d.render(make(), size=SIZE, **options).color.shape == (16, 24, 4)


@pytest.mark.parametrize("make", list(EMPTY.values())[:7], ids=list(EMPTY)[:7])
def test_empty_things_change_no_picture(make):
    scene = e3d.Scene()
    scene.add(e3d.box())
    before = e3d.render(scene, size=SIZE).color
    scene.add(make())
    assert np.array_equal(e3d.render(scene, size=SIZE).color, before)


@pytest.mark.parametrize("ask", ASKED.values(), ids=ASKED)
def test_all_can_be_asked_of_empty_things(ask, tmp_path):
    for make in EMPTY.values():
        scene = e3d.Scene()
        scene.add(make())
        ask(scene, tmp_path)


def test_instances_may_come_later():
    scene = e3d.Scene()
    crowd = e3d.InstancedMesh(e3d.box(), NOWHERE)
    scene.add(crowd)
    renderer = e3d.Renderer(SIZE)
    renderer.render(scene)
    crowd.poses = [np.eye(4)]
    later = renderer.render(scene).color
    assert np.array_equal(later, e3d.render(scene, size=SIZE).color)
    assert later.std() > 0
