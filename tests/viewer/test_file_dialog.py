"""The dialog that opens files: folders, a filter, what was opened before; by keys and by clicks."""

import os

import pytest
from viewer.scripted_window import ScriptedWindow

from engine3d import events
from engine3d.apps.desktop.recent_files import RecentFiles
from engine3d.apps.viewer.file_dialog import FolderPanel, RecentPanel, _size
from engine3d.apps.viewer.model_files import ModelFiles
from engine3d.apps.viewer.viewer import Viewer
from engine3d.stage.open_model import open_model
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
SIZE = (640, 480)


@pytest.fixture(autouse=True)
def home(tmp_path_factory, monkeypatch):
    folder = tmp_path_factory.mktemp("home")
    for name in ("XDG_STATE_HOME", "LOCALAPPDATA", "HOME", "USERPROFILE"):
        monkeypatch.setenv(name, str(folder))
    return folder


@pytest.fixture
def viewer(tmp_path):
    """Shows b.obj of a folder with models, a text and folders, one of them hidden."""
    for folder in ("parts", "tests", ".cache"):
        (tmp_path / folder).mkdir()
    for name in ("b.obj", "a.OBJ", "cart.stl", "notes.txt", "parts/wheel.obj", ".old.obj"):
        (tmp_path / name).write_text(TRIANGLE, newline="\n")  # of a known size
    path = tmp_path / "b.obj"
    view_renderer = ViewRenderer(open_model(path), Settings({}), SIZE)
    files = ModelFiles([path], remembered=True)
    return Viewer(view_renderer, ScriptedWindow(size=SIZE), files=files)


def press(viewer, *keys, **modifiers):
    for key in keys:
        viewer.handle(events.KeyDown(key, key, **modifiers))
    viewer.draw()


def type_text(viewer, text):
    """As a keyboard does: a key goes down, then its text comes."""
    for letter in text:
        viewer.handle(events.KeyDown(letter.upper(), letter.upper()))
        viewer.handle(events.TextEntered(letter))
    viewer.draw()


def names(viewer):
    return [row.text for row in viewer.panel.rows()]


def chosen(viewer):
    return names(viewer)[viewer.panel.chosen]


def title(viewer):
    return viewer.view_renderer.viewed.title


def click_row(viewer, text):
    panel = viewer.panel
    line = panel._heads + names(viewer).index(text) - panel._first
    x, y = panel._box[0] + 20, panel._box[1] + 8 + int((line + 0.5) * panel._row_height)
    viewer.handle(events.MouseButton("left", True, x=x, y=y))
    viewer.handle(events.MouseButton("left", False, x=x, y=y))
    viewer.draw()


def test_it_lists_folders_then_models_of_the_folder_of_the_one_that_is_shown(viewer, tmp_path):
    viewer.draw()
    before = viewer.window.shown[-1]
    press(viewer, "O", control=True)
    assert names(viewer) == ["../", "parts/", "tests/", "a.OBJ", "b.obj", "cart.stl"]
    assert chosen(viewer) == "b.obj"
    assert viewer.panel.rows()[-1].detail == f"{len(TRIANGLE)} B"
    assert viewer.panel.heads(0)[0] == "Open a model"
    assert viewer.panel.heads(0)[1].endswith(str(tmp_path)[-60:])
    assert (viewer.window.shown[-1] != before).any(axis=2).sum() > 0.2 * SIZE[0] * SIZE[1]
    press(viewer, "O", control=True)
    assert viewer.panel is None
    viewer.messages.said = ""
    viewer.draw()
    assert (viewer.window.shown[-1] == before).all()


def test_keys_choose_a_file_and_go_through_folders(viewer, tmp_path):
    press(viewer, "O", control=True)
    press(viewer, "Up")
    assert chosen(viewer) == "a.OBJ"
    press(viewer, "Home", "Up")
    assert chosen(viewer) == "../"
    press(viewer, "Down", "Return")
    assert names(viewer) == ["../", "wheel.obj"] and chosen(viewer) == "wheel.obj"
    press(viewer, "Backspace")
    assert chosen(viewer) == "parts/"
    press(viewer, "End", "Down")
    assert chosen(viewer) == "cart.stl"
    press(viewer, "PageUp")
    assert chosen(viewer) == "../"
    press(viewer, "Down", "Return", "Return")
    assert title(viewer) == "wheel.obj" and viewer.panel is None
    press(viewer, "Left")
    assert title(viewer) == "wheel.obj"
    press(viewer, "O", control=True)
    assert viewer.panel.folder == str(tmp_path / "parts")


def test_what_is_typed_narrows_the_list_and_presses_no_other_key(viewer):
    samples = viewer.sampling.fixed
    press(viewer, "O", control=True)
    type_text(viewer, "art")  # A, R and T are keys of the viewer
    assert viewer.sampling.fixed == samples and viewer.view_renderer.settings.textures
    assert names(viewer) == ["parts/", "cart.stl"] and chosen(viewer) == "parts/"
    press(viewer, "Backspace", "Backspace", "Backspace")
    assert len(names(viewer)) == 6
    type_text(viewer, "q.")
    assert viewer.running and names(viewer) == []
    press(viewer, "Return", "Down", "End", "PageDown", "Up")
    assert isinstance(viewer.panel, FolderPanel)
    press(viewer, "Escape")
    assert viewer.panel is None
    press(viewer, "O", control=True)
    type_text(viewer, ".")
    assert {".cache/", ".old.obj"} <= set(names(viewer))


def test_a_folder_that_is_typed_is_gone_to(viewer, tmp_path, home):
    press(viewer, "O", control=True)
    type_text(viewer, f"parts{os.sep}")
    assert viewer.panel.folder == str(tmp_path / "parts") and viewer.panel.filter == ""
    type_text(viewer, "../")
    assert viewer.panel.folder == str(tmp_path)
    type_text(viewer, "~/")
    assert viewer.panel.folder == str(home)
    type_text(viewer, "/nowhere-at-all")
    top = os.path.splitdrive(home)[0] + os.sep  # of the drive, on Windows
    assert viewer.panel.folder == top and viewer.panel.filter == "nowhere-at-all"
    type_text(viewer, "/")
    assert viewer.panel.folder == top and viewer.panel.filter == "nowhere-at-all/"


def test_clicks_enter_folders_and_open_files(viewer):
    press(viewer, "O", control=True)
    click_row(viewer, "parts/")
    assert names(viewer) == ["../", "wheel.obj"]
    click_row(viewer, "../")
    assert chosen(viewer) == "parts/"
    click_row(viewer, "a.OBJ")
    assert title(viewer) == "a.OBJ" and viewer.panel is None
    assert viewer.selected is None and viewer.mouse.drag is None


def test_a_long_folder_scrolls_to_what_the_keys_choose(viewer, tmp_path):
    for number in range(200):
        (tmp_path / "tests" / f"{number:03}.obj").write_text(TRIANGLE)
    press(viewer, "O", control=True)
    click_row(viewer, "tests/")
    press(viewer, "End")
    panel = viewer.panel
    assert chosen(viewer) == "199.obj" and panel._first == 201 - panel._fit
    assert "(201, wheel: more)" in panel.heads(1)[0]
    viewer.handle(events.Wheel(1000, panel._box[0] + 5, panel._box[1] + 50))
    viewer.draw()
    assert panel._first == 0 and chosen(viewer) == "199.obj"
    press(viewer, "Up")
    assert panel._first > 0 and chosen(viewer) == "198.obj"


def test_tab_goes_to_the_files_that_were_opened_before(viewer, tmp_path):
    RecentFiles().add(tmp_path / "cart.stl")
    RecentFiles().add(tmp_path / "parts" / "wheel.obj")
    press(viewer, "O", control=True)
    press(viewer, "Tab")
    assert isinstance(viewer.panel, RecentPanel) and viewer.walker is None
    assert names(viewer) == ["wheel.obj", "cart.stl"]
    type_text(viewer, "stl")
    assert names(viewer) == ["cart.stl"]
    press(viewer, "Tab")
    assert isinstance(viewer.panel, FolderPanel)
    press(viewer, "Escape")
    press(viewer, "O", control=True, shift=True)
    assert isinstance(viewer.panel, RecentPanel)
    press(viewer, "Escape")
    assert viewer.panel is None
    press(viewer, "O", control=True, shift=True)
    press(viewer, "Return")
    assert title(viewer) == "wheel.obj" and viewer.panel is None


def test_escape_closes_every_list_and_keys_of_the_window_still_answer(viewer):
    press(viewer, "O")
    press(viewer, "Escape")
    assert viewer.panel is None
    press(viewer, "O", control=True)
    press(viewer, "F11")
    assert viewer.window.fullscreen and viewer.panel is not None


def test_in_walking_mode_escape_closes_the_dialog_first(viewer):
    press(viewer, "Tab")
    viewer.handle(events.KeyDown("W", "W"))
    press(viewer, "O", control=True)
    assert viewer.held_positions == set()
    type_text(viewer, "w")
    assert viewer.held_positions == set()
    press(viewer, "Escape")
    assert viewer.panel is None and viewer.walker is not None
    press(viewer, "Escape")
    assert viewer.walker is None


def test_a_folder_that_cannot_be_read_says_why(viewer, tmp_path):
    press(viewer, "O", control=True)
    gone = tmp_path / "tests"
    gone.rmdir()
    click_row(viewer, "tests/")
    assert names(viewer) == ["../"] and viewer.panel.heads(0)[-1]
    press(viewer, "Return")
    assert "parts/" in names(viewer)


def test_a_broken_file_leaves_what_is_shown(viewer, tmp_path):
    (tmp_path / "cart.stl").write_text("solid")
    press(viewer, "O", control=True)
    click_row(viewer, "cart.stl")
    assert title(viewer) == "b.obj" and "cart.stl" in viewer.messages.said


def test_without_a_file_it_begins_where_the_program_does(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "b.obj").write_text(TRIANGLE)
    view_renderer = ViewRenderer(open_model(tmp_path / "b.obj"), Settings({}), (64, 64))
    viewer = Viewer(view_renderer, ScriptedWindow(size=(64, 64)))
    press(viewer, "O", control=True)
    assert viewer.panel.folder == str(tmp_path) and "b.obj" in names(viewer)


@pytest.mark.parametrize(
    ("size", "text"), [(0, "0 B"), (999, "999 B"), (12_345, "12.3 kB"), (2 * 10**16, "2e+04 TB")]
)
def test_sizes_are_short(size, text):
    from engine3d.base.files.folder_listing import Item

    assert _size(Item("a", "/a", False, size, 0.0)) == text
