"""Dropped files become nodes and textures, and joined nodes one mesh; all of it can be undone."""

import numpy as np
import pytest
from loaders.seeds import FILES

import engine3d as e3d
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.dropping import drop_file
from engine3d.apps.editor.node_commands import JoinNodes
from engine3d.apps.editor.scene_state import SceneState

VIEW = e3d.PerspectiveCamera(), e3d.look_at((0, 0, 6), (0, 0, 0))


@pytest.fixture
def folder(tmp_path):
    for name, data in FILES.items():
        (tmp_path / name).write_bytes(data)
    return tmp_path


@pytest.mark.filterwarnings("ignore::engine3d.Engine3DWarning")
@pytest.mark.parametrize("name", ["house.obj", "a.gltf", "a.asc", "a.json"])
def test_a_model_becomes_nodes_under_its_name(folder, name):
    document = SceneDocument()
    before = SceneState(document.scene)
    command = drop_file(document.scene, folder / name, at=(5, 1, -3))
    assert document.do(command)
    top = document.selection.active
    assert top.name == name.partition(".")[0] and top.parent is None
    alone = e3d.load_scene(folder / name)
    assert [node.name for node in document.scene.nodes[1:]] == [n.name for n in alone.nodes]
    box = document.scene.bounds
    np.testing.assert_allclose((box[0] + box[1])[[0, 2]] / 2, (5, -3), atol=1e-5)
    assert box[0, 1] == pytest.approx(1, abs=1e-5)
    document.undo()
    assert SceneState(document.scene) == before
    document.redo()
    assert document.scene.nodes[0] is top


def test_a_scene_of_nothing_becomes_a_node_of_nothing(tmp_path):
    e3d.Scene().save(tmp_path / "empty.json")
    document = SceneDocument()
    assert document.do(drop_file(document.scene, tmp_path / "empty.json"))
    assert [node.name for node in document.scene.nodes] == ["empty"]


def test_an_image_is_painted_onto_a_node(folder):
    document = SceneDocument()
    scene = document.scene
    node = scene.add(e3d.box(), name="box")
    crowd = scene.add(e3d.InstancedMesh(e3d.box(), [(0, 0, 0, 1)]))
    for onto, mesh in ((node, node.object), (crowd, crowd.object.mesh)):
        assert document.do(drop_file(scene, folder / "house.tga", onto=onto))
        assert mesh.materials[0].texture.name == "house.tga"
    document.undo(), document.undo()
    assert node.object.materials[0].texture is None
    for onto in (None, scene.add(e3d.PointLight())):
        with pytest.raises(e3d.InvalidArgumentError, match="drop it onto a node with a mesh"):
            drop_file(scene, folder / "house.tga", onto=onto)


def test_what_cannot_be_read_is_an_error_and_changes_nothing(folder):
    scene = e3d.Scene()
    (folder / "damaged.obj").write_bytes(b"v 1 2 x\nf 1 1 1\n")
    for name, error in (("damaged.obj", e3d.FileFormatError), ("none.obj", e3d.FileAccessError)):
        with pytest.raises(error):
            drop_file(scene, folder / name)
    assert scene.nodes == ()


def test_joined_nodes_look_as_before():
    document = SceneDocument()
    scene = document.scene
    group = scene.add(translation=(0.5, 0, 0), scale=(1, -1, 1))
    ball, box = e3d.icosphere(0.7, 2), e3d.box()
    box.materials = [e3d.Material(color=(200, 40, 20))]
    nodes = [
        scene.add(ball, parent=group, translation=(-1, 0.3, 0), name="first"),
        scene.add(box, parent=group, euler=(0.3, 0.5, 0)),
        scene.add(e3d.PointLight(), name="lamp"),
    ]
    before, state = e3d.render(scene, VIEW, size=(64, 48)).color, SceneState(scene)
    assert document.do(JoinNodes(scene, nodes))
    joined = document.selection.active
    assert [node.name for node in scene.nodes] == ["", "lamp", "first"]
    assert len(joined.object.faces) == len(ball.faces) + len(box.faces)
    after = e3d.render(scene, VIEW, size=(64, 48)).color
    differs = np.abs(before.astype(int) - after).max(axis=2) > 2
    assert differs.mean() < 0.01 and before.std() > 10
    document.undo()
    assert SceneState(scene) == state
    document.redo()
    assert scene.nodes[-1] is joined
    with pytest.raises(e3d.InvalidArgumentError, match="holds a mesh"):
        JoinNodes(scene, [scene.find("lamp")])
