"""An array repeats nodes in rows, and is undone to the bit."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.editor.array_command import MOST_PLACES, ArrayNodes, usual_steps
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.scene_state import SceneState


@pytest.fixture
def ball():
    scene = e3d.Scene()
    parent = scene.add(name="parent", rotation=(0.0, 0.6, 0.0, 0.8), scale=2.0)
    ball = scene.add(e3d.uv_sphere(0.5), name="ball", parent=parent, translation=(1, 2, 3))
    scene.add(e3d.box(), name="below", parent=ball, translation=(0, 1, 0))
    return ball


def test_copies_stand_in_rows_along_the_axes_of_the_parent(ball):
    scene = ball.scene
    document = SceneDocument(scene)
    document.do(ArrayNodes(scene, [ball], (2, 3, 2), (10.0, 20.0, 30.0)))
    names = {"ball", *(f"ball {number}" for number in range(2, 13))}
    balls = [node for node in scene.nodes if node.name in names]
    assert {node.name for node in balls} == names
    assert {tuple(node.translation) for node in balls} == {
        (1.0 + x, 2.0 + y, 3.0 + z) for x in (0, 10) for y in (0, 20, 40) for z in (0, 30)
    }
    assert all(node.object is ball.object and node.parent is ball.parent for node in balls)
    assert [len(node.children) for node in balls] == [1] * 12
    assert len(document.selection) == 11 and document.history.position == 1


def test_it_is_undone_and_done_again_to_the_bit(ball):
    scene = ball.scene
    e3d.Animator(scene).spin(ball, period=4.0)
    document, before = SceneDocument(scene), SceneState(scene)
    document.do(ArrayNodes(scene, [ball], (3, 1, 1), (1.5, 0.0, 0.0)))
    after = SceneState(scene)
    document.undo()
    assert SceneState(scene) == before != after
    document.redo()
    assert SceneState(scene) == after


@pytest.mark.parametrize("counts", [(1, 1, 1), (0, 5, 5), (MOST_PLACES, 2, 1), (-2, -3, 1)])
def test_nothing_and_too_many_are_refused(ball, counts):
    with pytest.raises(e3d.InvalidArgumentError, match="2 to 10000 places"):
        ArrayNodes(ball.scene, [ball], counts, (1, 1, 1))


def test_the_usual_distances_leave_room_between_copies():
    scene = e3d.Scene()
    flat = scene.add(e3d.plane((2.0, 4.0)))
    assert usual_steps([flat]) == (3.0, 6.0, 6.0)
    assert usual_steps([scene.add()]) == (1.0, 1.0, 1.0)
    assert np.all(np.array(usual_steps([flat, scene.add(e3d.box(8.0))])) >= 8.0)
