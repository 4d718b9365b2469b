"""``engine3d sheet``: files it writes, and what it refuses."""

import json

import numpy as np
import pytest
from cli.conftest import pixels

import engine3d as e3d
from engine3d.apps.cli import main

pytestmark = pytest.mark.usefixtures("no_screen")
SMALL = ("--size", "360x280", "--threads", "1")


def test_a_picture_with_its_report_beside_it(model, tmp_path, capsys):
    assert main(["sheet", str(model), "-o", "out.png", "--json", *SMALL]) == 0
    assert capsys.readouterr() == ("", "")
    assert pixels(tmp_path / "out.png").shape == (280, 360, 4)
    report = json.loads((tmp_path / "out.json").read_text())
    assert [view["name"] for view in report["models"][0]["views"]] == [
        *("top", "iso", "front", "right")
    ]
    assert report["models"][0]["bounds"]["high"] == [1.0, 1.0, 0.0]


def test_views_sections_and_units(model, tmp_path):
    options = ["--views", "front,a=1,2,3", "--section", "-x=50%", "--section", "y", "--unit", "mm"]
    assert main(["sheet", "square.obj", "-o", "out.png", "--json", *options, *SMALL]) == 0
    (told,) = json.loads((tmp_path / "out.json").read_text())["models"]
    names = [view["name"] for view in told["views"]]
    cuts = [f"{kind} {cut}" for cut in ("-x=50%", "y=50%") for kind in ("section", "cutaway")]
    assert names == ["front", "a", *cuts]
    assert told["unit"] == "mm"


def test_several_models_stand_one_below_another(model, tmp_path):
    (tmp_path / "other.obj").write_text(model.read_text())
    arguments = ["square.obj", "-o", "out.png", "other.obj", "--views", "front,iso"]
    assert main(["sheet", *arguments, *SMALL]) == 0
    assert pixels(tmp_path / "out.png").shape == (560, 360, 4)
    assert not (tmp_path / "out.json").exists()


def test_looks_colours_and_numbers_are_those_of_python(tmp_path):
    ball = e3d.uv_sphere(0.5, (12, 6))
    ball.save("ball.ply")
    rows = {
        ("--look", "plain"): {"look": "plain"},
        ("--color", "red"): {"material": e3d.Material(color="red")},
        ("--coloring-array", "y", "--range", "-1,1", "-b"): {
            "color_by": "y",
            "clim": (-1, 1),
            "bar": True,
        },
        ("-s", "--axes-grid"): {"colormap": "viridis", "axes_grid": True},
        ("--colormap", "gray", "-y", "0", "--coloring-array", "normals"): {
            "color_by": "normals",
            "colormap": "gray",
            "component": 0,
        },
    }
    for options, keywords in rows.items():
        arguments = ["ball.ply", "-o", "out.png", "--views", "front,iso", *options]
        assert main(["sheet", *arguments, *SMALL]) == 0
        sheet = e3d.sheets.contact_sheet("ball.ply", views="front,iso", size=(360, 280), **keywords)
        assert np.array_equal(pixels(tmp_path / "out.png"), np.asarray(sheet))


def test_a_report_without_a_picture(model, tmp_path, capfd):
    assert main(["sheet", "square.obj", "--report", "-", "--up", "-z", *SMALL]) == 0
    assert json.loads(capfd.readouterr().out)["models"][0]["up"] == "-Z"
    assert main(["sheet", "square.obj", "--report", "r.json", *SMALL]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["r.json", "square.obj"]


def test_a_picture_on_standard_output(model, tmp_path, capfdbinary):
    assert main(["sheet", "square.obj", "-o", "-", "--report", "r.json", *SMALL]) == 0
    assert capfdbinary.readouterr().out.startswith(b"\x89PNG")
    assert (tmp_path / "r.json").exists()


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        ([], "say where to write"),
        (["-o", "out.jpg"], ".png"),
        (["-o", "out.png", "--json", "--report", "r.json"], "--json does not go"),
        (["--report", "r.json", "--json"], "--json does not go"),
        (["-o", "-", "--json"], "--json goes with -o FILE"),
        (["-o", "-", "--report", "-"], "not both"),
        (["-o", "out.png", "--views", "fronts"], "--views: 'fronts'"),
        (["-o", "out.png", "--views", ""], "--views: a sheet has 1 to 24, not 0"),
        (["-o", "out.png", "--section", "w=1"], "--section: 'w=1'"),
        (["-o", "out.png", "--size", "40"], "40"),
        (["--report", "square.obj"], "is the model"),
    ],
)
def test_wrong_usage(model, tmp_path, capsys, arguments, part):
    before = model.read_text()
    assert main(["sheet", "square.obj", *arguments]) == 2
    assert part in capsys.readouterr().err
    assert model.read_text() == before
    assert [path.name for path in tmp_path.iterdir()] == ["square.obj"]


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["missing.obj", "-o", "out.png"], "missing.obj"),
        (["broken.obj", "-o", "out.png"], "broken.obj:2: "),
        (["square.obj", "-o", "square.obj/out.png"], "square.obj/out.png"),
        (["square.obj", "-o", "out.png", "--report", "square.obj/r.json"], "square.obj/r.json"),
        (["square.obj", "-o", "out.png", "--views", "camera0"], "square.obj has no camera 0"),
        (["square.obj", "-o", "out.png", "--size", "100x80"], "size: "),
    ],
)
def test_what_cannot_be_drawn_is_one_line_and_status_1(model, tmp_path, capsys, arguments, part):
    (tmp_path / "broken.obj").write_text("v 0 0 0\nf 1 2 9\n")
    assert main(["sheet", *arguments]) == 1
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("engine3d: error: ") and err.count("\n") == 1
    assert part in err
    assert not (tmp_path / "out.png").exists()
