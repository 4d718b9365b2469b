"""To trimesh and back, and the formats that it reads."""

import base64
import json
import struct
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest

import engine3d as e3d
from engine3d.cli.info import describe
from engine3d.errors import Engine3DWarning, FileFormatError, InvalidArgumentError
from engine3d.loaders import load_document, load_mesh, trimesh_formats
from engine3d.trimesh_conversion import posed_mesh

trimesh = pytest.importorskip("trimesh")

GREY = np.full((2, 2, 4), 128, np.uint8)


def same(a, b):
    return a is b is None or np.array_equal(a, b)


@pytest.mark.parametrize("make", [e3d.box, e3d.torus, e3d.icosphere])
def test_there_and_back(make):
    mesh = make()
    mesh.materials = [e3d.Material(color=(1.0, 0.0, 0.0), texture=e3d.Texture(GREY))]
    again = e3d.Mesh.from_trimesh(mesh.to_trimesh())
    for name in ("positions", "faces", "uvs", "colors"):
        assert same(getattr(mesh, name), getattr(again, name)), name
    assert np.allclose(mesh.normals, again.normals, atol=1e-6)
    assert again.materials[0].color == (1, 0, 0)
    assert np.array_equal(again.materials[0].texture.pixels, GREY)


def test_colors():
    triangle = e3d.Mesh(np.eye(3), [[0, 1, 2]], colors=np.arange(12, dtype=np.uint8).reshape(3, 4))
    assert same(e3d.Mesh.from_trimesh(triangle.to_trimesh()).colors, triangle.colors)
    linear = e3d.Mesh(np.eye(3), [[0, 1, 2]], colors=np.full((3, 4), 0.5, np.float32))
    assert e3d.Mesh.from_trimesh(linear.to_trimesh()).colors[0].tolist() == [188, 188, 188, 128]
    box = trimesh.creation.box()
    box.visual.face_colors = np.arange(48, dtype=np.uint8).reshape(12, 4)
    mesh = e3d.Mesh.from_trimesh(box)
    assert (mesh.colors[mesh.faces] == box.visual.face_colors[:, np.newaxis]).all()
    assert np.array_equal(mesh.positions[mesh.faces], box.triangles.astype(np.float32))


def test_points_and_paths():
    cloud = e3d.Mesh(np.eye(3), points=[0, 2])
    assert e3d.Mesh.from_trimesh(cloud.to_trimesh()).positions.tolist() == [[1, 0, 0], [0, 0, 1]]
    ends = np.array([[0, 0, 0], [1, 0, 0], [5, 5, 5], [6, 5, 5]], float)
    runs = [SimpleNamespace(discrete=lambda v, scale, k=k: v[k : k + 2]) for k in (0, 2)]
    path = SimpleNamespace(vertices=ends, entities=runs)
    mesh = e3d.Mesh.from_trimesh(path)
    ends = mesh.positions[mesh.lines]
    assert np.sort(ends[:, 0, 0]).tolist() == [0, 5]
    assert (ends[:, 1] - ends[:, 0]).tolist() == [[1, 0, 0]] * 2


def test_several_materials_are_a_scene():
    mesh = e3d.Mesh(
        np.eye(4, 3),
        [[0, 1, 2], [0, 2, 3]],
        materials=[e3d.Material(name="a", color=(1.0, 0.0, 0.0)), e3d.Material(name="b")],
        material_ids=[0, 1],
    )
    scene = mesh.to_trimesh()
    assert sorted(scene.geometry) == ["a", "b"]
    assert len(e3d.Mesh.from_trimesh(scene).faces) == 2


def test_a_mirroring_pose_turns_faces_over():
    mesh = e3d.box()
    posed = posed_mesh(mesh, np.diag([-1.0, 2.0, 1.0, 1.0]))
    outward = posed.face_normals * posed.positions[posed.faces].mean(axis=1)
    assert (outward.sum(axis=1) > 0).all()
    assert np.allclose((posed.normals**2).sum(axis=1), 1)
    assert len(posed.edges()) == len(mesh.edges())


def test_what_is_no_geometry():
    with pytest.raises(InvalidArgumentError, match="not a geometry of trimesh: int"):
        e3d.Mesh.from_trimesh(3)


def test_binary_gltf(tmp_path):
    scene = trimesh.Scene()
    pose = np.eye(4)
    pose[:3, 3] = 7, 0, 0
    scene.add_geometry(trimesh.creation.box(), node_name="left")
    scene.add_geometry(
        trimesh.creation.icosphere(subdivisions=1), node_name="right", transform=pose
    )
    path = tmp_path / "two.glb"
    path.write_bytes(scene.export(file_type="glb"))
    document = load_document(path)
    assert sorted(entry.name for entry in document.objects) == ["left", "right"]
    assert document.format == "glb"
    assert describe(path)["bounds"]["max"][0] == 8
    mesh = load_mesh(path.read_bytes())
    assert mesh.bounds[:, 0].tolist() == [-0.5, 8]
    assert len(mesh.faces) == 12 + 80


def test_textures_come_along(tmp_path):
    mesh = e3d.quad((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))
    mesh.materials = [e3d.Material(texture=e3d.Texture(GREY))]
    path = tmp_path / "a.glb"
    path.write_bytes(mesh.to_trimesh().export(file_type="glb"))
    again = load_mesh(path)
    assert np.array_equal(again.materials[0].texture.pixels, GREY)
    assert np.allclose(again.uvs[again.faces], mesh.uvs[mesh.faces])


def test_named_files_stay_in_the_folder(tmp_path):
    parts = trimesh.creation.box().export(file_type="gltf")
    folder = tmp_path / "model"
    folder.mkdir()
    for name, data in parts.items():
        (folder / name).write_bytes(data)
    path = folder / "model.gltf"
    assert len(load_mesh(path).faces) == 12
    tree = json.loads(path.read_text())
    name = tree["buffers"][0]["uri"]
    (folder / name).rename(tmp_path / name)
    tree["buffers"][0]["uri"] = f"../{name}"
    path.write_text(json.dumps(tree))
    with pytest.raises(FileFormatError, match=r"model\.gltf: trimesh cannot read it.*refused"):
        load_mesh(path)


@pytest.mark.parametrize("name", ["a.glb", "a.gltf", "a.dxf", "a.xyz"])
@pytest.mark.parametrize("content", [b"", b"glTF\2\0\0\0\xff\0\0\0", b"{}", b"nonsense"])
def test_damaged_files_are_our_own_errors(write, name, content):
    with pytest.raises(FileFormatError, match=name.replace(".", r"\.")) as caught:
        load_mesh(write(name, content))
    assert "\n" not in str(caught.value)


def test_without_trimesh(write):
    path = write("a.glb", b"glTF")
    code = (
        "import sys; sys.modules['trimesh'] = None\n"
        "import engine3d as e3d\n"
        f"try: e3d.load_mesh({str(path)!r})\n"
        "except e3d.FileFormatError as error: print(error)\n"
        "try: e3d.box().to_trimesh()\n"
        "except ImportError as error: print(error)\n"
    )
    found = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    lines = found.stdout.splitlines()
    assert "a.glb: .glb files need the package trimesh" in lines[0]
    assert "engine3d[formats]" in lines[1]


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.gltf", b"nonsense", "not a gltf file"),
        ("a.gltf", b"[1]", "not a gltf file"),
        ("a.glb", b"", "not a glb file"),
        ("a.dae", b"{}", "not a dae file"),
        ("a.3mf", b"<a/>", "not a 3mf file"),
        ("a.gltf", b'{"scenes": 3}', "damaged, or no gltf file .trimesh ended with TypeError"),
    ],
)
def test_what_is_no_such_file_at_all_is_told(tmp_path, name, content, message):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(FileFormatError, match=rf"{name}: {message}") as caught:
        load_mesh(tmp_path / name)
    assert "\n" not in str(caught.value)


def test_packages_that_trimesh_lacks_are_told(write, monkeypatch):
    path = write("a.dae", b"<COLLADA/>")
    monkeypatch.setattr(trimesh, "available_formats", lambda: {"glb"})
    with pytest.raises(FileFormatError, match=r"a.dae: trimesh needs further packages for dae"):
        load_mesh(path)


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
        lambda tree: tree["accessors"].append(ZEROS),
        lambda tree: tree["accessors"][0].update(count=10**7, sparse={"count": 1}),
        lambda tree: tree["meshes"][0]["primitives"].extend([MANY_POINTS] * 500),
    ],
)
def test_more_is_announced_than_a_file_can_hold(write, pack, change):
    """Nothing is allocated for it: memory is not even looked for."""
    tree = triangle_tree(points=1000)
    path = write("a.glb" if pack is as_glb else "a.gltf", pack(tree))
    assert len(load_mesh(path).faces) == 1
    change(tree)
    path.write_bytes(pack(tree))
    with pytest.raises(FileFormatError, match="numbers, more than the limit for its size"):
        load_mesh(path)


def test_the_limit_counts_what_other_files_hold(tmp_path, monkeypatch):
    monkeypatch.setattr(trimesh_formats, "MAX_REPEATED", 0)
    tree = triangle_tree(points=1000)
    data = base64.b64decode(tree["buffers"][0]["uri"].partition(",")[2])
    (tmp_path / "a b.bin").write_bytes(data)
    tree["buffers"][0]["uri"] = "a%20b.bin"
    tree["meshes"][0]["primitives"].append(MANY_POINTS)
    path = tmp_path / "a.gltf"
    path.write_text(json.dumps(tree))
    assert path.stat().st_size < 3000
    assert len(load_mesh(path).points) == 1000
    (tmp_path / "a b.bin").write_bytes(data[:100])
    with pytest.raises(FileFormatError, match="more than the limit"):
        load_mesh(path)


def test_nodes_that_repeat_a_mesh(write, monkeypatch):
    tree = triangle_tree()
    tree["nodes"] *= 50
    tree["scenes"][0]["nodes"] = list(range(50))
    path = write("a.gltf", json.dumps(tree))
    assert len(load_mesh(path).faces) == 50
    monkeypatch.setattr(trimesh_formats, "MAX_REPEATED", 149 - path.stat().st_size)
    with pytest.raises(FileFormatError, match=r"a\.gltf: 150 vertices where meshes are repeated"):
        load_mesh(path)
    assert len(load_document(path).objects) == 50


@pytest.mark.parametrize("matrix", [[0] * 16, [1] * 16, [1e300] * 15 + [1]])
def test_poses_that_are_none(write, matrix):
    tree = triangle_tree()
    tree["nodes"][0]["matrix"] = matrix
    path = write("a.gltf", json.dumps(tree))
    for load in (load_mesh, e3d.load_scene):
        with pytest.raises(FileFormatError, match=r"a\.gltf: node '.*' has no affine pose"):
            load(path)


def test_what_the_mesh_does_not_take_names_the_file(write):
    tree = triangle_tree()
    tree["accessors"][0]["count"] = 2
    with pytest.raises(FileFormatError, match=r"a\.gltf: damaged: faces holds the index 2"):
        load_mesh(write("a.gltf", json.dumps(tree)))


def test_what_trimesh_would_print_is_a_warning(write, capfd):
    tree = triangle_tree()
    missing = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {}}}
    tree["meshes"][0]["primitives"][0]["extensions"] = missing
    with pytest.warns(Engine3DWarning, match="KHR_draco_mesh_compression"):
        load_mesh(write("a.gltf", json.dumps(tree)))
    assert capfd.readouterr() == ("", "")
