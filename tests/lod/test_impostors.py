"""Impostors: cards that look like their mesh, chosen by size, under the same ids."""

import hashlib
import math

import numpy as np
import pytest
from plain_picture import render

import engine3d as e3d
from engine3d.errors import InvalidArgumentError
from engine3d.extras.lod.impostors import _in_cell, octahedral_directions

SIZE = (320, 240)
CAMERA = e3d.PerspectiveCamera(yfov=1.0, znear=0.1, zfar=2000.0)
FOCAL = 120 / math.tan(0.5)  # pixels of a unit at distance 1


def thing():
    """Not round, and another colour on each side."""
    colors = [(230, 60, 40), (60, 200, 70), (70, 90, 230)]
    parts = []
    for k, color in enumerate(colors):
        mesh = e3d.uv_sphere(0.6, (24, 12))
        offset = np.roll((0.9, 0.0, 0.0), k)
        mesh = e3d.Mesh(mesh.positions + np.float32(offset), mesh.faces, normals=mesh.normals)
        mesh.materials = [e3d.Material(color=color)]
        parts.append(mesh)
    return e3d.Mesh.concatenate(parts)


@pytest.fixture(scope="module")
def impostor():
    return e3d.detail.Impostor(thing(), views=6, texels=32)


def look(z, x=0.0, y=0.0):
    return e3d.look_at((x, y, z), (0, 0, 0))


def test_directions_are_all_around():
    for side in (2, 5, 8):
        directions = octahedral_directions(side)
        assert len(directions) == side * side
        np.testing.assert_allclose((directions**2).sum(axis=1), 1.0)
        assert len(np.unique(directions.round(9), axis=0)) == side * side
        assert np.abs(directions.mean(axis=0)).max() < 0.1


def test_rectangles_cover_what_the_mask_covers_once():
    random = np.random.default_rng(1)
    for _ in range(200):
        mask = random.random((8, 8)) < random.random()
        covered = np.zeros((8, 8), int)
        for left, top, right, bottom in _in_cell(mask, 0, 0):
            covered[top:bottom, left:right] += 1
        np.testing.assert_array_equal(covered, mask)


@pytest.mark.parametrize("number", range(0, 36, 5))
def test_a_card_looks_like_the_mesh_from_its_direction(impostor, number):
    """Outline, surface colours and light, far away."""
    direction = impostor.directions[number]
    up = (0, 1, 0) if abs(direction[1]) < 0.99 else (0, 0, 1)
    frames = []
    for mesh in (thing(), impostor.cards[number]):
        scene = e3d.Scene(ambient=e3d.linear(0.3, 0.3, 0.3))
        scene.add(e3d.DirectionalLight((-0.5, -0.8, -0.4)))
        scene.add(mesh)
        center = impostor._center
        pose = e3d.look_at(center + 60.0 * direction, center, up)
        camera = e3d.PerspectiveCamera(0.06, znear=1.0, zfar=100.0)
        outputs = ("color", "object_id", "albedo", "normal")
        frames.append(render(scene, (camera, pose), size=(64, 64), outputs=outputs))
    mesh, card = frames
    on_mesh, on_card = (frame.object_id >= 0 for frame in frames)
    both = on_mesh & on_card
    assert both.sum() > 0.9 * (on_mesh | on_card).sum()
    assert np.abs(mesh.albedo[both] - card.albedo[both]).mean() < 0.04
    assert (mesh.normal[both] * card.normal[both]).sum(axis=1).mean() > 0.85
    difference = np.abs(mesh.color[both].astype(float) - card.color[both]).mean()
    assert difference < 22


def test_chosen_by_size_with_hysteresis(impostor):
    sphere = thing()
    levels = [(sphere, 0.0), (sphere, 0.02)]
    options = {"impostor": impostor, "impostor_pixels": 4.0, "hysteresis": 0.3}
    things = e3d.detail.DetailedInstances(levels, [(0, 0, 0, 1.0)], **options)
    limit = things._radius + impostor.error * FOCAL / 4.0  # where its error is 4 pixels
    center = impostor._center

    def level_at(distance):
        eye = center + (0, 0, distance)
        things.update(CAMERA, e3d.look_at(eye, center), SIZE)
        return things.level[0]

    assert [level_at(d) for d in (3, limit * 0.9, limit * 1.1)] == [0, 1, 1]
    assert level_at(limit * 1.5) == 2
    assert [level_at(limit + 0.1 * (-1) ** k) for k in range(0, 20, 2)] == [2] * 10
    assert level_at(limit - 0.1) == 1
    assert [level_at(limit + 0.1 * (-1) ** k) for k in range(20)] == [1] * 20


def test_off_unless_asked_for():
    things = e3d.detail.DetailedInstances([(thing(), 0.0)], [(0, 0, 0, 1.0)])
    assert len(things.instances) == 1
    assert not things.update(CAMERA, look(900.0), SIZE)


def test_the_card_is_that_of_the_direction_in_the_instance(impostor):
    """Turned, scaled, mirrored and sheared instances, under a turned group."""
    random = np.random.default_rng(3)
    poses = np.tile(np.eye(4), (40, 1, 1))
    poses[:, :3, :3] = random.normal(size=(40, 3, 3))
    poses[:, :3, 3] = random.normal(0, 20, (40, 3))
    things = e3d.detail.DetailedInstances(
        [(thing(), 0.0)], poses, impostor=impostor, impostor_pixels=1e9
    )
    scene = e3d.Scene()
    turned = scene.add(rotation=random.normal(size=4), translation=(1, 2, 3), scale=1.5)
    group = things.add_to(scene, parent=turned)
    eye = np.array((30.0, 50.0, 400.0))
    things.update(CAMERA, e3d.look_at(eye, (0, 0, 0)), SIZE)
    for row, pose in enumerate(things._poses.astype(float)):
        inverse = np.linalg.inv(group.world_pose @ pose)
        towards = (inverse @ (*eye, 1.0))[:3] - impostor._center
        best = (impostor.directions @ towards).argmax()
        drawn = [k for k, some in enumerate(things.instances[1:]) if len(some) and row in some._ids]
        assert drawn == [best]


def test_ids_stay(impostor):
    """Of levels near and far: one object, and the rows of the poses."""
    places = [(4.0 * (k % 5) - 8, 0, -6.0 * k, 1.0) for k in range(20)]
    levels = [(thing(), 0.0), (e3d.icosphere(1.0, 1), 0.2)]
    things = e3d.detail.DetailedInstances(levels, places, impostor=impostor, impostor_pixels=2.0)
    scene = e3d.Scene()
    scene.add(e3d.box(), translation=(0, 300, 0))
    group = things.add_to(scene)
    pose = e3d.look_at((0, 20, 20), (0, 0, -60))
    outputs = ("object_id", "instance_id", "face_id")
    seen = []
    for _ in range(2):
        frame = render(scene, (CAMERA, pose), size=SIZE, outputs=outputs)
        assert set(np.unique(frame.object_id)) == {-1, group.id}
        assert set(np.unique(frame.instance_id)) == {-1, *range(20)}
        seen.append(frame)
        things.update(CAMERA, pose, SIZE)
    assert len(set(things.level)) == 3
    ids = [frame.instance_id for frame in seen]
    both = (ids[0] >= 0) & (ids[1] >= 0)
    assert (ids[0][both] == ids[1][both]).mean() > 0.95
    y, x = np.argwhere(ids[1] == 17)[len(np.argwhere(ids[1] == 17)) // 2]
    hit = scene.pick(seen[1], int(x), int(y))
    assert (hit.node, hit.instance_id) == (group, 17)


def test_pictures_are_the_same_everywhere(impostor):
    digests = set()
    places = [(2.0 * k - 10, 0, 0, 1.0) for k in range(10)]
    for backend in e3d.backends():
        for threads in (1, 3):
            made = e3d.detail.Impostor(thing(), views=3, texels=16)
            things = e3d.detail.DetailedInstances(
                [(thing(), 0.0)], places, impostor=made, impostor_pixels=30
            )
            scene = e3d.Scene(ambient=e3d.linear(0.4, 0.4, 0.4))
            scene.add(e3d.DirectionalLight((0, -1, -1)))
            things.add_to(scene)
            things.update(CAMERA, look(60.0, y=9.0), SIZE)
            assert (things.level == 1).all()
            options = {"backend": backend, "threads": threads, "size": (160, 120)}
            frame = render(scene, (CAMERA, look(60.0, y=9.0)), **options)
            digests.add(hashlib.sha256(frame.color.tobytes()).hexdigest())
    assert len(digests) == 1
    assert (frame.color[..., :3] != 0).any()


@pytest.mark.parametrize(
    "options", [{"views": 1}, {"views": 17}, {"views": 2.0}, {"texels": 6}, {"texels": 18}]
)
def test_errors(options):
    with pytest.raises(InvalidArgumentError):
        e3d.detail.Impostor(thing(), **options)


def test_more_errors(impostor):
    with pytest.raises(InvalidArgumentError, match="without faces"):
        e3d.detail.Impostor(e3d.Mesh([(0, 0, 0)], points=[0]))
    with pytest.raises(InvalidArgumentError, match="mesh must be a Mesh"):
        e3d.detail.Impostor("box")
    with pytest.raises(InvalidArgumentError, match="impostor must be an Impostor"):
        e3d.detail.DetailedInstances([(thing(), 0.0)], [(0, 0, 0, 1.0)], impostor=thing())
    with pytest.raises(InvalidArgumentError, match="impostor_pixels"):
        e3d.detail.DetailedInstances([(thing(), 0.0)], [(0, 0, 0, 1.0)], impostor_pixels=0)
