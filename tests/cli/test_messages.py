"""What commands say: nothing if quiet, what was probably meant."""

import pytest
from cli.conftest import OBJ

from engine3d.apps.cli import main

pytestmark = pytest.mark.usefixtures("no_screen")
SMALL = ("--size", "48x32")


def test_quiet_prints_errors_only(model, capsys, tmp_path):
    noisy = tmp_path / "noisy.obj"
    noisy.write_text("mtllib missing.mtl\n" + OBJ)
    for arguments in (
        ["render", str(noisy), *SMALL, "-o", "a.png"],
        ["run", str(noisy), *SMALL, "--frames", "2"],
        ["convert", str(noisy), "a.ply"],
    ):
        assert main(arguments) == 0
        assert capsys.readouterr().err != ""
        assert main([*arguments, "--quiet"]) == 0
        assert capsys.readouterr() == ("", "")
    assert main(["render", "nothing.obj", "-o", "a.png", "--quiet"]) == 1
    assert capsys.readouterr().err.startswith("engine3d: error: nothing.obj: ")
    assert main(["render", str(noisy), "-o", "a.png", "--quiet", "--verbose"]) == 2


@pytest.mark.parametrize(
    ("arguments", "meant"),
    [
        (["rendr", "a.obj"], "there is no command 'rendr': did you mean render?"),
        (["render", "a.obj", "--siez", "3x4"], "--siez 3x4: did you mean --size?"),
        (["render", "a.obj", "--siez=3x4"], "=3x4: did you mean --size?"),
        (["run", "--mode", "deph"], "did you mean depth?"),
        (["run", "--scene", "sity"], "did you mean city?"),
        (["render", "a.obj", "--resolution", "3x4"], "did you mean --size?"),
        (["sheet", "a.obj", "--resolution", "3x4"], "did you mean --size?"),
        (["run", "a.obj", "--camera-view-angle=60"], "did you mean --camera-yfov?"),
        (["run", "a.obj", "--fov=60"], "did you mean --camera-yfov?"),
        (["render", "a.obj", "--background", "white"], "a colour goes with --background-color"),
        (["render", "a.obj", "--size", "-5x5"], "'-5x5': each side must be from 1 to 16384 pixels"),
        (["render", "a.obj", "--size", "5"], "'5' is not WIDTHxHEIGHT, such as 1280x720"),
        (["render", "a b.obj", "out.PNG"], "-o FILE: engine3d render 'a b.obj' -o out.PNG"),
        (["render", "a.obj", "b.obj"], "say where to write with -o FILE\n"),
        (["convert", "a.obj"], "say where to write, such as: engine3d convert a.obj a.ply"),
        (["square.obj"], "'square.obj' is no command; to see that file: engine3d run square.obj"),
    ],
)
def test_what_was_probably_meant_is_named(model, capsys, arguments, meant):
    assert main(arguments) == 2
    error = capsys.readouterr().err
    assert meant in error and error.count("\n") == 1


def test_what_resembles_nothing_gets_no_guess(model, capsys):
    for arguments in (["zzzz"], ["run", "--nonsense"], ["run", "--mode", "zzzz"]):
        assert main(arguments) == 2
        assert "did you mean" not in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--watch", "--fps"])
def test_options_of_the_window_do_nothing_unseen(model, capsys, option):
    assert main(["run", str(model), "--headless", option, "--frames", "1", "-o", "a.png"]) == 2
    assert f"{option} needs a window" in capsys.readouterr().err
