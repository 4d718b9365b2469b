"""The scale of texts and panels: an option of all commands with windows, and of config files."""

import json

import pytest

from engine3d.apps.cli import main
from engine3d.apps.cli.parser import parse
from engine3d.apps.cli.usage import UsageError
from engine3d.apps.viewer.program_window import ProgramWindow

COMMANDS = ("run", "render", "edit", "learn")


@pytest.fixture(autouse=True)
def own_config(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    (tmp_path / "engine3d").mkdir()
    return tmp_path / "engine3d" / "config.json"


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(("text", "scale"), [("0.5", 0.5), ("1.25", 1.25), ("4", 4.0)])
def test_any_number_from_a_half_to_four_is_taken(command, text, scale):
    assert parse([command, "--ui-scale", text]).ui_scale == scale
    assert parse([command, "-D", f"ui-scale={text}"]).ui_scale == scale


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("text", ["0.49", "4.01", "-1", "nan", "inf", "large"])
def test_other_scales_are_refused(command, text, capsys):
    with pytest.raises((SystemExit, UsageError)) as error:
        parse([command, f"--ui-scale={text}"])
    told = capsys.readouterr().err + str(error.value)
    assert "--ui-scale" in told and repr(text) in told


@pytest.mark.parametrize("command", COMMANDS)
def test_config_files_choose_the_scale(command, own_config):
    own_config.write_text(json.dumps([{"options": {"ui-scale": 1.5, "grid": True}}]))
    assert parse([command]).ui_scale == 1.5
    assert parse([command, "--ui-scale", "2"]).ui_scale == 2.0
    assert parse([command, "--no-config"]).ui_scale is None


class Opened(BaseException):
    """What ends a command when it opens its window."""


@pytest.mark.parametrize("command", ["run", "edit", "learn"])
def test_the_window_of_each_command_has_the_scale(command, monkeypatch):
    if command == "edit":
        pytest.importorskip("imgui_bundle", reason="it is an extra", exc_type=ImportError)
    scales = []

    def open_window(window, size, vsync):
        scales.append(window.scale)
        raise Opened

    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.setattr(ProgramWindow, "_open", open_window)
    with pytest.raises(Opened):
        main([command, "--ui-scale", "1.75"])
    assert scales == [1.75]
