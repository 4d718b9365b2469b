"""Sections and parts taken apart: what stays, where it is, whether cuts are closed."""

import math
import tracemalloc

import numpy as np
import pytest

import engine3d as e3d
from engine3d.measuring import measure
from engine3d.model.measuring.cutting import Plane
from engine3d.stage.inspection.clipped_meshes import clipped, with_only
from engine3d.stage.inspection.loose_parts import loose_parts
from engine3d.stage.inspection.taken_apart import TakenApart
from engine3d.stage.viewed_scene import ViewedScene


def apart_of(*things, **options):
    scene = e3d.Scene()
    for number, (thing, place) in enumerate(things):
        scene.add(thing, name=f"part {number}", translation=place)
    return TakenApart(ViewedScene(scene, "model", **options))


def nodes_of(apart):
    shown = (node for node in apart.viewed.scene.nodes if node.object is not None)
    return {node.name: node for node in shown}


def at(x=0.0, y=0.0, z=0.0):
    return e3d.linalg.translation((x, y, z))


def turned_out(mesh):
    return e3d.Mesh(mesh.positions, mesh.faces[:, ::-1])


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("from_above", [True, False])
@pytest.mark.parametrize("place", [-0.4, 0.0, 0.3])
def test_a_cut_box_is_closed_and_has_its_volume(axis, from_above, place):
    apart = apart_of((e3d.box(), (0, 0, 0)))
    apart.spread(0.0)
    apart.cut(Plane(axis, place, from_above))
    assert apart.open_cuts == []
    low, high = apart.viewed.scene.bounds
    assert (low[axis], high[axis]) == pytest.approx(
        (-0.5, place) if from_above else (place, 0.5), abs=1e-4
    )
    nodes = nodes_of(apart)
    face = nodes["cut of part 0"].object
    assert measure(face).area == pytest.approx(1.0, rel=1e-3)
    normal = np.zeros(3)
    normal[axis] = 1.0 if from_above else -1.0
    assert (face.normals == normal).all() and (face.face_normals @ normal > 0.99).all()
    rest = place + 0.5 if from_above else 0.5 - place
    assert measure(nodes["part 0"].object).area == pytest.approx(1.0 + 4.0 * rest)


def test_a_ball_keeps_normals_and_attributes_where_it_is_cut():
    ball = e3d.uv_sphere(1.0, (32, 16))
    ball.colors = e3d.linear(ball.positions * 0.5 + 0.5)
    part = clipped(ball, np.array([0.0, 1.0, 0.0, -0.3]))
    assert part.positions[:, 1].min() == pytest.approx(0.3, abs=1e-6)
    lengths = np.linalg.norm(part.normals, axis=1)
    assert (np.abs(lengths - 1.0) < 0.02).all()
    assert np.abs(part.colors[:, :3] - (part.positions * 0.5 + 0.5)).max() < 1e-5
    assert (part.uvs >= 0).all() and (part.uvs <= 1).all()
    exact = 2.0 * math.pi * 0.7
    assert measure(part).area == pytest.approx(exact, rel=0.02)


def test_a_plane_beside_cuts_off_all_or_nothing():
    box = e3d.box()
    assert clipped(box, np.array([1.0, 0.0, 0.0, 2.0])) is box
    assert clipped(box, np.array([1.0, 0.0, 0.0, -2.0])) is None
    apart = apart_of((box, (0, 0, 0)), (box, (3, 0, 0)))
    apart.spread(0.0)
    apart.cut(Plane(0, 1.5, True))
    assert set(nodes_of(apart)) == {"part 0"}
    apart.spread(0.0)
    assert set(nodes_of(apart)) == {"part 0", "part 1"}


def test_hidden_edges_stay_hidden_and_the_cut_is_no_edge():
    part = clipped(e3d.box(), np.array([0.0, -1.0, 0.0, 0.1]))
    ends = part.positions[part.faces], np.roll(part.positions[part.faces], -1, axis=1)
    shown = part.edge_visible
    for a, b in zip(ends[0][shown], ends[1][shown], strict=True):
        assert (np.abs(a - b) > 1e-6).sum() == 1  # along an axis: no diagonal
        assert not (a[1] == b[1] == pytest.approx(0.1))


def test_a_hollow_body_stays_hollow():
    mesh = e3d.Mesh.concatenate(
        [e3d.box((4, 4, 4)), turned_out(e3d.box((2, 2, 2)))], poses=[at(), at()]
    )
    apart = apart_of((mesh, (0, 0, 0)))
    for amount in (0.0, 0.5):  # a hollow moves with what is around it
        apart.spread(amount)
        apart.cut(Plane(0, 0.3, True))
        face = nodes_of(apart)["cut of part 0"].object
        assert measure(face).area == pytest.approx(12.0, rel=1e-3)


def test_an_open_mesh_says_that_its_cut_is_open():
    sheet = e3d.plane(2.0)
    apart = apart_of((sheet, (0, 0, 0)), (e3d.box(), (0, 0, 0)))
    apart.spread(0.0)
    apart.cut(Plane(0, 0.2, True))
    assert apart.open_cuts == ["part 0"]
    assert set(nodes_of(apart)) == {"part 0", "part 1", "cut of part 1"}


def test_parts_move_from_the_middle_and_back():
    apart = apart_of((e3d.box(), (-2, 0, 0)), (e3d.box(), (0, 0, 0)), (e3d.box(), (2, 1, 0)))
    places = {"part 0": (-2, 0, 0), "part 1": (0, 0, 0), "part 2": (2, 1, 0)}
    center = np.array((0, 0.5, 0))
    for amount in (0.5, 1.0, 0.0):
        apart.spread(amount)
        for name, node in nodes_of(apart).items():
            place = np.array(places[name], float)
            moved = place + (place - center) * amount
            assert node.translation == pytest.approx(moved)
    assert [node.translation.tolist() for node in apart.whole.scene.nodes][0] == [-2, 0, 0]


def test_a_single_mesh_comes_apart_by_its_groups_or_pieces():
    mesh = e3d.Mesh.concatenate([e3d.box(), e3d.uv_sphere(0.4, (8, 4))], poses=[at(-1), at(1)])
    pieces = loose_parts(mesh)
    assert [name for name, _ in pieces] == ["piece 1", "piece 2"]
    assert sum(faces.sum() for _, faces in pieces) == len(mesh.faces)
    mesh.groups = {"lid": np.arange(2), "box": np.arange(2, 12)}
    named = loose_parts(mesh)
    assert [(name, int(faces.sum())) for name, faces in named][:2] == [("lid", 2), ("box", 10)]
    assert named[2].name == "rest"
    apart = apart_of((mesh, (0, 0, 0)))
    assert apart.count == 1
    apart.spread(1.0)
    assert apart.count == 3 and set(nodes_of(apart)) == {"lid", "box", "rest"}
    width = np.ptp(apart.viewed.scene.bounds[:, 0])
    assert width == pytest.approx(2 * 2.0 + 0.9, abs=0.05)


def test_a_part_of_a_mesh_has_only_its_own_vertices():
    mesh = e3d.Mesh.concatenate([e3d.box(), e3d.box()], poses=[at(), at(5)])
    part = with_only(mesh, np.arange(24) >= 12)
    assert part.bounds.tolist() == [[4.5, -0.5, -0.5], [5.5, 0.5, 0.5]]


def test_many_parts_cost_no_copies_of_the_whole():
    count = 300
    mesh = e3d.Mesh.concatenate([e3d.uv_sphere(0.4, (32, 16))] * count, poses=[at()] * count)
    assert len(mesh.normals) == len(mesh.positions)  # they are computed once, for all parts
    faces = np.arange(len(mesh.faces)) < len(mesh.faces) // count
    tracemalloc.start()
    try:
        part = with_only(mesh, faces)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert len(part.faces) == len(mesh.faces) // count
    assert most < mesh.positions.nbytes


def test_instances_are_cut_and_spread_one_by_one():
    poses = np.array([(x, 0, 0, 1.0) for x in (-2, 0, 2)], np.float32)
    instances = e3d.InstancedMesh(e3d.box(), poses, colors=[(255, 0, 0), (0, 255, 0), (0, 0, 255)])
    apart = apart_of((instances, (0, 0, 0)))
    apart.spread(0.0)
    apart.cut(Plane(0, 0.25, True))
    whole, piece = (
        node for node in apart.viewed.scene.nodes if isinstance(node.object, e3d.InstancedMesh)
    )
    assert len(whole.object) == 1 and len(piece.object) == 1
    assert piece.object.colors[0].tolist() == [0, 255, 0, 255]
    assert apart.viewed.scene.bounds[1, 0] == pytest.approx(0.25, abs=1e-4)
    apart.spread(1.0)
    assert apart.count == 3
    assert apart.viewed.scene.bounds[:, 0].tolist() == [-4.5, 4.5]


def test_the_copy_keeps_light_and_background_and_stands_still():
    scene = e3d.Scene((1, 2, 3), ambient=(0.2, 0.2, 0.2))
    parent = scene.add(translation=(1, 0, 0))
    scene.add(e3d.box(), name="box", parent=parent)
    scene.add(e3d.PointLight(), name="lamp", parent=parent, translation=(0, 2, 0))
    viewed = ViewedScene(scene, "model", update=lambda time: None, plays=True)
    copy = TakenApart(viewed).viewed
    assert copy.update is None and not copy.plays
    assert copy.scene.background == (1, 2, 3) and copy.scene.ambient == scene.ambient
    assert copy.scene.find("lamp").translation.tolist() == [1, 2, 0]
    assert copy.scene.find("box").translation.tolist() == [1, 0, 0]


def test_a_cut_is_seen_hatched_in_the_picture():
    apart = apart_of((e3d.box(), (0, 0, 0)), themed=True)
    apart.spread(0.0)
    apart.cut(Plane(2, 0.0, True))
    camera = e3d.OrthographicCamera(0.6), e3d.look_at((0, 0, 3), (0, 0, 0))
    frame = e3d.render(apart.viewed.scene, camera, size=(90, 90), mode="unlit")
    middle = frame.color[10:-10, 10:-10, :3].reshape(-1, 3).astype(int)
    assert (middle[:, 0] > middle[:, 2] + 60).all()  # orange and brown, without a gap
    assert len(np.unique(middle, axis=0)) > 2


def test_each_of_two_parts_with_one_name_gets_its_face():
    scene = e3d.Scene()
    places = [(x, 0.0, 0.0, 1.0) for x in range(5000)]
    scene.add(e3d.InstancedMesh(e3d.box(), places), name="tree")
    scene.add(e3d.box(), name="tree", translation=(0, 0, 9))
    apart = TakenApart(ViewedScene(scene, "model"))
    apart.spread(0.0)
    apart.cut(Plane(1, 0.0, True))
    assert apart.uncut == ["tree"] and "cut of tree" in nodes_of(apart)


def test_cut_instances_keep_what_their_node_casts():
    scene = e3d.Scene()
    scene.add(e3d.InstancedMesh(e3d.box(), [(0, 0, 0, 1)]), name="a", cast_shadows=False)
    apart = TakenApart(ViewedScene(scene, "model"))
    apart.spread(0.0)
    apart.cut(Plane(0, 0.1, True))
    pieces = [node for node in apart.viewed.scene.nodes if node.name == "a" and node.object]
    assert pieces and not any(node.cast_shadows for node in pieces)


def test_hidden_parts_have_no_cut():
    apart = apart_of((e3d.box(), (0, 0, 0)), (e3d.box(), (0, 2, 0)))
    apart.spread(0.0)
    hidden = nodes_of(apart)["part 0"]
    apart.cut(Plane(0, 0.0, True), {hidden})
    assert "cut of part 0" not in nodes_of(apart) and "cut of part 1" in nodes_of(apart)


def test_many_loose_pieces_are_told_apart_soon():
    count = 60_000
    rng = np.random.default_rng(1)
    corners = rng.normal(0, 10, (count, 1, 3)) + rng.normal(0, 0.1, (count, 3, 3))
    mesh = e3d.Mesh(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))
    parts = loose_parts(mesh)
    assert sum(part.faces.sum() for part in parts) == count
