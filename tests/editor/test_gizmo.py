"""Nodes that are moved: steps, turns and scales about a point, the ground."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.editor import gizmo
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.node_commands import MoveNodes, in_world


def test_steps():
    assert gizmo.snapped([0.26, -0.6, 3], 0.25).tolist() == [0.25, -0.5, 3]
    assert gizmo.snapped(-0.1, 0.5).tobytes() == np.zeros(()).tobytes()  # no minus zero
    assert gizmo.snapped(0.26, None) == 0.26 == gizmo.snapped(0.26, 0)
    assert gizmo.steps_of_turn(90) == math.pi / 2
    with pytest.raises(e3d.InvalidArgumentError):
        gizmo.snapped(1, -1)


def test_the_world_turns_and_grows_about_a_point():
    point = (1, 2, 3)
    for matrix in (gizmo.turned((0, 1, 0), 0.7, point), gizmo.scaled((2, 3, 4), point)):
        np.testing.assert_allclose(matrix[:3] @ (*point, 1), point)
    np.testing.assert_allclose(gizmo.scaled(2, point)[:3] @ (2, 2, 3, 1), (3, 2, 3))


def test_nodes_move_to_the_ground():
    document = SceneDocument()
    scene = document.scene
    table = scene.add(e3d.box((4, 1, 4)), translation=(0, 0.5, 0), name="table")
    lift = scene.add(translation=(0, 2, 0), scale=2.0)
    cup = scene.add(e3d.box(0.5), parent=lift, translation=(0.26, 1.2, 0))
    far = scene.add(e3d.icosphere(1, 2), translation=(9, 3, 0))
    empty = scene.add(translation=(0, 7, 0))
    document.do(MoveNodes(scene, [cup, lift, far, empty], gizmo.on_ground(scene)))
    assert cup.bounds[0, 1] == pytest.approx(1) and lift.translation[1] != 2
    assert far.bounds[0, 1] == pytest.approx(0, abs=1e-6) and far.translation[0] == 9
    assert empty.translation.tolist() == [0, 7, 0]
    assert all(node.visible for node in scene.nodes)
    document.do(MoveNodes(scene, [table], gizmo.on_ground(scene)))
    assert table.translation.tolist() == [0, 0.5, 0]
    while document.undo():
        pass
    assert cup.translation.tolist() == [0.26, 1.2, 0] and lift.translation[1] == 2


def test_a_turn_in_the_world_is_a_step():
    document = SceneDocument()
    node = document.scene.add(translation=(2, 0, 0))
    matrix = gizmo.turned((0, 0, 1), math.pi / 2, (1, 0, 0))
    document.do(MoveNodes(document.scene, [node], in_world(matrix)))
    np.testing.assert_allclose(node.translation, (1, 1, 0), atol=1e-12)
