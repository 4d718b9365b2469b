"""`engine3d diff`: reg-cli's options and exit statuses, on files of all kinds."""

import json
import os

import numpy as np
import pytest
from golden.samples import changed, colors, slope, write_png
from PIL import Image

from engine3d.apps.cli import main
from engine3d.apps.golden.reading import read_picture

PIXELS = colors(20, 30)


@pytest.fixture
def folders(tmp_path, monkeypatch):
    """Folders ``new`` and ``old``: a passed, a changed, a new and a deleted picture."""
    monkeypatch.chdir(tmp_path)
    other = changed(PIXELS, by=40)
    for name, pixels in (("same", PIXELS), ("sub/changed", other), ("added", PIXELS)):
        write_png(tmp_path / "new" / f"{name}.png", pixels)
    for name in ("same", "sub/changed", "gone"):
        write_png(tmp_path / "old" / f"{name}.png", PIXELS)
    (tmp_path / "new" / "notes.txt").write_text("not a picture")
    return tmp_path


def diff(*arguments):
    return main(["diff", *map(str, arguments)])


def test_folders(folders, capsys):
    largest = np.abs(changed(PIXELS, by=40).astype(int) - PIXELS).max()
    assert diff("new", "old") == 1
    assert capsys.readouterr().out.splitlines() == [
        "= passed  same.png",
        "+ new     added.png",
        "- deleted gone.png",
        "! changed sub/changed.png: 1 of 600 pixels differ by up to "
        f"{largest}, within (3, 2) to (3, 2)",
        "1 passed, 1 new, 1 deleted, 1 changed",
    ]
    assert sorted(path.name for path in folders.iterdir()) == ["new", "old"]


@pytest.fixture
def damaged(folders):
    """Of five pictures, one drawn and one expected are damaged, and one cannot be opened."""
    whole = (folders / "new/same.png").read_bytes()
    for name, drawn, expected in (
        ("drawn", whole[:60], whole),
        ("expected", whole, b"nothing"),
        ("other", whole, whole[:-20] + b"x" * 20),
    ):
        (folders / f"new/{name}.png").write_bytes(drawn)
        (folders / f"old/{name}.png").write_bytes(expected)
    return folders


def test_damaged_pictures_fail_and_the_others_are_compared(damaged, capsys):
    assert diff("new", "old", "-R", "r.html", "-J", "r.json", "--junit", "r.xml") == 1
    out, err = capsys.readouterr()
    lines = out.splitlines()
    assert err == "" and "= passed  same.png" in lines
    assert any(line.startswith("! changed sub/changed.png: ") for line in lines)
    drawn, old = os.path.join("new", "drawn.png"), os.path.join("old", "expected.png")
    assert lines[-4].startswith(f"? failed  drawn.png: {drawn}: damaged image: ")
    expected = f"? failed  expected.png: {old}: not an image of a known format"
    assert lines[-3] == expected
    assert lines[-1] == "1 passed, 1 new, 1 deleted, 1 changed, 3 failed"
    names = ["drawn.png", "expected.png", "other.png", "sub/changed.png"]
    assert json.loads((damaged / "r.json").read_text())["failedItems"] == names
    assert f'type="failed" message="{old}: not an' in (damaged / "r.xml").read_text()
    assert '<article class="card failed' in (damaged / "r.html").read_text()
    assert diff("-F", "r.json", "-R", "again.html") == 0
    assert diff("new", "old", "-I") == 1


def test_an_update_replaces_damaged_pictures_by_whole_ones_alone(damaged, capsys):
    before = (damaged / "old/drawn.png").read_bytes()
    assert diff("new", "old", "-U") == 1
    assert capsys.readouterr().out.endswith(", but for 1 that cannot be read\n")
    assert (damaged / "old/drawn.png").read_bytes() == before
    (damaged / "new/drawn.png").unlink()
    assert diff("new", "old") == 0


def test_what_is_a_failure(folders, capsys):
    assert diff("new", "old", "-I") == 0
    assert diff("new", "old", "-IE") == 0
    (folders / "new/sub/changed.png").write_bytes((folders / "old/sub/changed.png").read_bytes())
    assert diff("new", "old") == 0
    assert diff("new", "old", "-E") == 1
    capsys.readouterr()
    assert diff("new", "old", "-E", "-D", "ask the artist") == 1
    assert capsys.readouterr().out.endswith("\nask the artist\n")


def test_everything_that_is_written(folders, capsys):
    options = ("-R", "r/r.html", "-J", "made/too/r.json", "--junit", "made/r.xml", "-C", "2")
    assert diff("new", *options, "old", "out") == 1
    document = json.loads((folders / "made/too/r.json").read_text())
    assert document["failedItems"] == ["sub/changed.png"] and document["newItems"] == ["added.png"]
    assert document["deletedItems"] == ["gone.png"] and document["passedItems"] == ["same.png"]
    assert (document["actualDir"], document["diffDir"]) == ("new", "out")
    assert "sub/changed" in (folders / "made/r.xml").read_text()
    (difference,) = read_picture("out/sub/changed.png").frames
    assert difference.shape == (20, 30, 4)
    assert diff("-F", "made/too/r.json", "-R", "r2/again.html") == 0
    assert (folders / "r2/again.html").read_bytes() == (folders / "r/r.html").read_bytes()


def test_update(folders, capsys):
    same = (folders / "old/same.png").stat().st_mtime_ns
    assert diff("new", "old", "-U") == 0
    assert diff("new", "old", "-E") == 0
    assert not (folders / "old/gone.png").exists()
    assert (folders / "old/same.png").stat().st_mtime_ns == same


def test_two_pictures(folders, capsys):
    new, old = "new/sub/changed.png", "old/same.png"
    assert diff(new, old, "difference.png") == 1
    assert capsys.readouterr().out.startswith("! changed changed.png: 1 of 600")
    assert read_picture("difference.png").frames[0].shape == (20, 30, 4)
    assert diff(new, old, "-U") == 0 and diff(new, old) == 0


@pytest.mark.parametrize(
    ("options", "status"),
    [
        (["-S", "1"], 0),
        (["-S", "0"], 1),
        (["-T", "0.01"], 0),
        (["-T", "0.001"], 1),
        (["-T", "1", "-S", "0"], 1),
        (["-M", "0.9"], 0),
        (["-M", "0", "-A"], 1),
    ],
)
def test_what_may_differ(folders, capsys, options, status):
    assert diff("new/sub/changed.png", "old/same.png", *options) == status


def test_antialiasing_counts_unless_colors_are_matched(folders, capsys):
    write_png(folders / "a.png", slope(0.0))
    write_png(folders / "b.png", slope(0.3))
    assert diff("a.png", "b.png") == diff("a.png", "b.png", "-M", "0", "-A") == 1
    strict, counted = (line for line in capsys.readouterr().out.splitlines() if "of 600" in line)
    assert strict == counted
    assert diff("a.png", "b.png", "-M", "0") == 0


def test_flip(folders, capsys):
    pytest.importorskip("flip_evaluator", reason="needs flip-evaluator")
    assert diff("new/sub/changed.png", "old/same.png", "--flip", "0.2") == 0
    write_png(folders / "c.png", 255 - PIXELS)
    assert diff("c.png", "old/same.png", "--flip", "0.01") == 1
    assert "; mean FLIP error 0." in capsys.readouterr().out


def test_16_bits_and_sizes(folders, capsys):
    deep = colors(4, 4, 3, np.uint16)
    write_png(folders / "a.png", deep)
    write_png(folders / "b.png", changed(deep, 1, 1))  # by the lowest of 16 bits
    assert diff("a.png", "b.png") == 1
    assert "1 of 16 pixels differ by up to 1," in capsys.readouterr().out
    write_png(folders / "b.png", deep[:3])
    assert diff("a.png", "b.png", "-T", "1") == 1
    assert "it is 4x4 uint16 x 3, not 4x3 uint16 x 3" in capsys.readouterr().out


def test_other_files_of_the_same_picture_pass(folders, capsys):
    opaque = PIXELS.copy()
    opaque[..., 3] = 255
    Image.fromarray(opaque).save("a.png")
    Image.fromarray(opaque[..., :3]).save("b.bmp")
    Image.fromarray(opaque).save("c.webp", lossless=True)
    assert diff("a.png", "b.bmp") == diff("b.bmp", "c.webp") == diff("c.webp", "a.png") == 0


def test_animations_are_compared_frame_by_frame(folders, capsys):
    def animate(name, *colors_of_frames):
        first, *rest = (Image.new("RGB", (4, 4), color) for color in colors_of_frames)
        first.save(name, save_all=True, append_images=rest)

    animate("a.gif", "red", "lime", "blue")
    animate("b.gif", "red", "lime", "black")
    animate("c.gif", "red", "lime")
    assert diff("a.gif", "b.gif", "-J", "r.json", "-R", "r.html") == 1
    assert ": frame 2 of 3 (from 0): 16 of 16 pixels" in capsys.readouterr().out
    assert json.loads((folders / "r.json").read_text())["pictures"][0]["frame"] == 2
    assert diff("a.gif", "c.gif", "-S", "0") == 1
    assert ": it has 3 frames, not 2" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["new", "nowhere"], "nowhere: cannot read: No such file or directory"),
        (["new", "old/same.png"], "new: one is a folder and the other is none: old/same.png"),
        (["old/same.png", "new/notes.txt"], "new/notes.txt: not an image of a known format"),
        (["new", "old", "-R", "new/notes.txt/r"], "new/notes.txt/r: cannot write: "),
        (["-F", "new/notes.txt", "-R", "r.html"], "new/notes.txt:1: not JSON: "),
    ],
)
def test_errors_are_one_line_and_status_1(folders, capsys, arguments, message):
    assert diff(*arguments) == 1
    out, err = capsys.readouterr()
    assert out == "" and err.startswith(f"engine3d: error: {message}") and err.count("\n") == 1


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["new"],
        ["new", "old", "out", "more"],
        ["new", "old", "-T", "2"],
        ["new", "old", "-S", "-1"],
        ["new", "old", "-M", "x"],
        ["new", "old", "-J", "-"],
        ["-F", "r.json"],
        ["new", "old", "-F", "r.json", "-R", "r.html"],
    ],
)
def test_wrong_usage_is_status_2(folders, capsys, arguments):
    assert diff(*arguments) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1


@pytest.mark.skipif(os.name == "nt", reason="names of Windows hold no control characters")
def test_names_from_outside_cannot_steer_the_terminal(folders, capsys):
    write_png(folders / "new" / "\x1b[31mred.png", PIXELS)
    assert diff("new", "old", "-I") == 0
    assert "\\x1b[31mred.png" in capsys.readouterr().out


def test_no_pictures(folders, capsys):
    for name in ("a", "b"):
        (folders / name).mkdir()
    assert diff("a", "b") == 0
    assert capsys.readouterr().out == "no pictures\n"
