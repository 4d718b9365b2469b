"""Normals by crease angle: against fans found in Python, and on shapes that one knows."""

import itertools
import math

import numpy as np
import pytest
from plain_picture import render

import engine3d as e3d
from engine3d.errors import InvalidArgumentError
from engine3d.model.geometry.creases import CREASE_ANGLE, SMOOTH
from engine3d.model.primitives import box, cylinder, icosphere


def welded(mesh, **options):
    """The mesh with its places alone, and without normals."""
    places, faces = np.unique(
        mesh.positions[mesh.faces].reshape(-1, 3), axis=0, return_inverse=True
    )
    return e3d.Mesh(places, faces.reshape(-1, 3), **options)


def face_normals(mesh):
    a, b, c = (mesh.positions.astype(np.float64)[mesh.faces[:, k]] for k in range(3))
    areas = np.cross(b - a, c - a)
    return areas / np.linalg.norm(areas, axis=1, keepdims=True)


def corner_normals_by_hand(mesh, angle):
    """Of each corner the normal of its fan: triangles of one winding, joined edge by edge."""
    units, faces = face_normals(mesh), mesh.faces
    corners = [(f, k) for f in range(len(faces)) for k in range(3)]
    found = np.zeros((len(faces), 3, 3))
    for place in range(len(mesh.positions)):
        here = [(f, k) for f, k in corners if faces[f, k] == place]
        fans = [{corner} for corner in here]
        for (f, _), (g, _) in itertools.combinations(here, 2):
            common = set(faces[f]) & set(faces[g])
            if len(common) == 2 and units[f] @ units[g] >= math.cos(angle):
                one, two = (next(fan for fan in fans if h in [c[0] for c in fan]) for h in (f, g))
                if one is not two:
                    fans.remove(two)
                    one |= two
        for fan in fans:
            total = np.zeros(3)
            for f, k in fan:
                p, q, r = mesh.positions.astype(np.float64)[np.roll(faces[f], -k)]
                u, v = q - p, r - p
                cosine = u @ v / np.linalg.norm(u) / np.linalg.norm(v)
                total += math.acos(np.clip(cosine, -1, 1)) * units[f]
            for f, k in fan:
                found[f, k] = total / np.linalg.norm(total)
    return found


@pytest.mark.parametrize("degrees", [10, 35, 60])
def test_the_fans_of_a_rough_surface(degrees):
    ball = welded(icosphere(1.0, 2))
    bumps = 0.8 + 0.4 * np.random.default_rng(3).random((len(ball.positions), 1))
    mesh = e3d.Mesh(ball.positions * bumps, ball.faces, crease_angle=math.radians(degrees))
    creased = mesh.with_creases()
    wanted = corner_normals_by_hand(mesh, math.radians(degrees))
    assert np.abs(creased.normals[creased.faces] - wanted).max() < 1e-6
    # Only what has several normals at a place is split, and into no more vertices than it has.
    at = np.concatenate([mesh.faces.reshape(-1, 1), wanted.reshape(-1, 3).round(5)], axis=1)
    assert len(creased.positions) == len(np.unique(at, axis=0))
    assert (creased.positions[: len(mesh.positions)] == mesh.positions).all()
    assert (creased.positions[creased.faces] == mesh.positions[mesh.faces]).all()


def test_a_cylinder_is_round_and_its_rims_are_sharp():
    mesh = welded(cylinder(1.0, 2.0), crease_angle=CREASE_ANGLE)
    creased = mesh.with_creases()
    normals = creased.normals[creased.faces]
    side = np.abs(face_normals(mesh)[:, 1]) < 0.5
    assert np.abs(normals[side][..., 1]).max() < 1e-6
    radial = mesh.positions[mesh.faces[side]] * (1, 0, 1)
    assert (np.einsum("fkc,fkc->fk", normals[side], radial) > 0.999).all()
    assert np.abs(np.abs(normals[~side][..., 1]) - 1).max() < 1e-6


def test_a_box_has_flat_sides():
    mesh = welded(box((1, 2, 3)), crease_angle=CREASE_ANGLE)
    creased = mesh.with_creases()
    assert len(mesh.positions) == 8
    assert len(creased.positions) == 24
    assert np.abs(creased.normals[creased.faces] - face_normals(mesh)[:, None]).max() < 1e-7
    assert len(creased.edges()) == len(mesh.edges())


def test_what_has_no_creases_is_the_smooth_surface_to_the_bit():
    mesh = welded(icosphere(1.0, 3), crease_angle=CREASE_ANGLE)
    creased = mesh.with_creases()
    assert creased.normals.tobytes() == mesh.normals.tobytes()
    assert (creased.faces == mesh.faces).all()


def test_a_triangle_turned_over_is_no_crease():
    mesh = welded(icosphere(1.0, 3), crease_angle=CREASE_ANGLE)
    turned = mesh.faces.copy()
    turned[::3] = turned[::3, ::-1]
    mixed = e3d.Mesh(mesh.positions, turned, crease_angle=CREASE_ANGLE).with_creases()
    normals = mixed.normals[mixed.faces]
    normals[::3] = -normals[::3, ::-1]
    assert np.abs(normals - mesh.normals[mesh.faces]).max() < 1e-6


def test_vertices_at_one_place_are_one_point_whatever_they_carry():
    mesh = welded(icosphere(1.0, 3))
    apart = e3d.Mesh(
        mesh.positions[mesh.faces].reshape(-1, 3),
        np.arange(3 * len(mesh.faces)).reshape(-1, 3),
        uvs=np.random.default_rng(1).random((3 * len(mesh.faces), 2)),
        crease_angle=CREASE_ANGLE,
    ).with_creases()
    assert len(apart.positions) == 3 * len(mesh.faces)
    assert np.abs(apart.normals[apart.faces] - mesh.normals[mesh.faces]).max() < 1e-6


def test_the_diagonal_of_a_bent_polygon_is_no_crease():
    positions = [(0, 0, 0), (1, 0, 1), (1, 1, 0), (0, 1, 1)]
    faces, hidden = [(0, 1, 2), (0, 2, 3)], [(True, True, False), (False, True, True)]
    bent = e3d.Mesh(positions, faces, crease_angle=CREASE_ANGLE)
    assert len(bent.with_creases().positions) == 6
    bent.edge_visible = hidden
    assert len(bent.with_creases().positions) == 4


def test_triangles_without_area_split_nothing():
    mesh = welded(icosphere(1.0, 2))
    slivers = np.stack([mesh.faces[:, 0], mesh.faces[:, 0], mesh.faces[:, 1]], axis=1)
    both = e3d.Mesh(mesh.positions, np.concatenate([slivers, mesh.faces]), crease_angle=0.9)
    assert len(both.with_creases().positions) == len(mesh.positions)
    alone = e3d.Mesh(mesh.positions, slivers, crease_angle=0.9).with_creases()
    assert not alone.normals.any()


def test_many_triangles_at_one_point():
    count = 5000
    angles = np.arange(count) * (2 * math.pi / count)
    ring = np.stack([np.cos(angles), np.zeros(count), np.sin(angles)], axis=1)
    k = np.arange(count)
    faces = np.stack([np.zeros(count, int), 1 + (k + 1) % count, 1 + k], axis=1)
    order = np.random.default_rng(0).permutation(count)
    cone = e3d.Mesh(np.concatenate([[(0, 1, 0)], ring]), faces[order], crease_angle=CREASE_ANGLE)
    creased = cone.with_creases()
    assert len(creased.positions) == count + 1
    assert np.abs(creased.normals[0] - (0, 1, 0)).max() < 1e-3


def test_hostile_positions():
    values = np.array([np.nan, np.inf, -np.inf, 0.0, 1e38, -1e38, 1e-45, 1.0], np.float32)
    rng = np.random.default_rng(5)
    mesh = e3d.Mesh(rng.choice(values, (60, 3)), rng.integers(0, 60, (500, 3)), crease_angle=0.3)
    lengths = np.linalg.norm(mesh.with_creases().normals, axis=1)
    assert np.isfinite(lengths).all()
    assert ((lengths == 0) | (np.abs(lengths - 1) < 1e-5)).all()


def test_the_picture_has_the_creases():
    mesh = welded(box((1, 1, 1)), crease_angle=CREASE_ANGLE)
    drawn = [
        render(_scene(one), size=(64, 64), outputs=("world_normal",))
        for one in (mesh, mesh.with_creases())
    ]
    assert (drawn[0].world_normal == drawn[1].world_normal).all()
    shown = drawn[0].world_normal[drawn[0].world_normal.any(axis=2)]
    assert np.abs(np.abs(shown).max(axis=1) - 1).max() < 1e-6
    mesh.crease_angle = SMOOTH
    smooth = render(_scene(mesh), size=(64, 64), outputs=("world_normal",)).world_normal
    assert np.abs(smooth[smooth.any(axis=2)]).max(axis=1).min() < 0.8


def _scene(mesh):
    scene = e3d.Scene()
    scene.add(mesh)
    return scene


def test_given_normals_and_bent_meshes_stay_as_they_are():
    given = e3d.Mesh(
        [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)], normals=[(0, 0, 1)] * 3, crease_angle=0.1
    )
    assert given.with_creases() is given
    bent = welded(box((1, 1, 1)), crease_angle=0.1)
    bent.set_influences(np.zeros((8, 1), int), np.ones((8, 1)))
    assert bent.with_creases() is bent


def test_copies_joined_meshes_and_tangents_keep_the_creases():
    mesh = welded(box((1, 1, 1)), crease_angle=CREASE_ANGLE)
    assert e3d.Mesh.concatenate([mesh, mesh]).crease_angle == CREASE_ANGLE
    joined = e3d.Mesh.concatenate([mesh, icosphere(1.0, 1)])
    assert joined.has_normals
    assert len(joined.positions) == 24 + len(icosphere(1.0, 1).positions)
    mesh.uvs = mesh.positions[:, :2]
    assert len(mesh.with_tangents().positions) >= 24


@pytest.mark.parametrize("angle", [-0.1, 3.2, math.nan, "35"])
def test_no_angle(angle):
    with pytest.raises(InvalidArgumentError, match="crease_angle"):
        e3d.Mesh([(0, 0, 0)], crease_angle=angle)


def obj_of(mesh):
    lines = ["v {} {} {}".format(*p) for p in mesh.positions.tolist()]
    return "\n".join(lines + ["f {} {} {}".format(*f) for f in (mesh.faces + 1).tolist()])


def off_of(mesh):
    rows = ["{} {} {}".format(*p) for p in mesh.positions.tolist()]
    rows += ["3 {} {} {}".format(*f) for f in mesh.faces.tolist()]
    return f"OFF\n{len(mesh.positions)} {len(mesh.faces)} 0\n" + "\n".join(rows) + "\n"


@pytest.mark.parametrize("extension", ["obj", "off", "ply", "stl"])
def test_all_formats_alike(tmp_path, extension):
    mesh = welded(box((1, 1, 1)))
    path = tmp_path / f"a.{extension}"
    if extension in ("obj", "off"):
        path.write_text((obj_of if extension == "obj" else off_of)(mesh))
    else:
        mesh.save(path)
    assert len(e3d.load_mesh(path).with_creases().positions) == 24
    smooth = e3d.load_mesh(path, crease_angle=math.pi)
    assert len(smooth.with_creases().positions) == 8
    assert len(e3d.load_scene(path).nodes[0].object.with_creases().positions) == 24
    flat = e3d.load_mesh(path, crease_angle=0)
    picture = render(_scene(flat), size=(64, 64), outputs=("world_normal",)).world_normal
    assert np.abs(np.abs(picture[picture.any(axis=2)]).max(axis=1) - 1).max() < 1e-6


def test_smoothing_groups_count_whatever_the_angle(tmp_path):
    text = obj_of(welded(box((1, 1, 1))))
    path = tmp_path / "a.obj"
    path.write_text(text.replace("\nf", "\ns 1\nf", 1))
    assert e3d.load_mesh(path).with_creases().normals.shape == (8, 3)
    path.write_text(text.replace("\nf", "\ns off\nf", 1))
    assert e3d.load_mesh(path, crease_angle=math.pi).has_normals


def test_corners_without_normals_beside_some_that_have_them(tmp_path):
    text = obj_of(welded(box((1, 1, 1))))
    head, first, rest = text.partition("f ")
    path = tmp_path / "a.obj"
    corners, _, others = rest.partition("\n")
    given = " ".join(f"{corner}//1" for corner in corners.split())
    path.write_text(f"{head}vn 0 0 1\nf {given}\nf " + others.removeprefix("f "))
    mesh = e3d.load_mesh(path)
    assert mesh.normals[mesh.faces[0]].tolist() == [[0, 0, 1]] * 3
    assert np.abs(np.abs(mesh.normals[mesh.faces[1:]]).max(axis=2) - 1).max() < 1e-6


def test_a_smooth_mesh_is_smooth_again_from_an_obj(tmp_path):
    mesh = welded(box((1, 1, 1)))
    mesh.save(tmp_path / "a.obj")
    assert e3d.load_mesh(tmp_path / "a.obj").crease_angle == SMOOTH
    mesh.crease_angle = CREASE_ANGLE
    mesh.save(tmp_path / "a.obj")
    assert e3d.load_mesh(tmp_path / "a.obj").crease_angle == CREASE_ANGLE


def test_scene_files_keep_the_angle(tmp_path):
    welded(box((1, 1, 1))).save(tmp_path / "a.stl")
    scene = e3d.Scene()
    scene.add(e3d.load_mesh(tmp_path / "a.stl", crease_angle=0.5))
    scene.add(welded(box((1, 1, 1)), crease_angle=0.25))
    scene.save(tmp_path / "s.e3d.json")
    angles = [node.object.crease_angle for node in e3d.load_scene(tmp_path / "s.e3d.json").nodes]
    assert angles == [0.5, 0.25]
