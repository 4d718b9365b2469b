"""Meshes and textures are loaded again into the same objects, which is undone as anything is."""

import numpy as np
import pytest
from loaders.seeds import FILES

import engine3d as e3d
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.reloading import Reload
from engine3d.apps.editor.scene_state import SceneState

MTL = b"newmtl brick\nKd .8 .2 .1\nmap_Kd house.tga\n"


@pytest.fixture
def folder(tmp_path):
    for name, data in {**FILES, "house.mtl": MTL}.items():
        (tmp_path / name).write_bytes(data)
    return tmp_path


def test_a_changed_file_is_loaded_into_the_same_mesh(folder):
    document = SceneDocument.open(folder / "house.obj")
    node = document.scene.nodes[0]
    mesh, material = node.object, node.object.materials[0]
    material.color = (0, 0, 255)
    before, faces = SceneState(document.scene), len(mesh.faces)
    (folder / "house.obj").write_bytes(FILES["house.obj"] + b"f 1 2 5\n")
    assert document.do(Reload(mesh))
    assert node.object is mesh and len(mesh.faces) == faces + 1
    assert mesh.materials[0] is not material and mesh.materials[0].color != (0, 0, 255)
    document.undo()
    assert SceneState(document.scene) == before and mesh.materials[0] is material
    document.redo()
    assert len(mesh.faces) == faces + 1
    (folder / "house.obj").write_bytes(b"o roof\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert not document.do(Reload(mesh))
    assert "no part 'walls'" in document.console.entries[-1].text
    assert len(mesh.faces) == faces + 1


def test_a_texture_is_loaded_again_or_from_elsewhere(folder):
    texture = e3d.load_texture(folder / "house.tga", wrap="clamp")
    pixels = texture.pixels
    other = folder / "other.png"
    frame = e3d.render(e3d.Scene(background=(1, 2, 3)), size=(4, 2))
    frame.save(other)
    document = SceneDocument()
    assert document.do(Reload(texture, other))
    assert texture.pixels.shape == (2, 4, 4) and texture.wrap == "clamp"
    document.undo()
    assert np.array_equal(texture.pixels, pixels)
    assert document.do(Reload(texture))


@pytest.mark.filterwarnings("ignore::engine3d.Engine3DWarning")
def test_a_missing_mesh_is_found_elsewhere(folder):
    scene = e3d.Scene()
    scene.add(e3d.load_mesh(folder / "house.obj"), name="house")
    e3d.save_scene(scene, folder / "a.e3d.json")
    (folder / "models").mkdir()
    for name in ("house.obj", "house.mtl", "house.tga"):
        (folder / name).rename(folder / "models" / name)
    document = SceneDocument.open(folder / "a.e3d.json")
    mesh = document.scene.nodes[0].object
    assert len(mesh.faces) == 0
    assert document.do(Reload(mesh, folder / "models" / "house.obj"))
    assert len(mesh.faces) > 0 and document.save()
    assert b'"file":"models/house.obj"' in (folder / "a.e3d.json").read_bytes()


def test_what_is_of_no_file_is_not_loaded_again():
    for thing in (e3d.box(), e3d.Texture(np.zeros((1, 1, 3), np.uint8))):
        with pytest.raises(e3d.InvalidArgumentError, match="is of no file"):
            Reload(thing)
