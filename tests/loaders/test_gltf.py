"""glTF: what is read of it, what is told, what is refused."""

import base64
import io
import json
import struct
import subprocess
import sys
from urllib.parse import unquote_to_bytes

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d import InvalidArgumentError, linear
from engine3d.apps.cli.commands.info import describe
from engine3d.errors import Engine3DWarning, FileFormatError
from engine3d.io.formats.gltf import gltf_buffers
from engine3d.io.loaders import load_document, load_mesh
from engine3d.io.reading import percent_encoding


def triangle_tree(points=3):
    """A glTF file of one triangle, as JSON has it, and a third accessor of so many points."""
    data = struct.pack("<9f3H2x", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2) + bytes(12 * points)
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    views = [(0, 36), (36, 6), (44, 12 * points)]
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
            {"bufferView": 2, "componentType": 5126, "count": points, "type": "VEC3"},
        ],
        "bufferViews": [{"buffer": 0, "byteOffset": a, "byteLength": b} for a, b in views],
        "buffers": [{"uri": uri, "byteLength": len(data)}],
    }


def as_glb(tree):
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text


MANY_POINTS = {"attributes": {"POSITION": 2}, "mode": 0}
ZEROS = {"componentType": 5126, "count": 30_000_000, "type": "VEC3"}


@pytest.mark.parametrize("pack", [lambda tree: json.dumps(tree).encode(), as_glb])
@pytest.mark.parametrize(
    "change",
    [
        lambda tree: tree["accessors"].__setitem__(2, ZEROS),
        lambda tree: tree["accessors"][0].update(count=10**7, sparse={"count": 1}),
        lambda tree: tree["meshes"][0]["primitives"].extend([MANY_POINTS] * 500),
    ],
)
def test_more_is_announced_than_a_file_can_hold(write, pack, change):
    """Nothing is allocated for it: memory is not even looked for."""
    tree = triangle_tree(points=1000)
    tree["meshes"][0]["primitives"].append(MANY_POINTS)
    path = write("a.glb" if pack is as_glb else "a.gltf", pack(tree))
    assert len(load_mesh(path).points) == 1000
    change(tree)
    path.write_bytes(pack(tree))
    with pytest.raises(FileFormatError, match="numbers, the limit for its size"):
        load_mesh(path)


def test_the_limit_counts_what_other_files_hold(tmp_path, monkeypatch):
    monkeypatch.setattr(gltf_buffers, "MAX_REPEATED", 0)
    tree = triangle_tree(points=1000)
    data = base64.b64decode(tree["buffers"][0]["uri"].partition(",")[2])
    (tmp_path / "a b.bin").write_bytes(data)
    tree["buffers"][0]["uri"] = "a%20b.bin"
    tree["meshes"][0]["primitives"].append(MANY_POINTS)
    path = tmp_path / "a.gltf"
    path.write_text(json.dumps(tree))
    assert path.stat().st_size < 3000
    assert len(load_mesh(path).points) == 1000
    tree["meshes"][0]["primitives"] *= 30
    path.write_text(json.dumps(tree))
    with pytest.raises(FileFormatError, match="the limit for its size"):
        load_mesh(path)


def test_nodes_that_repeat_a_mesh(write, monkeypatch):
    tree = triangle_tree()
    tree["nodes"] *= 50
    tree["scenes"][0]["nodes"] = list(range(50))
    path = write("a.gltf", json.dumps(tree))
    assert len(load_mesh(path).faces) == 50
    monkeypatch.setattr(gltf_buffers, "MAX_REPEATED", 149 - 4 * path.stat().st_size)
    with pytest.raises(FileFormatError, match=r"a\.gltf: 150 vertices where meshes are repeated"):
        load_mesh(path)
    assert len(load_document(path).objects) == 50


@pytest.mark.parametrize("matrix", [[0] * 16, [1] * 16, [1e300] * 15 + [1]])
def test_poses_that_are_none(write, matrix):
    tree = triangle_tree()
    tree["nodes"][0]["matrix"] = matrix
    path = write("a.gltf", json.dumps(tree))
    for load in (load_mesh, e3d.load_scene):
        with pytest.raises(FileFormatError, match=r"a\.gltf: nodes\[0\]\.matrix is no affine pose"):
            load(path)


def test_what_the_mesh_does_not_take_names_the_file(write):
    tree = triangle_tree()
    tree["accessors"][0]["count"] = 2
    with pytest.raises(
        FileFormatError, match=r"a\.gltf: damaged: meshes\[0\]\.primitives\[0\] names vertex 2"
    ):
        load_mesh(write("a.gltf", json.dumps(tree)))


def test_named_files_stay_in_the_folder(tmp_path):
    tree = triangle_tree()
    data = base64.b64decode(tree["buffers"][0]["uri"].partition(",")[2])
    folder = tmp_path / "model"
    folder.mkdir()
    (folder / "a.bin").write_bytes(data)
    (tmp_path / "b.bin").write_bytes(data)
    path = folder / "model.gltf"
    for name in ("a.bin", "../b.bin", "%2e%2e/b.bin"):
        tree["buffers"][0]["uri"] = name
        path.write_text(json.dumps(tree))
        if name == "a.bin":
            assert len(load_mesh(path).faces) == 1
        else:
            with pytest.raises(FileFormatError, match=r"model\.gltf: buffers\[0\].*refused"):
                load_mesh(path)


def data_uri(data, kind="application/octet-stream"):
    return f"data:{kind};base64," + base64.b64encode(data).decode()


def add_buffer(tree, data):
    """Add bytes to a file; returns the number of their view."""
    tree["buffers"].append({"uri": data_uri(data), "byteLength": len(data)})
    view = {"buffer": len(tree["buffers"]) - 1, "byteLength": len(data)}
    tree["bufferViews"].append(view)
    return len(tree["bufferViews"]) - 1


def add_attribute(tree, name, values, **options):
    """Add an array as an attribute of the triangle."""
    types = {"float32": 5126, "uint8": 5121, "uint16": 5123, "int16": 5122, "int8": 5120}
    kinds = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
    accessor = {
        "bufferView": add_buffer(tree, values.tobytes()),
        "componentType": types[values.dtype.name],
        "count": len(values),
        "type": kinds[values.shape[1]],
        **options,
    }
    tree["accessors"].append(accessor)
    attributes = tree["meshes"][0]["primitives"][0]["attributes"]
    attributes[name] = len(tree["accessors"]) - 1


def add_material(tree, image=None, **material):
    """Give the triangle a material, with an image (bytes) if there is one."""
    tree["materials"] = [material]
    tree["meshes"][0]["primitives"][0]["material"] = 0
    if image is not None:
        tree["images"] = [{"uri": data_uri(image, "image/png")}]
        tree["textures"] = [{"source": 0}]
        physical = material.setdefault("pbrMetallicRoughness", {})
        physical["baseColorTexture"] = {"index": 0}
        add_attribute(tree, "TEXCOORD_0", np.array([[0, 0], [1, 0], [0, 1]], np.float32))


def png(array):
    file = io.BytesIO()
    Image.fromarray(array).save(file, "PNG")
    return file.getvalue()


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.gltf", b"", "not a gltf file"),
        ("a.gltf", b"nonsense", "not a gltf file"),
        ("a.gltf", b"[1]", "not a gltf file"),
        ("a.gltf", b"[" * 100_000, "not a gltf file: its JSON is nested too deeply"),
        ("a.gltf", b"{}", "not a glTF file: it does not tell its version"),
        ("a.gltf", b'{"asset": {"version": "1.0"}}', "glTF of version '1.0' is not read"),
        ("a.gltf", b'{"asset": {"version": "2.0"}, "scenes": 3}', "damaged: scenes is no list"),
        ("a.glb", b"", "not a glb file"),
        ("a.glb", b"glTF\2\0\0\0\xff\0\0\0", "damaged: the file ends within its header"),
        (
            "a.glb",
            struct.pack("<4sIIII", b"glTF", 2, 999, 0, 0),
            "damaged: 999 bytes are announced",
        ),
        ("a.glb", struct.pack("<4sIIII", b"glTF", 1, 20, 0, 0), "glTF of version 1 is not read"),
    ],
)
def test_what_is_no_such_file_is_told(write, name, content, message):
    with pytest.raises(FileFormatError) as caught:
        load_mesh(write(name, content))
    assert f"{name}: {message}" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_trimesh_is_not_needed(write):
    path = write("a.glb", as_glb(triangle_tree()))
    code = (
        "import sys; sys.modules['trimesh'] = None\n"
        "import engine3d as e3d\n"
        f"print(len(e3d.load_mesh({str(path)!r}).faces))\n"
    )
    found = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert found.stdout.strip() == "1"


def test_content_without_a_name_is_recognised(write):
    for pack in (as_glb, lambda tree: json.dumps(tree).encode()):
        assert len(load_mesh(pack(triangle_tree())).faces) == 1


def test_an_image_starts_no_program(write, tmp_path, monkeypatch):
    """Pillow reads EPS by starting Ghostscript."""
    tools, mark = tmp_path / "tools", tmp_path / "mark"
    tools.mkdir()
    (tools / "gs").write_text(f"#!/bin/sh\ntouch {mark}\n")
    (tools / "gs").chmod(0o755)
    monkeypatch.setenv("PATH", str(tools), prepend=":")
    tree = triangle_tree()
    add_material(tree, b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 10 10\n%%EndComments\n")
    with pytest.warns(Engine3DWarning, match=r"a\.glb: images\[0\] is left out: unknown image"):
        mesh = load_mesh(write("a.glb", as_glb(tree)))
    assert mesh.materials[0].texture is None
    assert not mark.exists()


def test_16_bit_grey_keeps_its_values(write):
    tree = triangle_tree()
    add_material(tree, png(np.array([[0x0000, 0x4000, 0x80FF, 0xFFFF]], np.uint16)))
    mesh = load_mesh(write("a.glb", as_glb(tree)))
    assert mesh.materials[0].texture.pixels[0, :, 0].tolist() == [0, 64, 128, 255]


@pytest.mark.parametrize(
    ("image", "message"),
    [
        (b"", "unknown image format"),
        (png(np.arange(8000, dtype=np.uint8).reshape(80, 100) ** 2)[:-200], "damaged image"),
        (png(np.zeros((9, 9), np.uint8))[:40], "not an image of a known format"),
    ],
)
def test_an_unreadable_image_is_a_warning(write, image, message):
    tree = triangle_tree()
    add_material(tree, image)
    with pytest.warns(Engine3DWarning, match=rf"a\.gltf: images\[0\] is left out: .*{message}"):
        mesh = load_mesh(write("a.gltf", json.dumps(tree)))
    assert len(mesh.faces) == 1
    assert mesh.materials[0].texture is None


def test_a_missing_image_is_a_warning(write):
    tree = triangle_tree()
    add_material(tree, b"")
    tree["images"] = [{"uri": "none.png"}]
    with pytest.warns(Engine3DWarning, match=r"images\[0\] is left out: 'none.png': not found"):
        assert load_mesh(write("a.gltf", json.dumps(tree))).materials[0].texture is None


def test_a_material_comes_along(write):
    tree = triangle_tree()
    red = np.array([[[255, 0, 0], [0, 255, 0]]], np.uint8)
    add_material(
        tree,
        png(red),
        name="paint",
        doubleSided=True,
        emissiveFactor=[0.5, 0, 0],
        extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 4}},
        pbrMetallicRoughness={"baseColorFactor": [1, 0.5, 0.25, 1], "metallicFactor": 0},
    )
    tree["samplers"] = [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}]
    tree["textures"][0]["sampler"] = 0
    info = tree["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]
    info["extensions"] = {"KHR_texture_transform": {"offset": [0.5, 0], "scale": [0.5, 2]}}
    document = load_document(write("a.gltf", json.dumps(tree)))
    mesh = document.objects[0].mesh
    (material,) = mesh.materials
    paint = linear(1, 0.5, 0.25)
    assert (material.name, material.two_sided, material.color) == ("paint", True, paint)
    assert (material.emissive, material.emissive_strength) == (linear(0.5, 0, 0), 4)
    assert (material.metallic, material.roughness) == (0, 1)
    texture = material.texture.texture
    assert material.texture == e3d.PlacedTexture(texture, offset=(0.5, 0), scale=(0.5, 2))
    assert np.array_equal(texture.pixels[:, :, :3], red)
    assert (texture.wrap, texture.filter) == (("clamp", "mirror"), "nearest")
    assert mesh.uvs.tolist() == [[0, 1], [1, 1], [0, 0]]
    assert document.counts["materials"] == ["paint"]
    assert document.warnings == []


def test_factors_above_one_are_no_suspicion(write):
    tree = triangle_tree()
    specular = {"KHR_materials_specular": {"specularColorFactor": [25, 25, 25]}}
    add_material(tree, png(np.zeros((1, 1, 3), np.uint8)), extensions=specular)
    document = load_document(write("a.gltf", json.dumps(tree)))
    assert document.objects[0].mesh.materials[0].specular_color == linear(25, 25, 25)
    with pytest.raises(InvalidArgumentError, match="holds the float 25"):  # here people write them
        e3d.Material(specular_color=(25.0, 25.0, 25.0))


def test_glass_is_read_without_a_warning(write):
    tree = triangle_tree()
    extensions = {
        "KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_volume": {"thicknessFactor": 2},
        "KHR_materials_dispersion": {"dispersion": 0.4},
    }
    base = {"roughnessFactor": 0.2, "metallicFactor": 0}
    tree["materials"] = [{"extensions": extensions, "pbrMetallicRoughness": base}]
    tree["meshes"][0]["primitives"][0]["material"] = 0
    tree["extensionsUsed"] = list(extensions)
    document = load_document(write("a.gltf", json.dumps(tree)))
    assert document.warnings == []
    material = document.objects[0].mesh.materials[0]
    assert (material.transmission, material.thickness, material.dispersion) == (1, 2, 0.4)


def test_diffuse_transmission_is_read_without_a_warning(write):
    tree = triangle_tree()
    image = np.full((2, 2, 4), 128, np.uint8)
    tree["images"] = [{"uri": data_uri(png(image), "image/png")}]
    tree["textures"] = [{"source": 0}]
    leaf = {
        "diffuseTransmissionFactor": 0.25,
        "diffuseTransmissionTexture": {"index": 0},
        "diffuseTransmissionColorFactor": [0.5, 1, 0.25],
        "diffuseTransmissionColorTexture": {"index": 0, "texCoord": 1},
    }
    tree["materials"] = [{"extensions": {"KHR_materials_diffuse_transmission": leaf}}]
    tree["meshes"][0]["primitives"][0]["material"] = 0
    tree["extensionsUsed"] = tree["extensionsRequired"] = ["KHR_materials_diffuse_transmission"]
    document = load_document(write("a.gltf", json.dumps(tree)))
    assert document.warnings == []
    material = document.objects[0].mesh.materials[0]
    assert material.diffuse_transmission == 0.25
    assert material.diffuse_transmission_color == linear(0.5, 1, 0.25)
    assert material.diffuse_transmission_texture.pixels[0, 0, 3] == 128
    assert material.diffuse_transmission_color_texture.uv_set == 1


def test_extensions_of_materials_count_listed_or_not(write):
    tree = triangle_tree()
    coat = {"KHR_materials_clearcoat": {"clearcoatFactor": 0.5}}
    tree["materials"] = [{"extensions": {**coat, "EXT_gold": {}}}, {"extensions": {"EXT_gold": {}}}]
    path = write("a.gltf", json.dumps(tree))
    with pytest.warns(Engine3DWarning):
        document = load_document(path)
    assert document.warnings == [f"{path}: the extension 'EXT_gold' is not read"]
    assert document.tree.materials[0].clearcoat == 0.5


def test_what_is_left_out_is_told_once(write):
    tree = triangle_tree()
    primitive = tree["meshes"][0]["primitives"][0]
    primitive["targets"] = [{"POSITION": 0, "COLOR_0": 0}, {"COLOR_0": 0}]
    tree["scenes"] *= 2
    tree["extensionsUsed"] = ["KHR_materials_unlit", "EXT_nobody_knows"]
    path = write("a.gltf", json.dumps(tree))
    with pytest.warns(Engine3DWarning):
        document = load_document(path)
    told = [warning.removeprefix(f"{path}: ") for warning in document.warnings]
    assert told == [
        "the extension 'EXT_nobody_knows' is not read",
        "2 scenes: only scenes[0] is shown",
        "meshes[0].primitives[0].targets[0]: what it adds to COLOR_0 is left out",
    ]
    assert describe(path)["warnings"] == [f"{path}: {line}" for line in told]
    with pytest.warns(Engine3DWarning):
        assert load_mesh(path).warnings == [f"{path}: {line}" for line in told]


def test_an_extension_that_is_needed_is_named(write):
    name = "EXT_nobody_knows"
    tree = triangle_tree()
    tree["extensionsUsed"] = tree["extensionsRequired"] = [name]
    tree["accessors"][0]["count"] = 10**7
    with pytest.raises(FileFormatError, match=rf"a\.gltf: needs the extension '{name}'"):
        load_mesh(write("a.gltf", json.dumps(tree)))


def test_names_are_the_same_in_every_run(write):
    tree = triangle_tree()
    tree["meshes"][0]["primitives"] *= 3
    tree["nodes"] = [{"mesh": 0}, {"mesh": 0, "name": "house"}]
    tree["scenes"][0]["nodes"] = [0, 1]
    path = write("a.gltf", json.dumps(tree))
    expected = ["0", "house"]
    assert [entry.name for entry in load_document(path).objects] == expected
    assert [entry["name"] for entry in describe(path)["objects"]] == expected


@pytest.mark.parametrize(
    ("mode", "faces", "lines"),
    [
        (4, [[0, 1, 2]], []),
        (5, [[0, 1, 2], [1, 3, 2]], []),
        (6, [[1, 2, 0], [2, 3, 0]], []),
        (1, [], [[0, 1], [2, 3]]),
        (2, [], [[0, 1], [1, 2], [2, 3], [3, 0]]),
        (3, [], [[0, 1], [1, 2], [2, 3]]),
        (0, [], []),
    ],
)
def test_modes(write, mode, faces, lines):
    tree = triangle_tree()
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], np.float32)
    add_attribute(tree, "POSITION", corners)
    primitive = tree["meshes"][0]["primitives"][0]
    del primitive["indices"]
    primitive["mode"] = mode
    mesh = load_mesh(write("a.gltf", json.dumps(tree)))
    chosen = range(3) if mode == 4 else range(4)
    assert np.array_equal(mesh.positions, corners[chosen])
    assert (mesh.faces.tolist(), mesh.lines.tolist()) == (faces, lines)
    assert mesh.points.tolist() == ([0, 1, 2, 3] if mode == 0 else [])


def test_integers_that_stand_for_fractions(write):
    tree = triangle_tree()
    add_attribute(
        tree, "POSITION", np.array([[0, 0, 0], [127, 0, 0], [0, -128, 0]], np.int8), normalized=True
    )
    add_attribute(
        tree, "TEXCOORD_0", np.array([[0, 0], [65535, 0], [0, 65535]], np.uint16), normalized=True
    )
    add_attribute(
        tree, "COLOR_0", np.array([[255, 0, 51], [0, 255, 0], [0, 0, 0]], np.uint8), normalized=True
    )
    mesh = load_mesh(write("a.gltf", json.dumps(tree)))
    assert mesh.positions.tolist() == [[0, 0, 0], [1, 0, 0], [0, -1, 0]]
    assert mesh.uvs.tolist() == [[0, 1], [1, 1], [0, 0]]
    assert np.allclose(mesh.colors[0], [1, 0, 0.2, 1])
    assert mesh.colors.dtype == np.float32  # linear light


def test_a_sparse_accessor(write):
    tree = triangle_tree()
    rows = add_buffer(tree, struct.pack("<H", 1))
    values = add_buffer(tree, struct.pack("<3f", 5, 6, 7))
    tree["accessors"][0]["sparse"] = {
        "count": 1,
        "indices": {"bufferView": rows, "componentType": 5123},
        "values": {"bufferView": values},
    }
    mesh = load_mesh(write("a.gltf", json.dumps(tree)))
    assert mesh.positions.tolist() == [[0, 0, 0], [5, 6, 7], [0, 1, 0]]


def test_triangles_without_normals_are_flat(write):
    tree = triangle_tree()
    assert load_mesh(write("a.gltf", json.dumps(tree))).materials[0].flat_shading
    add_attribute(tree, "NORMAL", np.array([[0, 0, 1]] * 3, np.float32))
    mesh = load_mesh(write("a.gltf", json.dumps(tree)))
    assert not mesh.materials[0].flat_shading
    assert mesh.has_normals


def test_poses_multiply_along_the_tree(write):
    tree = triangle_tree()
    half = 2**-0.5
    tree["nodes"] = [
        {"children": [1], "translation": [5, 0, 0], "rotation": [0, 0, half, half]},
        {"mesh": 0, "scale": [2, 2, 2]},
    ]
    mesh = load_mesh(write("a.gltf", json.dumps(tree)))
    assert np.allclose(mesh.positions, [[5, 0, 0], [5, 2, 0], [3, 0, 0]])


def test_nodes_nested_deeply(write):
    tree = triangle_tree()
    tree["nodes"] = [{"children": [k + 1], "translation": [1, 0, 0]} for k in range(20_000)]
    tree["nodes"].append({"mesh": 0})
    assert load_mesh(write("a.gltf", json.dumps(tree))).positions[0, 0] == 20_000


def test_very_many_primitives_are_refused(write):
    tree = triangle_tree()
    tree["meshes"][0]["primitives"] *= 10_001
    with pytest.raises(FileFormatError, match=r"a\.gltf: more than 10000 primitives"):
        load_mesh(write("a.gltf", json.dumps(tree)))
    half = tree["meshes"][0]["primitives"][:3]
    tree["meshes"] = [{"primitives": half}] * 4000
    tree["nodes"] = [{"mesh": k} for k in range(4000)]
    tree["scenes"][0]["nodes"] = list(range(4000))
    with pytest.raises(FileFormatError, match=r"a\.gltf: more than 10000 primitives"):
        load_mesh(write("a.gltf", json.dumps(tree)))


@pytest.mark.parametrize("nodes", [[{"children": [0]}], [{"children": [1, 1]}, {"mesh": 0}]])
def test_nodes_that_are_no_tree(write, nodes):
    tree = triangle_tree()
    tree["nodes"] = nodes
    with pytest.raises(FileFormatError, match=r"a\.gltf: damaged: nodes\[[01]\] is named twice"):
        load_mesh(write("a.gltf", json.dumps(tree)))


def test_percent_encoded_text_is_decoded_piece_by_piece(monkeypatch):
    text = "a%20b%zz%%41%4" * 3 + "%e4\u00e4%"
    expected = unquote_to_bytes(text)
    for size in range(3, 40):
        monkeypatch.setattr(percent_encoding, "_PIECE", size)
        assert percent_encoding.percent_decoded(text) == expected
