"""glTF files damaged in one place each: the rest is drawn, and a warning tells what is lacking."""

import base64
import json
import re

import numpy as np
import pytest
from loaders.seeds import FILES
from loaders.test_gltf import as_glb, triangle_tree

import engine3d as e3d
from engine3d.errors import FileFormatError
from engine3d.loaders import load_document

# What a picture can do without. "name" and "extras" may be anything that JSON has.
SPARE = ("animations", "cameras", "images", "materials", "samplers", "skins", "textures")
OF_NODES = ("skin", "camera", "weights", "extensions")
INSTANCED = 4  # a node whose extension says where its mesh is
OF_PRIMITIVES = ("targets", "material", "extensions")
# Keys of what is the number of something.
NUMBERS_OF = {"camera", "index", "input", "inverseBindMatrices", "light", "material", "node"}
NUMBERS_OF |= {"output", "sampler", "skeleton", "skin", "source", "POSITION", "JOINTS_0"}
WRONG = ("damaged", -1, 999, 0.5, True, None, [], {}, [None], ["x"], {"x": [1]})


def moving():
    """A file that has everything: skin, morph target, variants, cameras, a light, instances."""
    tree = json.loads(FILES["moving.gltf"])
    tree["samplers"] = [{"magFilter": 9728}]
    tree["textures"][0]["sampler"] = 0
    texture = tree["materials"][0]["normalTexture"]
    texture["extensions"] = {"KHR_texture_transform": {"offset": [0.5, 0], "scale": [2, 2]}}
    tree["materials"][0]["pbrMetallicRoughness"] = {"baseColorFactor": [1, 0, 0, 1]}
    for entries in (tree["animations"], tree["materials"]):
        for entry in entries:
            entry.pop("name", None)
    return tree


def places(value, place=()):
    """Every place of a JSON value, itself first."""
    yield place
    items = value.items() if isinstance(value, dict) else ()
    items = enumerate(value) if isinstance(value, list) else items
    for key, part in items:
        yield from places(part, (*place, key))


def spare_places():
    tree = moving()
    for name in SPARE:
        yield from places(tree[name], (name,))
    yield from places(tree["extensions"], ("extensions",))
    for index, node in enumerate(tree["nodes"]):
        for name in OF_NODES:
            if name in node and index != INSTANCED:
                yield from places(node[name], ("nodes", index, name))
    primitive = tree["meshes"][0]["primitives"][0]
    yield from places(tree["meshes"][0]["weights"], ("meshes", 0, "weights"))
    for name in OF_PRIMITIVES:
        yield from places(primitive[name], ("meshes", 0, "primitives", 0, name))
    for name in ("JOINTS_0", "WEIGHTS_0"):
        yield "meshes", 0, "primitives", 0, "attributes", name


def put(tree, place, value):
    *way, last = place
    for key in way:
        tree = tree[key]
    tree[last] = value


def at(tree, place):
    for key in place:
        tree = tree[key]
    return tree


def is_sound(place, held, value):
    """Whether a wrong value may be right where another one stands, or says nothing there."""
    if value is None or value in ([], {}):
        return True  # as if it were left out, or a list of nothing
    is_number = isinstance(value, (int, float)) and value is not True
    if isinstance(held, dict):
        return isinstance(value, dict)
    if isinstance(held, (int, float)) and not isinstance(held, bool):
        return is_number and (isinstance(held, float) or place[-1] not in NUMBERS_OF)
    return isinstance(held, bool) or (isinstance(held, str) and place[-1] == "name")


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "house.tga").write_bytes(FILES["house.tga"])
    return tmp_path


def read(tree, folder):
    path = folder / "a.gltf"
    path.write_text(json.dumps(tree))
    return load_document(path)


@pytest.mark.filterwarnings("ignore::engine3d.errors.Engine3DWarning")
@pytest.mark.parametrize("step", [7, pytest.param(1, marks=pytest.mark.slow)])
def test_the_rest_is_drawn_without_what_is_damaged(folder, step):
    sound = e3d.load_scene(write(moving(), folder))
    known, positions = set(sound.warnings), sound.nodes[0].object.positions
    cases = [(place, value) for place in spare_places() for value in WRONG]
    for place, value in cases[::step]:
        tree = moving()
        held = at(tree, place)
        put(tree, place, value)
        scene = e3d.load_scene(write(tree, folder))
        assert np.array_equal(scene.nodes[0].object.positions, positions), (place, value)
        assert len(scene.nodes) >= len(tree["nodes"])
        told = set(scene.warnings) - known
        assert told or is_sound(place, held, value) or held == value, (place, value)


@pytest.mark.filterwarnings("ignore::engine3d.errors.Engine3DWarning")
@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda t: t["skins"][0].update(joints=[]), r"skins[0] is left out: has no joints"),
        (lambda t: t["skins"][0].update(joints=[1, 2, 0]), "skins[0] is left out: has 2 matrices"),
        (
            lambda t: t["skins"][0].update(joints=[1]),
            "nodes[0].skin is left out: its mesh",
        ),
        (
            lambda t: t["meshes"][0].update(weights=[1, 2]),
            "meshes[0].weights is left out: meshes[0] has 2 weights, 1 targets",
        ),
        (
            lambda t: t["animations"][0]["samplers"][0].update(output=4),
            "animations[0].channels[0] is left out: has 2 numbers for 2 times of 4",
        ),
        (
            lambda t: t["cameras"][0]["perspective"].update(zfar=0.01),
            "cameras[0] is left out: cameras[0].perspective ends before it begins",
        ),
        (lambda t: t["nodes"][2].update(camera=9), "nodes[2].camera is left out: nodes[2] names"),
        (
            lambda t: t["extensions"]["KHR_lights_punctual"]["lights"][0].update(intensity=-1),
            "KHR_lights_punctual.lights[0] is left out: is darker than no light",
        ),
        (
            lambda t: t["materials"][0].update(alphaCutoff=-1),
            "materials[0].alpha_cutoff is left out: alpha_cutoff must be",
        ),
        (
            lambda t: t["meshes"][1]["primitives"][0]["attributes"].update(COLOR_0=8),
            "meshes[1].primitives[0].COLOR_0 is left out: accessors[8]",
        ),
        (
            lambda t: t["meshes"][1]["primitives"][0].update(mode=9),
            "meshes[1].primitives[0] is left out: meshes[1].primitives[0].mode is 9",
        ),
        (lambda t: t["nodes"][4].update(mesh=7), "nodes[4].mesh is left out: nodes[4] names"),
        (
            lambda t: t["nodes"][4].update(translation=[0, 0]),
            "nodes[4] is left out: nodes[4].translation is not 3 numbers",
        ),
        (lambda t: t["meshes"].__setitem__(1, {}), "meshes[1] is left out: has no primitives"),
    ],
)
def test_what_is_left_out_is_told_with_its_place(folder, change, message):
    tree = moving()
    change(tree)
    document = read(tree, folder)
    assert any(message in told for told in document.warnings), document.warnings
    assert len(document.objects[0].mesh.faces) == 1


def test_where_nothing_is_left_the_first_damage_is_the_error(folder):
    tree = triangle_tree()
    tree["meshes"][0]["primitives"] *= 2
    tree["meshes"][0]["primitives"][0] = {"attributes": {"POSITION": 0}, "indices": 9}
    with pytest.warns(e3d.Engine3DWarning, match=r"primitives\[0\] is left out"):
        assert len(e3d.load_mesh(as_glb(tree)).faces) == 1
    tree["meshes"][0]["primitives"][1] = {"attributes": {"POSITION": 9}}
    with pytest.raises(FileFormatError, match=r"damaged: meshes\[0\]\.primitives\[0\] names acc"):
        e3d.load_scene(as_glb(tree))


def test_times_before_the_start_move_the_clip(folder):
    tree = moving()
    sound = read(tree, folder).tree.clips[0]
    data = bytearray(tree_bytes(tree))
    data[224:232] = np.float32([-1.5, 0.5]).tobytes()
    put_bytes(tree, data)
    with pytest.warns(e3d.Engine3DWarning, match=r"animations\[0\] begins at -1.5 s: it is moved"):
        scene = e3d.load_scene(write(tree, folder))
    (clip,) = scene.animations.values()
    assert clip.duration == 2.0
    for channel, other in zip(clip.channels, sound.channels, strict=True):
        assert channel.times.tolist() == [0.0, 2.0]
        assert np.array_equal(channel.values, other.values)


def write(tree, folder):
    (folder / "a.gltf").write_text(json.dumps(tree))
    return folder / "a.gltf"


def tree_bytes(tree):
    return base64.b64decode(tree["buffers"][0]["uri"].partition(",")[2])


def put_bytes(tree, data):
    uri = "data:application/octet-stream;base64," + base64.b64encode(bytes(data)).decode()
    tree["buffers"][0]["uri"] = uri


def with_fractions(value):
    """The same JSON, each integer written as a decimal."""
    if isinstance(value, dict):
        return {key: with_fractions(part) for key, part in value.items() if key != "extras"}
    if isinstance(value, list):
        return [with_fractions(part) for part in value]
    return float(value) if type(value) is int else value


@pytest.mark.filterwarnings("ignore::engine3d.errors.Engine3DWarning")
@pytest.mark.parametrize("text", [".0", "e0", ".00E+0"])
def test_whole_numbers_may_be_decimals(folder, text):
    tree = moving()
    sound, warned = e3d.load_scene(write(tree, folder)), len(read(tree, folder).warnings)
    path = write(with_fractions(tree), folder)
    path.write_text(re.sub(r"(?<=\d)\.0(?=[],}])", text, path.read_text()))
    assert text in path.read_text()
    again = e3d.load_scene(path)
    assert len(again.warnings) == warned
    for one, other in zip(sound.nodes, again.nodes, strict=True):
        assert np.array_equal(one.world_pose, other.world_pose)
        assert type(one.object) is type(other.object)
    assert np.array_equal(sound.nodes[0].object.positions, again.nodes[0].object.positions)
    assert list(again.animations) == list(sound.animations)


@pytest.mark.parametrize("word", ["NaN", "Infinity", "-Infinity"])
def test_words_for_no_number_are_no_json(folder, word):
    text = json.dumps(triangle_tree()).replace('"asset"', f'"extras": {word}, "asset"')
    (folder / "a.gltf").write_text(text)
    with pytest.raises(FileFormatError, match=rf"no JSON in UTF-8 \({word} is no number\)"):
        load_document(folder / "a.gltf")


@pytest.mark.parametrize("least", ["2.1", "2.10", "3.0", "x", "2.x"])
def test_versions_beyond_are_refused(folder, least):
    tree = triangle_tree()
    tree["asset"] = {"version": "2.1", "minVersion": least}
    with pytest.raises(FileFormatError, match="needs glTF of version"):
        read(tree, folder)
    tree["asset"]["minVersion"] = "2.0"
    assert read(tree, folder).warnings == [
        f"{folder / 'a.gltf'}: what glTF '2.1' has beyond 2.0 is not read"
    ]


def test_the_last_row_of_a_pose_may_be_rounded(folder):
    tree = triangle_tree()
    tree["nodes"][0]["matrix"] = [1, 0, 0, 1e-8, 0, 1, 0, 0, 0, 0, 1, 0, 3, 4, 5, 0.9999999]
    (entry,) = read(tree, folder).objects
    assert entry.pose[3].tolist() == [0, 0, 0, 1]
    assert entry.pose[:3, 3].tolist() == [3, 4, 5]
    tree["nodes"][0]["matrix"][3] = 0.01
    with pytest.raises(FileFormatError, match=r"nodes\[0\]\.matrix is no affine pose"):
        read(tree, folder)
