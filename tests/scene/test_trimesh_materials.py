"""What things of trimesh wear: materials of glTF and of MTL files, colours, lights."""

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.errors import Engine3DWarning
from engine3d.io.scenes.trimesh_scenes import scene_from_trimesh
from engine3d.model.materials.material import PARAMETERS, TEXTURE_SLOTS

trimesh = pytest.importorskip("trimesh")

from trimesh.visual import TextureVisuals  # noqa: E402
from trimesh.visual.material import MultiMaterial, PBRMaterial, SimpleMaterial  # noqa: E402


def image(*color):
    return Image.new("RGB", (4, 4), color)


PHYSICAL = {
    "everything": {
        "name": "all",
        "baseColorFactor": [200, 100, 50, 128],
        "metallicFactor": 0.25,
        "roughnessFactor": 0.5,
        "emissiveFactor": [0.5, 0.25, 1.0],
        "baseColorTexture": image(250, 120, 10),
        "metallicRoughnessTexture": image(0, 100, 200),
        "normalTexture": image(140, 120, 250),
        "occlusionTexture": image(90, 90, 90),
        "emissiveTexture": image(60, 160, 60),
        "doubleSided": True,
        "alphaMode": "MASK",
        "alphaCutoff": 0.25,
    },
    "glass": {
        "baseColorFactor": [255, 0, 0, 100],
        "alphaMode": "BLEND",
        "metallicFactor": 0.0,
        "roughnessFactor": 0.0,
    },
    "maps alone": {"metallicRoughnessTexture": image(0, 100, 200)},
}


def wearing(material, **visuals):
    box = trimesh.creation.box()
    box.visual = TextureVisuals(uv=np.zeros((8, 2)), material=material, **visuals)
    return box


def mesh_of(thing):
    (node,) = (one for one in scene_from_trimesh(thing).nodes if isinstance(one.object, e3d.Mesh))
    return node.object


def held(material, field):
    """Return a field that can be compared."""
    value = getattr(material, field)
    if isinstance(value, e3d.Texture):
        return value.pixels.tolist()
    return np.round(value, 6).tolist() if isinstance(value, float | tuple) else value


@pytest.mark.parametrize("name", PHYSICAL)
def test_a_material_is_the_one_that_the_gltf_reader_makes_of_it(name, tmp_path):
    thing = wearing(PBRMaterial(**PHYSICAL[name]))
    (tmp_path / "a.glb").write_bytes(thing.export(file_type="glb"))
    (expected,) = e3d.load_mesh(tmp_path / "a.glb").materials
    (found,) = mesh_of(thing).materials
    fields = [field for field, row in PARAMETERS.items() if row.gltf or field in TEXTURE_SLOTS]
    for field in (*fields, "two_sided", "alpha_mode"):
        assert held(found, field) == held(expected, field), field


def test_what_is_clear_and_says_no_mode_is_blended():
    for material in (
        PBRMaterial(baseColorFactor=[255, 0, 0, 51]),
        SimpleMaterial(diffuse=[255, 0, 0, 51]),
        SimpleMaterial(diffuse=[255, 0, 0, 255], d=["0.2"]),
    ):
        (found,) = mesh_of(wearing(material)).materials
        assert (found.alpha_mode, found.alpha) == ("blend", pytest.approx(0.2))
    (found,) = mesh_of(wearing(PBRMaterial(baseColorFactor=[255, 0, 0, 255]))).materials
    assert (found.alpha_mode, found.is_physical) == ("opaque", False)


def test_highlights_of_simple_materials_show():
    shiny = SimpleMaterial(specular=[255, 255, 255, 255], glossiness=50)
    (found,) = mesh_of(wearing(shiny)).materials
    assert (found.specular, found.shininess) == ((1.0, 1.0, 1.0), 50.0)
    (found,) = mesh_of(wearing(SimpleMaterial(illum=["1"], specular=[9, 9, 9, 255]))).materials
    assert found.specular == mesh_of(wearing(SimpleMaterial())).materials[0].specular == (0, 0, 0)


def test_each_face_has_its_own_of_several_materials():
    several = MultiMaterial([PBRMaterial(name="a"), PBRMaterial(name="b")])
    numbers = [0, 1] * 6
    mesh = mesh_of(wearing(several, face_materials=numbers))
    assert [material.name for material in mesh.materials] == ["a", "b"]
    assert mesh.material_ids.tolist() == numbers
    with pytest.warns(Engine3DWarning, match="face_materials do not say which of 2 materials"):
        assert not mesh_of(wearing(several)).material_ids.any()


def test_what_is_left_out_is_named():
    with pytest.warns(Engine3DWarning, match="map_bump of material 'm': trimesh holds no image"):
        mesh_of(wearing(SimpleMaterial(name="m", map_bump=["a.png"])))
    with pytest.warns(Engine3DWarning, match="metallicFactor of material 'm' is left out"):
        mesh_of(wearing(PBRMaterial(name="m", metallicFactor=3.0)))
    scene = trimesh.creation.box().scene()
    scene.lights = [trimesh.scene.lighting.DirectionalLight(name="sun")]
    with pytest.warns(Engine3DWarning, match=r"the lights of a trimesh.Scene are left out"):
        scene_from_trimesh(scene)
    usual = trimesh.creation.box().scene()
    assert len(usual.lights) == 2
    scene_from_trimesh(usual)


@pytest.mark.parametrize("kind", ["face", "vertex"])
def test_the_alpha_of_colours_counts(kind):
    box = trimesh.creation.box()
    setattr(box.visual, f"{kind}_colors", [200, 100, 50, 255])
    assert mesh_of(box).materials[0].alpha_mode == "opaque"
    setattr(box.visual, f"{kind}_colors", [200, 100, 50, 90])
    assert mesh_of(box).materials[0].alpha_mode == "blend"


def test_paths_and_clouds_keep_their_colours():
    path = trimesh.load_path(np.array([[[0, 0, 0], [1, 0, 0]], [[0, 1, 0], [1, 1, 0.0]]]))
    path.colors = [[255, 0, 0, 255], [0, 255, 0, 90]]
    mesh = mesh_of(path)
    red, green = (mesh.colors[ends].tolist() for ends in mesh.lines)
    assert red == [[255, 0, 0, 255]] * 2 and green == [[0, 255, 0, 90]] * 2
    assert mesh.materials[0].alpha_mode == "blend"
    cloud = trimesh.PointCloud(np.eye(3), colors=[[255, 0, 0, 90]] * 3)
    assert mesh_of(cloud).materials[0].alpha_mode == "blend"
