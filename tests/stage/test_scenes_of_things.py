"""What `render` and `show` take besides scenes."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.stage.scenes_of_things import scene_of

POINTS = np.array([(0, 0, 0, 1), (3, 0, 0, 1)], np.float32)


@pytest.mark.parametrize("thing", [e3d.torus(), e3d.InstancedMesh(e3d.box(), POINTS)])
def test_a_mesh_is_drawn_as_a_scene_that_holds_it(thing):
    scene = e3d.Scene()
    scene.add(thing)
    picture = e3d.render(thing, size=(32, 24)).color
    assert np.array_equal(picture, e3d.render(scene, size=(32, 24)).color)
    assert (picture[..., :3] > 0).any()


def test_of_a_node_all_that_is_below_it_is_drawn_where_it_is():
    scene = e3d.Scene()
    scene.add(e3d.box(), translation=(50, 0, 0))
    above = scene.add(translation=(0, 2, 0))
    node = scene.add(e3d.box(), name="body", parent=above)
    for place, name in (((2, 0, 0), "first"), ((0, 0, 3), "second")):
        scene.add(e3d.torus(), name=name, translation=place, parent=node)
    scene.add(e3d.box(), translation=(0, 70, 0), parent=node).visible = False
    part = scene_of(node)
    assert [one.name for one in part.nodes] == ["body", "first", "second"]
    assert np.array_equal(
        [one.world_pose[:3, 3] for one in part.nodes], [(0, 2, 0), (2, 2, 0), (0, 2, 3)]
    )
    assert np.array_equal(
        e3d.render(node, size=(32, 24)).color, e3d.render(part, size=(32, 24)).color
    )


def test_deep_trees_are_no_trouble():
    scene = e3d.Scene()
    top = node = scene.add()
    for _ in range(2000):
        node = scene.add(parent=node)
    scene.add(e3d.box(), parent=node)
    assert len(scene_of(top).nodes) == 2002


def test_a_scene_is_itself_and_other_things_are_refused():
    scene = e3d.Scene()
    assert scene_of(scene) is scene and scene_of("cube.obj") is None
    with pytest.raises(e3d.InvalidArgumentError, match="a scene, a node, a mesh .* not int"):
        e3d.render(5)
