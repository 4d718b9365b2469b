"""Stepping through the models of a folder, and the files that were opened before."""

import math
import os

import numpy as np
import pytest
from viewer.scripted_window import ScriptedWindow

from engine3d import events
from engine3d.apps.desktop.recent_files import RecentFiles
from engine3d.apps.viewer.model_files import ModelFiles
from engine3d.apps.viewer.viewer import Viewer
from engine3d.stage.open_model import open_model
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
SIZE = (320, 240)


@pytest.fixture(autouse=True)
def state(tmp_path_factory, monkeypatch):
    folder = tmp_path_factory.mktemp("state")
    for name in ("XDG_STATE_HOME", "LOCALAPPDATA", "HOME", "USERPROFILE"):
        monkeypatch.setenv(name, str(folder))
    return folder


@pytest.fixture
def viewer(tmp_path):
    for name in ("b.obj", "a.OBJ", "c.obj", "notes.txt", "skin.png"):
        (tmp_path / name).write_text(TRIANGLE)
    path = tmp_path / "b.obj"
    view_renderer = ViewRenderer(open_model(path), Settings({}), SIZE)
    files = ModelFiles([path], remembered=True)
    return Viewer(view_renderer, ScriptedWindow(size=SIZE), files=files)


def press(viewer, key, **modifiers):
    viewer.handle(events.KeyDown(key, key, **modifiers))


def title(viewer):
    return viewer.view_renderer.viewed.title


@pytest.mark.parametrize(
    ("forward", "back"),
    [
        (("PageDown", {}), ("PageUp", {})),
        (("Right", {}), ("Left", {})),
    ],
)
def test_keys_go_through_the_models_of_the_folder(viewer, forward, back):
    azimuth = viewer.view.azimuth
    names = []
    for key, modifiers in (forward, forward, forward, back, back):
        press(viewer, key, **modifiers)
        names.append(title(viewer))
    assert names == ["c.obj", "a.OBJ", "b.obj", "a.OBJ", "c.obj"]
    assert viewer.view.azimuth == azimuth


def test_a_broken_file_is_told_and_gone_past(viewer, tmp_path):
    (tmp_path / "c.obj").write_text("v 0 0\n")
    press(viewer, "PageDown")
    assert title(viewer) == "b.obj" and "c.obj:1: " in viewer.messages.said
    press(viewer, "PageDown")
    assert title(viewer) == "a.OBJ"


def test_the_look_stays_from_file_to_file(viewer):
    press(viewer, "N")
    press(viewer, "PageDown")
    assert viewer.view_renderer.appearance.mode == "normal"


def test_up_loads_the_file_again(viewer, tmp_path):
    assert viewer.view_renderer.viewed.metadata()[-1].split() == ["triangles", "1"]
    azimuth = viewer.view.azimuth = 1.0
    (tmp_path / "b.obj").write_text(TRIANGLE + "f 3 2 1\n")
    press(viewer, "Up")
    assert viewer.view_renderer.viewed.metadata()[-1].split() == ["triangles", "2"]
    assert viewer.view.azimuth == azimuth and "loaded b.obj again" in viewer.messages.said
    (tmp_path / "b.obj").unlink()
    press(viewer, "Up")
    assert "b.obj" in viewer.messages.trouble and title(viewer) == "b.obj"
    viewer.opening.files = ModelFiles()
    press(viewer, "Up")
    assert viewer.messages.said == "there is no file to load again"


def test_a_held_arrow_key_goes_to_one_file_and_turns_on_with_shift(viewer):
    press(viewer, "Right", repeat=True)
    assert title(viewer) == "b.obj"
    azimuths = [viewer.view.azimuth]
    for repeat in (False, True):
        press(viewer, "Right", shift=True, repeat=repeat)
        azimuths.append(viewer.view.azimuth)
    for key in ("6", "Keypad 6"):
        press(viewer, key)
        press(viewer, key, repeat=True)  # a quarter at a time
        azimuths.append(viewer.view.azimuth)
    steps = np.remainder(np.diff(azimuths), 2 * math.pi)
    assert steps[0] > 0.1 and steps == pytest.approx([steps[0]] * 2 + [math.pi / 2] * 2)
    for key, modifiers in (("Left", {"shift": True}), ("4", {})):
        press(viewer, key, **modifiers)
        press(viewer, key, **modifiers)
    assert viewer.view.azimuth == pytest.approx(azimuths[0])
    elevation = viewer.view.elevation
    press(viewer, "Up", shift=True)
    assert viewer.view.elevation > elevation + 0.1
    press(viewer, "Down", shift=True)
    assert viewer.view.elevation == pytest.approx(elevation)
    press(viewer, "8")
    assert viewer.view.elevation == math.pi / 2  # overhead
    press(viewer, "2")
    assert viewer.view.elevation == pytest.approx(0.0)
    assert title(viewer) == "b.obj"


def test_alone_in_a_folder_or_without_a_file_nothing_happens(viewer, tmp_path):
    for name in ("a.OBJ", "c.obj"):
        (tmp_path / name).unlink()
    press(viewer, "PageDown")
    assert title(viewer) == "b.obj" and "no other model" in viewer.messages.said
    assert ModelFiles().beside(1) is None


def test_files_that_were_opened_are_remembered(viewer, tmp_path, state):
    for key in ("PageDown", "PageDown"):
        press(viewer, key)
    names = [os.path.basename(path) for path in RecentFiles().paths()]
    assert names == ["a.OBJ", "c.obj"]


def test_a_list_of_them_opens_one(viewer, tmp_path):
    RecentFiles().add(tmp_path / "c.obj")
    press(viewer, "O", control=True, shift=True)
    viewer.draw()
    left, top, width, _ = viewer.panel._box
    x, y = left + width // 2, top + 8 + int(2.5 * viewer.panel._row_height)
    assert viewer.panel.covers(x, y)
    viewer.handle(events.MouseButton("left", True, x=x, y=y))
    assert title(viewer) == "c.obj" and viewer.panel is None
