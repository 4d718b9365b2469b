"""New things stand on the ground in view, beside what is there, under names of their own."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.editor.array_command import ArrayNodes
from engine3d.apps.editor.clipboard import Clipboard
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.new_things.adding import GROUPS, add_new, usual_size
from engine3d.apps.editor.new_things.primitive_shapes import (
    PRIMITIVES,
    arguments_of,
    changed_primitives,
    new_primitive,
    title_of,
)
from engine3d.apps.editor.node_commands import AddNodes, DuplicateNodes, GroupNodes
from engine3d.stage.views.viewpoint import UP_DIRECTIONS, Viewpoint

TITLES = [title for group in GROUPS for title in group]


@pytest.fixture(params=UP_DIRECTIONS)
def view(request):
    return Viewpoint(np.zeros(3), 10.0, up=UP_DIRECTIONS[request.param])


def boxes_of(scene):
    return [node.bounds for node in scene.nodes if node.bounds is not None]


def overlap(a, b):
    return bool((np.minimum(a[1], b[1]) - np.maximum(a[0], b[0]) > 1e-6).all())


def test_things_stand_on_the_ground_and_apart(view):
    scene = e3d.Scene()
    for title in [*PRIMITIVES, "Box", "Box", "Sphere"]:
        add_new(scene, title, view)
    boxes, up = boxes_of(scene), np.array(view.up)
    assert not any(overlap(a, b) for k, a in enumerate(boxes) for b in boxes[:k])
    for box in boxes:
        ends = box @ up
        assert min(ends) == pytest.approx(0.0, abs=1e-6)
    frame = e3d.render(scene, (view.camera(_sphere(scene)), view.pose()), size=(320, 200))
    seen, depths = frame.project(np.array([node.world_pose[:3, 3] for node in scene.nodes]))
    assert (depths > 0).all() and (seen > 0).all() and (seen < (320, 200)).all()


@pytest.mark.parametrize("title", TITLES)
def test_no_two_things_stand_in_one_place(title, view):
    scene = e3d.Scene()
    for _ in range(5):
        add_new(scene, title, view)
    places = np.array([node.world_pose[:3, 3] for node in scene.nodes])
    apart = np.linalg.norm(places[:, np.newaxis] - places, axis=-1)[np.triu_indices(5, 1)]
    assert apart.min() > 0.9


def test_things_stand_beside_icons_and_below_lamps():
    scene, view = e3d.Scene(), Viewpoint(np.zeros(3), 10.0)
    lamp = add_new(scene, "Point light", view)
    first, empty = add_new(scene, "Box", view), add_new(scene, "Empty", view)
    second, floor = add_new(scene, "Box", view), add_new(scene, "Plane", view)
    across = [node.translation[::2].tolist() for node in (lamp, first, floor)]
    assert across == [[0.0, 0.0]] * 3
    assert np.abs(second.translation - empty.translation).max() > 0.9
    empty.visible = False
    assert (add_new(scene, "Box", view).translation[::2] == empty.translation[::2]).all()


def test_a_node_that_holds_others_takes_no_place_itself():
    scene, view = e3d.Scene(), Viewpoint(np.zeros(3), 10.0)
    scene.add(e3d.box(), parent=scene.add(name="model"), translation=(5.0, 0.5, 0.0))
    assert add_new(scene, "Box", view).translation.tolist() == [0.0, 0.5, 0.0]


def _sphere(scene):
    from engine3d.stage.scene_bounds import bounding_sphere

    return bounding_sphere(scene)


def test_names_are_numbered():
    scene, view = e3d.Scene(), Viewpoint(np.zeros(3), 10.0)
    names = [add_new(scene, "Box", view).name for _ in range(3)]
    assert names == ["box", "box 2", "box 3"]
    scene.remove(scene.find("box 2"))
    assert add_new(scene, "Box", view).name == "box 2"


def test_copies_have_names_of_their_own():
    scene = e3d.Scene()
    top, unnamed = scene.add(name="top"), scene.add()
    scene.add(name="box 7", parent=top)
    document = SceneDocument(scene)
    document.do(DuplicateNodes(scene, [top, unnamed]))
    document.do(DuplicateNodes(scene, [scene.find("top 2")]))
    document.do(ArrayNodes(scene, [scene.find("top 3")], (3, 1, 1), (1.0, 0.0, 0.0)))
    document.do(DuplicateNodes(scene, [scene.find("box 7")]))
    names = [node.name for node in scene.nodes if node.parent is None]
    assert names == ["top", "", "top 2", "", "top 3", "top 4", "top 5"]
    assert [node.name for node in top.children] == ["box 7", "box 8"]
    document.do(GroupNodes(scene, [scene.find("top 4")]))
    document.do(GroupNodes(scene, [scene.find("top 5")]))
    assert scene.find("group").children[0].name == "top 4" and scene.find("group 2")
    clipboard, other = Clipboard(), e3d.Scene()
    text, _ = clipboard.copy([top])
    for into, name in ((scene, "top 6"), (other, "top"), (other, "top 2")):
        nodes = set(into.nodes)
        clipboard.paste(into, text).do()
        assert name in {node.name for node in set(into.nodes) - nodes}
    source, target = e3d.Scene(), e3d.Scene()
    source.add(name="ball 2"), source.add(name="ball"), source.add(name="a"), source.add(name="a")
    text, _ = clipboard.copy(source.nodes)
    target.add(name="ball")
    clipboard.paste(target, text).do()
    assert sorted(node.name for node in target.nodes) == ["a", "a 2", "ball", "ball 2", "ball 3"]


def test_a_thing_below_another_stands_where_it_would_without():
    scene, view = e3d.Scene(), Viewpoint(np.zeros(3), 10.0)
    parent = scene.add(name="group", translation=(5, 5, 5), scale=2.0)
    child = add_new(scene, "Box", view, parent)
    assert child.parent is parent
    assert np.allclose(child.world_pose[:3, 3], (0, 0.5, 0)) and np.allclose(child.scale, 0.5)


def test_a_sky_takes_no_place_and_a_floor_none_either():
    scene, view = e3d.Scene(), Viewpoint(np.zeros(3), 10.0)
    scene.add(e3d.icosphere(500.0), name="sky")
    scene.add(e3d.plane((50, 50)), name="floor")
    assert add_new(scene, "Box", view).translation.tolist() == [0.0, 0.5, 0.0]


@pytest.mark.parametrize("title", TITLES)
def test_adding_is_one_step_and_selects(title):
    document, view = SceneDocument(), Viewpoint(np.zeros(3), 10.0)
    document.do(AddNodes(document.scene, lambda scene: add_new(scene, title, view), "Add"))
    (node,) = document.scene.nodes
    assert document.selection.nodes == (node,)
    assert node.name == title.lower()
    document.undo()
    assert document.scene.nodes == ()


def test_lamps_shine_down_on_the_ground():
    view = Viewpoint(np.zeros(3), 10.0)
    for title in TITLES:
        if title.endswith("light") and not title.startswith(("Hemisphere", "Tube")):
            scene = e3d.Scene(ambient=(0, 0, 0))
            scene.add(e3d.plane((30, 30)))
            add_new(scene, title, view)
            camera = e3d.PerspectiveCamera(), e3d.look_at((0, 8, 8), (0, 0, 0), (0, 1, 0))
            frame = e3d.render(scene, camera, size=(64, 48))
            assert frame.color[..., :3].max() > 60, title


@pytest.mark.parametrize(
    "distance, size", [(10, 1.0), (2, 1.0), (60, 1.0), (500, 100.0), (0.05, 0.01)]
)
def test_sizes_fit_the_view(distance, size):
    assert usual_size(distance) == pytest.approx(size)
    scene = e3d.Scene()
    node = add_new(scene, "Torus", Viewpoint(np.zeros(3), float(distance)))
    arguments = arguments_of(node.object)
    assert arguments["major_radius"] == pytest.approx(0.35 * size)
    assert arguments["segments"] == [48, 24]


def test_equal_primitives_are_one_mesh_with_one_material():
    scene = e3d.Scene()
    first = scene.add(new_primitive(scene, "Sphere"))
    second = scene.add(new_primitive(scene, "Sphere"))
    other = scene.add(new_primitive(scene, "Sphere", 10.0))
    assert first.object is second.object is not other.object
    first.object.materials[0].color = (255, 0, 0)
    assert new_primitive(scene, "Sphere") is not first.object


def test_primitives_keep_their_arguments_and_materials(tmp_path):
    scene = e3d.Scene()
    meshes = [e3d.box(2.0), e3d.box((1, 2, 3))]
    for mesh in meshes:
        mesh.materials = [e3d.Material(color=(1, 2, 3))]
        scene.add(mesh)
    assert [title_of(mesh) for mesh in meshes] == ["Box", "Box"]
    a, b, c = changed_primitives(scene, [*meshes, meshes[0]], "size", {0: 1.0, 1: 5.0, 2: 3.0})
    assert arguments_of(a)["size"] == [1.0, 5.0, 3.0] == arguments_of(b)["size"]
    assert a.materials == meshes[0].materials and c is a
    scene.nodes[0].object = a
    scene.save(tmp_path / "boxes.e3d.json")
    again = e3d.load_scene(tmp_path / "boxes.e3d.json").nodes[0].object
    assert arguments_of(again)["size"] == [1.0, 5.0, 3.0]
    again.positions = again.positions * 2
    assert title_of(again) is None and arguments_of(again) == {}
    assert title_of(e3d.primitives.quad()) is None
