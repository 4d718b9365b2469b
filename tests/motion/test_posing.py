"""Posed vertices against the reference to the bit, and against matrices in float64."""

import numpy as np
import pytest
from kernels.calls import of_core, record

import engine3d as e3d
from engine3d._native.rasterizer import pose_meshes
from engine3d.model.motion.posed_mesh import PosedMesh
from engine3d.model.motion.skeletons import skeleton_of


def bent_tube(rng, rings=40, sides=24, joints=5, influences=4, targets=0, normals=True):
    """A tube along Y, whose rings are moved by neighbouring joints."""
    turn = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    y = np.linspace(0, 4, rings)
    ring = np.stack([np.cos(turn), np.zeros(sides), np.sin(turn)], axis=1)
    positions = (ring[None] + y[:, None, None] * [0, 1, 0]).reshape(-1, 3).astype(np.float32)
    at = np.arange(rings - 1)[:, None] * sides + np.arange(sides)
    after = np.arange(rings - 1)[:, None] * sides + (np.arange(sides) + 1) % sides
    faces = [(at, at + sides, after), (after, at + sides, after + sides)]
    faces = np.concatenate([np.stack(corners, axis=-1).reshape(-1, 3) for corners in faces])
    moved_by = rng.integers(0, joints, (len(positions), influences))
    weights = rng.random((len(positions), influences))
    weights[:, 1:][rng.random((len(positions), influences - 1)) < 0.4] = 0
    morphs = [
        e3d.motion.MorphTarget(
            rng.normal(0, 0.2, positions.shape),
            rng.normal(0, 0.2, positions.shape) if normals else None,
            rng.normal(0, 0.2, positions.shape) if normals else None,
        )
        for _ in range(targets)
    ]
    tangents = np.hstack([rng.normal(size=positions.shape), np.ones((len(positions), 1))])
    return e3d.Mesh(
        positions,
        faces,
        tangents=tangents,
        joints=moved_by,
        weights=weights,
        morph_targets=morphs,
    )


def random_poses(rng, count):
    poses = np.tile(np.eye(4), (count, 1, 1))
    poses[:, :3] += rng.normal(0, 0.4, (count, 3, 4))
    return poses


def skinned_scene(mesh, rng, joints=5):
    scene = e3d.Scene()
    top = scene.add(pose=random_poses(rng, 1)[0])
    chain = [top]
    for pose in random_poses(rng, joints):
        chain.append(scene.add(parent=chain[-1], pose=pose))
    node = scene.add(mesh, translation=(100, 0, 0))
    node.skin = e3d.motion.Skin(chain[1:], random_poses(rng, joints))
    return scene, node


def posed(scene, node):
    scene.data.update()
    return node._drawn.now()


def by_matrices(mesh, node):
    """The definition of a skin, in float64."""
    skin = node.skin
    matrices = np.array([j.world_pose for j in skin.joints]) @ skin.inverse_binds
    blends = (mesh.weights[..., None, None] * matrices[mesh.joints]).sum(axis=1)
    points = np.hstack([mesh.positions, np.ones((len(mesh.positions), 1))])
    return (blends @ points[..., None])[:, :3, 0]


@pytest.mark.parametrize("influences", (1, 4, 8))
def test_skinned_vertices_stand_where_their_joints_put_them(influences):
    rng = np.random.default_rng(3)
    mesh = bent_tube(rng, influences=influences)
    scene, node = skinned_scene(mesh, rng)
    now = posed(scene, node)
    world = e3d.linalg.transform_points(
        scene.data.arrays.world_poses(scene.data.arrays.columns["anchor"][[node._slot]])[0],
        now.positions,
    )
    assert np.abs(world - by_matrices(mesh, node)).max() < 2e-6 * np.abs(world).max()


@pytest.mark.parametrize("case", ("joints", "morphs", "both", "positions only"))
def test_posed_vertices_are_those_of_the_reference(case):
    rng = np.random.default_rng(7)
    mesh = bent_tube(
        rng, influences=8, targets=0 if case == "joints" else 3, normals=case != "positions only"
    )
    scene, node = skinned_scene(mesh, rng)
    weights = None
    if case in ("morphs", "positions only"):
        node.skin = None
    if case != "joints":
        node.morph_weights = weights = (0.5, 0.0, -1.25)
    now = posed(scene, node)
    matrices = None
    if node.skin is not None:
        matrices = np.empty((len(node.skin.joints), 16), np.float32)
        node._drawn.native.copy_matrices(matrices)
    arrays = mesh._arrays
    skinned = matrices is not None
    positions, normals = (np.empty_like(mesh.positions) for _ in range(2))
    tangents = np.empty_like(mesh.tangents)
    given = {"normals": mesh.normals, "tangents": mesh.tangents}
    if skinned:
        given |= {"influences": mesh.joints.shape[1], "joints": mesh.joints}
        given["weights"] = mesh.weights
    targets = {name: arrays.get(f"morph_{name}") for name in ("positions", "normals", "tangents")}
    given |= {f"target_{name}": array for name, array in targets.items()}
    given["targets"] = max(0 if array is None else len(array) for array in targets.values())
    of_core("e3d_reference_pose")(
        record("mesh_desc", positions=mesh.positions, vertices=len(mesh.positions)),
        record("pose_desc", **given),
        matrices,
        None if weights is None else np.float32(weights),
        positions,
        normals,
        tangents,
    )
    assert now.positions.tobytes() == positions.tobytes()
    assert now.normals.tobytes() == normals.tobytes()
    assert now.tangents.tobytes() == tangents.tobytes()
    assert not np.array_equal(now.positions, mesh.positions)


def test_the_way_of_a_matrix_is_that_of_linear_algebra():
    rng = np.random.default_rng(5)
    scene, node = skinned_scene(bent_tube(rng), rng)
    scene.data.update()
    matrices = np.empty((5, 16), np.float32)
    node._drawn.native.copy_matrices(matrices)
    way = np.eye(4)
    for number, joint in enumerate(node.skin.joints):
        way = joint.pose if number == 0 else e3d.linalg.multiply(way, joint.pose)
        expected = e3d.linalg.multiply(way, node.skin.inverse_binds[number]).astype(np.float32)
        assert matrices[number].reshape(4, 4).T[:3].tobytes() == expected[:3].tobytes()


@pytest.mark.parametrize("threads", (1, 2, 5))
def test_large_meshes_are_shared_out_and_the_same_on_any_number_of_threads(threads):
    rng = np.random.default_rng(9)
    mesh = bent_tube(rng, rings=900, sides=40, targets=2)
    scene, node = skinned_scene(mesh, rng)
    node.morph_weights = (1.0, 0.3)
    scene.data.update(threads)
    now = node._drawn.now()
    alone, other = PosedMesh(mesh), node._drawn
    alone.native.set_weights(np.float32((1.0, 0.3)))
    arrays = scene.data.arrays
    joints = scene.data.slots_of(node.skin.joints).tolist()
    alone.native.set_skeleton(*skeleton_of(node.skin, joints, arrays.columns["parent"])[1:])
    pose_meshes([alone.native], arrays.columns["pose"], 1)
    assert alone.now().positions.tobytes() == now.positions.tobytes()
    assert np.array_equal(alone.box(), other.box())


def test_boxes_hold_what_was_posed():
    rng = np.random.default_rng(11)
    scene, node = skinned_scene(bent_tube(rng), rng)
    now = posed(scene, node)
    box = node._drawn.box()
    assert np.array_equal(box[:6].reshape(2, 3), now.bounds)
    world = by_matrices(node.object, node)
    assert (node.bounds[0] <= world.min(axis=0) + 1e-5).all()
    assert (node.bounds[1] >= world.max(axis=0) - 1e-5).all()


def test_vertices_that_are_not_finite_are_left_out_of_the_box():
    rng = np.random.default_rng(12)
    mesh = bent_tube(rng)
    positions = mesh.positions.copy()
    positions[5] = np.nan
    broken = e3d.Mesh(positions, mesh.faces, joints=mesh.joints, weights=mesh.weights)
    scene, node = skinned_scene(broken, rng)
    now = posed(scene, node)
    assert np.isnan(now.positions[5]).all() and np.isfinite(node.bounds).all()
    assert np.array_equal(node._drawn.box()[:6].reshape(2, 3), now.bounds)


def test_a_still_scene_poses_nothing_again():
    rng = np.random.default_rng(13)
    scene, node = skinned_scene(bent_tube(rng), rng)
    scene.data.update()
    moment, handle = scene.data.posing.moment, node._drawn.native.current
    scene.nodes[0].translation = (1, 2, 3)  # the anchor moves all alike
    scene.data.update()
    assert node._drawn.native.current is handle and scene.data.posing.moment == moment
    assert node.bounds is not None
    scene.nodes[2].translation = (1, 2, 3)
    scene.data.update()
    assert node._drawn.native.current is not handle and scene.data.posing.moment > moment


def test_a_node_follows_its_anchor():
    rng = np.random.default_rng(14)
    scene, node = skinned_scene(bent_tube(rng), rng)
    before = node.bounds
    first = scene.nodes[0]
    first.translation = first.translation + np.array([10.0, 0, 0])
    assert np.allclose(node.bounds, before + [10, 0, 0])
    node.translation = (-5, 7, 1)  # the node's own place changes nothing
    assert np.allclose(node.bounds, before + [10, 0, 0])


def test_joints_that_hang_elsewhere_or_go_are_followed():
    rng = np.random.default_rng(15)
    scene, node = skinned_scene(bent_tube(rng), rng)
    other = scene.add(translation=(0, 50, 0))
    last = node.skin.joints[-1]
    last.reparent(other)
    world = by_matrices(node.object, node)
    scene.data.update()
    assert scene.data.arrays.columns["anchor"][node._slot] == node._slot  # the world
    assert np.abs(posed(scene, node).positions - world).max() < 1e-4
    scene.remove(other)
    scene.data.update()
    assert np.array_equal(posed(scene, node).positions, node.object.positions)
    scene.restore(other)
    assert np.abs(posed(scene, node).positions - world).max() < 1e-4
