"""What is bent is drawn, culled, picked, met and framed where it is."""

import numpy as np
import pytest
from motion.test_posing import bent_tube, by_matrices, posed, skinned_scene
from plain_picture import Renderer

import engine3d as e3d
from engine3d import linalg
from engine3d.model.scene.shown import placing_pose


def stage(seed, count=6, targets=0):
    """Tubes that share a mesh and bend each in its own way."""
    rng = np.random.default_rng(seed)
    mesh = bent_tube(rng, rings=60, targets=targets)
    scene = e3d.Scene(background=None)
    scene.add(e3d.DirectionalLight((0.3, -1, -0.5)))
    joints = []
    for number in range(count):
        top = scene.add(translation=((number % 3) * 5 - 5, (number // 3) * 5 - 5, 0))
        chain = [top]
        for _ in range(5):
            chain.append(scene.add(parent=chain[-1]))
        joints += chain[1:]
        node = scene.add(mesh)
        node.skin = e3d.motion.Skin(chain[1:], np.tile(np.eye(4), (5, 1, 1)))
    return scene, scene.select(joints), rng


def wriggle(joints, rng):
    joints.rotations = rng.normal(0, 0.15, (len(joints), 4)) + [0, 0, 0, 1]
    joints.translations = rng.normal(0, 0.1, (len(joints), 3))


CAMERA = e3d.PerspectiveCamera(0.9, znear=0.1, zfar=100)


def view(distance=16):
    return CAMERA, linalg.look_at((0, 0, distance), (0, 0, 0))


@pytest.mark.parametrize("distance", (16, 4))
def test_culling_leaves_out_nothing_that_shows_at_any_time(distance):
    scene, joints, rng = stage(1)
    brute = Renderer((160, 120))
    culled = {culling: Renderer((160, 120)) for culling in ("all", "always", "frustum")}
    different = set()
    for _ in range(8):
        wriggle(joints, rng)
        truth = brute.render(scene, view(distance), culling="none").color.tobytes()
        different.add(truth)
        for culling, renderer in culled.items():
            assert renderer.render(scene, view(distance), culling=culling).color.tobytes() == truth
    assert len(different) == 8


def test_every_backend_draws_the_same():
    scene, joints, rng = stage(2, targets=2)
    for node in scene.nodes:
        if node.skin:
            node.morph_weights = (0.5, 0.25)
    wriggle(joints, rng)
    outputs = ("color", "depth", "normal", "object_id", "face_id")
    frames = [
        Renderer((160, 120), backend=name, threads=threads).render(scene, view(), outputs=outputs)
        for name in e3d.backends()
        for threads in (1, 2)
    ]
    for output in outputs:
        assert len({getattr(frame, output).tobytes() for frame in frames}) == 1


@pytest.mark.parametrize("options", ({}, {"normals": "flat"}, {"wireframe": "only"}))
def test_a_posed_mesh_is_drawn_as_one_with_those_vertices(options):
    scene, joints, rng = stage(3, count=2)
    renderer = Renderer((160, 120))
    for _ in range(3):
        wriggle(joints, rng)
        frame = renderer.render(scene, view(), **options)
        plain = e3d.Scene(background=None)
        plain.add(e3d.DirectionalLight((0.3, -1, -0.5)))
        for node in scene.nodes:
            if node.skin:
                plain.add(node._drawn.now(), pose=placing_pose(node))
        other = Renderer((160, 120)).render(plain, view(), **options)
        assert np.array_equal(frame.color, other.color)


def test_renderers_with_other_needs_show_the_same_pose():
    scene, joints, rng = stage(4, count=2)
    smooth, flat, fresh = (Renderer((96, 96)) for _ in range(3))
    for _ in range(3):
        wriggle(joints, rng)
        a = smooth.render(scene, view(), outputs=("depth",)).depth
        b = flat.render(scene, view(), outputs=("depth",), normals="flat").depth
        assert np.array_equal(a, b)
    assert np.array_equal(fresh.render(scene, view(), outputs=("depth",)).depth, a)


def test_rays_meet_what_is_bent():
    scene, joints, rng = stage(5)
    renderer = Renderer((64, 48))
    for _ in range(2):
        wriggle(joints, rng)
        outputs = ("depth", "object_id", "face_id", "instance_id")
        frame = renderer.render(scene, view(), outputs=outputs)
        apart = []  # along the view; at silhouettes, snapping moves steep faces
        for y in range(4, 48, 8):
            for x in range(4, 64, 8):
                hit = scene.pick(frame, x, y)
                assert (hit is None) == (frame.object_id[y, x] < 0)
                if hit is None:
                    continue
                apart.append(abs(16 - hit.position[2] - frame.depth[y, x]))
        assert len(apart) > 5 and np.median(apart) < 1e-3 and max(apart) < 0.3


def test_colliders_of_the_mesh_follow_its_pose():
    scene, joints, rng = stage(6, count=1)
    node = next(node for node in scene.nodes if node.skin)
    node.collider = e3d.colliders.MeshCollider()
    world = by_matrices(node.object, node)
    spot = world[17]
    assert scene.overlap_sphere(spot, 0.01) == (node,)
    joints.translations = np.tile((0.0, 30.0, 0.0), (5, 1))
    assert scene.overlap_sphere(spot, 0.01) == ()
    moved = by_matrices(node.object, node)
    assert scene.overlap_sphere(moved[17], 0.01) == (node,)
    node.collider = e3d.colliders.BoxCollider()
    assert scene.overlap_box(moved[17] - 0.01, moved[17] + 0.01) == (node,)
    assert scene.overlap_box(spot - 0.01, spot + 0.01) == ()


def test_cameras_frame_what_is_bent():
    rng = np.random.default_rng(7)
    scene, node = skinned_scene(bent_tube(rng), rng)
    scene.nodes[0].translation = (1000, 0, 0)
    camera, pose = e3d.frame_scene(scene)
    world = by_matrices(node.object, node)
    seen = linalg.transform_points(linalg.inverse(pose), world)
    assert (seen[:, 2] < 0).all()
    frame = Renderer((64, 64)).render(scene, (camera, pose), outputs=("object_id",))
    assert (frame.object_id == node.id).sum() > 100


def test_one_mesh_many_poses_and_one_at_rest():
    scene, joints, rng = stage(8, count=3)
    mesh = next(node for node in scene.nodes if node.skin).object
    plain = scene.add(mesh, translation=(0, 5, 0))
    wriggle(joints, rng)
    scene.data.update()
    assert plain.bounds is not None and plain._drawn is plain.object
    rests = {node._drawn.native.rest for node in scene.nodes if node.skin}
    assert len(rests) == 1  # what does not move is there once
    assert [number for _, number in e3d_uses(scene, mesh)] == [4]


def e3d_uses(scene, mesh):
    from engine3d.model.scene.usage import uses_in

    return [(thing, count) for thing, count in uses_in([scene]).items() if thing is mesh]


def test_a_mesh_that_changes_is_bent_anew():
    rng = np.random.default_rng(9)
    scene, node = skinned_scene(bent_tube(rng, targets=1), rng)
    node.morph_weights = [0.5]
    renderer = Renderer((64, 64))
    renderer.render(scene)
    mesh = node.object
    mesh.positions = mesh.positions * 2
    assert np.allclose(posed(scene, node)._arrays["faces"], mesh.faces)
    one = e3d.Scene()
    chain = [one.add(pose=n.pose) if n.parent is None else None for n in scene.nodes[:1]]
    for n in scene.nodes[1:6]:
        chain.append(one.add(parent=chain[-1], pose=n.pose))
    same = one.add(mesh)
    same.skin = e3d.motion.Skin(chain[1:], node.skin.inverse_binds)
    same.morph_weights = [0.5]
    one.data.update()
    assert same._drawn.now().positions.tobytes() == posed(scene, node).positions.tobytes()


def test_what_a_node_holds_may_change():
    rng = np.random.default_rng(10)
    scene, node = skinned_scene(bent_tube(rng), rng)
    renderer = Renderer((64, 64))
    renderer.render(scene)
    mesh, before = node.object, node.bounds
    node.object = e3d.box()
    assert np.allclose(node.bounds, [[99.5, -0.5, -0.5], [100.5, 0.5, 0.5]])
    renderer.render(scene)
    node.object = None
    renderer.render(scene)
    node.object = mesh
    assert np.array_equal(node.bounds, before)
    node.skin = None
    renderer.render(scene)
    assert scene.data.arrays.columns["anchor"][node._slot] == -1
    node.object = e3d.box()
    renderer.render(scene)
    assert np.allclose(node.bounds, [[99.5, -0.5, -0.5], [100.5, 0.5, 0.5]])
    scene.remove(node)
    renderer.render(scene)


@pytest.mark.parametrize(
    ("joints", "weights", "message"),
    (
        ([[0, 1]] * 3, [[1, np.nan]] * 3, "vertex 0 must be finite"),
        ([[0, 1]] * 3, [[1, 0], [0, 0], [1, 0]], "vertex 1 are all 0"),
        ([[0, 1]] * 3, [[1, -1]] * 3, "not negative"),
        ([[0, 70000]] * 3, [[1, 1]] * 3, "no number of a joint"),
        ([[0, 1]] * 2, [[1, 1]] * 2, "2 rows for 3 vertices"),
        ([[0.5, 1]] * 3, [[1, 1]] * 3, "integers"),
        ([[0, 1]] * 3, None, "give both"),
    ),
)
def test_wrong_influences_are_told(joints, weights, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        e3d.Mesh(np.eye(3), [[0, 1, 2]], joints=joints, weights=weights)


def test_wrong_skins_are_told():
    scene = e3d.Scene()
    joint = scene.add()
    mesh = e3d.Mesh(np.eye(3), [[0, 1, 2]], joints=[[3]] * 3, weights=[[1]] * 3)
    node = scene.add(mesh)
    with pytest.raises(e3d.InvalidArgumentError, match="joint 3, but the skin has 1"):
        node.skin = e3d.motion.Skin([joint])
    for binds in (np.full((1, 4, 4), np.nan), np.ones((1, 4, 4)), np.eye(4)):
        with pytest.raises(e3d.InvalidArgumentError):
            e3d.motion.Skin([joint], binds)
    with pytest.raises(e3d.InvalidArgumentError, match="another scene"):
        e3d.motion.Skin([joint, e3d.Scene().add()])
    with pytest.raises(e3d.InvalidArgumentError, match="scene"):
        e3d.Scene().add(mesh).skin = e3d.motion.Skin([joint] * 4)
    with pytest.raises(e3d.InvalidArgumentError, match="morph_weights"):
        node.morph_weights = [1]
