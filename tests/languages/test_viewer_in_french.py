"""The viewer in French: what its keys and panels say, and that the help has room."""

import numpy as np
import pytest
from languages.drawn_texts import SAME_KEY
from languages.recorder import Recorder
from viewer.scripted_window import ScriptedWindow

import engine3d as e3d
from engine3d import events
from engine3d.apps.viewer import actions, command_values
from engine3d.apps.viewer.controls.menu_bar import bar_buttons
from engine3d.apps.viewer.help_panel import CommandPanel
from engine3d.apps.viewer.keymap import BINDINGS
from engine3d.apps.viewer.viewer import Viewer
from engine3d.base import language
from engine3d.base.language import speaking
from engine3d.rendering.fonts.font import Font
from engine3d.stage.overlays.lettering import text_font
from engine3d.stage.overlays.theme import DARK
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene

#: Long, or they end the window.
LEFT_OUT = ("save_turntable", "quit")


@pytest.fixture
def recorder(monkeypatch):
    recorder = Recorder()
    monkeypatch.setattr(language, "_chosen", recorder)
    return recorder


@pytest.fixture
def viewer(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = e3d.Scene()
    scene.add(e3d.InstancedMesh(e3d.box(), np.eye(4)[None]), name="box")
    viewed = ViewedScene(scene, "box.obj")
    with ViewRenderer(viewed, Settings({}), (480, 360)) as view_renderer:
        yield Viewer(view_renderer, ScriptedWindow(size=(480, 360)))


@pytest.mark.parametrize("action", [b.action for b in BINDINGS if b.action not in LEFT_OUT])
def test_every_key_speaks_french(action, viewer, recorder):
    for _ in range(len(viewer.view_renderer.lighting.names) + 4):
        getattr(actions, action)(viewer, 1)
        viewer.draw()
    assert not _lacking(recorder)


def test_what_is_selected_is_told_in_french(viewer, recorder):
    viewer.draw()
    viewer.select(240, 120)
    viewer.draw()
    assert not _lacking(recorder)
    assert "instance 0 sur 1" in viewer._selection()


def _lacking(recorder):
    keys = {text for context, text in recorder._translations if context == "key"}
    return {(c, text) for c, text in recorder.missing if not _is_keys(text, keys)}


def _is_keys(text, keys):
    words = text.split()
    return all(word in keys or len(word) == 1 or SAME_KEY.fullmatch(word) for word in words)


def test_messages_are_french_only_in_a_french_window(viewer):
    with speaking("fr"):
        viewer.handle(events.KeyDown("U", "U"))
        assert viewer.messages.said == "mode\u00a0: sans lumière"
    viewer.handle(events.KeyDown("U", "U"))
    assert viewer.messages.said == "mode: lit"


def test_the_list_of_commands_cuts_no_french(viewer, monkeypatch):
    cut, fitted = [], Font.fitted

    def fitted_or_noted(font, text, width):
        shown = fitted(font, text, width)
        if shown != text:
            cut.append(text)
        return shown

    monkeypatch.setattr(Font, "fitted", fitted_or_noted)
    with speaking("fr"):
        CommandPanel(viewer).draw(e3d.Canvas((1280, 2400)), 1.0, DARK)
    assert not cut


def test_the_bar_has_its_buttons_in_french():
    font = text_font(1.0)
    count = len(bar_buttons(1280, font))
    with speaking("fr"):
        buttons = bar_buttons(1280, font)
    assert len(buttons) == count


def test_the_list_of_commands_of_a_terminal_is_french(viewer):
    viewer.window.text_room = (80, 400)
    with speaking("fr"):
        lines = CommandPanel(viewer).lines()
    assert any("toutes les commandes" in line for line in lines)
    assert any("Maj+Haut" in line for line in lines)


def test_values_of_commands_are_french(viewer):
    with speaking("fr"):
        assert command_values.switch(True).text == "oui"
        assert command_values.theme(viewer).text == "sombre"
