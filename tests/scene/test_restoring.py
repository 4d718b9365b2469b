"""What `Scene.remove` took out comes back as it was: drawing, rays, colliders, order, ids."""

import gc

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d

VIEW = e3d.PerspectiveCamera(), e3d.look_at((0, 0, 6), (0, 0, 0))
MESHES = e3d.box(0.8), e3d.icosphere(0.6, 1)


def seen(scene, renderer):
    """What a scene shows to a renderer that is kept, to a new one, to rays and to boxes."""
    frame = renderer.render(scene, VIEW, outputs=("color", "object_id"))
    fresh = render(scene, VIEW, size=(64, 48), outputs=("color", "object_id"))
    assert frame.color.tobytes() == fresh.color.tobytes()
    hits = scene.raycast_many(np.mgrid[-2:3, -2:3, 5:6].reshape(3, -1).T, (0, 0, -1))
    return (
        frame.color.tobytes(),
        frame.object_id.tobytes(),
        scene.bounds.tobytes(),
        hits.object_id.tobytes(),
        scene.overlap_box((-9, -9, -9), (9, 9, 9)),
        scene.nodes,
        [(node.id, node.name, node.parent, node.children) for node in scene.nodes],
        [node.pose.tobytes() for node in scene.nodes],
    )


def random_scene(random):
    scene = e3d.Scene(ambient=e3d.linear(0.2, 0.2, 0.2))
    nodes = []
    for k in range(30):
        kinds = (*MESHES, None, e3d.PointLight(intensity=2.0), e3d.PerspectiveCamera())
        node = scene.add(
            kinds[random.integers(len(kinds))],
            name=f"n{k}",
            parent=nodes[random.integers(k)] if k and random.random() < 0.6 else None,
            translation=random.uniform(-1, 1, 3),
        )
        if random.random() < 0.3:
            node.collider = e3d.colliders.SphereCollider(0.3)
        nodes.append(node)
    return scene


@pytest.mark.parametrize("seed", range(4))
def test_all_is_as_it_was_when_what_was_removed_is_back(seed):
    random = np.random.default_rng(seed)
    scene = random_scene(random)
    with Renderer((64, 48)) as renderer:
        states, gone = [seen(scene, renderer)], []
        for _ in range(8):
            node = scene.nodes[random.integers(len(scene.nodes))]
            siblings = (node,) if node.parent is None else node.parent.children
            after = siblings[siblings.index(node) + 1 :]
            gone.append((node, node.parent, after[0] if after else None))
            scene.remove(node)
            if random.random() < 0.5:
                gc.collect()
                scene.data._pack()
            states.append(seen(scene, renderer))
        assert len({state[0] for state in states}) > 3
        while gone:
            assert seen(scene, renderer) == states.pop()
            node, parent, before = gone.pop()
            scene.restore(node, parent=parent, before=before)
        assert seen(scene, renderer) == states.pop()
        assert not states


def test_what_changed_meanwhile_stays_changed():
    scene = e3d.Scene()
    node = scene.add(MESHES[0])
    below = scene.add(MESHES[1], parent=node)
    scene.remove(node)
    node.name, below.translation, node.visible = "back", (1, 2, 3), False
    scene.restore(node)
    assert scene.find("back") is node and not below.shown
    assert below.world_pose[:3, 3].tolist() == [1, 2, 3]


def test_only_what_was_removed_from_this_scene_comes_back():
    scene, other = e3d.Scene(), e3d.Scene()
    node = scene.add()
    below = scene.add(parent=node)
    foreign = other.add()
    for wrong in (node, foreign, None, "node"):
        with pytest.raises(e3d.InvalidArgumentError, match="removed from this scene"):
            scene.restore(wrong)
    scene.remove(node)
    for wrong_scene, wrong in ((other, node), (scene, below)):
        with pytest.raises(e3d.InvalidArgumentError, match="removed from this scene"):
            wrong_scene.restore(wrong)
    for parent in (below, foreign):
        with pytest.raises(e3d.InvalidArgumentError):
            scene.restore(node, parent=parent)
        assert scene.nodes == ()
    scene.restore(node)
    assert scene.nodes == (node, below)
    with pytest.raises(e3d.InvalidArgumentError, match="removed from this scene"):
        scene.restore(node)


def test_a_child_that_went_first_comes_back_alone():
    scene = e3d.Scene()
    node = scene.add()
    child, other = scene.add(parent=node), scene.add(parent=node)
    scene.remove(child)
    scene.remove(node)
    scene.restore(node)
    assert scene.nodes == (node, other)
    scene.restore(child, parent=node, before=other)
    assert node.children == (child, other)


def test_children_stand_where_they_are_put():
    scene = e3d.Scene()
    top = scene.add()
    a, b, c = (scene.add(parent=top, name=name) for name in "abc")
    c.reparent(top, before=a)
    assert top.children == (c, a, b)
    c.reparent(top, before=b)
    assert top.children == (a, c, b)
    b.reparent(c)
    b.reparent(top, before=c)
    assert top.children == (a, b, c)
    c.reparent(top)
    assert top.children == (a, b, c)
    for wrong in (a, top, scene.add(), "b"):
        with pytest.raises(e3d.InvalidArgumentError, match="before"):
            a.reparent(top, before=wrong)
    with pytest.raises(e3d.InvalidArgumentError, match="before"):
        a.reparent(None, before=b)
    assert top.children == (a, b, c)
