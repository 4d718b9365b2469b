"""Many nodes at once against one after the other, to the bit."""

import numpy as np
import pytest

import engine3d as e3d


def twins(count=30):
    """Two equal scenes: the nodes of the first, and a selection of the second's."""
    random = np.random.default_rng(6)
    scenes = e3d.Scene(), e3d.Scene()
    mesh = e3d.box()
    for scene in scenes:
        random = np.random.default_rng(6)
        for k in range(count):
            parent = scene.nodes[k // 3] if k else None
            scene.add(mesh if k % 2 else None, parent=parent, translation=random.normal(size=3))
    chosen = random.permutation(count)[:20].tolist()
    return [scenes[0].nodes[k] for k in chosen], scenes[1].select(
        scenes[1].nodes[k] for k in chosen
    )


def check_equal(nodes, selection):
    for k, node in enumerate(nodes):
        assert selection.poses[k].tobytes() == node.pose.tobytes()
        assert selection.translations[k].tobytes() == node.translation.tobytes()
        assert selection.rotations[k].tobytes() == node.rotation.tobytes()
        assert selection.scales[k].tobytes() == node.scale.tobytes()
        assert selection.world_poses[k].tobytes() == node.world_pose.tobytes()
        assert selection.visible[k] == node.visible
        if node.bounds is None:
            assert np.isnan(selection.bounds[k]).all()
        else:
            assert selection.bounds[k].tobytes() == node.bounds.tobytes()
        twin = selection.nodes[k]
        assert twin.pose.tobytes() == node.pose.tobytes()
        assert twin.world_pose.tobytes() == node.world_pose.tobytes()


def test_together_is_one_by_one():
    nodes, selection = twins()
    random = np.random.default_rng(7)
    count = len(selection)
    changes = {
        "translation": random.normal(size=(count, 3)),
        "rotation": random.normal(size=(count, 4)),
        "scale": random.normal(size=(count, 3)),
        "pose": np.tile(np.eye(4), (count, 1, 1)) + 0.1 * np.triu(np.ones((4, 4)), 1),
        "visible": random.random(count) < 0.7,
    }
    changes["pose"][:, 3] = (0, 0, 0, 1)
    for name in ("translation", "rotation", "scale", "pose", "scale", "visible", "rotation"):
        many = name if name == "visible" else name + "s"
        for node, value in zip(nodes, changes[name], strict=True):
            setattr(node, name, value)
        setattr(selection, many, changes[name])
        check_equal(nodes, selection)
    selection.scales = 2
    selection.translations = (1, 2, 3)
    assert all(node.scale.tolist() == [2, 2, 2] for node in selection.nodes)
    assert (selection.translations == (1, 2, 3)).all()


def test_reading_does_not_write():
    _, selection = twins()
    before = selection.poses
    selection.translations[:] = 9
    selection.poses[:] = 9
    assert selection.poses.tobytes() == before.tobytes()


def test_all_nodes_and_none():
    scene = e3d.Scene()
    assert len(scene.select()) == 0
    scene.select().translations = (1, 2, 3)
    nodes = [scene.add() for _ in range(3)]
    assert scene.select().nodes == tuple(nodes)


def test_selections_follow_slots_and_notice_removal():
    scene = e3d.Scene()
    gone = [scene.add() for _ in range(3000)]
    kept = scene.add(e3d.box(), translation=(1, 0, 0))
    selection = scene.select([kept])
    for node in gone:
        scene.remove(node)
    selection.translations = (5, 0, 0)
    assert kept.translation.tolist() == [5, 0, 0]
    scene.remove(kept)
    with pytest.raises(e3d.InvalidArgumentError, match="not a node of this scene"):
        selection.translations = (0, 0, 0)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("translations", np.zeros((19, 3)), "shape"),
        ("translations", "far", "numbers"),
        ("translations", np.nan, "finite"),
        ("rotations", (0, 0, 0, 0), "zero quaternions"),
        ("rotations", (1e200, 0, 0, 0), "overflow"),
        ("poses", np.ones((4, 4)), "affine"),
        ("scales", np.zeros((20, 2)), "shape"),
        ("visible", [True] * 3, "visible"),
    ],
)
def test_arguments(name, value, message):
    _, selection = twins()
    before = selection.poses
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        setattr(selection, name, value)
    assert selection.poses.tobytes() == before.tobytes()


def test_nodes_of_another_scene():
    with pytest.raises(e3d.InvalidArgumentError, match="not a node of this scene"):
        e3d.Scene().select([e3d.Scene().add()])
    with pytest.raises(e3d.InvalidArgumentError, match="not a node"):
        e3d.Scene().select(["node"])
