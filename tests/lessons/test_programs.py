"""Each lesson runs by itself and draws the picture of its page, whatever the size."""

import os
import re
import runpy
import shutil
import subprocess
import sys
from fnmatch import fnmatch
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import engine3d
from engine3d.apps.learn.lesson_programs import Listing

ROOT = Path(__file__).resolve().parents[2]
LESSONS, COURSE = ROOT / "lessons", ROOT / "docs" / "course"
NAMES = runpy.run_path(str(COURSE / "make.py"))["lesson_names"]()
MAX_PICTURE_BYTES = 100_000


def run(name, monkeypatch, *arguments):
    """Run a lesson as a program, in this process."""
    monkeypatch.setattr(sys, "argv", [f"{name}.py", *arguments])
    monkeypatch.syspath_prepend(str(LESSONS))
    runpy.run_path(str(LESSONS / f"{name}.py"), run_name="__main__")


def test_lessons_are_numbered_from_1():
    assert [int(name[:2]) for name in NAMES] == list(range(1, len(NAMES) + 1))
    assert len(NAMES) >= 3


@pytest.mark.parametrize("name", NAMES)
def test_a_lesson_runs_by_itself_and_draws_its_picture(name, tmp_path, monkeypatch, capsys):
    run(name, monkeypatch, "--out", str(tmp_path / "new"))
    written = tmp_path / "new" / f"{name}.png"
    assert [path.name for path in tmp_path.rglob("*.png")] == [written.name]
    assert str(written) in capsys.readouterr().out
    kept = COURSE / "pictures" / written.name
    with Image.open(written) as new, Image.open(kept) as old:
        same = np.array_equal(np.asarray(new.convert("RGB")), np.asarray(old.convert("RGB")))
    assert same, f"look at it, then: python docs/course/make.py {name}"
    assert kept.stat().st_size < MAX_PICTURE_BYTES


def test_a_lesson_runs_from_anywhere(tmp_path):
    command = [sys.executable, LESSONS / "03_lines.py", "--size", "35x33"]
    done = subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, text=True)
    assert done.stdout == f"{Path('out', '03_lines.png')}: 6 steps\n"
    assert (tmp_path / "out" / "03_lines.png").exists()


def test_a_lesson_opens_a_window_if_asked(tmp_path, monkeypatch):
    shown = []
    monkeypatch.setattr(engine3d, "show", lambda picture, title: shown.append((picture, title)))
    run("02_points", monkeypatch, "--window", "--out", str(tmp_path))
    ((picture, title),) = shown
    with Image.open(tmp_path / "02_points.png") as written:
        assert np.array_equal(np.asarray(written), picture)
    assert title == "02_points"


@pytest.mark.parametrize("name", NAMES)
def test_a_lesson_draws_any_size(name, monkeypatch):
    monkeypatch.syspath_prepend(str(LESSONS))
    steps = runpy.run_path(str(LESSONS / f"{name}.py"))["steps"]
    drawn = list(steps(53, 32))
    assert len(drawn) >= 3
    for caption, *shown in drawn:
        assert str(caption) and shown
        pictures = [one for one in shown if not isinstance(one, Listing)]
        assert all(p.dtype == np.uint8 and p.shape[2:] == (3,) for p in pictures)
        assert all(one.lines for one in shown if isinstance(one, Listing))


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--model", "no.obj"], "No such file"),
        (["--size", "40"], "invalid size value"),
        (["--size", "0x20"], "invalid size value"),
        (["--size", "100000x100000"], "invalid size value"),
        (["--out", f"{__file__}/out"], "[WinError" if os.name == "nt" else "Not a directory"),
    ],
)
def test_what_is_wrong_is_told_in_a_line(arguments, said, monkeypatch, capsys):
    with pytest.raises(SystemExit) as left:
        run("02_points", monkeypatch, *arguments)
    assert said in f"{left.value}{capsys.readouterr().err}"


def test_lines_differ_as_often_as_their_pages_say(monkeypatch, capsys):
    run("03_lines", monkeypatch, "--compare")
    counts = re.findall(r" (\d+) +(\d+)$", capsys.readouterr().out, re.M)
    assert len(counts) == 4 and counts[2] == ("0", "0")
    for language in ("en", "fr"):
        page = (COURSE / language / "03_lines.md").read_text(encoding="utf-8")
        assert re.findall(r"^\| \D+ \| (\d+) \| (\d+) \|$", page, re.M) == counts


@pytest.mark.parametrize(
    ("name", "said"),
    [("05_triangles", "500 triangles: the same"), ("13_rotations", "equal, all 200")],
)
def test_ways_that_are_compared_are_equal(name, said, monkeypatch, capsys):
    run(name, monkeypatch, "--compare")
    assert said in capsys.readouterr().out


def test_lessons_use_models_of_the_wheel():
    pytest.importorskip("setuptools")
    left_out = runpy.run_path(str(ROOT / "setup.py"), run_name="rules")["SOURCE_ONLY"]
    texts = [(LESSONS / f"{name}.py").read_text(encoding="utf-8") for name in NAMES]
    models = set(re.findall(r'MODELS / "(.*?)"', "".join(texts)))
    assert len(models) >= 2
    for model in models:
        assert (ROOT / "data" / "models" / model).exists()
        assert not any(fnmatch(f"models/{model}", pattern) for pattern in left_out), model


def test_lessons_build_on_earlier_ones_only():
    for name in NAMES:
        text = (LESSONS / f"{name}.py").read_text(encoding="utf-8")
        used = re.findall(r'earlier\("(\w+)"\)', text)
        assert all(other in NAMES and other < name for other in used), name
        assert "import engine3d._" not in text and "from engine3d" not in text, name


def tutorial_pixels(x0, y0, x1, y1):
    """The pixels of the tutorial's Line(), each by a formula of its own.

    After i steps along the longer side, half of it and i times the shorter side have been added to
    the error; the steps sideways took it down to at most the longer side.
    """
    dx, dy = abs(x1 - x0), abs(y1 - y0)
    longer, shorter = max(dx, dy), min(dx, dy)
    way_x, way_y = (1 if x0 < x1 else -1), (1 if y0 < y1 else -1)
    for along in range(1, longer + 1):
        aside = -(-(longer // 2 + along * shorter) // longer) - 1
        aside = max(aside, 0)
        moved = (along, aside) if dx > dy else (aside, along)
        yield x0 + way_x * moved[0], y0 + way_y * moved[1]


def test_the_tutorial_line_is_the_one_of_the_document(monkeypatch):
    monkeypatch.syspath_prepend(str(LESSONS))
    lesson = runpy.run_path(str(LESSONS / "03_lines.py"))
    small = [(0, 0, x, y) for x in range(-4, 5) for y in range(-4, 5)]
    for ends in (*small, *lesson["random_lines"](2000)):
        assert lesson["tutorial_line"](*ends) == list(tutorial_pixels(*ends)), ends


@pytest.mark.skipif(shutil.which("cc") is None, reason="needs a C compiler")
def test_the_tutorial_line_in_c_is_the_one_in_python(tmp_path, monkeypatch):
    """C counts as many pixels of the same lines, and puts them where Python does."""
    monkeypatch.syspath_prepend(str(LESSONS))
    lesson = runpy.run_path(str(LESSONS / "03_lines.py"))
    source = (LESSONS / "03_lines.c").read_text().partition("int main(void)")[0]
    lines = lesson["random_lines"](200)
    rows = ", ".join(f"{{{', '.join(map(str, ends))}}}" for ends in lines)
    source += f"""int main(void)
{{
    static const int ends[][4] = {{{rows}}};
    for (int i = 0; i < {len(lines)}; i++)
        tutorial_line(ends[i][0], ends[i][1], ends[i][2], ends[i][3]);
    fwrite(picture, 1, sizeof picture, stdout);
    return 0;
}}
"""
    (tmp_path / "lines.c").write_text(source)
    program = tmp_path / "lines"
    subprocess.run(["cc", "-w", "-o", program, tmp_path / "lines.c", "-lm"], check=True)
    drawn = np.frombuffer(subprocess.check_output([program]), np.uint8).reshape(1024, 1036)
    expected = np.zeros_like(drawn)
    for ends in lines:
        for x, y in lesson["tutorial_line"](*ends):
            expected[y, x] += 1
    assert np.array_equal(drawn, expected)


@pytest.mark.parametrize("side", [0.37, 0.9, 40.0])
def test_a_model_is_cut_into_chunks_of_any_size(side, monkeypatch):
    monkeypatch.syspath_prepend(str(LESSONS))
    lesson = runpy.run_path(str(LESSONS / "21_frustum.py"))
    model = str(ROOT / "data" / "models" / "teapot.obj")
    *steps, (told, _) = lesson["steps"](64, 48, model=model, chunk=side)
    mesh, scale = lesson["load"](model)
    chunks = lesson["cut"](mesh, side * scale)
    assert str(told) == f"cut into {len(chunks)} chunks of {side:g} x {side:g}, a colour each"
    assert sum(len(part.faces) for part, _, _ in chunks) == len(mesh.faces)
    corners = np.concatenate([part.positions[part.faces] for part, _, _ in chunks])
    assert {c.tobytes() for c in corners} == {c.tobytes() for c in mesh.positions[mesh.faces]}
    for part, _, _ in chunks:
        middles = part.positions[part.faces].mean(axis=1, dtype=np.float64)[:, ::2]
        assert len(np.unique(middles // (side * scale), axis=0)) == 1
    captions = [str(caption) for caption, *_ in steps]
    assert all("no pixel lost" in caption for caption in captions if "p-vertex" in caption)


def test_the_town_is_cut_into_chunks_of_any_size(monkeypatch):
    monkeypatch.syspath_prepend(str(LESSONS))
    lesson = runpy.run_path(str(LESSONS / "21_frustum.py"))
    *_, (told, _) = lesson["steps"](64, 48, chunk=3.0)
    assert str(told).endswith(" chunks of 3 x 3, a colour each")


def test_chunks_that_are_too_small_are_told(monkeypatch):
    monkeypatch.syspath_prepend(str(LESSONS))
    lesson = runpy.run_path(str(LESSONS / "21_frustum.py"))
    monkeypatch.setitem(lesson["cut"].__globals__, "MOST_CHUNKS", 99)
    with pytest.raises(engine3d.InvalidArgumentError, match="more than 99 chunks: take larger"):
        lesson["cut"](engine3d.icosphere(subdivisions=3), 1e-9)
    with pytest.raises(SystemExit):
        run("21_frustum", monkeypatch, "--chunk", "-1")
