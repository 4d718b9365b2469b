"""Motion is added, changed and removed as steps; copies move as their originals."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.editor import motion_commands as commands
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.motion_commands import SetMotions, added, removed
from engine3d.apps.editor.motion_copies import motions_in
from engine3d.apps.editor.node_commands import DeleteNodes, DuplicateNodes
from engine3d.apps.editor.scene_state import SceneState
from engine3d.model.scene.animation import Track


@pytest.fixture
def document():
    scene = e3d.Scene()
    scene.add(e3d.uv_sphere(), name="Sun", rotation=(0, 0, 0.6, 0.8))
    scene.add(e3d.uv_sphere(0.3), name="Earth", translation=(4, 1, 0))
    scene.add(e3d.uv_sphere(0.1), name="Moon", translation=(5, 1, 0))
    return SceneDocument(scene)


def put(document, motion, drag=None):
    command = SetMotions(document.animator, document.scene, added(motion), "Put", (motion.node,))
    return document.do(command, drag=drag)


def take(document, motion):
    command = SetMotions(document.animator, document.scene, removed(motion), "", (motion.node,))
    return document.do(command)


def solar(document):
    sun, earth, moon = document.scene.nodes
    put(document, commands.new_spin(sun, 0.0))
    put(document, commands.new_orbit(earth, sun, time=0.0, reach=1.0))
    put(document, commands.new_orbit(moon, earth, time=0.0, reach=1.0))
    return sun, earth, moon


def test_every_step_is_undone_and_done_again_to_the_bit(document):
    states = [SceneState(document.scene)]
    sun, earth, _ = document.scene.nodes
    for motion in (
        commands.new_spin(sun, 0.0),
        commands.new_orbit(earth, sun, time=0.0, reach=1.0),
        commands.new_path(sun, time=0.0, reach=2.0),
        commands.with_key(earth, None, 0.0),
    ):
        assert put(document, motion)
        states.append(SceneState(document.scene))
    assert take(document, motions_in(document.scene).spins[0])
    states.append(SceneState(document.scene))
    for state in states[-2::-1]:
        assert document.undo() and SceneState(document.scene) == state
    assert not document.is_modified
    for state in states[1:]:
        assert document.redo() and SceneState(document.scene) == state


def test_undo_restores_places_though_time_went_on_meanwhile(document):
    sun, earth, _ = document.scene.nodes
    put(document, commands.new_spin(sun, 0.0))
    put(document, commands.new_orbit(earth, sun, time=0.0, reach=1.0))
    before = earth.translation.tolist()
    document.animator.seek(1.3)
    assert earth.translation.tolist() != before
    document.undo()
    assert np.allclose(earth.translation, (4, 1, 0))
    assert not np.array_equal(sun.rotation, (0, 0, 0.6, 0.8))  # it still turns
    document.undo()
    assert sun.rotation.tolist() == [0, 0, 0.6, 0.8]


@pytest.mark.parametrize("time", [0.0, 1.3])
def test_new_motion_leaves_its_node_where_it_is(document, time):
    sun, earth, moon = document.scene.nodes
    document.animator.seek(time)
    put(document, commands.new_spin(sun, time))
    assert np.allclose(sun.rotation, (0, 0, 0.6, 0.8))
    put(document, commands.new_orbit(moon, earth, time=time, reach=1.0))
    assert np.allclose(moon.translation, (5, 1, 0))
    put(document, commands.new_orbit(earth, sun, time=time, reach=1.0))
    assert np.allclose(earth.translation, (4, 0, 0))  # the circle is level with the Sun
    put(document, commands.new_path(sun, time=time, reach=1.0))
    assert np.allclose(sun.translation, (0, 0, 0))


def test_solar_moves_and_is_saved(document, tmp_path):
    _, earth, moon = solar(document)
    path = tmp_path / "solar.e3d.json"
    assert document.moves and document.length == commands.USUAL_PERIOD and document.save(path)
    document.animator.seek(1.0)
    assert np.allclose(earth.translation, (0, 0, -4)) and np.allclose(moon.translation, (0, 0, -5))
    scene = e3d.load_scene(path)
    scene.animator.seek(1.0)
    assert [node.pose.tobytes() for node in scene.nodes] == [
        node.pose.tobytes() for node in document.scene.nodes
    ]


def test_a_kind_of_motion_is_held_once_a_node(document):
    sun = document.scene.nodes[0]
    for _ in range(3):
        put(document, commands.new_spin(sun, 0.0))
    assert len(motions_in(document.scene).spins) == 1


def test_an_orbit_about_what_moves_with_it_is_refused(document):
    sun, earth, _ = document.scene.nodes
    put(document, commands.new_orbit(earth, sun, time=0.0, reach=1.0))
    before = SceneState(document.scene)
    assert not put(document, commands.new_orbit(sun, earth, time=0.0, reach=1.0))
    assert "'Sun' cannot circle" in document.console.entries[-1].text
    assert SceneState(document.scene) == before and document.history.position == 1


def test_a_drag_is_one_step(document):
    sun = document.scene.nodes[0]
    first = commands.new_spin(sun, 0.0)
    put(document, first)
    for period in (3.0, 2.0, 1.0):
        spin = type(first)(sun, first.rotation, first.axis, period, 0.0)
        put(document, spin, drag="a")
    assert document.history.position == 2
    document.undo()
    assert motions_in(document.scene).spins == (first,)
    document.redo()
    assert motions_in(document.scene).spins[0].period == 1.0


# Keyframes


def test_keys_are_set_replaced_moved_and_deleted(document):
    sun = document.scene.nodes[0]
    track = commands.with_key(sun, None, 1.0)
    for time, x in ((0.0, 5.0), (2.0, 7.0), (1.5, 6.0)):
        sun.translation = (x, 0, 0)
        track = commands.with_key(sun, track, time)
    assert track.times.tolist() == [0, 1, 1.5, 2]
    assert track.translations[:, 0].tolist() == [5, 0, 6, 7]
    sun.translation = (9, 0, 0)
    track = commands.with_key(sun, track, 1.5)
    assert track.times.tolist() == [0, 1, 1.5, 2] and track.translations[2, 0] == 9
    assert commands.key_near(track, 1.5) == 2 and commands.key_near(track, 1.6) is None
    track = commands.with_key_at(track, 1, 9.0)  # not past the next one
    assert 1.4 < track.times[1] < 1.5
    track = commands.with_key_at(track, 3, 3.0)
    assert track.times[3] == 3.0
    assert not commands.with_repeat(track, False).repeat
    for count in (3, 2, 1):
        track = commands.without_key(track, 0)
        assert len(track.times) == len(track.rotations) == len(track.scales) == count
    assert commands.without_key(track, 0) is None


def test_keys_keep_to_the_parts_that_the_track_moves(document):
    sun = document.scene.nodes[0]
    track = Track(sun, [0, 1], [(0, 0, 0), (1, 0, 0)], None, None, True)
    sun.translation = (3, 0, 0)
    track = commands.with_key(sun, track, 2.0)
    assert track.rotations is None and track.translations[-1].tolist() == [3, 0, 0]


def test_the_time_settles_in_the_first_repetition(document):
    sun, earth, _ = solar(document)
    document.animator.seek(9.0)
    place = earth.translation.tolist()
    document.settle()
    assert document.animator.time == 1.0 and np.allclose(earth.translation, place)
    put(document, commands.with_repeat(commands.with_key(sun, None, 6.0), False))
    document.animator.seek(50.0)
    document.settle()
    assert document.animator.time == document.length == 12.0


# Copies


def test_copies_move_as_their_originals(document):
    _, earth, moon = solar(document)
    before = SceneState(document.scene)
    document.do(DuplicateNodes(document.scene, [earth, moon]))
    copies = document.selection.nodes
    held = motions_in(document.scene).orbits
    assert {orbit.node: orbit.about.name for orbit in held[2:]} == {
        copies[0]: "Sun",
        copies[1]: "Earth 2",
    }
    assert held[3].about is copies[0]
    after = SceneState(document.scene)
    document.undo()
    assert SceneState(document.scene) == before
    document.redo()
    assert SceneState(document.scene) == after
    document.animator.seek(1.0)
    assert np.allclose(copies[1].translation, moon.translation)


def test_a_deleted_node_moves_again_after_undo(document):
    sun, earth, moon = solar(document)
    document.do(DeleteNodes(document.scene, [earth]))
    document.animator.seek(1.0)
    document.undo()
    document.animator.seek(2.0)
    assert np.allclose(moon.translation, (-5, 0, 0))
