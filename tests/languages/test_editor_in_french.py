"""The editor in French: labels, and IDs and layouts that do not change with the language."""

from importlib.resources import files

import pytest

from engine3d import data
from engine3d.base.language import speaking

pytest.importorskip(
    "imgui_bundle", reason="it is an extra: pip install -e .[editor]", exc_type=ImportError
)

from editor.ui.editor_hands import SIZE, find, press, settle
from imgui_bundle import imgui as imgui_itself

from engine3d.apps.editor.ui import translated_imgui
from engine3d.apps.editor.ui.editor_window import EditorWindow
from engine3d.apps.editor.ui.translated_imgui import label


@pytest.fixture
def make_editor(monkeypatch, tmp_path):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    for variable in ("XDG_STATE_HOME", "XDG_CACHE_HOME"):
        monkeypatch.setenv(variable, str(tmp_path / variable))

    def make():
        editor = EditorWindow(str(files(data) / "models" / "train.asc"), size=SIZE)
        editor.window.present = lambda pixels: None
        settle(editor)
        return editor

    return make


@pytest.mark.parametrize(
    ("text", "shown", "identity"),
    [
        ("Save", "Enregistrer", "###Save"),
        ("Name##2", "Name", "##2"),
        ("Name###of node", "Nom", "###of node"),
        ("##search", "", "##search"),
    ],
)
def test_labels_change_and_their_ids_do_not(text, shown, identity):
    assert label(text).endswith(identity)
    with speaking("fr"):
        assert label(text) == (shown + identity)


def test_layouts_are_the_same_in_every_language(make_editor):
    layouts = []
    for language in ("en", "fr"):
        with speaking(language), make_editor():
            layouts.append(imgui_itself.save_ini_settings_to_memory())
    assert layouts[0] == layouts[1] and "Scene" in layouts[0]


def test_commands_are_told_in_french(make_editor):
    with speaking("fr"), make_editor() as editor:
        editor.workspace.document.selection.set([find(editor, "Cab")])
        press(editor, "Delete")
        press(editor, "Z", control=True)
        said = [entry.text for entry in editor.workspace.console.entries]
        assert said[-2:] == ["Supprimer 'Cab'", "Annuler\u00a0: Supprimer 'Cab'"]


def test_only_names_of_functions_that_are_there_are_wrapped():
    names = (*translated_imgui.LABELLED, *translated_imgui.REMARKING)
    assert all(callable(getattr(imgui_itself, name)) for name in names)
