"""What holds for all commands: errors, usage, help, warnings, versions."""

import re
import subprocess
import sys

import pytest
from cli.conftest import OBJ, SMALL

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.apps.cli.commands import COMMANDS

pytestmark = pytest.mark.usefixtures("no_screen")


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["missing.obj"], "missing.obj"),
        (["broken.obj"], "broken.obj:2: "),
        (["square.obj", "--texture", "missing.png"], "missing.png"),
        (["square.obj", "--texture", "broken.obj"], "broken.obj"),
        (["square.obj", "--reference", "missing.png"], "missing.png"),
        (["square.obj", "--reference", "broken.obj"], "broken.obj"),
        (["square.obj", "-o", "square.obj/no/out.png"], "square.obj/no"),
        (["square.obj", "--camera-position", "0.5,0.5,0"], "same"),
        (["square.obj", "--camera-position", "1e300,0,0"], "too far apart"),
        (["empty"], "empty: there is no model in this folder"),
    ],
)
def test_bad_input_is_one_line_and_status_1(model, tmp_path, capsys, arguments, part):
    (tmp_path / "empty").mkdir()
    (tmp_path / "broken.obj").write_text("v 0 0 0\nf 1 2 9\n")
    if "-o" not in arguments:
        arguments = [*arguments, "-o", "out.png"]
    assert main(["render", *SMALL, *arguments]) == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("engine3d: error: ")
    assert err.count("\n") == 1
    assert part in err


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["fly"],
        ["render"],
        ["render", "a.obj"],
        ["render", "-o", "out.png"],
        ["render", "a.obj", "-o", "out.xyz"],
        ["render", "a.obj", "-o", "out"],
        ["render", "a.obj", "-o", "out.gif"],
        ["render", "a.obj", "--turntable", "4", "-o", "out.png"],
        ["render", "a.obj", "--turntable", "4", "-o", "-"],
        ["render", "a.obj", "--turntable", "0", "-o", "out.gif"],
        ["render", "a.obj", "--no-background", "-o", "out.jpg"],
        ["render", "a.obj", "--scene", "cube", "-o", "out.png"],
        ["render", "--scene", "moon", "-o", "out.png"],
        ["render", "--scene", "cube", "--texture", "a.png", "-o", "out.png"],
        ["render", "--scene", "cube", "--triangles", "50000", "-o", "out.png"],
        ["city", "out.png"],
        ["city", "out.obj", "--seed", "x"],
        ["render", "a.obj", "-o", "out.png", "--size", "0x0"],
        ["render", "a.obj", "-o", "out.png", "--mode", "pretty"],
        ["render", "a.obj", "-o", "out.png", "--unlit", "--mode", "depth"],
        ["render", "a.obj", "-o", "out.png", "--backend", "gpu"],
        ["render", "a.obj", "-o", "out.png", "--no-such-option"],
        ["render", "a.obj", "-o", "out.png", "--reference-threshold", "0.1"],
        ["render", "a.obj", "--reference", "a.png", "--reference-threshold", "1.1"],
        ["render", "a.obj", "-o", "out.png", "--threads", "257"],
        ["render", "a.obj", "-o", "out.png", "--line-width", "256.5"],
        ["render", "a.obj", "-o", "out.png", "--point-size", "300"],
        ["render", "a.obj", "-o", "out.png", "--camera-view-up", "0,0,0"],
        [
            "render",
            "a.obj",
            "-o",
            "out.png",
            "--camera-position",
            "1,2,3",
            "--camera-focal-point",
            "1,2,3",
        ],
        ["render", "--scene", "city", "--triangles", "500", "-o", "out.png"],
        ["city", "out.obj", "--triangles", "500"],
        ["run", "--headless", "-o", "out.png"],
        ["run", "--watch"],
        ["run", "-", "--watch"],
        ["run", "-o", "out.gif"],
        ["info"],
    ],
)
def test_wrong_usage_is_status_2_and_writes_nothing(tmp_path, capsys, arguments):
    (tmp_path / "a.obj").write_text(OBJ)
    assert main(arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("engine3d") and "error: " in err
    assert err.count("\n") == 1
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.obj"]


@pytest.mark.parametrize(
    ("arguments", "work"),
    [
        (["render", "--scene", "cube", "-o", "no/a.png"], "options.scene_options.viewed_scene"),
        (
            ["run", "--scene", "cube", "--headless", "-o", "no/a.gif"],
            "options.scene_options.viewed_scene",
        ),
        (["convert", "square.obj", "no/a.ply"], "commands.convert.load_mesh"),
        (["city", "no/a.obj"], "commands.city.make_city"),
        (["bench", "--json", "no/a.json"], "commands.bench.workloads.make"),
    ],
)
def test_a_folder_that_cannot_be_made_is_found_before_any_work(
    model, capsys, monkeypatch, arguments, work
):
    def begin(*arguments, **options):
        raise AssertionError("the work has begun")

    monkeypatch.setattr(f"engine3d.apps.cli.{work}", begin)
    path = arguments[-1]
    for name, place, reason in (
        ("a file", "square.obj/below", "Not a directory"),
        ("a link to nothing", "link/below", "No such file or directory"),
    ):
        model.with_name("link").unlink(missing_ok=True)
        model.with_name("link").symlink_to("nothing")
        output = path.replace("no/", f"{place}/")
        assert main([*arguments[:-1], output]) == 1, name
        expected = f"engine3d: error: {output}: cannot write: {reason}\n"
        assert capsys.readouterr() == ("", expected)


QUICK_BENCH = ["--workloads", "textured", "--seconds", "0.01", "--size", "32x24"]


@pytest.mark.parametrize(
    "arguments",
    [
        ["render", "square.obj", "--size", "32x24", "-o", "new/a b/a.png"],
        ["render", "square.obj", "--size", "32x24", "--turntable", "2", "-o", "new/b/a.gif"],
        ["render", "square.obj", "--size", "32x24", "--turntable", "2", "-o", "n/b/%d.png"],
        ["run", "square.obj", "--headless", "--frames", "1", "-o", "new/b/a.png"],
        ["run", "square.obj", "--headless", "--frames", "2", "-o", "new/b/a.webp"],
        ["sheet", "square.obj", "--json", "-o", "new/b/a.png"],
        ["convert", "square.obj", "new/b/a.ply"],
        ["city", "--triangles", "20000", "new/b/a.obj"],
        ["bench", *QUICK_BENCH, "--json", "new/b/a.json"],
    ],
    ids=lambda arguments: f"{arguments[0]} {arguments[-1]}",
)
def test_folders_of_outputs_are_made_when_something_is_written(model, arguments):
    broken = [word.replace("square.obj", "none.obj") for word in arguments]
    if broken != arguments:
        assert main(broken) == 1
        assert not list(model.parent.glob("n*"))  # a failure leaves no folder
    assert main(arguments) == 0
    made = [path for path in model.parent.rglob("n*/*/*") if path.is_file()]
    assert made and all(path.stat().st_size for path in made)


@pytest.mark.parametrize(
    ("arguments", "meant", "program"),
    [
        (["--versoin"], "--version", "engine3d"),
        (["info", "square.obj", "--jsn"], "--json", "engine3d info"),
    ],
)
def test_a_misspelt_option_leads_to_the_help_that_lists_it(
    model, capsys, arguments, meant, program
):
    assert main(arguments) == 2
    wrong = f"{arguments[-1]}: did you mean {meant}?"
    expected = f"engine3d: error: unknown arguments: {wrong} (see {program} --help)\n"
    assert capsys.readouterr().err == expected


def test_a_backend_that_the_machine_lacks_is_an_error(model, capsys, monkeypatch):
    monkeypatch.setenv("ENGINE3D_BACKEND", "abacus")
    assert main(["render", str(model), *SMALL, "-o", "out.png"]) == 1
    assert "abacus" in capsys.readouterr().err


def test_a_loaders_warning_is_a_line(tmp_path, capsys):
    path = tmp_path / "model.obj"
    path.write_text("mtllib missing.mtl\n" + OBJ)
    assert main(["render", str(path), *SMALL, "-o", "out.png"]) == 0
    err = capsys.readouterr().err
    assert err.startswith("engine3d: warning: ")
    assert "missing.mtl" in err
    assert err.count("\n") == 1


def test_verbose_tells_what_was_loaded_and_drawn(model, capsys):
    small = (*SMALL, "--look", "plain", "-o", "out.png")
    assert main(["render", str(model), *small, "--verbose"]) == 0
    out, err = capsys.readouterr()
    assert out == ""
    assert "square.obj" in err and "48x32" in err and "triangles" in err
    counted = "2 in frustum, 2 unoccluded, 2 drawn; boxes tested 1; materials 1; "
    assert sum(counted in line for line in err.splitlines()) == 1


def test_list_readers_and_version(capsys):
    assert main(["--list-readers"]) == 0
    text = capsys.readouterr().out
    assert ".obj" in text and ".tga" in text and ".asc" in text
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"engine3d {e3d.__version__}\n"


@pytest.mark.parametrize("command", [[], ["run"], ["render"], ["info"]])
def test_help(command, capsys):
    assert main([*command, "--help"]) == 0
    assert "usage: engine3d" in capsys.readouterr().out


def headings(text):
    return re.findall(r"^\w[\w ]*:$", text, re.M)


def option_lines(text):
    """The long options that a help has a line for."""
    return set(re.findall(r"^  (?:-\w[^,]*, )?(--[\w-]+)", text, re.M))


@pytest.mark.parametrize("command", ["run", "render"])
def test_the_short_help_shows_common_options_and_the_whole_help_all(command, capsys):
    assert main([command, "--help"]) == 0
    short = capsys.readouterr().out
    assert main([command, "--help-all"]) == 0
    whole = capsys.readouterr().out
    common = set(COMMANDS[command].common)
    assert len(common) == 25
    assert option_lines(short) == {"--help", "--help-all", *common}
    assert option_lines(short) < option_lines(whole)
    assert f"show all {len(option_lines(whole)) - 1} options" in short
    assert [line for line in headings(whole) if line in headings(short)] == headings(short)


def test_help_loads_neither_numpy_nor_pillow():
    code = (
        "import sys; from engine3d.apps.cli import main; main(['render', '--help']);"
        "print([name for name in ('numpy', 'PIL', 'sdl2', 'rich') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
