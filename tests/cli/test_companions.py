"""The image beside a model that bears its name: what commands take, say, and never take."""

import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

from engine3d.apps.cli import main

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n"
OPTIONS = ("--size", "48x32", "--unlit")
GREY, BLUE, RED = [172, 169, 164], [10, 30, 200], [200, 30, 10]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "head.obj").write_text(SQUARE)
    return tmp_path


def paint(name, color=BLUE):
    Image.new("RGB", (4, 4), tuple(color)).save(name)


def draw(output="out.png", *arguments):
    assert main(["render", "head.obj", *OPTIONS, *arguments, "-o", output]) == 0
    with Image.open(output) as image:
        return np.asarray(image.convert("RGB"))


def middle(*arguments):
    return draw("out.png", *arguments)[16, 24].tolist()


@pytest.mark.parametrize("suffix", ["png", "jpg", "jpeg", "webp", "tga"])
def test_pictures_that_bear_the_models_name_are_all_the_same(suffix, capsys):
    pictures = [draw(f"head.{suffix}") for _ in range(3)]
    assert capsys.readouterr().err == ""
    assert np.array_equal(pictures[0], pictures[1])
    assert np.array_equal(pictures[0], pictures[2])
    assert middle() == GREY
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("name", ["head_diffuse.png", "head_texture.tga", "head.tga"])
def test_the_output_is_no_companion_but_the_next_one_is(name):
    paint("head_basecolor.png")
    first = draw(name)
    assert first[16, 24].tolist() == BLUE
    assert np.array_equal(draw(name), first)


def test_standard_output_is_no_companion():
    command = [sys.executable, "-m", "engine3d", "render", "head.obj", *OPTIONS, "-o", "-"]
    written = []
    for _ in range(2):
        with open("head_diffuse.png", "wb") as file:
            done = subprocess.run(command, stdout=file, stderr=subprocess.PIPE, timeout=60)
        assert (done.returncode, done.stderr) == (0, b"")
        with open("head_diffuse.png", "rb") as file:
            written.append(file.read())
    assert written[0] == written[1]


@pytest.mark.parametrize("name", ["head.tga", "head_diffuse.tga", "head_texture.png"])
def test_a_companion_is_taken_and_told(name, capsys):
    paint(name)
    assert middle() == BLUE
    said = f"engine3d: warning: head.obj: no materials: {name!r} beside the model is taken as its "
    assert capsys.readouterr().err == said + "texture, for its name\n"


@pytest.mark.parametrize("output", ["a.obj", "a.ply"])
def test_a_conversion_says_which_companion_it_took(output, capsys):
    paint("head.tga")
    assert main(["convert", "head.obj", output]) == 0
    assert "'head.tga' beside the model is taken" in capsys.readouterr().err


@pytest.mark.parametrize("text", [SQUARE, "usemtl skin\n" + SQUARE, "mtllib no.mtl\n" + SQUARE])
def test_what_is_asked_for_wins_over_a_companion(folder, text, capsys):
    (folder / "head.obj").write_text(text)
    paint("head.tga")
    paint("red.png", RED)
    assert middle("--texture", "red.png") == RED
    assert middle("--color", "200,30,10") == RED
    err = capsys.readouterr().err
    assert "is taken" not in err and "materials of its own" not in err


def test_a_texture_that_is_not_there_is_an_error_for_every_model(folder, capsys):
    (folder / "blue.mtl").write_text("newmtl blue\nKd 0 0 1\n")
    for text in (SQUARE, "mtllib blue.mtl\nusemtl blue\n" + SQUARE):
        (folder / "head.obj").write_text(text)
        paint("head.tga")
        for command in ("render", "run"):
            options = ["--headless", "--frames", "1"] if command == "run" else []
            texture = ["--texture", "no.png", "-o", "out.png"]
            assert main([command, "head.obj", *OPTIONS, *options, *texture]) == 1
            assert "engine3d: error: no.png: cannot read: " in capsys.readouterr().err


def test_a_texture_without_coordinates_to_show_it_is_warned_of(folder, capsys):
    (folder / "head.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n")
    paint("red.png", RED)
    assert main(["render", "head.obj", "--texture", "red.png", *OPTIONS, "-o", "out.png"]) == 0
    assert "no texture coordinates: the texture does not show" in capsys.readouterr().err


@pytest.mark.parametrize("format", ["obj", "off", "stl", "ply"])
def test_an_unreadable_companion_is_left_out(folder, format, capsys):
    (folder / "head.off").write_text("STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n")
    (folder / "source.obj").write_text(SQUARE)
    if format in ("stl", "ply"):
        assert main(["convert", "source.obj", f"head.{format}"]) == 0
    (folder / "head.tga").write_bytes(b"no image")
    capsys.readouterr()
    for command in (["render"], ["run", "--headless", "--frames", "1"]):
        assert main([*command, f"head.{format}", *OPTIONS, "-o", "out.png"]) == 0
        err = capsys.readouterr().err
        # Nobody looks for a texture where there are no coordinates to show it.
        assert ("texture 'head.tga' beside the model left out" in err) == (format != "stl")
