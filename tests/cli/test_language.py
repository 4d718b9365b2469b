"""What chooses the language of a command's window, and that files do not depend on it."""

import argparse
import json

import pytest

from engine3d import FileFormatError
from engine3d.apps.cli import main
from engine3d.apps.cli.options.language_options import language_of
from engine3d.apps.cli.parser import parse


@pytest.fixture(autouse=True)
def locale(monkeypatch, tmp_path):
    for name in ("LANGUAGE", "LC_ALL", "LC_MESSAGES"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("LANG", "en_GB.UTF-8")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    return monkeypatch


def write_config(tmp_path, *entries):
    folder = tmp_path / "engine3d"
    folder.mkdir()
    (folder / "config.json").write_text(json.dumps(entries))


@pytest.mark.parametrize("command", ["run", "edit", "learn"])
def test_the_locale_chooses_and_the_option_overrides_it(command, locale):
    assert language_of(parse([command])) == "en"
    locale.setenv("LANG", "fr_FR.UTF-8")
    assert language_of(parse([command])) == "fr"
    assert language_of(parse([command, "--language", "en"])) == "en"


@pytest.mark.parametrize("command", ["run", "edit", "learn"])
def test_the_file_of_options_chooses(command, tmp_path):
    write_config(tmp_path, {"options": {"language": "fr"}})
    assert language_of(parse([command])) == "fr"
    assert language_of(parse([command, "--language", "en"])) == "en"


def test_no_config_leaves_the_locale(tmp_path):
    write_config(tmp_path, {"options": {"language": "fr"}})
    assert language_of(parse(["run", "--no-config"])) == "en"


def test_a_language_that_is_not_there_is_told(tmp_path, capsys):
    write_config(tmp_path, {"options": {"language": "xx"}})
    with pytest.raises(FileFormatError, match=r"\[0\]\.options\.language: .*xx"):
        language_of(argparse.Namespace(language=None))
    assert main(["learn", "--language", "xx", "--list"]) == 2
    assert "en" in capsys.readouterr().err


def test_files_say_the_same_in_every_locale(tmp_path, locale):
    written, model = [], tmp_path / "face.obj"
    model.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    for name in ("en_GB.UTF-8", "fr_FR.UTF-8"):
        locale.setenv("LANG", name)
        path = tmp_path / f"{name}.png"
        arguments = [str(model), "--headless", "--frames", "1", "--size", "320x240"]
        assert main(["run", *arguments, "--metadata", "-o", str(path), "--quiet"]) == 0
        written.append(path.read_bytes())
    assert written[0] == written[1]
