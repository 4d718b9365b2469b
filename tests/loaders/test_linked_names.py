"""Files that models name, however they are spelt: one finder for libraries, images and buffers."""

import json
import unicodedata
import warnings

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.errors import FileAccessError, InvalidArgumentError
from engine3d.io.reading.linked_files import LinkedFileError, LinkedFiles
from engine3d.io.resources import Resources
from engine3d.loaders import load_document, load_mesh

MODEL = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
RED = (200, 10, 20, 255)


def image(path):
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.new("RGBA", (2, 2), RED).save(path, "PNG")


def quietly(load, *args, **options):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return load(*args, **options)


def obj_of(folder, name: bytes):
    """A model whose library names an image."""
    (folder / "m.mtl").write_bytes(b"newmtl m\nmap_Kd " + name + b"\n")
    (folder / "m.obj").write_bytes(b"mtllib m.mtl\n" + MODEL.encode())
    return folder / "m.obj"


def ply_of(folder, name: bytes):
    head = b"ply\nformat ascii 1.0\ncomment TextureFile " + name + b"\nelement vertex 3\n"
    axes = b"".join(b"property float %s\n" % axis for axis in (b"x", b"y", b"z", b"s", b"t"))
    face = b"element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    rows = b"0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"
    (folder / "m.ply").write_bytes(head + axes + face + rows)
    return folder / "m.ply"


def gltf_of(folder, name: bytes):
    """A model whose buffer is named; what it should hold is in the image's place."""
    data = np.float32([0, 0, 0, 1, 0, 0, 0, 1, 0]).tobytes()
    accessor = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}
    whole = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{**accessor, "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
        "buffers": [{"byteLength": len(data), "uri": name.decode()}],
    }
    (folder / "m.gltf").write_text(json.dumps(whole))
    return folder / "m.gltf"


def is_textured(mesh):
    texture = mesh.materials[0].texture
    return texture is not None and texture.pixels[0, 0].tolist() == list(RED)


PATHS = [
    "wood 1.png",
    "./wood 1.png",
    "WOOD 1.PNG",
    "wood%201.png",
    "/home/me/wood 1.png",
    "~/wood 1.png",
    "C:\\work\\wood 1.png",
    "C:wood 1.png",
    "d:/work/wood 1.png",
    "\\\\server\\share\\wood 1.png",
    "//server/share/wood 1.png",
    "..\\..\\wood 1.png",
    "../images/wood 1.png",
    "images\\wood 1.png",
    "file:wood 1.png",
    "file:///C:/work/wood%201.png",
    "file://localhost/home/me/wood%201.png",
    "FILE:///home/me/wood 1.png",
]


@pytest.mark.parametrize("name", PATHS)
@pytest.mark.parametrize("model_of", [obj_of, ply_of])
def test_ends_of_paths_of_other_machines(tmp_path, model_of, name):
    image(tmp_path / "wood 1.png")
    mesh = quietly(load_mesh, model_of(tmp_path, name.encode()))
    assert is_textured(mesh), mesh.warnings
    is_as_named = name.lower() in ("wood 1.png", "./wood 1.png", "wood%201.png", "file:wood 1.png")
    assert bool(mesh.warnings) != is_as_named


@pytest.mark.parametrize("name", PATHS)
def test_ends_of_paths_that_buffers_have(tmp_path, name):
    (tmp_path / "wood 1.png").write_bytes(np.float32([0, 0, 0, 1, 0, 0, 0, 1, 0]).tobytes())
    assert len(quietly(load_mesh, gltf_of(tmp_path, name.encode())).faces) == 1


@pytest.mark.parametrize("name", PATHS)
def test_ends_of_paths_that_libraries_have(tmp_path, name):
    (tmp_path / "wood 1.png").write_text("newmtl m\nKd 1 0 0\n")
    (tmp_path / "a.obj").write_text(f"mtllib {name}\n{MODEL}")
    assert quietly(load_mesh, tmp_path / "a.obj").materials[0].color == (1, 0, 0)


@pytest.mark.parametrize(
    "name", ["C:\\me\\proj\\textures\\a.png", "/me/proj/Textures/A.png", "../proj/textures/a.png"]
)
def test_as_many_parts_as_possible_count(tmp_path, name):
    image(tmp_path / "textures" / "a.png")
    Image.new("RGB", (2, 2)).save(tmp_path / "a.png")
    assert is_textured(quietly(load_mesh, obj_of(tmp_path, name.encode())))


NAMES = {
    "cp932": ["テクスチャ", "ソース表", "十能ソ", "ｱｲｳ"],
    "gb18030": ["木纹", "贴图誠", "俓"],
    "big5": ["木紋", "功能許蓋"],
    "cp949": ["나무결", "텍스처"],
    "latin-1": ["Größe", "forêt à"],
    "cp1252": ["“bois” €"],
    "cp1251": ["дерево"],
    "utf-8": ["Möbel", "テソ表", "a\u00a0b", "x\u0085y"],
}


@pytest.mark.parametrize(
    ("encoding", "name"), [(code, name) for code, names in NAMES.items() for name in names]
)
@pytest.mark.parametrize("options", ["", "-s 2 2 2 "])
def test_names_in_other_encodings(tmp_path, encoding, name, options):
    image(tmp_path / "maps" / f"{name}.png")
    written = f"{options}maps/{name}.png".encode(encoding)
    mesh = quietly(load_mesh, obj_of(tmp_path, written))
    assert is_textured(mesh) and not mesh.warnings
    if not options:
        assert is_textured(quietly(load_mesh, ply_of(tmp_path, written)))


@pytest.mark.parametrize(
    ("encoding", "name"), [(code, name) for code, names in NAMES.items() for name in names]
)
def test_materials_and_libraries_in_other_encodings(tmp_path, encoding, name):
    """Also those whose last byte is that of a backslash, which continues lines elsewhere."""
    letters = name.encode(encoding)
    (tmp_path / f"{name}.mtl").write_bytes(b"newmtl " + letters + b"\nKd 1 0 0\n")
    model = MODEL.encode().replace(b"usemtl m", b"g " + letters + b"\nusemtl " + letters)
    (tmp_path / "a.obj").write_bytes(b"mtllib " + letters + b".mtl\n" + model)
    mesh = quietly(load_mesh, tmp_path / "a.obj")
    assert mesh.materials[0].color == (1, 0, 0) and not mesh.warnings
    assert len(mesh.faces) == 1 and len(mesh.groups) == len(name.split(" "))


@pytest.mark.parametrize("forms", [("NFC", "NFD"), ("NFD", "NFC")])
def test_composed_and_decomposed_letters(tmp_path, forms):
    named, stored = (unicodedata.normalize(form, "Möbel é.png") for form in forms)
    image(tmp_path / stored)
    assert is_textured(quietly(load_mesh, obj_of(tmp_path, named.encode())))


@pytest.mark.parametrize(
    "name", ["../images/a.png", "..\\images\\a.png", "images/a.png", "{}/images/a.png"]
)
@pytest.mark.parametrize("kind", [str, lambda path: path])
def test_a_root_lets_names_lead_into_it(tmp_path, name, kind):
    image(tmp_path / "images" / "a.png")
    folder = tmp_path / "models"
    folder.mkdir()
    path = obj_of(folder, name.format(tmp_path).encode())
    assert quietly(load_mesh, path).materials[0].texture is None
    root = kind(tmp_path)
    assert is_textured(load_mesh(path, root=root))
    assert is_textured(e3d.load_scene(path, root=root).nodes[0].object)
    assert is_textured(load_document(path, root=root).objects[0].mesh)
    assert is_textured(Resources().load_mesh(path, root=root))


def test_names_of_bytes_are_looked_for_in_the_root_alone(tmp_path):
    image(tmp_path / "a.png")
    data = obj_of(tmp_path, b"a.png").read_bytes()
    assert quietly(load_mesh, data, format="obj").materials[0].texture is None
    assert is_textured(load_mesh(data, format="obj", root=tmp_path))


def test_nothing_beyond_the_root_is_read(tmp_path):
    image(tmp_path / "secret" / "a.png")
    for folder in ("work/models", "work/root"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "work" / "root" / "link.png").symlink_to(tmp_path / "secret" / "a.png")
    for name in ("../../secret/a.png", str(tmp_path / "secret" / "a.png"), "../root/link.png"):
        mesh = quietly(
            load_mesh,
            obj_of(tmp_path / "work" / "models", name.encode()),
            root=tmp_path / "work" / "root",
        )
        assert mesh.materials[0].texture is None and "refused" in mesh.warnings[0]


@pytest.mark.parametrize("load", [load_mesh, load_document, e3d.load_scene])
def test_roots_that_are_none(tmp_path, load):
    path = obj_of(tmp_path, b"a.png")
    with pytest.raises(InvalidArgumentError, match="root must be a str or a path or None, not 3"):
        load(path, root=3)
    with pytest.raises(FileAccessError, match="root: there is no such folder"):
        load(path, root=tmp_path / "none")


def test_a_scene_names_no_file_that_was_read_with_a_root(tmp_path):
    image(tmp_path / "images" / "a.png")
    (tmp_path / "models").mkdir()
    scene = e3d.Scene()
    scene.add(load_mesh(obj_of(tmp_path / "models", b"../images/a.png"), root=tmp_path))
    scene.save(tmp_path / "models" / "a.e3d.json")
    assert is_textured(e3d.load_scene(tmp_path / "models" / "a.e3d.json").nodes[0].object)


def test_many_missing_files_do_not_keep_the_disk_busy(tmp_path, monkeypatch):
    monkeypatch.setattr("engine3d.io.reading.linked_files._MAX_FAILURES", 100)
    files = LinkedFiles(str(tmp_path))
    for number in range(100):
        with pytest.raises(LinkedFileError):
            files.find_near(f"C:\\a\\b\\c\\d\\e\\{number}é.png")
    with pytest.raises(LinkedFileError, match="too many files are missing"):
        files.find("a.png")
