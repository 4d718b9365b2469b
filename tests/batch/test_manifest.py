"""Manifests: what they may say, and errors that name the place of what is wrong."""

import json
import re
from pathlib import Path

import pytest

import engine3d as e3d
from engine3d.apps.cli.parser import make_parser
from engine3d.batch import Task, read_manifest

MODEL = {"model": "model.obj"}
SCRIPT = {"script": "script.py"}


def test_defaults_and_own_values(manifest, place):
    path = manifest(MODEL, {**SCRIPT, "name": "a/b", "size": [8, 9], "seed": 5})
    tasks, writer = read_manifest(path)
    assert writer is None
    assert [task.name for task in tasks] == ["model", "a/b"]
    assert [task.size for task in tasks] == [(24, 16), (8, 9)]
    assert [task.index for task in tasks] == [0, 1]
    assert tasks[1].seed == 5 and tasks[1].path("x") == str(place / "x")


def test_matrices_combine_values(manifest):
    cameras = [{"azimuth_degrees": 10, "name": "left"}, {"azimuth_degrees": 20}]
    path = manifest(
        {"matrix": {"model": ["model.obj", "b/c.stl"], "camera": cameras, "seed": [7, 9]}},
        {**SCRIPT, "name": "s{seed:03}-{index}", "matrix": {"seed": {"from": 4, "count": 2}}},
        {**MODEL, "matrix": {"size": [[4, 5], [6, 7]], "camera": [0]}},
    )
    names = [task.name for task in read_manifest(path).tasks]
    assert names[:4] == ["model_left_7", "model_left_9", "model_1_7", "model_1_9"]
    assert names[4:8] == [name.replace("model", "c") for name in names[:4]]
    assert names[8:] == ["s004-8", "s005-9", "model_4x5_0", "model_6x7_0"]


def test_a_lens_says_how_large_its_pictures_are(place):
    record = {"model": "PINHOLE", "params": [40, 40, 24, 16], "width": 52, "height": 36}
    posed, unsized = {"pose": POSE, "lens": record}, {**record, "width": None}
    entries = [
        {**MODEL, "name": "a", "camera": posed},
        {**MODEL, "name": "b", "camera": posed, "size": [8, 9]},
        {**MODEL, "name": "c", "camera": {**posed, "lens": unsized}},
    ]
    for defaults, sizes in (
        ({}, [(52, 36), (8, 9), (320, 240)]),
        ({"size": [4, 5]}, [(4, 5), (8, 9), (4, 5)]),
    ):
        text = json.dumps({"version": 1, "defaults": defaults, "tasks": entries})
        (place / "lens.json").write_text(text)
        assert [task.size for task in read_manifest(place / "lens.json").tasks] == sizes


def test_writers_are_made_as_they_say(manifest):
    path = manifest(SCRIPT, dataset={"writer": "bop", "split": "val", "depth_scale": 2})
    assert read_manifest(path).writer.said()["split"] == "val"


POSE = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
INTRINSICS = {"fx": 1, "fy": 1, "cx": 1, "cy": 1}
WRONG = [
    ({}, "tasks[1]: a task needs a model or a script"),
    ({**MODEL, "modle": 1}, "tasks[1].modle: is none of antialiasing, arguments, camera"),
    ({**MODEL, "size": [0, 4]}, "tasks[1].size: width must be a whole number in 1..16384, not 0"),
    ({**MODEL, "seed": -1}, "tasks[1].seed: seed must be a whole number from 0 on: -1"),
    ({**MODEL, "samples": 3}, "tasks[1].samples: samples must be one of 1, 2, 4, 8, 16, not 3"),
    (
        {**MODEL, "camera": {"azimuth_degrees": "x"}},
        "tasks[1].camera.azimuth_degrees: azimuth_degrees must be a finite",
    ),
    ({**MODEL, "camera": {"pose": [1]}}, "tasks[1].camera.pose: pose must have shape (4, 4)"),
    (
        {**MODEL, "camera": {"position": [1, 2, 3], "azimuth_degrees": 3}},
        "tasks[1].camera.azimuth_degrees: azimuth_degrees is none of pos",
    ),
    (
        {**MODEL, "camera": {"position": [1, 2, 3], "height": 1, "yfov_degrees": 3}},
        "tasks[1].camera: yfov_degrees and height do not go together",
    ),
    (
        {**MODEL, "camera": {"elevation_degrees": 91}},
        "tasks[1].camera.elevation_degrees: elevation_degrees must be from -90",
    ),
    (
        {**MODEL, "camera": {"pose": POSE, "intrinsics": {**INTRINSICS, "fy": "x"}}},
        "tasks[1].camera.intrinsics.fy: fy must be a finite number, not 'x'",
    ),
    (
        {**MODEL, "matrix": {"camera": [{}, {"yfov_degrees": 200}]}},
        "tasks[1].matrix.camera[1].yfov_degrees: yfov_degrees must be between 0 and 180",
    ),
    ({**MODEL, "camera": True}, "tasks[1].camera: camera must be a number or an object, not True"),
    ({**MODEL, "render": {"mode": "lti"}}, "tasks[1].render.mode: mode must be one of 'lit'"),
    ({**MODEL, "render": {"outputs": ["color"]}}, "tasks[1].render.outputs: outputs is none of al"),
    ({**MODEL, "scene": {"ambient": 3}}, "tasks[1].scene.ambient: "),
    ({**MODEL, "outputs": ["depth.tga"]}, "tasks[1].outputs[0]: the format of depth must"),
    ({**MODEL, "outputs": ["depth.flo"]}, "tasks[1].outputs[0]: depth: .flo holds floats of 2 ch"),
    ({**MODEL, "outputs": ["disparity"]}, "tasks[1].outputs[0]: outputs must be one of 'color'"),
    ({**MODEL, "outputs": "color"}, "outputs must be a list of texts"),
    ({**MODEL, "outputs": ["color", "color.jpg"]}, "outputs must name some outputs, none twice"),
    (
        {**MODEL, "name": "FIRST"},
        "names that are one on Windows and macOS, 'first' and",
    ),
    (
        {**MODEL, "name": "aux.1"},
        "tasks[1].name: name must name files of every system: 'aux",
    ),
    ({**MODEL, "name": "../up"}, "tasks[1].name: name must be made of letters"),
    ({**MODEL, "name": "a/.b"}, "tasks[1].name: name must be made of letters"),
    ({**MODEL, "name": 4}, "tasks[1].name: 4 is not a text"),
    (
        {**MODEL, "name": "{kind}"},
        "tasks[1].name: {kind} stands for nothing: known are size",
    ),
    ({**MODEL, "name": "first"}, "tasks[1]: two tasks have the name 'first', the other is of task"),
    ({**SCRIPT, "look": "plain"}, "tasks[1]: look does not go with script"),
    ({**MODEL, "look": "nice"}, "tasks[1].look: look must be one of None, 'studio', 'plain'"),
    (
        {**MODEL, "look": "plain", "outputs": ["depth"], "camera": {"position": [1, 2, 3]}},
        "tasks[1]: look does not go with the output depth, camera: position",
    ),
    ({**SCRIPT, "arguments": [1]}, "tasks[1].arguments: arguments must be an object"),
    ({**SCRIPT, "function": "a b"}, "tasks[1].function: function must be a name"),
    ({"model": ""}, "tasks[1].model: model must be a text"),
    ({**MODEL, "inputs": [3]}, "tasks[1].inputs[0]: inputs must be a text, not 3"),
    ({**MODEL, "matrix": {"seed": []}}, "tasks[1].matrix.seed: holds no values"),
    ({**MODEL, "matrix": {"seed": [1, -2]}}, "tasks[1].matrix.seed[1]: seed must be"),
    ({**MODEL, "matrix": {"seed": {"count": 0}}}, "tasks[1].matrix.seed.count: 0 is not a whole"),
    ({**MODEL, "matrix": {"seed": {"count": 10**8}}}, "tasks[1].matrix.seed.count: 100000000"),
    ({**MODEL, "matrix": {"seed": {"to": 3}}}, "tasks[1].matrix.seed.to: is none of count, from"),
    ({**MODEL, "matrix": {"name": ["a"]}}, "tasks[1].matrix.name: is no key whose values may be"),
    ({**MODEL, "matrix": [1]}, "tasks[1].matrix: [1] is not an object"),
    (
        {**MODEL, "matrix": {"seed": {"count": 10**6}, "size": [[k, 1] for k in range(1, 20)]}},
        "tasks[1].matrix: these are 19,000,000 tasks; a manifest has up to 10,000,000",
    ),
    ([], "tasks[1]: [] is not an object"),
]


@pytest.mark.parametrize(("task", "message"), WRONG)
def test_errors_name_the_place(manifest, task, message):
    path = manifest({**MODEL, "name": "first"}, task)
    with pytest.raises(e3d.FileFormatError) as caught:
        read_manifest(path)
    assert str(caught.value).startswith(f"{path}: ") and message in str(caught.value)


@pytest.mark.parametrize(
    ("whole", "message"),
    [
        ({"version": 2}, "version: 2 is not 1, the only version of manifests"),
        ({"version": True}, "version: True is not 1"),
        ({"tasks": []}, "tasks: there are no tasks"),
        ({"tasks": 3}, "tasks: 3 is not"),
        ({"task": []}, "task: is none of dataset, defaults, tasks, version"),
        ({"defaults": {"name": "x"}}, "defaults.name: is none of"),
        ({"defaults": {"seed": "x"}}, "defaults.seed: seed must be"),
        ({"dataset": {"writer": "voc"}}, "dataset.writer: voc' is not one of bop, coco, folders"),
        ({"dataset": {}}, "dataset: 'writer' is missing"),
        ({"dataset": {"writer": "coco", "shard": 3}}, "dataset.shard: is none of baseline, cat"),
        ({"dataset": {"writer": "webdataset", "shard": 0}}, "dataset.shard: shard must be a whole"),
        (
            {"dataset": {"writer": "coco"}, "defaults": {"outputs": ["color"]}},
            "defaults.outputs: a data set's writer says what is written: see dataset.outputs",
        ),
    ],
)
def test_errors_of_the_whole(manifest, whole, message):
    path = manifest(MODEL, **whole)
    with pytest.raises(e3d.FileFormatError) as caught:
        read_manifest(path)
    assert message in str(caught.value).replace("'voc", "voc")


def test_what_is_no_json_names_the_line(place):
    path = place / "manifest.json"
    path.write_text('{"version": 1,\n "tasks": [}')
    with pytest.raises(e3d.FileFormatError, match=r"manifest\.json:2: not JSON"):
        read_manifest(path)
    path.write_text('{"version": 1, "tasks": [{"model": "a.obj", "model": "b.obj"}]}')
    with pytest.raises(e3d.FileFormatError, match="an object has 'model' twice"):
        read_manifest(path)
    with pytest.raises(e3d.FileAccessError):
        read_manifest(place / "none.json")


def test_tasks_in_python_are_checked_alike():
    with pytest.raises(e3d.InvalidArgumentError, match="seed must be"):
        Task(name="a", model="a.obj", seed=1.5)
    with pytest.raises(e3d.InvalidArgumentError, match="a model or a script"):
        Task(name="a")
    with pytest.raises(e3d.InvalidArgumentError, match="arguments must be of JSON's types"):
        Task(name="a", script="a.py", arguments={"x": object()})


def test_tasks_are_known_by_all_that_they_say():
    from engine3d.apps.batch.plain import PlainWriter
    from engine3d.datasets import CocoWriter

    writer, base = PlainWriter(["color"]), Task(name="a", model="a.obj", folder="/a")
    others = [
        Task(name="a", model="a.obj", folder="/a", **{key: value})
        for key, value in (
            *(("seed", 1), ("size", (3, 4)), ("camera", 0), ("render", {"cull": "none"})),
            *(("scene", {"exposure": 1}), ("samples", 1), ("antialiasing", "ssaa"), ("index", 2)),
            ("look", "plain"),
            *(("script", "b.py"), ("arguments", {"a": 1}), ("function", "f"), ("inputs", ["x"])),
        )
    ]
    keys = {task.key(writer) for task in (base, *others)}
    keys |= {base.key(CocoWriter()), base.key(CocoWriter(["a"])), base.key(PlainWriter(["depth"]))}
    assert len(keys) == len(others) + 4
    assert Task(name="a", model="a.obj", folder="/b").key(writer) == base.key(writer)
    assert json.dumps(base.name) == '"a"'


PAGE = Path(__file__).parents[2] / "docs" / "batches.md"


def test_the_manifest_of_the_page_is_one(place):
    text = PAGE.read_text(encoding="utf-8")
    start = text.index("    {\n")
    path = place / "manifest.json"
    path.write_text(text[start : text.index("\n\n", start)])
    names = [task.name for task in read_manifest(path).tasks]
    assert len(names) == 101 and names[0] == "teapot" and names[100] == "boxes_99"


def test_the_commands_of_the_page_parse():
    lines = re.findall(r"^    engine3d (.*)$", PAGE.read_text(encoding="utf-8"), re.M)
    parsed = [make_parser().parse_args(line.split()) for line in lines]
    assert len(parsed) == 4 and all(args.command == "batch" for args in parsed)
    assert parsed[1].resume and parsed[2].scheduler.startswith("tcp://")
