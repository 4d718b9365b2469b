"""Scene files that are wrong: a clear error that names the place, or a warning."""

import json
import os

import pytest
from loaders.seeds import FILES
from plain_picture import render

import engine3d as e3d
from engine3d.loaders import load_document

MTL = b"newmtl brick\nKd .8 .2 .1\nmap_Kd house.tga\n"  # without what is not drawn
SEED = json.loads(FILES["a.json"])


@pytest.fixture
def folder(tmp_path):
    for name, data in {**FILES, "house.mtl": MTL}.items():
        (tmp_path / name).write_bytes(data)
    return tmp_path


def changed(*path_and_value):
    """The seed, another in one place; a value that is a function changes what is there."""
    tree = json.loads(FILES["a.json"])
    *path, key, value = path_and_value
    held = tree
    for step in path:
        held = held[step]
    if value is ...:
        del held[key]
    else:
        held[key] = value
    return tree


def load(folder, tree):
    path = folder / "case.json"
    path.write_text(tree if isinstance(tree, str) else json.dumps(tree), encoding="utf-8")
    return e3d.load_scene(path)


def test_the_seed_is_whole(folder):
    scene = load(folder, SEED)
    assert not scene.warnings and len(scene.nodes) == 8
    assert [child.id for child in scene.nodes[0].children] == [2, 1, 3]
    assert scene.nodes[2].world_pose[0].tolist() == [0.8, 0, 0, 0.4]
    assert scene.nodes[7].object.zfar == float("inf")
    assert scene.nodes[1].object.materials != scene.nodes[5].object.materials
    assert render(scene, size=(32, 24)).color.any()


ARRAYS = ("objects", 3, "arrays")
WRONG = [
    ("{", r"case\.json:1: not JSON"),
    ('{"format": "engine3d scene",\n"version": 1\n"nodes": []}', r"case\.json:3: not JSON"),
    ("[" * 100_000, "nested too deeply"),
    ('{"format": "engine3d scene", "version": ' + "9" * 5000 + "}", "case.json"),
    ('{"format": "other"}', "not a scene of engine3d"),
    ("[]", "not a scene of engine3d"),
    (changed("version", 2), "a scene of version 2, which a newer engine3d reads"),
    (changed("version", "1"), "version: '1' is not a version"),
    (changed("version", ...), "'version' is missing"),
    (changed("nodes", {}), "nodes: {} is not a list"),
    (changed("nodes", 0, 7), r"nodes\[0\]: 7 is not an object"),
    (changed("nodes", 0, "children", [9]), r"nodes\[0\].children\[0\]: 9 is not the number of"),
    (changed("nodes", 0, "children", [1, 1]), r"nodes\[1\] is a child of nodes\[0\] already"),
    (changed("nodes", 4, "children", [0]), r"nodes\[\d\]: is below itself"),
    (changed("nodes", 3, "children", [3]), "already"),
    (changed("nodes", 6, "children", [6]), r"nodes\[6\]: is below itself"),
    (changed("nodes", 1, "object", 7), r"nodes\[1\].object: 7 is not the number of one of 7 obj"),
    (changed("nodes", 1, "object", -1), r"nodes\[1\].object"),
    (changed("nodes", 1, "object", True), r"nodes\[1\].object"),
    (changed("nodes", 1, "rotation", [0, 0, 0, 0]), r"nodes\[1\].rotation: .*quaternion"),
    (changed("nodes", 1, "rotation", [0, 0, 1]), r"nodes\[1\].rotation: .* is not 4 finite"),
    (changed("nodes", 1, "rotation", [0, 0, 1, 1e999]), r"Infinity is no number of JSON"),
    (changed("nodes", 1, "rotation", [0, 0, 1, 10**400]), r"nodes\[1\].rotation"),
    (changed("nodes", 2, "scale", [1, 1, 1]), r"nodes\[2\]: give pose or translation"),
    (changed("nodes", 4, "hidden", 1), r"nodes\[4\].hidden: 1 is not true or false"),
    (changed("nodes", 4, "name", 1), r"nodes\[4\].name: 1 is not a text"),
    (changed("nodes", 4, "position", 1), r"nodes\[4\].position: is no property of a node"),
    (changed("nodes", 6, "collider", {"kind": "box"}), r"nodes\[6\].collider: .*needs a node"),
    (changed("nodes", 1, "collider", {"kind": "cone"}), "collider.kind: 'cone' is not one of"),
    (changed("nodes", 1, "collider", {"kind": "sphere"}), "collider: .*radius"),
    (changed("nodes", 3, "collider", "mesh", 5), r"collider.mesh: objects\[5\] is no mesh"),
    (changed("nodes", 1, "spins", [{"axis": [0, 1, 0]}]), r"nodes\[1\].spins\[0\]: 'period' is"),
    (changed("nodes", 1, "spins", [{"axis": [0, 0, 0], "period": 1}]), r"spins\[0\]: .*an axis"),
    (changed("nodes", 1, "spins", [{"axis": [0, 1], "period": 1}]), "axis: .* is not 3 finite"),
    (changed("nodes", 1, "spins", [{"speed": 1}]), "speed: is no property of a motion"),
    (changed("nodes", 1, "tracks", [{"times": [1, 1]}]), r"tracks\[0\]: times must increase"),
    (changed("nodes", 1, "tracks", [{"times": [1], "scales": []}]), "scales"),
    (changed("nodes", 1, "tracks", [{"times": [1], "repeat": 0}]), "repeat: 0 is not true or"),
    (changed("scene", "full_rate_distance", "far"), "scene.full_rate_distance: "),
    (changed("scene", "weather", 1), "scene.weather: is no property of a scene"),
    (changed("scene", "ambient", "bluish"), "scene.ambient: "),
    (changed("objects", 0, "kind", "cat"), r"objects\[0\].kind: 'cat' is not one of mesh"),
    (changed("objects", 0, "kind", ...), r"objects\[0\]: 'kind' is missing"),
    (changed("objects", 5, "brightness", 1), r"objects\[5\]: .*brightness"),
    (changed("objects", 5, "range", ...), r"objects\[5\]: falloff 'window' needs a finite"),
    (changed("objects", 6, "znear", -1), r"objects\[6\]: znear"),
    (changed("objects", 4, "mesh", 4), r"objects\[4\].mesh: objects\[4\] is no mesh"),
    (changed("objects", 2, "primitive", "cow"), "primitive: 'cow' is not one of box"),
    (changed("objects", 2, "primitive", "__all__"), "is not one of box"),
    (changed("objects", 2, "arguments", "segments", [8, 1]), r"objects\[2\]: segments"),
    (changed("objects", 2, "arguments", "segments", [8192, 8192]), "more vertices of primitives"),
    (changed("objects", 2, "arguments", "segments", ["a"]), r"objects\[2\]"),
    (changed("objects", 2, "arguments", "colour", 1), r"objects\[2\]: .*colour"),
    (changed("objects", 2, "materials", [2]), r"objects\[2\].materials\[0\]: 2 is not the number"),
    (changed(*ARRAYS, "positions", "shape", [2, 3]), "36 bytes do not fill an array of shape"),
    (changed(*ARRAYS, "positions", "shape", [2**31, 2]), "shape"),
    (changed(*ARRAYS, "positions", "shape", [3, -3]), "shape: .* is not up to 3 counts"),
    (changed(*ARRAYS, "positions", "type", "float128"), "type: 'float128' is not one of float32"),
    (changed(*ARRAYS, "positions", "base64", "AAA"), "base64: is not base64"),
    (changed(*ARRAYS, "positions", "base64", "A\u00e9=="), "base64: is not base64"),
    (changed(*ARRAYS, "faces", "base64", "AAAAAAEAAAADAAAA"), r"objects\[3\]: .*faces"),
    (changed(*ARRAYS, "widths", {}), "meshes have no array 'widths'"),
    (changed("objects", 3, "values", {"t": {"on": "edges", "array": {"type": "int32", "shape": [1],
     "base64": "BQAAAA=="}}}), r"objects\[3\]: on must be one of 'vertices'"),
    (changed("objects", 3, "values", {"t": {"on": "faces", "array": {"type": "int8", "shape": [2],
     "base64": "BQU="}}}), r"objects\[3\]: values 't' has 2 rows for"),
    (changed("objects", 3, "values", {"t": {"on": "faces"}}), "array: missing|array"),
    (changed("objects", 3, "groups", {"g": {"type": "int32", "shape": [1], "base64": "BQAAAA=="}}),
     r"objects\[3\]: .*group"),
    (changed("materials", 0, "texture", 1), r"materials\[0\].texture: 1 is not the number"),
    (changed("materials", 0, "glow", 1), r"materials\[0\]: .*glow"),
    (changed("materials", 0, "color", [1, 2]), r"materials\[0\]: color"),
    (changed("textures", 0, {"png": "AAAA"}), r"textures\[0\].png: "),
    (changed("textures", 0, {"png": "?"}), r"textures\[0\].png: is not base64"),
    (changed("textures", 0, "wrap", "round"), r"textures\[0\]: wrap"),
    (changed("textures", 0, "wrap", ["clamp"]), r"textures\[0\]: wrap must be one name or a pair"),
    (changed("textures", 0, "anisotropy", 17), r"textures\[0\]: anisotropy must be a whole number"),
    (changed("textures", 0, "lod_bias", "low"), r"textures\[0\]: lod_bias must be in -16..16"),
    (changed("textures", 0, "wrap", ["clamp", 1]), r"textures\[0\]\.wrap\[1\]"),
]  # fmt: skip


@pytest.mark.parametrize(("tree", "message"), WRONG, ids=[message for _, message in WRONG])
def test_what_is_wrong_is_an_error_that_names_its_place(folder, tree, message):
    with pytest.raises(e3d.FileFormatError, match=message) as caught:
        load(folder, tree)
    text = str(caught.value)
    assert text.startswith(str(folder / "case.json")) and len(text) < 500 and "\n" not in text


@pytest.mark.filterwarnings("ignore::engine3d.Engine3DWarning")
@pytest.mark.parametrize(
    ("tree", "message"),
    [
        (changed("objects", 0, "file", "../house.obj"), "leaves the model's folder"),
        (changed("objects", 0, "file", "/etc/passwd"), "absolute path"),
        (changed("objects", 0, "file", "none.obj"), "not found"),
        (changed("objects", 0, "file", "case.json"), "a scene within a scene"),
        (changed("objects", 0, "file", "house.mtl"), "left out"),
        (changed("objects", 1, "part", "roof"), "no part 'roof' number 0"),
        (changed("objects", 1, "occurrence", 1), "no part 'walls' number 1"),
        (changed("textures", 0, "file", "house.obj"), "textures.0.* is left out"),
        (changed("textures", 0, "file", "\0"), "not a file name"),
        (changed("comment", "mine"), "'comment' is not known"),
    ],
)
def test_what_can_be_left_out_is_told(folder, tree, message):
    scene = load(folder, tree)
    assert len(scene.nodes) == 8
    assert [line for line in scene.warnings if e3d_matches(message, line)]


def e3d_matches(pattern, line):
    import re

    return re.search(pattern, line) is not None


def test_few_bytes_make_no_large_scene(folder):
    nodes = ",".join(["{}"] * 60_000)
    with pytest.raises(e3d.FileFormatError, match="60000 nodes are more than the file can say"):
        load(folder, '{"format": "engine3d scene", "version": 1, "nodes": [' + nodes + "]}")
    repeated = changed("objects", 2, "arguments", "segments", [16, 8])
    load(folder, {**repeated, "nodes": [{"object": 2}] * 20_000})
    with pytest.raises(e3d.FileFormatError, match="one mesh of them is limited"):
        e3d.load_mesh(folder / "case.json")


def test_a_scene_without_meshes_is_a_scene(folder):
    scene = load(folder, '{"format": "engine3d scene", "version": 1}')
    assert scene.nodes == ()
    with pytest.raises(e3d.FileFormatError, match="no vertices in this scene"):
        e3d.load_mesh(folder / "case.json")


def test_bytes_without_a_folder_are_a_scene(folder):
    data = FILES["a.json"]
    with pytest.warns(e3d.Engine3DWarning, match="in no folder"):
        document = load_document(data)
    assert document.format == "e3d" and len(document.scene.nodes) == 8


def test_each_use_of_a_file_has_materials_of_its_own(folder):
    tree = changed("objects", 1, {"kind": "mesh", "file": "house.obj", "materials": [1]})
    scene = load(folder, tree)
    first, second = scene.nodes[1].object, scene.nodes[5].object
    assert first is not second and first.positions is second.positions
    assert first.materials != second.materials


def test_files_are_read_once_however_often_they_are_named(folder, monkeypatch):
    from engine3d.io.formats import scene_looks, scene_parts

    reads = []
    for module, name in ((scene_parts, "document_of"), (scene_looks, "texture_of")):
        read = getattr(module, name)
        monkeypatch.setattr(
            module, name, lambda *a, read=read, **k: reads.append(a[0].path) or read(*a, **k)
        )
    (folder / "damaged.obj").write_bytes(b"v 0 0 x\n")
    tree = json.loads(FILES["a.json"])
    tree["textures"] = [{"file": "house.tga", "name": f"{k}"} for k in range(50)]
    tree["objects"] += [{"kind": "mesh", "file": "house.obj"}] * 50
    tree["objects"] += [{"kind": "mesh", "file": "damaged.obj"}] * 50
    (folder / "case.json").write_text(json.dumps(tree), encoding="ascii")
    with pytest.warns(e3d.Engine3DWarning, match="damaged.obj"):
        document = load_document(folder / "case.json")
    assert sorted(os.path.basename(path) for path in reads) == [
        "damaged.obj", "house.obj", "house.obj", "house.tga",
    ]  # fmt: skip
    assert len({id(mesh.positions) for mesh in document.scene.meshes.values()}) < 60
    monkeypatch.setattr(scene_parts, "_MAX_COPIES", 10)
    with pytest.warns(e3d.Engine3DWarning, match="more than 10 materials of repeated"):
        e3d.load_scene(folder / "case.json")


def test_primitives_that_are_alike_share_arrays_but_no_materials(folder):
    again = {"kind": "mesh", "primitive": "box", "arguments": {"size": 2}}
    tree = changed("objects", 2, again)
    tree["objects"] += [again, {**again, "arguments": {"size": 3}}]
    count = len(tree["objects"])
    tree["nodes"] = [{"object": number} for number in (2, count - 2, count - 1)]
    one, other, larger = (node.object for node in load(folder, tree).nodes)
    assert one is not other and one.positions is other.positions
    assert one.materials[0] is not other.materials[0]
    assert larger.positions.max() == 1.5
