"""The language of windows: what chooses it, how long it lasts, what texts and numbers become."""

import ctypes
import os
from types import SimpleNamespace
from unittest.mock import Mock

import pytest

from engine3d import InvalidArgumentError
from engine3d.base import language, system_languages
from engine3d.base.language import (
    languages,
    speaking,
    translated,
    translated_choice,
    translated_count,
    translated_keys,
    usual_language,
)


@pytest.mark.parametrize(
    ("environment", "expected"),
    [
        ({}, "en"),
        ({"LANG": "C"}, "en"),
        ({"LANG": "fr_FR.UTF-8"}, "fr"),
        ({"LANG": "fr"}, "fr"),
        ({"LANG": "fr.UTF-8"}, "fr"),
        ({"LANG": "fr@euro"}, "fr"),
        ({"LANG": "fro_FR.UTF-8"}, "en"),
        ({"LANG": "xx_XX.UTF-8"}, "en"),
        ({"LANG": "fr_FR.UTF-8", "LC_ALL": "en_US.UTF-8"}, "en"),
        ({"LANG": "en_US.UTF-8", "LC_MESSAGES": "fr_CA.UTF-8"}, "fr"),
        ({"LANG": "fr_FR.UTF-8", "LC_ALL": ""}, "fr"),
        ({"LANG": "en_US.UTF-8", "LANGUAGE": "xx:fr:en"}, "fr"),
        ({"LANGUAGE": "fr"}, "en"),
        ({"LANG": "C", "LANGUAGE": "fr"}, "en"),
    ],
)
def test_the_language_is_that_of_the_locale(monkeypatch, environment, expected):
    monkeypatch.setattr(language, "system_languages", list)  # as where only variables tell
    assert usual_language(environment) == expected


@pytest.mark.parametrize(
    ("number", "expected"), [(0x040C, "fr"), (0x0C0C, "fr"), (0x0407, "en"), (0, "en")]
)
def test_windows_tells_the_language_of_its_windows(monkeypatch, number, expected):
    kernel = SimpleNamespace(GetUserDefaultUILanguage=lambda: number)
    monkeypatch.setattr("sys.platform", "win32")
    monkeypatch.setattr(ctypes, "windll", SimpleNamespace(kernel32=kernel), raising=False)
    assert usual_language({}) == expected
    assert usual_language({"LANG": "C"}) == "en"
    assert usual_language({"LANG": "fr_FR.UTF-8"}) == "fr"
    if number:
        assert usual_language({"LANGUAGE": "xx:fr"}) == "fr"


@pytest.mark.parametrize(
    ("printed", "expected"),
    [
        ('(\n    "fr-CA",\n    "en-CA"\n)', "fr"),
        ('(\n    "de-DE",\n    fr\n)', "fr"),
        ('(\n    "zh-Hans-CN"\n)', "en"),
        ("", "en"),
    ],
)
def test_macos_tells_the_languages_of_its_settings(monkeypatch, printed, expected):
    ask = Mock(return_value=printed)
    monkeypatch.setattr("sys.platform", "darwin")
    monkeypatch.setattr(system_languages, "answer_of", ask)
    assert usual_language({}) == expected
    assert usual_language({"LANG": "C.UTF-8"}) == "en"
    ask.assert_called_once_with("/usr/bin/defaults", "read", "-g", "AppleLanguages")


@pytest.mark.skipif(os.path.exists("/usr/bin/defaults"), reason="macOS has it")
def test_macos_without_its_program_is_english(monkeypatch):
    monkeypatch.setattr("sys.platform", "darwin")
    assert usual_language({}) == "en"


def test_texts_are_english_but_in_a_block_with_another_language():
    assert languages()[0] == "en" and "fr" in languages()
    assert translated("saved {name}", name="a.png") == "saved a.png"
    with speaking("fr"):
        assert translated("saved {name}", name="a.png") == "a.png enregistré"
        assert translated("no such text") == "no such text"
        with speaking("en"):
            assert translated("Save") == "Save"
        assert translated("Save") == "Enregistrer"
    assert translated("Save") == "Save"


def test_an_error_ends_the_language_too():
    with pytest.raises(ValueError), speaking("fr"):
        raise ValueError
    assert translated("Save") == "Save"


def test_braces_of_texts_without_values_stay():
    assert translated("cannot read {x}.obj") == "cannot read {x}.obj"


@pytest.mark.parametrize(
    ("count", "english", "french"),
    [(0, "0 nodes", "0 nœud"), (1, "1 node", "1 nœud"), (1234, "1,234 nodes", "1\u00a0234 nœuds")],
)
def test_counts_have_the_plural_and_the_marks_of_the_language(count, english, french):
    assert translated_count("{count:,} node", "{count:,} nodes", count) == english
    with speaking("fr"):
        assert translated_count("{count:,} node", "{count:,} nodes", count) == french


def test_only_numbers_get_other_marks():
    with speaking("fr"):
        assert translated("{ms:.1f} ms to draw", ms=2.5) == "dessiné en 2,5 ms"
        assert translated("saved {name}", name="a.b,c") == "a.b,c enregistré"


def test_values_depend_on_their_option():
    assert translated_choice("fog", "none") == "none"
    with speaking("fr"):
        assert translated_choice("fog", "none") == "aucun"
        assert translated_choice("cull", "none") == "aucune"


@pytest.mark.parametrize(
    ("keys", "french"),
    [
        ("Ctrl+Shift+Z", "Ctrl+Maj+Z"),
        ("Delete", "Suppr"),
        ("Shift+Up", "Maj+Haut"),
        ("+", "+"),
        ("Ctrl++", "Ctrl++"),
        ("F11", "F11"),
    ],
)
def test_keys_have_the_names_of_the_keyboard(keys, french):
    assert translated_keys(keys) == keys
    with speaking("fr"):
        assert translated_keys(keys) == french


def test_keys_of_macos_are_those_with_cmd(monkeypatch):
    monkeypatch.setattr("sys.platform", "darwin")
    assert translated_keys("Ctrl+Shift+Z") == "Cmd+Shift+Z"
    assert translated_keys("Ctrl+M") == "Ctrl+M"  # Cmd+M is the system's
    with speaking("fr"):
        assert translated_keys("Ctrl+Shift+Z") == "Cmd+Maj+Z"


def test_a_language_without_a_catalogue_is_refused():
    with pytest.raises(InvalidArgumentError, match="one of en, fr, not 'xx'"), speaking("xx"):
        pass
    assert language._chosen is None
