"""Options that inspect: sections, parts taken apart, dimensions, measures."""

import json

import numpy as np
import pytest
from cli.conftest import pixels

import engine3d as e3d
from engine3d.apps.cli import main

pytestmark = pytest.mark.usefixtures("no_screen")


@pytest.fixture
def part(tmp_path):
    """Two boxes, as pieces of one mesh."""
    poses = [e3d.linalg.translation((x, 0, 0)) for x in (-1, 1)]
    path = tmp_path / "part.stl"
    e3d.Mesh.concatenate([e3d.box(), e3d.box()], poses=poses).save(path)
    return path


def drawn(part, *options):
    path = part.with_name("out.png")
    arguments = ["--size", "160x120", "--camera-direction=0,0,-1", "--up=+Y", "-o", str(path)]
    assert main(["render", str(part), *arguments, *options]) == 0
    return pixels(path)


def test_render_cuts_and_closes(part):
    picture = drawn(part, "--section", "z=0", "--mode", "unlit")
    hatched = picture[:, :, 0].astype(int) > picture[:, :, 2].astype(int) + 60
    assert hatched.sum() > 2000


def test_render_takes_apart(part):
    def gap(picture):
        columns = np.flatnonzero((picture[..., 3] > 0).any(axis=0))
        return np.diff(columns).max()

    together, apart = (
        drawn(part, "--no-background"),
        drawn(part, "--no-background", "--explode", "1"),
    )
    assert gap(apart) > 1.6 * gap(together) > 30  # both fill the picture


def test_dimensions_and_measures_are_drawn_and_printed(part, capsys):
    before = drawn(part)
    given = ["--measure", "distance=0,0,0/3,4,0", "--measure", "surface"]
    marked = drawn(part, "--dimensions", *given)
    assert (marked != before).any(axis=2).sum() > 500
    told = capsys.readouterr().err.splitlines()
    assert told == ["engine3d: distance 5", "engine3d: area 12, volume 2"]


def test_a_section_that_cuts_nothing_is_told(part, capsys):
    drawn(part, "--section", "x=9")
    assert "section x=9 cuts nothing: x is -1.5 to 1.5" in capsys.readouterr().err


def test_an_open_cut_is_told(tmp_path, capsys):
    path = tmp_path / "sheet.obj"
    e3d.plane(1.0).save(path)
    drawn(path, "--section", "x")
    assert "the cut of" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--section", "w=1"], "--section: 'w=1' is not like"),
        (["--measure", "angle=0,0,0/1,0,0"], "angle takes 3 points"),
        (["--measure", "distnce=0,0,0/1,0,0"], "did you mean distance?"),
        (["--explode", "-1"], "zero or more"),
        (["--explode", "1", "--animation", "3"], "not with --animation"),
    ],
)
def test_wrong_options_are_told(part, capsys, options, told):
    assert main(["render", str(part), "-o", str(part.with_name("o.webp")), *options]) == 2
    assert told in capsys.readouterr().err


def test_line_drawings_have_no_dimensions(part, capsys):
    path = part.with_name("o.svg")
    assert main(["render", str(part), "-o", str(path), "--dimensions"]) == 2
    assert "--dimensions" in capsys.readouterr().err


def test_a_sheet_of_parts_taken_apart(part, capsys):
    report = part.with_name("out.json")
    arguments = [
        "--report",
        str(report),
        "--views",
        "front",
        "--unit",
        "mm",
        "--measure",
        "surface",
    ]
    assert main(["sheet", str(part), *arguments, "--explode", "1"]) == 0
    model = json.loads(report.read_text())["models"][0]
    assert model["bounds"]["size"] == pytest.approx([5.0, 1.0, 1.0])
    assert [node["name"] for node in model["nodes"]] == ["piece 1", "piece 2"]
    assert "area 12 mm², volume 2 mm³" in capsys.readouterr().err
