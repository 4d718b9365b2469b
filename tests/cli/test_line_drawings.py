"""``engine3d render`` and ``engine3d sheet`` as lines: what they write and what they refuse."""

import pytest

import engine3d as e3d
from engine3d.apps.cli import main

pytestmark = [
    pytest.mark.usefixtures("no_screen"),
    pytest.mark.filterwarnings("ignore:.*stl files do not hold"),
]


@pytest.fixture(autouse=True)
def part(no_screen):
    e3d.save_mesh(e3d.cylinder(10.0, 30.0), "part.stl")


def test_render_draws_lines(tmp_path):
    assert main(["render", "part.stl", "-o", "new/a.svg", "--hidden"]) == 0
    text = (tmp_path / "new" / "a.svg").read_text("utf-8")
    assert 'id="view-outline"' in text and 'id="view-hidden-' in text
    assert 'width="338.667mm"' in text
    assert main(["render", "part.stl", "-o", "b.svg", "--size", "96x96"]) == 0
    assert 'width="25.4mm" height="25.4mm"' in (tmp_path / "b.svg").read_text("utf-8")


def test_render_draws_to_scale(tmp_path):
    arguments = ["render", "part.stl", "--camera-orthographic", "--scale", "2:1"]
    assert main([*arguments, "-o", "b.pdf", "--line-scale", "0.5"]) == 0
    assert (tmp_path / "b.pdf").read_bytes().startswith(b"%PDF")
    assert b"0.25 w" in (tmp_path / "b.pdf").read_bytes()


def test_several_models_are_drawn_one_by_one(tmp_path):
    e3d.save_mesh(e3d.box(), "other.stl")
    assert main(["render", "part.stl", "other.stl", "-o", "{model}.svg"]) == 0
    assert (tmp_path / "part.svg").exists() and (tmp_path / "other.svg").exists()


def test_sheet_draws_a_page(tmp_path, capsys):
    arguments = ["--page", "A4", "--section", "x", "--title", "Pin", "--unit", "cm"]
    assert main(["sheet", "part.stl", "-o", "c.svg", *arguments]) == 0
    text = (tmp_path / "c.svg").read_text("utf-8")
    assert 'width="297mm"' in text and "Scale 1:" in text and ">Pin<" in text
    assert "section x=50%" in text


def test_sheet_writes_to_standard_output(capfdbinary):
    assert main(["sheet", "part.stl", "-o", "-", "--vector", "--views", "front"]) == 0
    assert capfdbinary.readouterr().out.startswith(b"<?xml")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("render part.stl -o a.png --hidden", "--hidden goes with line drawings"),
        ("render part.stl -o a.svg --scale 1:x", "not like 1:2"),
        ("render part.stl -o a.svg --scale 1:2", "only a parallel projection"),
        ("render part.stl -o a.svg --reference b.png", "--reference compares pictures"),
        ("render part.stl -o a.svg --turntable 3", "an animation needs"),
        ("sheet part.stl -o a.png --page A4", "--page goes with line drawings"),
        ("sheet part.stl -o a.png --vector", "--vector goes with line drawings"),
        ("sheet part.stl -o a.svg --json", "--json goes with pictures"),
        ("sheet part.stl -o a.svg --size 90x90", "--size goes with pictures"),
        ("sheet part.stl -o a.svg --bar", "--scalar-coloring goes with pictures"),
        ("sheet part.stl part.stl -o a.svg", "one MODEL"),
        ("sheet part.stl -o a.svg --views frnt", "--views"),
        ("sheet part.stl -o a.svg --scale 99:1", "do not fit the page"),
        ("sheet part.stl -o a.jpg", ".png, .svg, .pdf"),
    ],
)
def test_impossible_options_are_refused(words, said, tmp_path, capsys):
    try:
        status = main(words.split())
    except SystemExit as error:
        status = error.code
    assert status in (1, 2)
    assert said in capsys.readouterr().err
    assert not list(tmp_path.glob("a.*"))
