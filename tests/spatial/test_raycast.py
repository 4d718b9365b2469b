"""Rays and picking against brute force over all triangles, and against what pictures show."""

import math

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d import linalg
from engine3d.model.scene.instances import instance_matrices


def brute_force(scene, origin, direction):
    """The nearest hit of all triangles by Moeller and Trumbore: distance and identities."""
    best = (math.inf, -1, -1, -1)
    for node in scene.nodes:
        obj = node.object
        if not node.shown or not isinstance(obj, e3d.Mesh | e3d.InstancedMesh):
            continue
        mesh = obj.mesh if isinstance(obj, e3d.InstancedMesh) else obj
        poses = [np.eye(4)] if mesh is obj else instance_matrices(obj.poses)
        for instance, pose in enumerate(poses):
            world = linalg.multiply(node.world_pose, pose)
            corners = linalg.transform_points(world, mesh.positions)[mesh.faces]
            a, ab, ac = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
            p = np.cross(direction, ac)
            with np.errstate(all="ignore"):
                inverse = 1.0 / (ab * p).sum(axis=1)
                u = ((origin - a) * p).sum(axis=1) * inverse
                q = np.cross(origin - a, ab)
                v = (q @ direction) * inverse
                t = (q * ac).sum(axis=1) * inverse
            t = np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0), t, math.inf)
            if len(t) and t.min() < best[0]:
                best = (t.min(), node.id, instance, int(t.argmin()))
    return best


def random_scene(seed):
    random = np.random.default_rng(seed)
    scene = e3d.Scene()
    ball = e3d.uv_sphere(0.7, (16, 9))
    soup = e3d.Mesh(random.normal(size=(60, 3)), np.arange(60).reshape(20, 3))
    places = random.normal(0, 2, (12, 4))
    poses = np.stack([linalg.compose(p[:3], random.normal(size=4), p[1:]) for p in places])
    objects = (ball, soup, e3d.InstancedMesh(ball, places), e3d.InstancedMesh(soup, poses))
    parents = [None]
    for k in range(40):
        node = scene.add(
            objects[k % 4],
            parent=parents[random.integers(len(parents))] if k % 2 else None,
            translation=random.normal(0, 4, 3),
            rotation=random.normal(size=4),
            scale=random.normal(0.5, 0.5, 3),
        )
        node.visible = k % 11 != 5
        parents.append(node)
    return scene, random


@pytest.mark.parametrize("seed", range(4))
def test_rays_against_brute_force(seed):
    scene, random = random_scene(seed)
    origins, targets = random.normal(0, 12, (30, 3)), random.normal(0, 3, (30, 3))
    hits = scene.raycast_many(origins, targets - origins)
    met = 0
    for k, direction in enumerate(linalg.normalize(targets - origins)):
        distance, *ids = brute_force(scene, origins[k], direction)
        single = scene.raycast(origins[k], direction)
        assert [hits.object_id[k], hits.instance_id[k], hits.face_id[k]] == ids
        if single is None:
            assert ids[0] == -1
            assert hits.distance[k] == math.inf
            continue
        met += 1
        assert [single.node.id, single.instance_id, single.face_id] == ids
        np.testing.assert_allclose(single.distance, distance, rtol=1e-9)
        np.testing.assert_allclose(single.position, origins[k] + distance * direction, atol=1e-8)
        np.testing.assert_allclose(single.barycentric.sum(), 1, atol=1e-12)
    assert met > 5


def test_many_rays_find_what_each_finds_alone():
    """They are shared among threads, and objects become known while some are cast already."""
    origins = np.random.default_rng(2).normal(0, 8, (900, 3))
    (scene, _), (fresh, _) = random_scene(31), random_scene(31)
    hits = scene.raycast_many(origins, -origins)
    again = scene.raycast_many(origins, -origins)
    assert all(np.array_equal(a, b) for a, b in zip(hits, again, strict=True))
    assert 0.1 < (hits.object_id >= 0).mean() < 1.0
    for row in range(0, 900, 7):
        hit = fresh.raycast(origins[row], -origins[row])
        if hit is None:
            assert hits.object_id[row] == -1 and np.isinf(hits.distance[row])
            continue
        same = hit.object_id, hit.instance_id, hit.face_id, hit.distance
        found = hits.object_id[row], hits.instance_id[row], hits.face_id[row], hits.distance[row]
        assert same == found
        assert np.array_equal(hits.barycentric[row], hit.barycentric)


def test_rays_follow_what_moves():
    scene, random = random_scene(9)
    for step in range(8):
        for node in scene.nodes[step::7]:
            node.translation = random.normal(0, 4, 3)
        if step == 5:
            scene.remove(scene.nodes[3])
            scene.nodes[0].object.positions = scene.nodes[0].object.positions * np.float32(1.5)
        origin = random.normal(0, 12, 3)
        direction = linalg.normalize(-origin)
        hit = scene.raycast(origin, direction)
        expected = brute_force(scene, origin, direction)
        assert (hit.node.id if hit else -1) == expected[1]


def test_no_ray_slips_between_faces():
    """Through vertices and edges of a closed surface, from inside, turned and scaled oddly."""
    scene = e3d.Scene()
    ball = e3d.icosphere(1.0, 3)
    node = scene.add(
        ball, rotation=(0.1, 0.7, 0.3, 0.6), scale=(1, 1.7, 0.3), translation=(9, 7, 5)
    )
    points = linalg.transform_points(node.world_pose, ball.positions)
    middles = (points[ball.faces] + points[np.roll(ball.faces, 1, axis=1)]).reshape(-1, 3) * 0.5
    for targets in (points, middles):
        hits = scene.raycast_many(node.translation, targets - node.translation)
        assert (hits.object_id == node.id).all()
        np.testing.assert_allclose(hits.position, targets, atol=1e-9)


def test_axis_aligned_rays_along_faces_and_corners():
    scene = e3d.Scene()
    for x in range(3):
        for y in range(3):
            scene.add(e3d.primitives.quad(), translation=(x, y, 0))
    for x in np.linspace(-0.5, 2.5, 13):
        for y in np.linspace(-0.5, 2.5, 13):
            hit = scene.raycast((x, y, 4), (0, 0, -1))
            assert hit.distance == 4
            assert hit.node.id == min(
                n.id
                for n in scene.nodes
                if abs(n.translation[0] - x) <= 0.5 and abs(n.translation[1] - y) <= 0.5
            )


def test_sides_normals_and_distance():
    scene = e3d.Scene()
    node = scene.add(e3d.primitives.quad(), scale=(2, 2, 1))
    hit = scene.raycast((0.5, 0.25, 3), (0, 0, -2))
    assert hit.node is node
    assert hit.distance == 3
    assert hit.normal.tolist() == [0, 0, 1]
    assert hit.position.tolist() == [0.5, 0.25, 0]
    assert scene.raycast((0, 0, 3), (0, 0, -1), cull="front") is None
    assert scene.raycast((0, 0, -3), (0, 0, 1), cull="back") is None
    assert scene.raycast((0, 0, -3), (0, 0, 1)).normal.tolist() == [0, 0, 1]
    assert scene.raycast((0, 0, 3), (0, 0, -1), max_distance=2.9) is None
    assert scene.raycast((0, 0, 3), (0, 0, -1), max_distance=3).distance == 3
    node.scale = (-1, 1, 1)  # mirrored, its front is still its front
    assert scene.raycast((0.1, 0, 3), (0, 0, -1), cull="back").normal.tolist() == [0, 0, 1]
    node.scale = (1, 1, 0)  # flat: no volume to go into
    assert scene.raycast((0.1, 0, 3), (0, 0, -1)).face_id == hit.face_id
    assert e3d.Scene().raycast((0, 0, 0), (0, 0, 1)) is None


def test_what_is_not_finite_is_not_met():
    scene = e3d.Scene()
    positions = np.float32([(-1, -1, 0), (1, -1, 0), (np.nan, 1, 0), (0, 1, 0)])
    scene.add(e3d.Mesh(positions, [(0, 1, 2), (0, 1, 3)]))
    scene.add(e3d.InstancedMesh(e3d.primitives.quad(), [(0, 0, 1, np.inf), (0, 0, -1, 1)]))
    assert scene.raycast((0, 0, 5), (0, 0, -1)).face_id == 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (((0, 0), (0, 0, 1)), "origin"),
        (((0, 0, 0), (0, 0, 0)), "zero vector"),
        (((0, 0, 0), (0, np.nan, 0)), "finite"),
        (((0, 0, 0), (0, 0, 1), {"max_distance": -1}), "max_distance"),
        (((0, 0, 0), (0, 0, 1), {"max_distance": "far"}), "max_distance must be a number"),
        (((0, 0, 0), (0, 0, 1), {"cull": "all"}), "cull"),
    ],
)
def test_arguments(arguments, message):
    *vectors, options = arguments if isinstance(arguments[-1], dict) else (*arguments, {})
    scene = e3d.Scene()
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        scene.raycast(*vectors, **options)
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        scene.raycast_many(*vectors, **options)


def test_many_need_as_many():
    with pytest.raises(e3d.InvalidArgumentError, match="equally many"):
        e3d.Scene().raycast_many(np.zeros((2, 3)), np.ones((3, 3)))


IDS = ("object_id", "instance_id", "face_id")


@pytest.mark.parametrize("exact", [True, False])
@pytest.mark.parametrize("perspective", [True, False])
def test_picking_tells_what_the_picture_shows(exact, perspective):
    scene, _ = random_scene(5)
    camera = e3d.PerspectiveCamera(znear=2) if perspective else e3d.OrthographicCamera(8.0)
    camera = camera, e3d.look_at((3, 5, 18), (0, 0, 0))
    with Renderer((40, 30)) as renderer:
        shown = renderer.render(scene, camera, outputs=(*IDS, "world_position"))
        frame = shown if exact else renderer.render(scene, camera)
    agreed = 0
    for y in range(0, 30, 2):
        for x in range(0, 40, 2):
            hit = scene.pick(frame, x, y)
            ids = tuple(int(getattr(shown, name)[y, x]) for name in IDS)
            found = (-1, -1, -1) if hit is None else (hit.node.id, hit.instance_id, hit.face_id)
            agreed += found == ids
            if exact:
                assert found == ids
            if found == ids and hit is not None:
                np.testing.assert_allclose(hit.position, shown.world_position[y, x], atol=2e-2)
    assert agreed >= 298  # of 300: a ray and a rounded edge may differ


def test_picking_lines_and_removed_nodes():
    scene = e3d.Scene()
    node = scene.add(e3d.Mesh([(-1, 0, 0), (1, 0, 0)], lines=[(0, 1)]))
    camera = e3d.OrthographicCamera(1.0), e3d.look_at((0, 0, 5), (0, 0, 0))
    frame = render(scene, camera, size=(8, 8), outputs=IDS, line_width=3)
    hit = scene.pick(frame, 4, 4)
    assert (hit.node, hit.face_id) == (node, -1)
    assert scene.pick(frame, 0, 0) is None
    with pytest.raises(e3d.InvalidArgumentError, match="outside"):
        scene.pick(frame, 8, 0)
    scene.remove(node)
    assert scene.pick(frame, 4, 4) is None


def test_picking_what_is_not_there_any_more():
    """A mesh with fewer faces, fewer instances than the frame shows."""
    camera = e3d.PerspectiveCamera(yfov=1.0), e3d.look_at((0, 0, 5), (0, 0, 0))
    outputs = ("object_id", "instance_id", "face_id")
    mesh = e3d.icosphere(1.0, 1)
    crowd = e3d.InstancedMesh(mesh, [(9, 0, 0, 1), (0, 0, 0, 1)])
    scene = e3d.Scene()
    node = scene.add(crowd)
    frame = render(scene, camera, size=(9, 9), outputs=outputs)
    assert scene.pick(frame, 4, 4)[:2] == (node, 1)
    for poses in ([(9, 0, 0, 1)], []):
        crowd.replace(poses)
        assert scene.pick(frame, 4, 4) is None
    crowd.replace([(9, 0, 0, 1), (0, 5, 0, 1)])  # there, but elsewhere
    assert scene.pick(frame, 4, 4)[:2] == (node, 1)
    mesh.faces = mesh.faces[:0]
    assert scene.pick(frame, 4, 4) is None


@pytest.mark.parametrize("pixel", [("a", 1), (1, None), ((1, 2), 3)])
def test_a_pixel_is_two_numbers(pixel):
    frame = render(e3d.Scene(), size=(8, 8))
    with pytest.raises(e3d.InvalidArgumentError, match="frame must be a Frame, not NoneType"):
        e3d.Scene().pick(None, *pixel)
    with pytest.raises(e3d.InvalidArgumentError, match="x and y, a pixel, are numbers"):
        e3d.Scene().pick(frame, *pixel)
