"""glTF as it is written: read again, it says the same."""

import base64
import io
import json
import struct
import warnings

import numpy as np
import pytest
from loaders.seeds import FILES
from loaders.test_gltf_corpus import cases, loaded, needs_package
from PIL import Image

import engine3d as e3d
from engine3d.errors import Engine3DError, Engine3DWarning, InvalidArgumentError
from engine3d.io.scenes.object_kinds import parameters
from engine3d.loaders import load_document
from engine3d.model.materials.material import TEXTURE_SLOTS
from engine3d.model.materials.textures import PlacedTexture

ENDS = (".glb", ".gltf")
_FIELDS = ("positions", "faces", "lines", "points", "uvs", "uvs1", "tangents", "colors")


def check_same_material(one, other):
    for name in parameters(type(one)):
        held, again = getattr(one, name), getattr(other, name)
        if name in TEXTURE_SLOTS:
            check_same_texture(held, again)
        elif name in ("color", "emissive", "specular_color", "sheen_color", "attenuation_color"):
            assert np.allclose(held, again, rtol=1e-6), name
        else:
            assert held == again, name


def check_same_texture(one, other):
    assert type(one) is type(other)
    if isinstance(one, PlacedTexture):
        place = (one.uv_set, one.offset, one.rotation, one.scale)
        assert place == (other.uv_set, other.offset, other.rotation, other.scale)
        one, other = one.texture, other.texture
    if one is not None:
        assert np.array_equal(one.pixels, other.pixels)
        assert (one.wrap, one.filter, one.name) == (other.wrap, other.filter, other.name)


def check_same_mesh(one, other):
    assert one.name == other.name
    for name in _FIELDS:
        held, again = getattr(one, name), getattr(other, name)
        assert (held is None) == (again is None), name
        if held is not None:
            assert np.array_equal(held, again, equal_nan=True), name
    assert one.has_normals == other.has_normals
    if one.has_normals:
        assert np.array_equal(one.normals, other.normals)
    assert np.array_equal(one.material_ids, other.material_ids)
    for held, again in zip(one.materials, other.materials, strict=True):
        check_same_material(held, again)
    assert (one.joints is None) == (other.joints is None)
    if one.joints is not None:
        assert np.array_equal(one.joints, other.joints)
        assert np.allclose(one.weights, other.weights, atol=1e-6)
    for held, again in zip(one.morph_targets, other.morph_targets, strict=True):
        assert held.name == again.name
        for name in ("positions", "normals", "tangents"):
            assert np.array_equal(getattr(held, name), getattr(again, name))


def check_same_scene(one, other):
    assert len(one.nodes) == len(other.nodes)
    number = {node: k for k, node in enumerate(one.nodes)}
    again = {node: k for k, node in enumerate(other.nodes)}
    for a, b in zip(one.nodes, other.nodes, strict=True):
        assert (a.name, a.visible, number.get(a.parent)) == (b.name, b.visible, again.get(b.parent))
        assert np.allclose(a.pose, b.pose, rtol=1e-6, atol=1e-9)
        assert type(a.object) is type(b.object)
        if isinstance(a.object, e3d.Mesh):
            check_same_mesh(a.object, b.object)
        elif isinstance(a.object, e3d.InstancedMesh):
            assert np.allclose(a.object.poses, b.object.poses, rtol=1e-5, atol=1e-6)
            assert np.array_equal(a.object.colors, b.object.colors)
            check_same_mesh(a.object.mesh, b.object.mesh)
        else:
            assert repr(a.object) == repr(b.object)
        assert (a.skin is None) == (b.skin is None)
        if a.skin is not None:
            assert a.skin.name == b.skin.name
            assert [number[j] for j in a.skin.joints] == [again[j] for j in b.skin.joints]
            assert np.array_equal(a.skin.inverse_binds, b.skin.inverse_binds)
        weights = [None if n.morph_weights is None else n.morph_weights.tolist() for n in (a, b)]
        assert weights[0] == weights[1]
    assert list(one.animations) == list(other.animations)
    for a, b in zip(one.animations.values(), other.animations.values(), strict=True):
        for held, read in zip(a.channels, b.channels, strict=True):
            assert type(held) is type(read)
            if isinstance(held, e3d.motion.Channel):
                assert number[held.node] == again[read.node]
            assert (held.path, held.interpolation) == (read.path, read.interpolation)
            assert np.array_equal(held.times, read.times)
            assert np.array_equal(held.values, read.values)
    shared = [len({id(n.object) for n in s.nodes if n.object is not None}) for s in (one, other)]
    assert shared[0] == shared[1]


def saved_and_read(scene, path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", Engine3DWarning)
        scene.save(path)
        return e3d.load_scene(path)


@pytest.mark.parametrize("case", cases("models", "generator", "own"))
def test_files_of_others_come_back(case, tmp_path):
    scene = loaded(e3d.load_scene, case)
    if isinstance(scene, Engine3DError) or needs_package(scene):
        return
    again = saved_and_read(scene, tmp_path / "a.glb")
    check_same_scene(scene, again)
    saved_and_read(again, tmp_path / "b.glb")
    if {"skin", "EXT_mesh_gpu_instancing"} & set(case["features"]):
        return  # weights and matrices are rounded each time
    assert (tmp_path / "a.glb").read_bytes() == (tmp_path / "b.glb").read_bytes()


@pytest.mark.parametrize("end", ENDS)
@pytest.mark.parametrize("name", ["a.gltf", "moving.gltf", "moving.glb"])
def test_a_scene_comes_back(tmp_path, name, end):
    (tmp_path / "house.tga").write_bytes(FILES["house.tga"])
    (tmp_path / name).write_bytes(FILES[name])
    scene = e3d.load_scene(tmp_path / name)
    again = saved_and_read(scene, tmp_path / f"again{end}")
    assert again.warnings == []
    check_same_scene(scene, again)
    tree, other = (load_document(tmp_path / n).tree for n in (name, f"again{end}"))
    assert tree.variants == other.variants
    assert [mesh.extras for mesh in tree.meshes] == [mesh.extras for mesh in other.meshes]
    for held, read in zip(
        (*tree.cameras, *tree.lights), (*other.cameras, *other.lights), strict=True
    ):
        assert vars(held) == vars(read)


def test_a_scene_of_our_own_comes_back(tmp_path):
    scene = e3d.Scene()
    glass = e3d.Material(
        name="glass", metallic=0.0, roughness=0.25, color=e3d.linear(0.5, 1.0, 1.0, 0.5),
        alpha_mode="blend",
        transmission=0.75, thickness=2.0, attenuation_distance=3.0, ior=1.25, two_sided=True,
        dispersion=0.5,
        diffuse_transmission=0.5, diffuse_transmission_color=e3d.linear(0.5, 1.0, 0.25),
        anisotropy=0.5, anisotropy_rotation=1.5, iridescence=0.5, iridescence_ior=1.75,
        iridescence_thickness_minimum=50.0, iridescence_thickness_maximum=800.0,
        extras={"kind": "cup"},
    )  # fmt: skip
    ball = e3d.uv_sphere()
    ball.materials = [glass]
    above = scene.add(name="above", translation=(1, 2, 3))
    scene.add(ball, name="left", parent=above, scale=(1, 2, 3))
    scene.add(ball, name="right", parent=above, rotation=(0, 0, 0.6, 0.8)).visible = False
    scene.add(e3d.SpotLight(e3d.linear(1.0, 1.0, 1.0), 20.0, range=9.0), name="spot")
    scene.add(e3d.PerspectiveCamera(0.5, zfar=None), name="eye", translation=(0, 0, 9))
    again = saved_and_read(scene, tmp_path / "a.glb")
    check_same_scene(scene, again)
    assert again.find("left").object is again.find("right").object


def test_lights_that_shine_elsewhere_are_turned(tmp_path):
    scene = e3d.Scene()
    scene.add(e3d.DirectionalLight((1, -2, 0.5), intensity=3.0), name="sun")
    again = saved_and_read(scene, tmp_path / "a.glb")
    (node,) = [node for node in again.nodes if node.object is not None]
    way = -node.world_pose[:3, 2]
    assert np.allclose(way / way[0], (1, -2, 0.5))
    assert node.object.intensity == 3.0


def jpeg(array):
    file = io.BytesIO()
    Image.fromarray(array).save(file, "JPEG")
    return file.getvalue()


def images_of(path):
    """The bytes of a .glb file's images."""
    data = path.read_bytes()
    (size,) = struct.unpack_from("<I", data, 12)
    tree, binary = json.loads(data[20 : 20 + size]), data[28 + size :]
    views = [tree["bufferViews"][image["bufferView"]] for image in tree.get("images", ())]
    return [binary[v["byteOffset"] : v["byteOffset"] + v["byteLength"]] for v in views]


def test_images_keep_their_bytes_while_they_are_the_same(tmp_path):
    content = jpeg(np.arange(192, dtype=np.uint8).reshape(8, 8, 3))
    tree = json.loads(FILES["a.gltf"])
    uri = "data:image/jpeg;base64," + base64.b64encode(content).decode()
    tree["images"] = [{"uri": uri}]
    (tmp_path / "a.gltf").write_text(json.dumps(tree))
    scene = e3d.load_scene(tmp_path / "a.gltf")
    scene.save(tmp_path / "a.glb")
    assert images_of(tmp_path / "a.glb") == [content]
    material = scene.nodes[1].object.materials[0]
    material.texture.texture.pixels = np.zeros((2, 2, 3), np.uint8)
    scene.save(tmp_path / "a.glb")
    (image,) = images_of(tmp_path / "a.glb")
    assert image.startswith(b"\x89PNG")


def test_mirrors_are_lost_with_a_warning(tmp_path):
    scene = e3d.Scene()
    pane = e3d.plane()
    pane.materials = [e3d.Material(name="pane", metallic=1.0, mirror=0.5)]
    scene.add(pane)
    with pytest.warns(Engine3DWarning, match="gltf files do not hold mirror of 'pane'"):
        scene.save(tmp_path / "pane.glb")
    scene.save(tmp_path / "pane.e3d.json")
    (node,) = e3d.load_scene(tmp_path / "pane.e3d.json").nodes
    assert node.object.materials[0].mirror == 0.5


def test_what_states_no_material_loses_none(tmp_path):
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        e3d.save_mesh(e3d.box(), tmp_path / "box.glb")
        e3d.save_mesh(e3d.torus().transformed(np.eye(4)), tmp_path / "torus.glb")
    assert {str(one.message).partition(": ")[2] for one in told} == {
        f"mesh '{name}': gltf files hold no polygons" for name in ("box", "torus")
    }


@pytest.mark.parametrize("end", ENDS)
def test_a_mesh_becomes_a_file(tmp_path, end):
    mesh = e3d.box()
    mesh.materials = [
        e3d.Material(color=e3d.linear(0.5, 0.25, 0.0), specular=(1, 1, 1), shininess=6.0)
    ]
    with pytest.warns(Engine3DWarning, match="gltf files hold physical materials: 1 others"):
        mesh.save(tmp_path / f"a{end}")
    again = e3d.load_mesh(tmp_path / f"a{end}")
    assert np.array_equal(again.positions, mesh.positions)
    (material,) = again.materials
    assert (material.color, material.metallic) == (e3d.linear(0.5, 0.25, 0.0), 0)
    assert material.roughness == pytest.approx(0.25**0.25)
    stream = io.BytesIO()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        e3d.save_mesh(mesh, stream, format=end[1:])
    assert stream.getvalue() == (tmp_path / f"a{end}").read_bytes()


def test_what_is_lost_is_told(tmp_path):
    scene = e3d.Scene(background=(10, 20, 30))
    mesh = e3d.box()
    mesh.groups = {"top": [0, 1]}
    scene.add(mesh, name="crate").collider = e3d.colliders.BoxCollider()
    scene.add(e3d.IntrinsicsCamera(9, 9, 5, 5), name="lens")
    scene.add(e3d.PointLight(range=3.0, falloff="window"), name="lamp")
    with pytest.warns(Engine3DWarning) as told:
        scene.save(tmp_path / "a.glb")
    lines = " ".join(str(warning.message) for warning in told)
    for lost in ("background", "colliders", "groups", "IntrinsicsCamera", "'window'"):
        assert lost in lines


def test_a_variant_is_chosen(tmp_path):
    (tmp_path / "house.tga").write_bytes(FILES["house.tga"])
    path = tmp_path / "a.gltf"
    path.write_bytes(FILES["moving.gltf"])
    usual, a, b = (e3d.load_scene(path, variant=v) for v in (None, "a", 1))
    materials = [scene.nodes[0].object.materials[0] for scene in (usual, a, b)]
    assert [material.alpha_mode for material in materials] == ["mask", "mask", "opaque"]
    for variant in ("c", 2):
        with pytest.raises(InvalidArgumentError, match=r"no variant .* \(there are: 'a', 'b'\)"):
            e3d.load_scene(path, variant=variant)


@pytest.mark.parametrize("extension", [".gltf", ".glb"])
@pytest.mark.parametrize("odd", [float("inf"), float("nan"), {1, 2}, [[[float("-inf")]]]])
def test_extras_that_json_does_not_hold_are_left_out(extension, odd, tmp_path):
    """JSON has no infinite numbers, but a file's 1e999 is one."""
    box = e3d.box()
    box.materials = [
        e3d.Material(name="odd", metallic=1.0, extras={"a": odd}),
        e3d.Material(name="plain", metallic=1.0, extras={"a": 1.5}),
    ]
    box.material_ids = [0, 1] * 6
    path = tmp_path / f"a{extension}"
    scene = e3d.Scene()
    scene.add(box)
    with pytest.warns(e3d.Engine3DWarning, match="extras that JSON does not hold are left out"):
        e3d.save_scene(scene, path)
    assert b"Infinity" not in path.read_bytes() and b"NaN" not in path.read_bytes()
    (read,) = [node.object for node in e3d.load_scene(path).nodes if node.object is not None]
    assert [material.extras for material in read.materials] == [{}, {"a": 1.5}]


def test_clips_keep_the_names_under_which_a_scene_holds_them(tmp_path):
    scene = e3d.Scene()
    node = scene.add(e3d.box(), name="box")
    keys = [0, 1], [(0, 0, 0), (0, 1, 0)]
    one, other = (
        e3d.motion.AnimationClip([e3d.motion.Channel(node, "translation", *keys)], name)
        for name in ("", "run")
    )
    scene.animations = {"hop": one, "walk": other}
    e3d.save_scene(scene, tmp_path / "a.glb")
    assert list(e3d.load(tmp_path / "a.glb").animations) == ["hop", "walk"]
