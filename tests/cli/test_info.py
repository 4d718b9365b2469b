"""``engine3d info``: what it prints of a file."""

import json
import sys

import pytest
from cli.conftest import OBJ

from engine3d.apps.cli import main

pytestmark = pytest.mark.usefixtures("no_screen")


def test_info(model, capsys):
    assert main(["info", str(model)]) == 0
    text = capsys.readouterr().out
    assert "square.obj" in text and "vertices" in text and "bounds" in text
    assert main(["info", str(model), "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["counts"]["vertices"] == 4
    assert report["bounds"][1] == [1.0, 1.0, 0.0]
    assert report["warnings"] == []
    assert [item["faces"] for item in report["objects"]] == [2]


def test_info_counts_the_points_that_are_drawn(tmp_path, capsys):
    path = tmp_path / "cloud.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n")
    assert main(["info", str(path)]) == 0
    assert "object cloud: 3 vertices, 0 faces, 3 points\n" in capsys.readouterr().out


@pytest.mark.skipif(sys.platform == "win32", reason="names of Windows hold no line feeds")
def test_info_shows_names_that_would_steer_the_terminal(tmp_path, capsys):
    path = tmp_path / "a\nb.obj"
    path.write_text("o \x1b[31mred\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert main(["info", str(path)]) == 0
    printed = capsys.readouterr().out
    assert "a\\nb.obj: obj\n" in printed
    assert "object \\x1b[31mred: 3 vertices" in printed
    assert "\x1b" not in printed


def test_info_of_a_file_that_is_no_model(tmp_path, capsys):
    (tmp_path / "a.obj").write_text("v 1 2\n")
    assert main(["info", "a.obj"]) == 1
    assert "a.obj:1: " in capsys.readouterr().err


def test_info_lists_warnings(tmp_path, capsys):
    (tmp_path / "a.obj").write_text("mtllib none.mtl\n" + OBJ)
    assert main(["info", "a.obj", "--json"]) == 0
    out, err = capsys.readouterr()
    (warning,) = json.loads(out)["warnings"]
    assert "none.mtl" in warning
    assert err == ""
