"""Pictures that show nothing: each command says so in a line, with the reason, and succeeds."""

import json
import re

import pytest

from engine3d.apps.cli import main
from engine3d.batch import read_manifest, run
from engine3d.errors import Engine3DWarning

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
CLEAR = "newmtl m\nd 0\n"
_LIGHTS = {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}
LAMP = json.dumps(
    {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": _LIGHTS,
    }
)
HIDDEN = json.dumps(
    {
        "format": "engine3d scene",
        "version": 1,
        "objects": [{"kind": "mesh", "primitive": "box", "arguments": {}}],
        "nodes": [{"object": 0, "hidden": True}],
    }
)


def seen_from(position, target, **more):
    """Where one stands, as options of commands and as the camera of a task."""
    spelt = [",".join(map(str, place)) for place in (position, target)]
    options = [f"--camera-position={spelt[0]}", f"--camera-focal-point={spelt[1]}"]
    options += [f"--{key}={value}" for key, value in more.items()]
    return options, {"position": position, "target": target, **more}


AROUND = [], {}
#: The word -> the file, its text, from where it is seen, and what a sentence holds.
REASONS = {
    "no_geometry": ("a.gltf", LAMP, AROUND, "no mesh in the scene"),
    "not_finite": ("a.obj", TRIANGLE.replace("0", "nan"), AROUND, "finite coordinates"),
    "infinite": ("a.obj", TRIANGLE.replace("0", "1e999"), AROUND, "finite coordinates"),
    "one_corner": ("a.obj", TRIANGLE.replace("1 0 0", "nan 0 0"), AROUND, "finite coordinates"),
    "zero_size": (
        "a.obj",
        TRIANGLE.replace("1 0 0", "0 0 0").replace("0 1 0", "0 0 0"),
        AROUND,
        "one point",
    ),
    "hidden_nodes": ("a.e3d.json", HIDDEN, AROUND, "switched off"),
    "transparent": ("a.obj", f"mtllib m.mtl\nusemtl m\n{TRIANGLE}", AROUND, "transparent"),
    "all_culled": ("a.stl", None, seen_from([0.3, 0.3, -3], [0.3, 0.3, 0]), "show their backs"),
    "behind_camera": ("a.obj", TRIANGLE, seen_from([0, 0, 5], [0, 0, 9]), "behind the camera"),
    "beyond_far": ("a.obj", TRIANGLE, seen_from([0, 0, 50], [0, 0, 0], near=1, far=10), "beyond"),
    "too_near": ("a.obj", TRIANGLE, seen_from([0, 0, 5], [0, 0, 0], near=20, far=30), "near plane"),
    "outside": (
        "a.obj",
        TRIANGLE,
        seen_from([0, 0, 5], [5, 0, 0]),
        "outside of the picture|near plane",
    ),
    "edge_on": ("a.obj", TRIANGLE, seen_from([0.2, 5, 0], [0.2, 0, 0]), "edge on"),
    "far_away": ("a.obj", TRIANGLE, seen_from([0, 0, 9e5], [0, 0, 0]), "smaller than a pixel"),
}
UP = {"edge_on": ["--camera-view-up=1,0,0"]}
COMMANDS = {
    "render": ["render", "--look", "studio"],
    "plain": ["render", "--look", "plain"],
    "white": ["render", "--background-color", "white", "--grid"],
    "turntable": ["render", "--turntable", "2"],
    "run": ["run", "--headless", "--frames", "1"],
}


@pytest.fixture
def file(tmp_path):
    """Write the file of a reason, and return its path."""

    def write(word):
        name, text, *_ = REASONS[word]
        if text is None:
            facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
            text = f"solid a\n{facet}endloop\nendfacet\nendsolid\n"
        (tmp_path / "m.mtl").write_text(CLEAR)
        (tmp_path / name).write_text(text)
        return tmp_path / name

    return write


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("word", REASONS)
def test_commands_say_it(file, tmp_path, capsys, word, command):
    options, part = REASONS[word][2][0], REASONS[word][3]
    if command == "turntable" and word in ("all_culled", "behind_camera", "outside", "edge_on"):
        pytest.skip("a turn shows it")
    cull = ["--cull", "back"] if word == "all_culled" else []
    output = tmp_path / ("a.gif" if command == "turntable" else "a.png")
    said = [*COMMANDS[command], str(file(word)), "-o", str(output), "--size", "64x48"]
    assert main([*said, *options, *cull, *UP.get(word, [])]) == 0
    lines = capsys.readouterr().err.splitlines()
    assert [line for line in lines if re.search(f"nothing shows: .*({part})", line)], lines
    assert sum("nothing shows" in line for line in lines) == 1 and output.exists()


@pytest.mark.parametrize("look", [None, "plain", "studio"])
@pytest.mark.parametrize("word", REASONS)
def test_batches_say_it_and_their_records(file, tmp_path, word, look):
    name, _, (_, camera), part = REASONS[word]
    if look is not None and camera:
        pytest.skip("a look shows all of the model")
    file(word)
    task = {"model": name, "name": "a", "size": [64, 48], "look": look}
    if camera:
        up = {"up": [1, 0, 0]} if word == "edge_on" else {}
        task |= {"camera": {**camera, **up}}
    if word == "all_culled":
        task |= {"render": {"cull": "back"}}
    path = tmp_path / "m.json"
    path.write_text(json.dumps({"version": 1, "tasks": [{k: v for k, v in task.items() if v}]}))
    with pytest.warns(Engine3DWarning, match=f"a: nothing shows: .*({part})"):
        summary = run(read_manifest(path).tasks, tmp_path / "out", jobs=1)
    assert summary.drawn == 1
    record = json.loads((tmp_path / "out" / ".batch" / "a.json").read_text())
    usual = {"infinite": "not_finite", "one_corner": "not_finite", "too_near": "behind_camera"}
    assert (record["blank"], record["why"]) == (True, usual.get(word, word))


@pytest.mark.parametrize("command", COMMANDS)
def test_what_shows_is_not_told_of(tmp_path, capsys, command):
    (tmp_path / "a.obj").write_text(TRIANGLE)
    output = tmp_path / ("a.gif" if command == "turntable" else "a.png")
    size = ["--size", "64x48"]
    assert main([*COMMANDS[command], str(tmp_path / "a.obj"), "-o", str(output), *size]) == 0
    assert "nothing shows" not in capsys.readouterr().err


def test_glass_shows(tmp_path, capsys):
    (tmp_path / "m.mtl").write_text("newmtl m\nd 0.2\n")
    (tmp_path / "a.obj").write_text(f"mtllib m.mtl\nusemtl m\n{TRIANGLE}")
    for command in ("render", "plain", "white"):
        arguments = [*COMMANDS[command], str(tmp_path / "a.obj"), "-o", str(tmp_path / "a.png")]
        assert main([*arguments, "--size", "64x48"]) == 0
    assert capsys.readouterr().err == ""
