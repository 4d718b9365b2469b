"""Several models on one command line."""

import json

import numpy as np
import pytest
from cli.conftest import OBJ
from PIL import Image

import engine3d as e3d
from engine3d.apps.cli import main

pytestmark = pytest.mark.usefixtures("no_screen")
SMALL = ("--size", "48x32")


def pixels(path):
    with Image.open(path) as image:
        return np.asarray(image.convert("RGBA"))


def test_several_models_are_drawn_together(model, tmp_path, capsys):
    other = tmp_path / "other.obj"
    other.write_text(OBJ.replace("v ", "v 2").replace("v 20 ", "v 2 ").replace("v 21 ", "v 3 "))
    options = [*SMALL, "--color", "red", "--unlit"]
    assert main(["render", str(model), str(other), *options, "-o", "two.png"]) == 0
    assert main(["render", str(model), "--unlit", *options, "-o", "mixed.png", str(other)]) == 0
    assert main(["render", str(model), *options, "-o", "one.png"]) == 0
    assert (pixels("two.png") == pixels("mixed.png")).all()
    assert (pixels("two.png") != pixels("one.png")).any()


def red(name):
    """The columns of a picture that show something red."""
    picture = pixels(name)[..., :3].astype(int)
    return ((picture[..., 0] > picture[..., 1] + 100).any(axis=0)).tolist()


def test_side_by_side_models_stand_apart(model, capsys):
    straight = ["--camera-azimuth-angle", "-30", "--camera-elevation-angle", "-18"]
    options = ["--size", "300x100", "--color", "red", "--unlit", *straight]
    command = ["render", str(model), str(model), *options, "-o"]
    assert main([*command, "same.png"]) == 0
    assert main([*command, "row.png", "--side-by-side"]) == 0
    for name, pieces in (("same.png", 1), ("row.png", 2)):
        columns = red(name)
        assert sum(b and not a for a, b in zip(columns, columns[1:], strict=False)) == pieces
    assert main(["render", str(model), *options, "-o", "a.png", "--side-by-side"]) == 2
    assert "--side-by-side needs several MODELs" in capsys.readouterr().err


def test_models_that_differ_in_size_or_up_are_warned_of(model, tmp_path, capsys):
    mesh = e3d.load_mesh(model)
    mesh.save(tmp_path / "square.stl")
    assert main(["render", str(model), "square.stl", *SMALL, "-o", "a.png"]) == 0
    assert "square.stl counts +Z as up, square.obj +Y" in capsys.readouterr().err
    assert main(["render", str(model), "square.stl", *SMALL, "-o", "a.png", "--up", "+Z"]) == 0
    assert capsys.readouterr().err == ""
    (tmp_path / "large.obj").write_text(OBJ.replace("1 ", "100 ").replace("f 100", "f 1"))
    command = ["render", str(model), "large.obj", *SMALL, "-o", "a.png"]
    assert main([*command, "--side-by-side"]) == 0
    assert "large.obj is more than 50 times as large as square.obj" in capsys.readouterr().err


def test_models_of_other_axes_stand_upright_side_by_side(tmp_path):
    from engine3d.stage.open_models import open_models

    box = e3d.box((1.0, 3.0, 2.0))
    box.save(tmp_path / "y.ply")
    turned = e3d.box((1.0, 2.0, 3.0))
    turned.save(tmp_path / "z.stl")
    viewed = open_models([tmp_path / "y.ply", tmp_path / "z.stl"], side_by_side=True)
    nodes = [node for node in viewed.scene.nodes if node.object is not None]
    for node in nodes:
        low, high = node.bounds
        np.testing.assert_allclose(high - low, (1, 3, 2), atol=1e-6)
        np.testing.assert_allclose((low[1], low[2]), (0, -1), atol=1e-6)
    np.testing.assert_allclose(nodes[1].bounds[0][0] - nodes[0].bounds[1][0], 0.15, atol=1e-6)


def test_info_of_several_files(model, capsys):
    assert main(["info", "--json", str(model), str(model)]) == 0
    reports = json.loads(capsys.readouterr().out)
    assert [report["file"] for report in reports] == [str(model)] * 2
    assert main(["info", str(model), "missing.obj", str(model)]) == 1
    said = capsys.readouterr()
    assert said.out.count(": obj\n") == 2
    assert said.err.startswith("engine3d: error: missing.obj: ") and said.err.count("\n") == 1


@pytest.mark.parametrize("command", ["render", "run", "info"])
def test_standard_input_is_read_once(command, capsys):
    assert main([command, "-", "-", *(["-o", "a.png"] if command == "render" else [])]) == 2
    assert "can be read only once" in capsys.readouterr().err
