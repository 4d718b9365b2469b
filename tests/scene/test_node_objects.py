"""What a node holds may come later, be replaced and go: frames, bounds, rays and lights follow."""

import gc
import weakref

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d

VIEW = e3d.PerspectiveCamera(), e3d.look_at((0, 0, 6), (0, 0, 0))
SIZE = (64, 48)
OUTPUTS = ("color", "object_id")
DOWN = (0, 0, -1)


def everything(scene, renderer):
    """What a scene shows, to a renderer that is kept, to a new one, and to rays."""
    frame = renderer.render(scene, VIEW, outputs=OUTPUTS)
    fresh = render(scene, VIEW, size=SIZE, outputs=OUTPUTS)
    assert np.array_equal(frame.color, fresh.color)
    assert np.array_equal(frame.object_id, fresh.object_id)
    hits = scene.raycast_many([(-1, 0, 5), (1, 0, 5)], DOWN)
    return frame.color.copy(), frame.object_id.copy(), scene.bounds, hits.object_id


def test_an_empty_node_is_filled_replaced_and_emptied():
    box, ball = e3d.box(), e3d.icosphere(0.7, 2)
    crowd = e3d.InstancedMesh(box, [(0, 0, 0, 1), (0, 1.5, 0, 1)])
    scene = e3d.Scene()
    scene.add(box, translation=(-1, 0, 0))
    node = scene.add(translation=(1, 0, 0), name="later")
    child = scene.add(e3d.primitives.quad(), parent=node, translation=(0, 0, -1))
    with Renderer(SIZE) as renderer:
        assert everything(scene, renderer)[3].tolist() == [0, child.id]
        for obj in (box, ball, crowd, None, e3d.PointLight(), ball, e3d.PerspectiveCamera(), box):
            node.object = obj
            assert node.object is obj and node.name == "later" and child.parent is node
            other = e3d.Scene()
            other.add(box, translation=(-1, 0, 0))
            twin = other.add(obj, translation=(1, 0, 0))
            other.add(e3d.primitives.quad(), parent=twin, translation=(0, 0, -1))
            for one, expected in zip(
                everything(scene, renderer), everything(other, Renderer(SIZE)), strict=True
            ):
                assert np.array_equal(one, expected), obj
            assert np.array_equal(node.bounds, twin.bounds) or node.bounds is twin.bounds is None


def test_cameras_and_lights_stand_in_the_order_of_their_nodes():
    scene, other = e3d.Scene(), e3d.Scene()
    first = scene.add(translation=(0, 0, 6))
    lamp = scene.add(translation=(1, 1, 2))
    scene.add(e3d.PointLight(intensity=3.3), translation=(-1, 2, 2))
    scene.add(e3d.PerspectiveCamera(0.4), translation=(0, 0, 9))
    scene.add(e3d.icosphere(0.8, 2))
    first.object, lamp.object = (
        e3d.PerspectiveCamera(1.1),
        e3d.PointLight(e3d.linear(1, 0.3, 0.7), 2.1),
    )
    other.add(first.object, translation=(0, 0, 6))
    other.add(lamp.object, translation=(1, 1, 2))
    for node in scene.nodes[2:]:
        other.add(node.object, pose=node.pose)
    assert np.array_equal(render(scene, size=SIZE).color, render(other, size=SIZE).color)
    first.object = lamp.object = None
    assert scene.data.camera_node() is scene.nodes[3]
    assert not np.array_equal(render(scene, size=SIZE).color, render(other, size=SIZE).color)


def test_colliders_follow_the_object():
    scene = e3d.Scene()
    node = scene.add(e3d.box())
    node.collider = e3d.colliders.BoxCollider()
    assert scene.overlap_box((0.8, -1, -1), (2, 1, 1)) == ()
    node.object = e3d.box((2, 2, 2))
    assert scene.overlap_box((0.8, -1, -1), (2, 1, 1)) == (node,)
    with pytest.raises(e3d.InvalidArgumentError, match="the node's own mesh"):
        node.object = None
    assert node.object is not None
    node.collider = e3d.colliders.SphereCollider(1.0)
    node.object = None
    assert scene.overlap_box((0.8, -0.1, -0.1), (2, 0.1, 0.1)) == (node,)


def test_what_was_replaced_is_let_go():
    scene = e3d.Scene()
    node = scene.add()
    alive = weakref.WeakSet()
    with Renderer((16, 12), threads=1) as renderer:
        for _ in range(20):
            node.object = mesh = e3d.icosphere(1.0, 1)
            alive.add(mesh)
            del mesh
            renderer.render(scene)
    gc.collect()
    assert len(alive) == 1


def test_errors():
    scene = e3d.Scene()
    node = scene.add(e3d.box())
    with pytest.raises(e3d.InvalidArgumentError, match="obj must be Mesh"):
        node.object = "box"
    assert isinstance(node.object, e3d.Mesh)
    scene.remove(node)
    with pytest.raises(e3d.InvalidArgumentError, match="removed"):
        node.object = None
