"""Materials are made, copied, named, given to nodes and kept in files, each as one step."""

import pytest

import engine3d as e3d
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.material_commands import (
    DiscardMaterial,
    Dress,
    KeepMaterial,
    new_material,
)
from engine3d.apps.editor.node_commands import DuplicateNodes
from engine3d.apps.editor.scene_state import SceneState


@pytest.fixture
def document():
    scene = e3d.Scene()
    scene.add(e3d.box(), name="box")
    two = e3d.Mesh.concatenate([e3d.box(), e3d.uv_sphere()], "two")
    scene.add(two, name="two", translation=(2, 0, 0))
    scene.add(name="empty")
    document = SceneDocument(scene)
    document.do(DuplicateNodes(scene, [scene.nodes[0]]))
    return document


def red(document, name="red"):
    material = e3d.Material(color=(200, 20, 20), name=name)
    document.do(KeepMaterial(document.resources, material, "Add"))
    return material


def test_one_of_two_nodes_that_share_a_mesh_is_dressed(document):
    box, _, _, other = document.scene.nodes
    before, plain = SceneState(document.scene), box.object.materials[0]
    material = red(document)
    assert document.do(Dress(document.resources, [box], material))
    assert box.object is not other.object and box.object.positions is other.object.positions
    assert box.object.materials[0] is material and other.object.materials[0] is plain
    after = SceneState(document.scene)
    document.undo()
    assert SceneState(document.scene) == before and box.object is other.object
    document.redo()
    assert SceneState(document.scene) == after


def test_all_nodes_that_share_a_mesh_go_on_sharing_it(document):
    box, _, _, other = document.scene.nodes
    mesh, material = box.object, red(document)
    document.do(Dress(document.resources, [box, other], material))
    assert box.object is other.object is mesh and mesh.materials[0] is material


def test_one_material_of_a_mesh_is_replaced(document):
    two, material = document.scene.nodes[1], red(document)
    count = len(two.object.materials)
    old = two.object.materials[0]
    document.do(Dress(document.resources, [two], material, 0))
    assert two.object.materials[0] is material and len(two.object.materials) == count
    document.undo()
    assert two.object.materials[0] is old


def test_what_has_no_mesh_gets_no_material(document):
    with pytest.raises(e3d.InvalidArgumentError, match="a mesh"):
        Dress(document.resources, [document.scene.nodes[2]], e3d.Material())


def test_a_dressed_node_is_saved_by_its_primitive(document, tmp_path):
    box = document.scene.nodes[0]
    document.do(Dress(document.resources, [box], red(document)))
    assert document.save(tmp_path / "a.e3d.json")
    assert '"primitive":"box"' in (tmp_path / "a.e3d.json").read_text()
    loaded = e3d.load_scene(tmp_path / "a.e3d.json")
    assert loaded.nodes[0].object.materials[0].name == "red"
    assert loaded.nodes[3].object.materials[0].name != "red"


def test_names_of_new_materials_are_free(document):
    first = red(document)
    names = []
    for like in (None, None, first, first):
        material = new_material(document.resources, like)
        document.do(KeepMaterial(document.resources, material, "Add"))
        names.append(material.name)
    assert names == ["material", "material 2", "red 2", "red 3"]
    assert material.color == first.color and material is not first
    material.color = (1, 2, 3)
    assert first.color == (200, 20, 20)


def test_a_material_that_nobody_uses_is_in_the_file(document, tmp_path):
    path = tmp_path / "a.e3d.json"
    red(document)
    assert document.is_modified and document.save(path)
    opened = SceneDocument.open(path)
    material = opened.resources.find("red", "material")
    assert material.color == (200, 20, 20)
    opened.do(DiscardMaterial(opened.resources, material))
    assert opened.resources.find("red") is None
    opened.undo()
    assert opened.resources.find("red") is material
    opened.redo()
    assert opened.save() and SceneDocument.open(path).resources.find("red") is None


def test_a_material_in_use_is_not_discarded(document):
    material = red(document)
    document.do(Dress(document.resources, [document.scene.nodes[0]], material))
    with pytest.raises(e3d.InvalidArgumentError, match="nodes use"):
        DiscardMaterial(document.resources, material)


def test_a_named_material_that_is_replaced_stays_in_the_list(document):
    box = document.scene.nodes[0]
    first, second = red(document), e3d.Material(name="blue")
    document.resources.drop(first)
    document.do(Dress(document.resources, [box], first))
    document.do(Dress(document.resources, [box], second))
    assert document.resources.find("red") is first and document.resources.users(first) == ()
    document.undo()
    assert document.resources.kept_materials == ()
    document.redo()
    assert document.resources.kept_materials == (first,)


def test_instances_are_dressed_alone(document):
    box, other = document.scene.nodes[0], document.scene.nodes[3]
    crowd = document.scene.add(e3d.InstancedMesh(box.object, [(3, 0, 0, 1), (4, 0, 0, 1)]))
    plain, before = other.object.materials[0], SceneState(document.scene)
    material = red(document)
    assert document.do(Dress(document.resources, [crowd], material))
    assert crowd.object.mesh.materials == [material] or material in crowd.object.mesh.materials
    assert len(crowd.object) == 2 and other.object.materials[0] is plain
    document.undo()
    document.undo()
    assert SceneState(document.scene) == before


def test_undoing_keeps_the_order_in_which_materials_are_saved(document):
    materials = [red(document, name) for name in ("a", "b", "c")]
    document.do(DiscardMaterial(document.resources, materials[0]))
    document.undo()
    assert list(document.resources.kept_materials) == materials
    box = document.scene.nodes[0]
    document.do(Dress(document.resources, [box], e3d.Material(name="d"), is_new=True))
    document.do(Dress(document.resources, [box], materials[1]))
    names = [material.name for material in document.resources.kept_materials]
    assert names == ["a", "b", "c", "d"]
    document.undo()
    document.undo()
    assert list(document.resources.kept_materials) == materials
