"""Several files and folders, one by one; names of outputs with variables; what is read, and how."""

import os
import sys
import time

import pytest
from cli.conftest import OBJ, SMALL, pixels

from engine3d.apps.cli import main
from engine3d.apps.cli.commands import render
from engine3d.apps.cli.output_templates import fill
from engine3d.apps.cli.parser import make_parser
from engine3d.apps.cli.usage import UsageError
from engine3d.io.output.frame_names import frame_name, literal_name

pytestmark = pytest.mark.usefixtures("no_screen")
NOT_ON_WINDOWS = pytest.mark.skipif(
    os.name == "nt", reason="dates hold any letter there, and names no colon"
)
FAST = [*SMALL, "--look", "plain"]


@pytest.fixture
def folder(tmp_path):
    """Two models, one of them broken, one below, and other files."""
    place = tmp_path / "models"
    (place / "below").mkdir(parents=True)
    (place / "b.obj").write_text(OBJ)
    (place / "A.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    (place / "below" / "c.obj").write_text(OBJ)
    (place / "notes.txt").write_text("none")
    (place / "data.json").write_text("{}")
    return place


def test_a_folder_is_drawn_one_by_one(folder, tmp_path, capsys):
    assert main(["render", str(folder), *FAST, "-o", "{model}-{model_ext}.png"]) == 0
    assert sorted(path.name for path in tmp_path.glob("*.png")) == ["A-off.png", "b-obj.png"]
    (folder / "bad.obj").write_text("v 1\n")
    assert main(["render", str(folder), *FAST, "-o", "x{n:2}.png", "--recursive-dir-add"]) == 1
    assert "bad.obj:1" in capsys.readouterr().err
    # The broken one has no picture; the numbers are given before anything is drawn.
    assert sorted(path.name for path in tmp_path.glob("x*.png")) == [
        "x01.png",
        "x02.png",
        "x04.png",
    ]


def test_files_are_drawn_together_unless_the_output_names_them(model, tmp_path):
    other = tmp_path / "other.obj"
    other.write_text(OBJ)
    both = ["render", str(model), str(other), *FAST, "-o"]
    assert main([*both, "all.png"]) == 0
    assert main([*both, "{model}_1.png"]) == 0
    assert main([*both, "{date:%Y}.png", "--multi-file-mode", "all"]) == 0
    names = {path.name for path in tmp_path.glob("*.png")}
    assert names == {"all.png", "square_1.png", "other_1.png", time.strftime("%Y") + ".png"}


def test_folders_with_variables_in_their_names_are_made(model, tmp_path):
    assert main(["render", str(model), *FAST, "-o", "{model}/{date:%Y}/{n:3}.png"]) == 0
    assert (tmp_path / "square" / time.strftime("%Y") / "001.png").exists()


def test_outputs_that_the_system_takes_for_one_are_not_written(
    tmp_path, capsys, monkeypatch, model
):
    (tmp_path / "below").mkdir()
    monkeypatch.setattr(sys, "platform", "darwin")
    for name in ("Chair.obj", "below/chair.obj"):
        (tmp_path / name).write_text(OBJ)
    files = ["render", "Chair.obj", "below/chair.obj", *FAST, "-o"]
    assert main([*files, "{model}.png"]) == 2
    said = "chair.png would be written twice, as Chair.png; add {folder}"
    assert said in capsys.readouterr().err
    assert not list(tmp_path.glob("*.png"))


def test_numbers_keep_names_with_capitals_apart(tmp_path):
    for name in ("a.obj", "b.obj"):
        (tmp_path / name).write_text(OBJ)
    assert main(["render", "a.obj", "b.obj", *FAST, "-o", "Out_{n}.png"]) == 0
    assert {path.name for path in tmp_path.glob("*.png")} == {"Out_1.png", "Out_2.png"}


def test_the_tree_of_models_becomes_a_tree_of_pictures(folder, tmp_path, capsys):
    """`{folder}` is empty in the innermost folder that holds all that was given."""
    (folder / "below" / "b.obj").write_text(OBJ)  # another of that name
    (folder / "bad.obj").write_text("v 1\n")
    tree = ["render", str(folder), *FAST, "--recursive-dir-add"]
    assert main([*tree, "-o", "{model}.png"]) == 2
    assert "b.png would be written twice; add {folder} or {n}" in capsys.readouterr().err
    assert main([*tree, "-o", "small/{folder}/{model}.png"]) == 1
    drawn = {path.relative_to(tmp_path / "small").as_posix() for path in tmp_path.rglob("*.png")}
    assert drawn == {"A.png", "b.png", "below/b.png", "below/c.png"}
    told = capsys.readouterr().err.splitlines()
    assert "bad.obj:1" in told[0] and told[1:] == ["engine3d: 4 drawn, 1 failed"]
    files = ["models/b.obj", "models/below/c.obj", *FAST, "-o"]
    assert main(["render", *files, "{folder}/x_{model}.png"]) == 0
    assert capsys.readouterr().err == "engine3d: 2 drawn\n"
    assert sorted(path.as_posix() for path in tmp_path.rglob("x_*.png")) == [
        (tmp_path / name).as_posix() for name in ("below/x_c.png", "x_b.png")
    ]


def test_a_model_that_stands_still_does_not_stop_animations(folder, capsys):
    turn = ["render", str(folder), *FAST, "--animation", "2", "-o", "{model}.gif"]
    assert main(turn) == 1
    told = capsys.readouterr().err.splitlines()
    assert [line.endswith("has no animation") for line in told] == [True, True, False]
    assert told[-1] == "engine3d: 0 drawn, 2 failed"
    assert main([*turn[:1], str(folder / "b.obj"), *turn[2:]]) == 2


def test_headless_runs_draw_what_can_be_drawn_too(folder, tmp_path, capsys):
    (folder / "a.obj").write_text("v 1\n")
    one = [
        "run",
        str(folder),
        *FAST,
        "--headless",
        "--frames",
        "1",
        "-o",
        "{model_ext}/{model}.png",
    ]
    assert main(one) == 1
    assert sorted(path.name for path in tmp_path.rglob("*.png")) == ["A.png", "b.png"]
    assert capsys.readouterr().err.splitlines()[-1] == "engine3d: 2 drawn, 1 failed"
    assert main([*one, "--quiet"]) == 1
    assert "drawn" not in capsys.readouterr().err


@pytest.mark.parametrize("look", ["studio", "plain"])
def test_one_theme_is_one_ground_for_all(folder, tmp_path, look):
    """Before which auto puts a dark model on light, and a light one on dark."""
    # White faces stand out from light ground as well; white points don't.
    (folder / "p.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n")
    corners = {}
    for theme in ("auto", "dark", "light"):
        for color in ("black", "white"):
            options = [*SMALL, "--look", look, "--theme", theme, "--color", color, "--unlit"]
            assert main(["render", str(folder / "p.obj"), *options, "-o", "a.png"]) == 0
            corners[theme, color] = tuple(pixels("a.png")[0, 0])
    for theme in ("dark", "light"):
        assert corners[theme, "black"] == corners[theme, "white"]
    assert corners["dark", "black"] != corners["light", "black"]
    assert (corners["auto", "black"] != corners["auto", "white"]) == (look == "studio")


def test_the_themes_are_the_viewers():
    from engine3d.stage.overlays.theme import THEMES

    actions = make_parser().commands["render"]._actions
    (option,) = (action for action in actions if "--theme" in action.option_strings)
    assert option.choices == ("auto", *(theme.name for theme in THEMES))


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (
            ["-o", "a.png", "--multi-file-mode", "single"],
            "needs a variable, as in -o '{model}.png'",
        ),
        (["-o", "{colour}.png"], "there is no variable {colour}; there are {app}"),
        (["-o", "{n:x}.png"], "there is no variable {n:x}"),
        (
            ["-o", "{model.png"],
            "-o: '{' without '}' in '{model.png': a variable is {model}",
        ),
        (["-o", "{n}model}.png"], "-o: '}' without '{' in '{n}model}.png': a variable is {model}"),
        (["-o", "{model_ext}.png"], "obj.png would be written twice; add {folder} or {n}"),
        (["-o", "{n}.png", "--side-by-side", "--multi-file-mode", "single"], "does not go with"),
        (["-o", "a.png", "--force-reader", "tga"], "'tga' is not one of 3mf, asc"),
    ],
)
def test_what_does_not_go_together(model, tmp_path, capsys, options, told):
    (tmp_path / "b.obj").write_text(OBJ)
    assert main(["render", str(model), "b.obj", *SMALL, *options]) == 2
    assert told in capsys.readouterr().err
    assert not list(tmp_path.glob("*.png"))


def test_an_empty_folder_is_told(tmp_path, capsys):
    (tmp_path / "empty").mkdir()
    assert main(["render", "empty", *SMALL, "-o", "{model}.png"]) == 1
    assert "empty: there is no model in this folder" in capsys.readouterr().err


def test_variables(tmp_path):
    assert fill("{model}.{model_ext}", "a/b.tar.gz") == "b.tar.gz"
    assert fill("{{model}}_%04d_{:03}.png", "x") == "{model}_%04d_{:03}.png"
    assert fill("plain.png", "x") == "plain.png" and fill(None, "x") is None
    (tmp_path / "c_1.png").touch()
    assert fill("{model}_{n}.png", "c.obj") == "c_2.png"
    assert fill("{app}{n:3}.png", "c.obj", ["engine3d001.png"]) == "engine3d002.png"
    with pytest.raises(UsageError, match="no variable {Model}"):
        fill("{Model}.png", "x")


@pytest.mark.parametrize(
    ("template", "told"),
    [
        ("{n:²}.png", "up to two digits"),
        ("{n:999999999}.png", "up to two digits"),
        ("{n:-1}.png", "up to two digits"),
        ("{n:d}.png", "up to two digits"),
        ("{date:%999999999d}.png", "is no date"),
        pytest.param("{date:\ud800\0}.png", "is no date", marks=NOT_ON_WINDOWS),
        ("{a!r}.png", "no variable"),
        ("{0.__class__}.png", "no variable"),
        ("{.png", "without '}'"),
        ("a}.png", "without '{'"),
    ],
)
def test_patterns_that_are_none(template, told):
    with pytest.raises(UsageError, match=told):
        fill(template, "x.obj")


ODD = [
    "%04d",
    pytest.param("{:04}", marks=NOT_ON_WINDOWS),
    "{}",
    "{model}",
    "{n}",
    "{{",
    "}}",
    "%%d",
    "%s",
    "{0!r:^999}",
    "[a-z]*",
    "%",
]


@pytest.mark.parametrize("stem", ODD)
def test_what_variables_stand_for_is_no_pattern(stem):
    assert fill("{model}.png", f"a/{stem}.obj") == f"{stem}.png"
    assert fill("{model}.png", f"a/{stem}.obj").place is None
    name = fill("{model}_%03d_{model_ext}.png", f"{stem}.{stem}")
    assert name.of_frame(7) == f"{stem}_007_{stem}.png"
    assert fill("{model}d.png", "%04.obj").place is None


def test_escapes():
    assert fill("%%04d{{:04}}.png", "x").place is None
    assert fill("%%04d{{:04}}.png", "x") == "%04d{:04}.png"
    assert fill("{{}}_{:02}%%d.png", "x").of_frame(3) == "{}_03%d.png"
    assert frame_name("a/{{:04}}_%%d.png") == f"a{os.sep}{{:04}}_%d.png"
    assert frame_name("%04d/a.png").place is None
    assert frame_name("%04d/a_{}.png").of_frame(5) == os.path.join("%04d", "a_5.png")
    assert frame_name("%d%d.png").place is None
    assert literal_name("%04d.png").place is None


@pytest.mark.parametrize(
    "stem",
    ["m%04d", pytest.param("m{:04}", marks=NOT_ON_WINDOWS), "m{}", "m{model}", "m{n}", "m%s%n"],
)
def test_models_of_any_name_are_drawn(stem, tmp_path, capsys):
    (tmp_path / f"{stem}.obj").write_text(OBJ)
    assert main(["render", f"{stem}.obj", *SMALL, "-o", "{model}.png"]) == 0
    assert (tmp_path / f"{stem}.png").exists()
    assert main(["render", f"{stem}.obj", *SMALL, "-o", "{model}.gif", "--turntable", "2"]) == 0
    assert (tmp_path / f"{stem}.gif").exists()
    assert main(["render", f"{stem}.obj", *SMALL, "-o", "{model}_%d.png", "--turntable", "2"]) == 0
    assert (tmp_path / f"{stem}_1.png").exists()
    assert main(["run", f"{stem}.obj", *SMALL, "--headless", "--frames", "2"]) == 0
    assert (tmp_path / f"{stem}-turntable-001.gif").exists()


def test_large_files_and_other_readers(model, tmp_path, capsys):
    assert main(["render", str(model), *FAST, "--max-size", "0.00001", "-o", "a.png"]) == 1
    assert "are more than --max-size 1e-05" in capsys.readouterr().err
    renamed = tmp_path / "model.dat"
    renamed.write_text("\n" + OBJ)
    assert main(["render", str(renamed), *FAST, "--force-reader", "obj", "-o", "a.png"]) == 0
    assert main(["render", str(renamed), *FAST, "--force-reader", "ply", "-o", "a.png"]) == 1


def test_the_direction_of_the_camera(model):
    name = model.with_name("a.png")
    command = ["render", str(model), *FAST, "--color", "red", "--unlit", "-o", str(name)]
    seen = []
    for direction in ("0,0,-1", "0,0,1", "0,-1,0"):
        assert main([*command, "--camera-direction", direction]) == 0
        picture = pixels(name)[..., :3].astype(int)
        seen.append((picture[..., 0] > picture[..., 1] + 100).any(axis=1).sum())
    assert seen[0] == seen[1] > 25  # a square from before and from behind, which fills the picture
    assert seen[2] <= 2  # and from above, where it is a line


def test_render_watches(model, monkeypatch, capsys):
    steps = []

    def sleep(seconds):
        steps.append(seconds)
        if len(steps) == 1:
            model.write_text(OBJ.replace("v 1 1 0", "v 1 3 0"))
        if len(steps) == 12:
            raise KeyboardInterrupt

    clock = iter(range(10_000))
    monkeypatch.setattr(render.time, "sleep", sleep)
    monkeypatch.setattr("engine3d.base.files.watch.time.monotonic", lambda: next(clock))
    output = model.with_name("a.png")
    first = ["render", str(model), *FAST, "-o", str(output)]
    assert main(first) == 0
    before = output.read_bytes()
    assert main([*first, "--watch"]) == 130
    assert output.read_bytes() != before
    assert capsys.readouterr().err.count(f"wrote {output}") == 1
    assert main(["render", "--scene", "cube", "--watch", "-o", "a.png"]) == 2


def test_what_changes_while_the_first_picture_is_drawn_is_drawn_again(model, monkeypatch, capsys):
    steps = []

    def drawn(job, draw=render._render):
        status = draw(job)
        if not steps:
            model.write_text(OBJ.replace("v 1 1 0", "v 1 3 0"))
        return status

    def sleep(seconds):
        steps.append(seconds)
        if len(steps) == 12:
            raise KeyboardInterrupt

    clock = iter(range(10_000))
    monkeypatch.setattr(render, "_render", drawn)
    monkeypatch.setattr(render.time, "sleep", sleep)
    monkeypatch.setattr("engine3d.base.files.watch.time.monotonic", lambda: next(clock))
    output = model.with_name("a.png")
    assert main(["render", str(model), *FAST, "--watch", "-o", str(output)]) == 130
    assert capsys.readouterr().err.count(f"wrote {output}") == 1


def test_arrows_go_through_what_was_given(folder):
    from engine3d.apps.viewer.model_files import ModelFiles

    given = [folder / "b.obj", folder / "below" / "c.obj"]
    files = ModelFiles(given[:1], listed=given)
    assert files.beside(1) == os.fspath(given[1])
    assert files.beside(1) == os.fspath(given[0])
    assert ModelFiles([folder / "A.off"], listed=given).beside(1) == os.fspath(given[0])
