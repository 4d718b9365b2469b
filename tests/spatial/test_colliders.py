"""Colliders against brute force: points on surfaces, sampled finely, and exact cases."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d import linalg
from engine3d.model.spatial.triangles import closest_points, triangles_meet_box


def random_scene(seed):
    random = np.random.default_rng(seed)
    scene = e3d.Scene()
    ball = e3d.icosphere(0.6, 2)
    for k in range(60):
        parent = scene.nodes[random.integers(k)] if k % 4 == 3 else None
        node = scene.add(
            ball if k % 3 else None,
            parent=parent,
            translation=random.normal(0, 3, 3),
            rotation=random.normal(size=4),
            scale=random.uniform(0.3, 1.5, 3),
        )
        kinds = (
            lambda: e3d.colliders.SphereCollider(0.4, (0.1, 0, 0)),
            lambda: e3d.colliders.BoxCollider((-1, 0, 0), (1, 0.5, 0.2)),
            lambda: e3d.colliders.MeshCollider(e3d.box()),
            lambda: e3d.colliders.MeshCollider(),
            lambda: e3d.colliders.BoxCollider(),
        )
        node.collider = kinds[k % 5 if node.object is not None else k % 3]()
        node.visible = k % 13 > 0
    return scene, random


def samples(node):
    """Points of a node's collider in the world: of its surface for meshes, else of its inside."""
    collider, pose = node.collider, node.world_pose
    grid = np.stack(np.meshgrid(*[np.linspace(-1, 1, 13)] * 3), -1).reshape(-1, 3)
    if isinstance(collider, e3d.colliders.SphereCollider):
        inside = grid[(grid * grid).sum(axis=1) <= 1]
        radius = collider.radius * np.sqrt((pose[:3, :3] ** 2).sum(axis=0)).max()
        return linalg.transform_points(pose, collider.center) + inside * radius
    if isinstance(collider, e3d.colliders.MeshCollider):
        mesh = collider.mesh or node.object
        weights = np.array([(i, j, 12 - i - j) for i in range(13) for j in range(13 - i)]) / 12
        corners = mesh.positions[mesh.faces].astype(np.float64)
        return linalg.transform_points(pose, (weights @ corners).reshape(-1, 3))
    low, high = node.object.bounds if collider.box is None else collider.box
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    corners = linalg.transform_points(pose, low + np.array(corners) * (high - low))
    low, high = corners.min(axis=0), corners.max(axis=0)
    return (low + high) * 0.5 + grid * (high - low) * 0.5


@pytest.mark.parametrize("seed", range(3))
def test_overlaps_against_samples(seed):
    scene, random = random_scene(seed)
    points = {node: samples(node) for node in scene.nodes if node.shown}
    for _ in range(40):
        center, size = random.normal(0, 3, 3), random.uniform(0.2, 1.5, 3)
        found = set(scene.overlap_box(center - size, center + size))
        for node, cloud in points.items():
            inside = (np.abs(cloud - center) <= size).all(axis=1).any()
            near = (np.abs(cloud - center) <= size + 0.35).all(axis=1).any()
            assert not inside or node in found
            assert near or node not in found
        assert found <= points.keys()
        found = set(scene.overlap_sphere(center, size[0]))
        for node, cloud in points.items():
            distance = np.sqrt(((cloud - center) ** 2).sum(axis=1)).min()
            assert not distance <= size[0] or node in found
            assert distance <= size[0] + 0.35 or node not in found


def test_rays_are_those_of_faces():
    scene, random = random_scene(7)
    for node in scene.nodes:
        node.collider = None if node.object is None else e3d.colliders.MeshCollider()
    for _ in range(40):
        origin, direction = random.normal(0, 8, 3), random.normal(size=3)
        hit, expected = scene.raycast_colliders(origin, direction), scene.raycast(origin, direction)
        assert (hit is None) == (expected is None)
        if hit is not None:
            assert hit.node is expected.node
            assert hit.distance == expected.distance


def test_rays_against_boxes_and_spheres():
    scene = e3d.Scene()
    box = scene.add(translation=(5, 0, 0))
    box.collider = e3d.colliders.BoxCollider((-1, -1, -1), (1, 1, 1))
    ball = scene.add(translation=(0, 9, 0), scale=(1, 2, 1))
    ball.collider = e3d.colliders.SphereCollider(1.5)
    hit = scene.raycast_colliders((0, 0, 0), (3, 0, 0))
    assert (hit.node, hit.distance, hit.position.tolist()) == (box, 4, [4, 0, 0])
    hit = scene.raycast_colliders((0, 0, 0), (0, 1, 0))
    assert (hit.node, hit.distance) == (ball, 6)
    assert scene.raycast_colliders((5.5, 0, 0), (0, 0, 1)).distance == 0
    assert scene.raycast_colliders((0, 0, 0), (1, 0, 0), max_distance=3.9) is None
    assert scene.raycast_colliders((0, 0, 0), (-1, 0, 0)) is None
    assert scene.raycast_colliders((0, 1.1, 0), (1, 0, 0)) is None
    box.rotation = linalg.quaternion_from_axis_angle((0, 0, 1), math.pi / 4)
    hit = scene.raycast_colliders((0, 0, 0), (1, 0, 0))
    np.testing.assert_allclose(hit.distance, 5 - math.sqrt(2))


def test_colliders_follow_what_changes():
    scene = e3d.Scene()
    mesh = e3d.box()
    node = scene.add(mesh)
    assert scene.overlap_box((-1, -1, -1), (1, 1, 1)) == ()
    node.collider = e3d.colliders.BoxCollider()
    assert scene.overlap_box((0.4, 0, 0), (1, 1, 1)) == (node,)
    node.translation = (2, 0, 0)
    assert scene.overlap_box((0.4, 0, 0), (1, 1, 1)) == ()
    mesh.positions = mesh.positions * 3
    assert scene.overlap_box((0.4, 0, 0), (1, 1, 1)) == (node,)
    node.visible = False
    assert scene.overlap_sphere((2, 0, 0), 1) == ()
    node.visible = True
    assert scene.overlap_sphere((2, 0, 0), 1) == (node,)
    scene.remove(node)
    assert scene.overlap_sphere((2, 0, 0), 1) == ()


def test_triangles_that_only_their_edges_keep_apart():
    corners = np.array([[(2.2, 0, 0), (0, 2.2, 0), (2.2, 2.2, 0)]], np.float64)
    one = np.ones(3)
    assert not triangles_meet_box(corners, -one, one)[0]
    assert triangles_meet_box(corners * 0.9, -one, one)[0]
    assert closest_points(corners, np.zeros(3))[0].tolist() == [1.1, 1.1, 0]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda s, n: setattr(n, "collider", "box"), "collider must be"),
        (lambda s, n: setattr(n, "collider", e3d.colliders.MeshCollider()), "own mesh"),
        (lambda s, n: setattr(n, "collider", e3d.colliders.BoxCollider()), "own mesh"),
        (lambda s, n: e3d.colliders.BoxCollider((0, 0, 0)), "both corners"),
        (lambda s, n: e3d.colliders.BoxCollider((1, 0, 0), (0, 1, 1)), "above"),
        (lambda s, n: e3d.colliders.SphereCollider(0), "radius"),
        (lambda s, n: e3d.colliders.MeshCollider(3), "mesh must be"),
        (lambda s, n: s.overlap_box((1, 1, 1), (0, 0, 0)), "above"),
        (lambda s, n: s.overlap_sphere((0, 0, 0), -1), "radius"),
        (lambda s, n: s.raycast_colliders((0, 0, 0), (0, 0, 0)), "direction"),
    ],
)
def test_arguments(make, message):
    scene = e3d.Scene()
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        make(scene, scene.add())


def test_a_box_without_end_meets_every_mesh_and_nothing_beside_them():
    # Trees hold room for faces that there are none of: such a box must not take them for faces.
    scene = e3d.Scene()
    random = np.random.default_rng(1)
    for count in range(1, 60):
        positions = random.random((3 * count, 3))
        mesh = e3d.Mesh(positions, np.arange(3 * count).reshape(-1, 3))
        scene.add(mesh).collider = e3d.colliders.MeshCollider()
    assert scene.overlap_box((-1e300,) * 3, (1e300,) * 3) == scene.nodes


def test_many_colliders_against_each_alone():
    """Hundreds of all kinds, some hidden, through the tree and one by one; then moved."""
    random = np.random.default_rng(11)
    scene = e3d.Scene()
    mesh = e3d.icosphere(0.5, 1)
    kinds = (
        lambda: e3d.colliders.SphereCollider(0.6, random.normal(0, 0.2, 3)),
        lambda: e3d.colliders.BoxCollider((-0.5, -0.3, -0.4), (0.2, 0.5, 0.6)),
        e3d.colliders.BoxCollider,
        e3d.colliders.MeshCollider,
    )
    nodes = []
    for k in range(300):
        turn, scale = random.normal(size=4), random.uniform(0.3, 2, 3)
        place = random.uniform(-9, 9, 3)
        nodes.append(scene.add(mesh, translation=place, rotation=turn, scale=scale))
        nodes[k].collider = kinds[k % 4]()
        nodes[k].visible = k % 17 > 0

    def alone(question, *arguments):
        """The answers of scenes that hold one of the colliders each."""
        for node in nodes:
            if node.visible and node.scene is not None:
                other = e3d.Scene()
                one = other.add(mesh, pose=node.world_pose)
                one.collider = node.collider
                yield node, getattr(other, question)(*arguments)

    met = 0
    for turn in range(2):
        for _ in range(2):
            low = random.uniform(-8, 5, 3)
            high = low + random.uniform(2, 7, 3)
            expected = [node for node, found in alone("overlap_box", low, high) if found]
            assert list(scene.overlap_box(low, high)) == expected
            met += len(expected)
            center, radius = random.uniform(-6, 6, 3), random.uniform(2, 4)
            expected = [n for n, found in alone("overlap_sphere", center, radius) if found]
            assert list(scene.overlap_sphere(center, radius)) == expected
            met += len(expected)
            origin, way = random.uniform(-20, 20, 3), random.normal(size=3)
            hits = [
                (hit.distance, node)
                for node, hit in alone("raycast_colliders", origin, way)
                if hit is not None
            ]
            hit = scene.raycast_colliders(origin, way)
            nearest = min(hits, key=lambda pair: pair[0], default=None)
            assert (None if hit is None else (hit.distance, hit.node)) == nearest
        if turn == 0:
            for node in nodes[::3]:
                node.translation = random.uniform(-9, 9, 3)
            for node in nodes[1::50]:
                scene.remove(node)
            nodes[5].collider = None
            nodes = [node for node in nodes if node.collider is not None]
    assert met > 20
