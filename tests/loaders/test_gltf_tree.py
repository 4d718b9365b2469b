"""The tree of a glTF file as plain data, and the scene that becomes of it."""

import importlib.util
import json
import math
import struct
import subprocess
import sys

import numpy as np
import pytest
from loaders.meshopt_reference import pack_attributes, random_triangles
from loaders.seeds import FILES
from loaders.test_gltf import add_attribute, add_buffer, as_glb, png, triangle_tree
from plain_picture import render

import engine3d as e3d
from engine3d.apps.cli.commands.info import describe
from engine3d.errors import Engine3DWarning, FileFormatError
from engine3d.io.formats.gltf import gltf_basisu
from engine3d.io.loaders import load_document, load_mesh


def moving():
    return json.loads(FILES["moving.gltf"])


def read(tree, tmp_path):
    (tmp_path / "house.tga").write_bytes(FILES["house.tga"])
    path = tmp_path / "a.gltf"
    path.write_text(json.dumps(tree))
    return load_document(path)


def test_a_file_is_plain_data(tmp_path):
    tree = moving()
    tree["nodes"][1]["extras"] = {"a": [1]}
    record = read(tree, tmp_path).tree
    assert record.roots == (0, 1, 4)
    assert record.nodes[1].extras == {"a": [1]}
    assert record.nodes[1].translation == (0, 0, 1)
    assert (record.nodes[1].rotation, record.nodes[1].matrix) == (None, None)
    assert record.nodes[0].weights == (0.5,)
    assert not record.nodes[3].visible
    mesh = record.meshes[0]
    assert mesh.morph_weights == (0.25,)
    (target,) = mesh.mesh.morph_targets
    assert (target.name, target.positions.tolist()) == ("up", [[0, 0, 0.5]] * 3)
    assert mesh.mesh.joints.tolist() == [[0, 1, 0, 0]] * 3
    assert mesh.mesh.weights.tolist() == [[0.5, 0.5, 0, 0]] * 3
    (skin,) = record.skins
    assert (skin.joints, skin.skeleton) == ((1, 2), 1)
    assert np.array_equal(skin.inverse_binds, [np.eye(4)] * 2)
    (clip,) = record.clips
    assert (clip.name, clip.duration) == ("turn", 1.0)
    turn, weights = clip.channels
    assert (turn.node, turn.path, turn.interpolation) == (1, "rotation", "linear")
    assert turn.times.tolist() == [0, 1]
    assert np.allclose(turn.values, [[0, 0, 0, 1], [0, 0, 0.6, 0.8]])
    assert (weights.path, weights.interpolation) == ("weights", "step")
    assert weights.values.tolist() == [[0], [1]]
    eye, flat = record.cameras
    assert (eye.kind, eye.yfov, eye.znear, eye.zfar) == ("perspective", 0.8, 0.1, math.inf)
    assert (flat.kind, flat.xmag, flat.ymag, flat.zfar) == ("orthographic", 1, 1, 9)
    (lamp,) = record.lights
    assert (lamp.kind, lamp.intensity, lamp.outer_cone_angle) == ("spot", 1, 0.5)
    assert record.variants == ("a", "b")
    assert list(mesh.variants) == [1]


def test_a_scene_holds_all_of_it(tmp_path):
    read(moving(), tmp_path)
    scene = e3d.load_scene(tmp_path / "a.gltf")
    mesh, joint, eye, lamp, flat, many = scene.nodes
    assert mesh.skin.joints == (joint, eye)
    assert mesh.morph_weights.tolist() == [0.5]
    assert isinstance(eye.object, e3d.PerspectiveCamera) and isinstance(lamp.object, e3d.SpotLight)
    assert lamp.parent is eye and flat.parent is eye and not flat.visible
    assert len(many.object) == 3 and len(many.object.mesh.points) == 3
    assert scene.animations["turn"].duration == 1.0


def test_meshes_stay_shared(tmp_path):
    tree = triangle_tree()
    tree["nodes"] = [{"mesh": 0, "children": [1]}, {"mesh": 0, "translation": [1, 0, 0]}]
    read(tree, tmp_path)
    one, other = e3d.load_scene(tmp_path / "a.gltf").nodes
    assert one.object is other.object and other.parent is one


def test_rest_is_as_the_file_has_it(tmp_path):
    """Both joints move up by 1, the morph target by a quarter; the node's pose does nothing."""
    tree = moving()
    tree["nodes"][0]["translation"] = [9, 9, 9]
    tree["nodes"][4] = {}
    document = read(tree, tmp_path)
    assert document.objects[0].mesh.positions[:, 2].tolist() == [0, 0, 0]
    assert load_mesh(tmp_path / "a.gltf").positions[:, 2].tolist() == [1.25] * 3
    report = describe(tmp_path / "a.gltf")
    assert report["bounds"] == [[0, 0, 1.25], [1, 1, 1.25]]
    assert report["animations"] == [{"name": "turn", "duration": 1.0}]
    assert (report["skins"], report["cameras"]) == ([{"joints": 2}], 2)
    assert (report["lights"], report["variants"]) == (["spot"], ["a", "b"])


def test_instances_count(tmp_path):
    tree = triangle_tree()
    attributes = {"TRANSLATION": 0}
    tree["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": attributes}}
    document = read(tree, tmp_path)
    assert document.tree.nodes[0].instances[:, :3, 3].tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    report = describe(tmp_path / "a.gltf")
    assert (report["triangles"], report["bounds"]) == (3, [[0, 0, 0], [2, 2, 0]])
    assert len(load_mesh(tmp_path / "a.gltf").faces) == 3


def test_instances_have_colours(tmp_path):
    """Those of three.js's name; what else instances say is told."""
    tree = triangle_tree()
    attributes = {"TRANSLATION": 0, "_COLOR_0": 0, "_ID": 0}
    tree["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": attributes}}
    with pytest.warns(Engine3DWarning, match="what instances say of '_ID' is left out"):
        read(tree, tmp_path)
    colors = [[0, 0, 0, 1], [1, 0, 0, 1], [0, 1, 0, 1]]
    scene = e3d.load_scene(tmp_path / "a.gltf")
    assert scene.nodes[0].object.colors.tolist() == colors
    whole = load_mesh(tmp_path / "a.gltf")
    assert whole.colors[::3].tolist() == colors
    scene.save(tmp_path / "b.glb")
    again = e3d.load_scene(tmp_path / "b.glb").nodes[0].object
    assert again.colors.tolist() == colors and np.allclose(again.poses, scene.nodes[0].object.poses)


def test_colours_of_as_many_instances(tmp_path):
    tree = triangle_tree()
    tree["accessors"].append({**tree["accessors"][0], "count": 2})
    attributes = {"TRANSLATION": 0, "_COLOR_0": len(tree["accessors"]) - 1}
    tree["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": attributes}}
    with pytest.warns(Engine3DWarning, match="_COLOR_0 is left out: 2 colours for 3 instances"):
        document = read(tree, tmp_path)
    assert document.tree.nodes[0].instance_colors is None


def test_hidden_nodes_do_not_count(tmp_path):
    tree = triangle_tree()
    tree["nodes"] = [{"children": [1]}, {"mesh": 0}]
    tree["nodes"][0]["extensions"] = {"KHR_node_visibility": {"visible": False}}
    read(tree, tmp_path)
    report = describe(tmp_path / "a.gltf")
    assert (report["triangles"], report["bounds"], report["nodes"]) == (0, None, 2)
    assert [node.shown for node in e3d.load_scene(tmp_path / "a.gltf").nodes] == [False, False]


def test_primitives_of_one_kind_are_one_mesh(tmp_path):
    tree = triangle_tree(points=4)
    primitive = tree["meshes"][0]["primitives"][0]
    tree["materials"] = [{"name": "a"}, {"name": "b"}]
    tree["meshes"][0]["primitives"] = [
        {**primitive, "material": 1},
        {"attributes": {"POSITION": 2}, "mode": 1, "material": 0},
        primitive,
        {"attributes": {"POSITION": 2}, "mode": 3, "material": 0},
    ]
    (record,) = read(tree, tmp_path).tree.meshes
    mesh, lines = (part.mesh for part in record.parts)
    assert mesh.faces.tolist() == [[0, 1, 2], [3, 4, 5]]
    assert [material.name for material in mesh.materials] == ["b", ""]
    assert mesh.material_ids.tolist() == [0, 1]
    assert len(lines.lines) == 2 + 3
    scene = e3d.load_scene(tmp_path / "a.gltf")
    assert [node.object for node in scene.nodes][1].lines.tolist() == lines.lines.tolist()
    assert scene.nodes[1].parent is scene.nodes[0]


def test_all_that_vertices_carry(tmp_path):
    tree = triangle_tree()
    rng = np.random.default_rng(3)
    tangents = np.array([[1, 0, 0, 1], [1, 0, 0, -1], [1, 0, 0, 1]], np.float32)
    uvs = rng.random((3, 2)).astype(np.float32)
    add_attribute(tree, "NORMAL", np.tile(np.float32([0, 0, 1]), (3, 1)))
    add_attribute(tree, "TANGENT", tangents)
    add_attribute(tree, "TEXCOORD_0", uvs)
    add_attribute(tree, "TEXCOORD_1", uvs[::-1].copy())
    colors = np.array([[0, 255, 51, 102]] * 3, np.uint8)
    add_attribute(tree, "COLOR_0", colors, normalized=True)
    mesh = read(tree, tmp_path).tree.meshes[0].mesh
    assert np.array_equal(mesh.tangents, tangents)
    flipped = np.stack([uvs[:, 0], np.float32(1) - uvs[:, 1]], axis=1)
    assert np.array_equal(mesh.uvs, flipped) and np.array_equal(mesh.uvs1, flipped[::-1])
    assert np.allclose(mesh.colors, colors / 255) and mesh.colors.dtype == np.float32


def test_without_normals_faces_are_flat_and_tangents_nothing(tmp_path):
    tree = triangle_tree()
    add_attribute(tree, "TANGENT", np.tile(np.float32([1, 0, 0, 1]), (3, 1)))
    mesh = read(tree, tmp_path).tree.meshes[0].mesh
    assert mesh.tangents is None and mesh.materials[0].flat_shading
    assert (mesh.materials[0].metallic, mesh.materials[0].roughness) == (1, 1)


def textured(sets):
    """A triangle with coordinates in some sets, and a texture that is read by each of them."""
    tree = triangle_tree()
    for number in sets:
        add_attribute(tree, f"TEXCOORD_{number}", np.full((3, 2), number / 8, np.float32))
    tree["images"] = [{"bufferView": add_buffer(tree, png(np.zeros((1, 1), np.uint8)))}]
    tree["textures"] = [{"source": 0}]
    infos = [{"index": 0, "texCoord": number} for number in sets]
    keys = ("normalTexture", "occlusionTexture", "emissiveTexture")
    tree["materials"] = [dict(zip(keys, infos, strict=False))]
    tree["meshes"][0]["primitives"][0]["material"] = 0
    return tree


def test_any_two_sets_of_coordinates_are_read(tmp_path):
    mesh = read(textured([2, 5]), tmp_path).tree.meshes[0].mesh
    assert (mesh.uvs[0, 0], mesh.uvs1[0, 0]) == (0.25, 0.625)
    (material,) = mesh.materials
    assert isinstance(material.normal_texture, e3d.Texture)
    assert material.occlusion_texture.uv_set == 1
    with pytest.warns(Engine3DWarning, match="of 3 sets of texture coordinates two are drawn"):
        read(textured([1, 2, 3]), tmp_path)


def test_glossiness_becomes_roughness(tmp_path):
    tree = textured([])
    gloss = np.zeros((1, 2, 4), np.uint8)
    gloss[0, :, :3], gloss[0, :, 3] = [200, 100, 50], [255, 51]
    tree["images"] = [{"bufferView": add_buffer(tree, png(gloss))}]
    said = {"specularGlossinessTexture": {"index": 0}, "glossinessFactor": 0.5}
    said |= {"diffuseFactor": [0.5, 0.25, 1, 0.5], "specularFactor": [0.1, 0.2, 0.3]}
    tree["materials"] = [{"extensions": {"KHR_materials_pbrSpecularGlossiness": said}}]
    (material,) = read(tree, tmp_path).tree.meshes[0].mesh.materials
    assert (material.metallic, material.roughness, material.ior) == (0, 1, 0)
    assert material.color == e3d.linear(0.5, 0.25, 1, 0.5)
    assert material.specular_color == e3d.linear(0.1, 0.2, 0.3)
    assert np.array_equal(material.specular_color_texture.pixels, gloss)
    green = material.metallic_roughness_texture.pixels[0, :, 1]
    assert green.tolist() == [128, 230]  # 255 - 127.5 and 255 - 25.5, rounded up
    del said["specularGlossinessTexture"]
    (material,) = read(tree, tmp_path).tree.meshes[0].mesh.materials
    assert (material.roughness, material.metallic_roughness_texture) == (0.5, None)


def pack(tree, view, packed, **said):
    """Give a view packed bytes in place of its own."""
    index = add_buffer(tree, packed)
    place = {key: tree["bufferViews"][index][key] for key in ("buffer", "byteLength")}
    tree["bufferViews"].pop()
    said = {**place, "mode": "ATTRIBUTES", **said}
    tree["bufferViews"][view]["extensions"] = {"EXT_meshopt_compression": said}
    tree["bufferViews"][view]["buffer"] = 0
    tree["extensionsRequired"] = ["EXT_meshopt_compression"]


def test_meshopt_is_unpacked(tmp_path):
    import random

    tree, choice = triangle_tree(), random.Random(1)
    positions = np.arange(9, dtype=np.float32).reshape(3, 3)
    packed = pack_attributes(positions.view(np.uint8), 1, choice)
    pack(tree, 0, packed, byteStride=12, count=3)
    assert np.array_equal(read(tree, tmp_path).tree.meshes[0].mesh.positions, positions)
    pack(tree, 0, packed[:-1], byteStride=12, count=3)
    with pytest.raises(FileFormatError, match=r"bufferViews\[0\], 3 elements of 12 bytes packed"):
        read(tree, tmp_path)
    pack(tree, 0, packed, byteStride=256, count=1 << 40)
    with pytest.raises(FileFormatError, match=r"bufferViews\[0\] unpacks to more than"):
        read(tree, tmp_path)
    packed, corners = random_triangles(1, choice)
    pack(tree, 0, pack_attributes(positions.view(np.uint8), 1, choice), byteStride=12, count=3)
    pack(tree, 1, packed, byteStride=2, count=3, mode="TRIANGLES")
    if max(corners) < 3:
        assert read(tree, tmp_path).tree.meshes[0].mesh.faces.tolist() == [corners]


@pytest.mark.skipif(importlib.util.find_spec("DracoPy") is None, reason="needs engine3d[draco]")
def test_draco_is_unpacked(tmp_path, monkeypatch):
    import DracoPy

    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.5]], np.float32)
    faces = np.array([[0, 1, 2], [2, 1, 3]], np.uint32)
    packed = DracoPy.encode(points, faces, quantization_bits=14)
    tree = triangle_tree()
    said = {"bufferView": add_buffer(tree, packed), "attributes": {"POSITION": 0}}
    primitive = tree["meshes"][0]["primitives"][0]
    primitive["extensions"] = {"KHR_draco_mesh_compression": said}
    tree["accessors"][0] = {"componentType": 5126, "count": 4, "type": "VEC3"}
    tree["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    mesh = read(tree, tmp_path).tree.meshes[0].mesh
    assert len(mesh.faces) == 2
    # Draco turns faces and reorders both.
    found, given = (
        sorted(p[f].sum(axis=1).round(2).tolist())
        for p, f in ((mesh.positions, mesh.faces), (points, faces))
    )
    assert found == given
    said["attributes"]["POSITION"] = 7
    with pytest.raises(FileFormatError, match="Draco has no attribute for POSITION"):
        read(tree, tmp_path)
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name, *rest: None if "Draco" in name else find(name)
    )
    with pytest.raises(FileFormatError, match=r"needs the package DracoPy: pip install 'engine3d"):
        read(tree, tmp_path)


def test_packed_textures_name_their_package(tmp_path, monkeypatch):
    monkeypatch.setattr(gltf_basisu, "is_installed", lambda: False)
    tree = textured([0])
    packed = b"\xabKTX 20\xbb\r\n\x1a\n" + struct.pack("<5I", 0, 1, 4, 4, 0) + bytes(100)
    tree["images"].append({"bufferView": add_buffer(tree, packed), "mimeType": "image/ktx2"})
    tree["textures"][0]["extensions"] = {"KHR_texture_basisu": {"source": 1}}
    mesh = read(tree, tmp_path).tree.meshes[0].mesh
    assert mesh.materials[0].normal_texture.pixels.shape == (1, 1, 4)  # the one that it can read
    del tree["textures"][0]["source"]
    with pytest.raises(
        FileFormatError, match=r"package opengl-basisu: pip install 'engine3d\[ktx2"
    ):
        read(tree, tmp_path)


def test_equal_times_and_rotations_without_direction(tmp_path):
    tree = moving()
    tree["accessors"][4] = {"componentType": 5126, "count": 2, "type": "SCALAR"}
    tree["accessors"][6] = {"componentType": 5126, "count": 2, "type": "VEC4"}
    with pytest.warns(Engine3DWarning):
        document = read(tree, tmp_path)
    told = " ".join(document.warnings)
    assert "equal times: the last one of each counts" in told
    assert "rotations without a direction" in told
    turn = document.tree.clips[0].channels[0]
    assert (turn.times.tolist(), turn.values.tolist()) == ([0], [[0, 0, 0, 1]])


def test_a_file_without_vertices_is_an_empty_scene(tmp_path):
    path = tmp_path / "a.glb"
    path.write_bytes(as_glb({"asset": {"version": "2.0"}}))
    assert e3d.load_scene(path).nodes == ()
    with pytest.raises(FileFormatError, match="no vertices"):
        load_mesh(path)


def test_vertices_that_many_primitives_share_are_read_as_they_are_used(tmp_path):
    """Each takes what it uses of a long array, and not all of it."""
    tree = triangle_tree(points=20_000)
    primitive = tree["meshes"][0]["primitives"][0]
    shared = {**primitive, "attributes": {"POSITION": 2}}
    tree["meshes"][0]["primitives"] = [shared] * 2000
    mesh = read(tree, tmp_path).tree.meshes[0].mesh
    assert (len(mesh.faces), len(mesh.positions)) == (2000, 6000)


_PEAK = """
import sys
import engine3d as e3d
from engine3d.loaders import gltf, load_document
def held(key):
    return next(int(l.split()[1]) for l in open("/proc/self/status") if l.startswith(key)) << 10
before = held("VmRSS:")
open("/proc/self/clear_refs", "w").write("5")
document = load_document(sys.argv[1])
print(held("VmHWM:") - before)
"""


def test_memory_is_at_most_three_times_the_file(tmp_path):
    tree = triangle_tree()
    tree["accessors"][2]["count"], tree["bufferViews"][2]["byteLength"] = 2_000_000, 24_000_000
    tree["meshes"][0]["primitives"] = [{"attributes": {"POSITION": 2}, "mode": 0}]
    binary = bytes(44 + 24_000_000)
    tree["buffers"] = [{"byteLength": len(binary)}]
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    path = tmp_path / "a.glb"
    with path.open("wb") as file:
        size = 28 + len(text) + len(binary)
        file.write(struct.pack("<4sIIII", b"glTF", 2, size, len(text), 0x4E4F534A) + text)
        file.write(struct.pack("<II", len(binary), 0x4E4942) + binary)
    run = [sys.executable, "-c", _PEAK, str(path)]
    try:
        peak = int(subprocess.run(run, check=True, capture_output=True, text=True).stdout)
    except subprocess.CalledProcessError:
        pytest.skip("the system tells no peak of memory")
    assert peak <= 3 * size


def tangents_of(mesh):
    """What a picture says of them."""
    scene = e3d.Scene()
    scene.add(mesh)
    return render(scene, size=(60, 60), outputs=("tangent",), wireframe="overlay").tangent


def bumpy_ball():
    normals = np.random.default_rng(3).integers(100, 156, (8, 8, 3)).astype(np.uint8)
    normals[..., 2] = 255
    ball = e3d.uv_sphere(1, (9, 6))
    ball.uvs = ball.uvs @ [[2, 0.4], [-0.3, 1]]
    ball.materials = [e3d.Material(roughness=0.5, normal_texture=e3d.Texture(normals))]
    return ball


@pytest.mark.filterwarnings("ignore::engine3d.errors.Engine3DWarning")
def test_tangents_that_a_file_lacks_are_drawn(tmp_path):
    """They are found when the mesh is drawn; in the file that is written there are none again."""
    scene = e3d.Scene()
    scene.add(bumpy_ball())
    scene.save(tmp_path / "a.glb")
    (node,) = e3d.load_scene(tmp_path / "a.glb").nodes
    mesh = node.object
    drawn, known = tangents_of(mesh), tangents_of(mesh.with_tangents())
    assert mesh.tangents is None
    assert np.array_equal(drawn, known) and not np.array_equal(drawn, tangents_of(bumpy_ball()))
    e3d.load_scene(tmp_path / "a.glb").save(tmp_path / "b.glb")
    assert (tmp_path / "a.glb").read_bytes() == (tmp_path / "b.glb").read_bytes()
    mesh.positions = mesh.positions * 2
    assert np.abs(tangents_of(mesh)).max() > 0.5


@pytest.mark.filterwarnings("ignore::engine3d.errors.Engine3DWarning")
def test_what_bends_has_its_tangents_from_the_start(tmp_path):
    ball = bumpy_ball()
    ball.morph_targets = [
        e3d.motion.MorphTarget(positions=np.ones_like(ball.positions), name="away")
    ]
    scene = e3d.Scene()
    scene.add(ball).morph_weights = [0.5]
    scene.save(tmp_path / "a.glb")
    (node,) = e3d.load_scene(tmp_path / "a.glb").nodes
    # Texture coordinates are turned over twice, and so rounded.
    assert np.allclose(node.object.tangents, ball.with_tangents().tangents, atol=1e-5)
    assert len(node.object.morph_targets[0].positions) == len(node.object.positions)


@pytest.mark.parametrize(
    ("extensions", "is_turned"),
    [({"VRM": {}}, True), ({"VRMC_vrm": {}}, False), ({"VRM": {}, "VRMC_vrm": {}}, False)],
)
def test_avatars_face_the_viewer(tmp_path, extensions, is_turned):
    tree = moving()
    still = read(tree, tmp_path)
    tree["extensions"] |= extensions
    turned = read(tree, tmp_path)
    assert any("faces the other way" in told for told in turned.warnings) == is_turned
    for one, other in zip(still.objects, turned.objects, strict=True):
        turn = np.diag([-1.0, 1, -1, 1]) if is_turned else np.eye(4)
        assert np.array_equal(turn @ one.pose, other.pose)
    (tmp_path / "a.gltf").write_text(json.dumps(tree))
    scene = e3d.load_scene(tmp_path / "a.gltf")
    assert scene.nodes[0].name == ("VRM" if is_turned else "")
    assert len(scene.nodes[0].children) == (3 if is_turned else 0)


def spheres(count):
    """Meshes that share their accessors, each with a material of its own."""
    tree = triangle_tree()
    ball = e3d.uv_sphere(segments=(64, 48))
    for name, array in (("POSITION", ball.positions), ("NORMAL", ball.normals)):
        add_attribute(tree, name, array)
    primitive = tree["meshes"][0]["primitives"][0]
    named = primitive["attributes"]
    add_attribute(tree, "indices", ball.faces.astype(np.uint16).reshape(-1, 1))
    indices = named.pop("indices")
    tree["meshes"] = [
        {"primitives": [{"attributes": dict(named), "indices": indices, "material": k}]}
        for k in range(count)
    ]
    tree["materials"] = [{"alphaCutoff": k / count} for k in range(count)]
    tree["nodes"] = [{"mesh": k, "translation": [k, 0, 0]} for k in range(count)]
    tree["scenes"] = [{"nodes": list(range(count))}]
    return tree


def test_what_meshes_share_counts_once_and_is_there_once(tmp_path):
    document = read(spheres(200), tmp_path)
    assert document.warnings == []
    meshes = [entry.mesh for entry in document.objects]
    for name in ("positions", "normals", "faces", "material_ids"):
        assert len({id(getattr(mesh, name)) for mesh in meshes}) == 1
    assert [mesh.materials[0].alpha_cutoff for mesh in meshes] == [k / 200 for k in range(200)]
    meshes[0].positions = meshes[0].positions * 2
    assert meshes[1].bounds[1].tolist() != meshes[0].bounds[1].tolist()


def test_arrays_that_some_of_several_primitives_share_are_there_once(tmp_path):
    tree = spheres(2)
    colors = np.zeros((len(e3d.uv_sphere(segments=(64, 48)).positions), 3), np.float32)
    add_attribute(tree, "COLOR_0", colors)
    one, other = (mesh.mesh for mesh in read(tree, tmp_path).objects)
    assert one.colors is not None and other.colors is None
    assert one.positions is other.positions and one.normals is other.normals
    assert one.faces is other.faces


def test_what_shared_arrays_are_made_into_is_limited(tmp_path):
    """Primitives that each use other vertices of one long array are each made."""
    tree = spheres(200)
    count = tree["accessors"][tree["meshes"][0]["primitives"][0]["indices"]]["count"]
    for k, mesh in enumerate(tree["meshes"]):
        (primitive,) = mesh["primitives"]
        accessor = tree["accessors"][primitive["indices"]]
        tree["accessors"].append({**accessor, "count": count - 3 * k - 3})
        primitive["indices"] = len(tree["accessors"]) - 1
    with pytest.raises(FileFormatError, match="numbers, the limit for its size"):
        read(tree, tmp_path)
