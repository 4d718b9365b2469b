"""Options that stand in files, and -D."""

import json
import sys

import pytest

from engine3d.apps.cli import main
from engine3d.apps.cli.parser import parse

MODEL = "part.stl"


@pytest.fixture
def own(tmp_path, monkeypatch):
    """Write the user's own file."""
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))

    def write(*entries):
        path = tmp_path / "engine3d" / "config.json"
        path.parent.mkdir(exist_ok=True)
        path.write_text(json.dumps(entries))
        return path

    return write


def parsed(*options, command="render"):
    return parse([command, MODEL, *options])


def test_options_of_the_users_own_file(own):
    own(
        {"options": {"look": "plain", "grid": True, "size": "64x48", "samples": 4}},
        {"files": "*.STL", "options": {"up": "+X", "wireframe": True, "normals": "flat"}},
        {"files": ["*.ply", "other/*"], "options": {"up": "-Z"}},
        {"options": {"background-gradient": ["white", "black"], "background-color": [1, 2, 3]}},
    )
    args = parsed()
    assert (args.look, args.grid, args.size, args.samples) == ("plain", True, (64, 48), 4)
    assert (args.up, args.wireframe, args.normals) == ("+X", "only", "flat")
    assert args.background_gradient == [(255, 255, 255), (0, 0, 0)]
    assert args.background_color == (1, 2, 3)
    assert parse(["render", "other/a.ply"]).up == "-Z"
    assert parsed("--no-config").up is None
    args = parsed(
        "--normals", "smooth", "--look", "studio", "-D", "grid=false", "-D", "wireframe=overlay"
    )
    assert (args.normals, args.look, args.grid) == ("smooth", "studio", False)
    assert args.wireframe == "overlay"


def test_what_is_said_later_counts(own):
    own(
        {"options": {"background-color": "red", "fog": [1, 2], "light-position": [1, 2, 3]}},
        {"files": "*.stl", "options": {"background-gradient": ["white", "black"]}},
    )
    args = parsed("-D", "fog-density=0.5", "--light-direction", "1,0,0")
    assert args.background_color is None and args.background_gradient is not None
    assert (args.fog, args.fog_density) == (None, 0.5)
    assert (args.light_position, args.light_direction) == (None, (1.0, 0.0, 0.0))
    args = parsed("--background-color", "blue")
    assert (args.background_color, args.background_gradient) == ((0, 0, 255), None)
    assert args.fog == (1.0, 2.0)


def test_options_of_models_are_no_matter_of_built_in_scenes(own):
    own({"options": {"crease-angle": 20, "grid": True}})
    args = parse(["render", "--scene", "cube"])
    assert (args.crease_angle, args.grid) == (None, True)
    assert parsed().crease_angle is not None


def test_options_that_other_commands_have_are_passed_over(own):
    own({"options": {"vsync": False, "no-background": True}})
    assert parsed(command="run").vsync is False
    assert parsed("--vsync", command="run").vsync is True
    assert parsed().no_background is True


def test_each_of_several_files_has_its_own(own, tmp_path):
    from engine3d.apps.cli.options.input_options import jobs

    own({"files": "a.*", "options": {"axis": True}})
    found = jobs(parse(["render", "a.obj", "b.obj", "-o", "{model}.png"]))
    assert [job.axis for job in found] == [True, False]
    assert jobs(parse(["render", "a.obj", "b.obj", "-o", "c.png"]))[0].axis is True


@pytest.mark.parametrize(
    ("entries", "told"),
    [
        ([{"options": {"girds": True}}], "[0].options.girds: there is no such option"),
        ([{}, {}], '[0]: an object with "options" is needed'),
        ([{"options": {}, "match": "x"}], "[0].match: there is no such key"),
        ([{"options": {}, "files": 3}], "[0].files: a pattern or a list of patterns is needed"),
        ([{"options": {"look": "odd"}}], "[0].options.look: 'odd' is not one of studio, plain"),
        (
            [{"options": {"size": [1]}}],
            "[0].options.size: '1' is not WIDTHxHEIGHT, such as 1280x720",
        ),
        ([{"options": {"size": True}}], "[0].options.size: true is no value of it"),
        ([{"options": {"grid": 1}}], "[0].options.grid: 1 is no value of it"),
        ([{"options": {"up": None}}], "a text, a number or a list of them is needed"),
        ([{"options": {"background-gradient": "red"}}], "2 values are needed"),
        ([{"options": {"config": "x"}}], "[0].options.config: there is no such option"),
    ],
)
def test_what_a_file_may_not_say(own, capsys, entries, told):
    path = own(*entries)
    assert main(["render", MODEL, "-o", "a.png"]) == 1
    error = capsys.readouterr().err
    assert error.startswith(f"engine3d: error: {path}: ") and told in error
    assert error.count("\n") == 1


def test_files_that_cannot_be_read(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for content, told in [
        (None, "a.json: cannot read: No such file or directory"),
        (b'[\n{"options"]', "a.json:2: not JSON"),
        (b"{}", "a.json: a list of entries is needed"),
        (b"\xff", "a.json: not JSON"),
        (b"[" * 100_000, "a.json: not read: its JSON is nested too deeply"),
        (b" " * (1 << 21), "a.json: not read: larger than 1048576 bytes"),
    ]:
        if content is not None:
            (tmp_path / "a.json").write_bytes(content)
        assert main(["render", MODEL, "--config", "a.json", "-o", "a.png"]) == 1
        assert told in capsys.readouterr().err


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("grid", "NAME=VALUE is needed"),
        ("gird=true", "there is no option 'gird': did you mean grid?"),
        ("nonsense=1", "there is no option 'nonsense' (engine3d render --help-all lists them)\n"),
        ("samples=3", "is not one of 1, 2, 4, 8, 16"),
    ],
)
def test_what_is_defined_wrong(capsys, given, told):
    assert main(["render", MODEL, "-D", given, "-o", "a.png"]) == 2
    assert told in capsys.readouterr().err
