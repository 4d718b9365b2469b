"""Counts of nodes, clusters and triangles after each stage of culling, against brute force."""

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d.linalg import inverse, multiply

WHAT = ("nodes", "clusters", "triangles")
STAGES = ("", "_in_frustum", "_unoccluded", "_drawn")
SIZE = (160, 120)


def counts(stats):
    """(3, 4): a row for nodes, clusters and triangles, a column a stage."""
    return np.array([[stats[what + stage] for stage in STAGES] for what in WHAT])


def square(side):
    """Two triangles around the origin that face +Z."""
    corners = [(x * side / 2, y * side / 2, 0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return e3d.primitives.quad(*corners)


def boxes(places, side=1.0):
    """Boxes that are not turned: the box of a node is that of its only cluster."""
    scene = e3d.Scene()
    mesh = e3d.box((side, side, side))
    for place in places:
        scene.add(mesh, translation=place)
    return scene


def outside(places, side, camera, pose):
    """How far each box is beyond the plane that it is farthest beyond; float64."""
    clip = multiply(camera.projection(SIZE), inverse(pose))
    corners = np.stack(np.meshgrid(*[(-side / 2, side / 2)] * 3, indexing="ij"), -1).reshape(-1, 3)
    points = places[:, np.newaxis] + corners
    x, y, z, w = (points @ row[:3] + row[3] for row in clip)
    planes = np.stack([w + x, w - x, w + y, w - y, w + z, w - z])
    return (-planes.max(axis=2)).max(axis=0)


@pytest.mark.parametrize("culling", ["frustum", "tree"])
@pytest.mark.parametrize("backend", e3d.backends())
def test_in_frustum(backend, culling):
    random = np.random.default_rng(1)
    places = random.uniform(-30, 30, (900, 3))
    scene = boxes(places)
    camera = e3d.PerspectiveCamera(0.8, znear=0.5, zfar=40.0)
    with Renderer(SIZE, backend=backend) as renderer:
        for _ in range(8):
            pose = e3d.look_at(random.uniform(-20, 20, 3), random.uniform(-20, 20, 3))
            beyond = outside(places, 1.0, camera, pose)
            assert np.abs(beyond).min() > 1e-4  # else it may be either
            inside = int((beyond < 0).sum())
            stats = renderer.render(scene, (camera, pose), culling=culling).stats
            found = counts(stats)
            assert found[:, 0].tolist() == [900, 900, 900 * 12]
            assert found[:, 1].tolist() == [inside, inside, 12 * inside]
            assert (found[:, 1] == found[:, 2]).all()  # occlusion is not tried


@pytest.mark.parametrize("threads", [1, 3])
def test_unoccluded_and_drawn(threads):
    """Boxes before and behind a wall that fills the view."""
    random = np.random.default_rng(2)
    places = random.uniform((-3, -2, -8), (3, 2, -4), (40, 3))
    scene = boxes(places, 0.3)
    wall = scene.add(square(400), translation=(0, 0, -10))
    hidden = random.uniform((-3, -2, -90), (3, 2, -40), (400, 3))
    mesh = e3d.uv_sphere(0.5, (24, 12))
    for place in hidden:
        scene.add(mesh, translation=place)
    camera, pose = e3d.PerspectiveCamera(1.2, znear=0.1, zfar=200.0), np.eye(4)
    with Renderer(SIZE, threads=threads) as renderer:
        for _ in range(6):  # until all that was seen at first is tried again
            outputs = ("object_id", "face_id")
            frame = renderer.render(scene, (camera, pose), culling="always", outputs=outputs)
    normals = np.concatenate([np.eye(3), -np.eye(3)])
    facing = -((places[:, np.newaxis] + 0.15 * normals) * normals).sum(axis=2) > 0
    seen = counts(frame.stats)
    assert seen[0].tolist() == [441, 441, 41, 41]
    assert seen[1, 2:].tolist() == [41, 41] and seen[1, 1] > 441
    pixels = np.stack([frame.object_id.ravel(), frame.face_id.ravel()], axis=1)
    visible = len(np.unique(pixels, axis=0))
    assert wall.id in pixels and pixels[:, 0].max() == wall.id
    assert seen[2, 2] == 40 * 12 + 2
    assert visible <= seen[2, 3] <= 2 * facing.sum() + 2  # some show edge-on, between the samples


def test_of_what_faces_away_nothing_is_drawn():
    """A turned quad is in the frustum and unoccluded; a node of lines is drawn."""
    scene = e3d.Scene()
    scene.add(square(1), rotation=(0, 1, 0, 0))
    scene.add(e3d.Mesh([(0, 0, 0), (1, 1, 0)], lines=[(0, 1)]))
    view = e3d.PerspectiveCamera(0.8), e3d.look_at((0, 0, 5), (0, 0, 0))
    for backend in e3d.backends():
        if backend != "scalar":  # which leaves out nothing
            stats = render(scene, view, size=(32, 32), backend=backend).stats
            assert counts(stats).tolist() == [[2, 2, 2, 1], [1, 1, 1, 0], [2, 2, 2, 0]]
            assert stats["materials"] == 2
    stats = render(scene, view, size=(32, 32), cull="none").stats
    assert counts(stats)[:, 3].tolist() == [2, 1, 2]


def test_clipped_and_two_sided_triangles():
    """One triangle of several pieces counts once, and a culled one of a two-sided scene not."""
    scene = e3d.Scene()
    floor = e3d.Mesh([(-50, -1, -50), (50, -1, -50), (0, -1, 50)], [(0, 2, 1)])
    behind = square(1)
    behind.materials = [e3d.Material(two_sided=True)]
    scene.add(floor)
    scene.add(square(1), translation=(0, 0, -3), rotation=(0, 1, 0, 0))
    scene.add(behind, translation=(0, 0, -4), rotation=(0, 1, 0, 0), scale=3)
    view = e3d.PerspectiveCamera(0.8, znear=0.1, zfar=200.0), np.eye(4)
    for options in ({}, {"hidden_surfaces": "painter"}):
        stats = render(scene, view, size=(64, 64), **options).stats
        assert stats["triangles_clipped"] == 1
        assert counts(stats)[2].tolist() == [5, 5, 5, 3]


def random_scene(random):
    scene = e3d.Scene()
    sphere = e3d.uv_sphere(0.6, (40, 20))
    meshes = (sphere, e3d.box(), e3d.InstancedMesh(e3d.box(), random.normal(0, 3, (8, 4))))
    for k in range(200):
        node = scene.add(meshes[k % 3], translation=random.uniform(-12, 12, 3))
        node.visible = k % 7 > 0
    return scene


@pytest.mark.parametrize("culling", ["all", "tree", "frustum", "none", "always"])
def test_no_stage_has_more_than_the_one_before(culling):
    random = np.random.default_rng(3)
    scene = random_scene(random)
    camera = e3d.PerspectiveCamera(0.9, znear=0.1, zfar=60.0)
    with (
        Renderer(SIZE, threads=1) as one,
        Renderer(SIZE, threads=3) as three,
        Renderer(SIZE, backend="scalar") as scalar,
    ):
        for k in range(5):
            view = camera, e3d.look_at((3 * k - 6, 4, 14), (0, 0, 0))
            outputs = ("object_id", "instance_id", "face_id")
            frame = one.render(scene, view, culling=culling, outputs=outputs)
            found = counts(frame.stats)
            assert (np.diff(found) <= 0).all()
            others = [r.render(scene, view, culling=culling).stats for r in (three, scalar)]
            assert (found == counts(others[0])).all()
            assert (found[:, 0] == counts(others[1])[:, 0]).all()
            pixels = np.stack([getattr(frame, name).ravel() for name in outputs], axis=1)
            pixels = np.unique(pixels[pixels[:, 0] >= 0], axis=0)
            assert len(np.unique(pixels[:, 0])) <= found[0, 3]
            assert len(pixels) <= found[2, 3]
            stats = frame.stats
            left_out = stats["clusters_culled"] + stats["clusters_occluded"]
            assert stats["clusters_drawn"] + left_out == stats["clusters"]
            if culling == "none":
                assert (found[:2, 1] == found[:2, 3]).all()


@pytest.mark.parametrize("threads", [1, 3])
def test_edges_alone_count_the_triangles_that_they_are_of(threads):
    """Faces that are not drawn, because their edges hide nothing, count where they are in view."""
    random = np.random.default_rng(3)
    scene = boxes(random.uniform(-30, 30, (300, 3)))
    view = e3d.PerspectiveCamera(0.8, znear=0.5, zfar=40.0), np.eye(4)
    with Renderer(SIZE, threads=threads) as renderer:
        faces = counts(renderer.render(scene, view, culling="frustum").stats)
        edges = counts(renderer.render(scene, view, wireframe="only", hidden_lines=True).stats)
    assert (edges[1:, :3] == faces[1:, :3]).all() and 0 < edges[2, 1] < edges[2, 0]
    assert (edges[1:, 3] == edges[1:, 1]).all()


@pytest.mark.parametrize("threads", [1, 3])
def test_in_frustum_does_not_depend_on_what_is_hidden(threads):
    """Nor on freezing what is culled: large meshes across the sides of the view, behind a wall."""
    scene = e3d.Scene()
    scene.add(square(3), translation=(0, 0, -2))
    mesh = e3d.uv_sphere(1.0, (96, 48))
    random = np.random.default_rng(4)
    for place in random.uniform((-14, -9, -14), (14, 9, -6), (60, 3)):
        scene.add(mesh, translation=place)
    camera = e3d.PerspectiveCamera(0.8, znear=0.1, zfar=40.0)
    with Renderer(SIZE, threads=threads) as renderer:
        for k in range(6):
            view = camera, e3d.look_at((0.1 * k, 0, 0), (0, 0, -10))
            expected = counts(renderer.render(scene, view, culling_camera=view).stats)[:, 1]
            for options in ({"culling": "always"}, {}, {"culling_camera": view}):
                for _ in range(5):
                    found = counts(renderer.render(scene, view, **options).stats)
                    assert (found[:, 1] == expected).all()
            assert (found[:, 2] < found[:, 0]).all()
    assert 0 < expected[1] < found[1, 0]


@pytest.mark.parametrize("threads", [1, 2, 4])
def test_the_time_in_which_one_thread_works_alone(threads):
    """It is all of the time with one thread; with several, sooner or later, others help."""
    scene = e3d.Scene()
    scene.add(e3d.icosphere(1.0, 5))
    camera = e3d.PerspectiveCamera(0.8), e3d.look_at((0, 0, 3), (0, 0, 0))
    with Renderer((256, 256), threads=threads) as renderer:
        for _ in range(20 if threads == 1 else 3000):
            stats = renderer.render(scene, camera).stats
            assert 0.0 <= stats["ms_alone"] <= stats["ms_total"]
            if stats["ms_alone"] < stats["ms_total"]:
                break
    assert (stats["ms_alone"] < stats["ms_total"]) == (threads > 1)
