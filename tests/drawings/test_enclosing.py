"""Bodies that enclose a volume: which they are, and that their backs hide nothing of their own."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d._native import drawing as native
from engine3d.apps.drawings.mesh_edges import mesh_edges
from engine3d.drawings import line_drawing
from engine3d.model.geometry.derived import arrays_of

BOX = e3d.box((2.0, 1.0, 3.0))
SHAPES = (BOX, e3d.torus(1.0, 0.4), e3d.cylinder(), e3d.icosphere(subdivisions=2))


def enclosing(positions, faces):
    return mesh_edges(arrays_of(e3d.Mesh(positions, faces)), 0.6).enclosing


def flipped(faces):
    return np.ascontiguousarray(faces[:, ::-1])


@pytest.mark.parametrize("mesh", SHAPES)
def test_closed_bodies_enclose_a_volume(mesh):
    assert (enclosing(mesh.positions, mesh.faces) == 1).all()
    assert (enclosing(mesh.positions, flipped(mesh.faces)) == -1).all()


@pytest.mark.parametrize("mesh", SHAPES)
def test_open_bodies_and_those_of_both_windings_do_not(mesh):
    assert (enclosing(mesh.positions, mesh.faces[1:]) == 0).all()
    mixed = np.concatenate([flipped(mesh.faces[:1]), mesh.faces[1:]])
    assert (enclosing(mesh.positions, mixed) == 0).all()


def test_each_body_of_a_mesh_has_its_own_side():
    ball = SHAPES[3]
    faces = np.concatenate([BOX.faces, flipped(ball.faces) + len(BOX.positions)])
    found = enclosing(np.concatenate([BOX.positions, ball.positions + 5.0]), faces)
    assert (found[: len(BOX.faces)] == 1).all() and (found[len(BOX.faces) :] == -1).all()


def test_bodies_that_share_an_edge_count_as_open():
    one = e3d.box((1.0, 1.0, 1.0))
    places = np.concatenate([one.positions, one.positions + np.float32((1.0, 1.0, 0.0))])
    faces = np.concatenate([one.faces, one.faces + len(one.positions)])
    assert (enclosing(places, faces) == 0).all()


def bow_tie():
    """A prism over a quadrilateral whose sides cross: its small part is inside out."""
    profile = [(0.0, 0.0), (4.0, 2.0), (4.0, 0.0), (0.0, 1.0)]
    places = [(x, y, z) for z in (0.0, 1.0) for x, y in profile]
    sides = [(i, (i + 1) % 4) for i in range(4)]
    walls = [face for i, j in sides for face in ((i, j, j + 4), (i, j + 4, i + 4))]
    return e3d.Mesh(places, [*walls, (4, 5, 6), (4, 6, 7), (0, 2, 1), (0, 3, 2)])


def test_a_body_that_runs_through_itself_counts_as_open():
    mesh = bow_tie()
    assert (enclosing(mesh.positions, mesh.faces) == 0).all()


def crowd(rng):
    """Return a scene of closed and open meshes that run through each other, some mirrored."""
    scene = e3d.Scene()
    for _ in range(7):
        mesh = SHAPES[rng.integers(4)]
        faces = (mesh.faces, flipped(mesh.faces), mesh.faces[3:])[rng.integers(3)]
        pose = np.eye(4)
        pose[:3, :3] = np.linalg.qr(rng.normal(size=(3, 3)))[0] * rng.uniform(0.4, 1.0, 3)
        pose[:3, 3] = rng.uniform(-1.5, 1.5, 3)
        scene.add(e3d.Mesh(mesh.positions, faces), pose=pose)
    return scene


@pytest.mark.parametrize("eye", [None, (0.0, 0.0, 0.3), (0.5, 0.2, -0.4)], ids=str)
@pytest.mark.parametrize("seed", range(6))
def test_backs_of_closed_bodies_change_no_piece(monkeypatch, seed, eye):
    def drawn():
        scene = crowd(np.random.default_rng(seed))
        camera = None
        if eye is not None:  # within the box of everything, perhaps within a body
            pose = np.eye(4)
            pose[:3, 3] = eye
            camera = e3d.PerspectiveCamera(yfov=1.2, znear=0.01), pose
        return line_drawing(scene, camera, size=(500, 500)).pieces

    found = drawn()
    monkeypatch.setattr(
        native, "find_enclosing", lambda _, faces, __: np.zeros(len(faces), np.int8)
    )
    wanted = drawn()
    assert len(found.ends) == len(wanted.ends)
    assert eye is not None or len(found.ends) > 50
    assert (found.hidden == wanted.hidden).all() and (found.kinds == wanted.kinds).all()
    assert np.abs(found.ends - wanted.ends).max(initial=0.0) < 1e-9
