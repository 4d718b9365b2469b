"""The editor at other scales: texts, lengths, thumbnails, saved layouts, whole numbers."""

import re
from importlib.resources import files

import pytest
from editor.ui.editor_hands import SIZE, find, settle
from imgui_bundle import imgui, imguizmo

from engine3d import data, events
from engine3d.apps.editor.ui.editor_window import EditorWindow
from engine3d.apps.editor.ui.panel_layout import layout_path, save_layout
from engine3d.apps.editor.ui.resources_panel import PICTURE
from engine3d.apps.editor.ui.style import FONT_PIXELS, scaled
from engine3d.apps.editor.ui.translated_imgui import imgui as translated_imgui
from engine3d.apps.editor.ui.workspace import PANELS


@pytest.fixture
def opened(monkeypatch, tmp_path):
    """What opens an editor at a scale, with a train in it."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    for variable in ("XDG_STATE_HOME", "XDG_CACHE_HOME"):
        monkeypatch.setenv(variable, str(tmp_path / variable))
    editors = []

    def open_at(scale, size=SIZE):
        path = str(files(data) / "models" / "train.asc")
        editors.append(EditorWindow(path, size=size, ui_scale=scale))
        editors[-1]._scene._draw_times = lambda corner: None
        settle(editors[-1])
        return editors[-1]

    yield open_at
    for editor in editors:
        editor.close()


def lengths():
    style = imgui.get_style()
    return [*style.frame_padding, *style.item_spacing, style.scrollbar_size, style.grab_min_size]


@pytest.mark.parametrize("scale", [0.75, 1.25, 1.5, 2.0])
def test_texts_lengths_and_thumbnails_have_the_scale(opened, scale):
    usual = opened(1.0)
    plain, arrow = lengths(), imguizmo.im_guizmo.get_style().translation_line_arrow_size
    usual.close()
    editor = opened(scale)
    fonts, lay_out = set(), editor._files.draw
    editor._files.draw = lambda: (fonts.add(imgui.get_font_size()), lay_out())
    settle(editor)
    assert fonts == {round(scale * FONT_PIXELS)}
    for small, large in zip(plain, lengths(), strict=True):
        assert abs(large - scale * small) <= 1
    assert imguizmo.im_guizmo.get_style().translation_line_arrow_size == scale * arrow
    material = editor.workspace.resources.entries()[0].thing
    side = round(scale * PICTURE)
    assert editor._panels["Resources"]._thumbnails._thumbnails.get(material).shape == (
        side,
        side,
        4,
    )
    assert scaled(8.0) == round(8 * scale)


def test_the_editor_follows_its_window_to_another_screen(opened):
    editor = opened(1.0)
    before, plain = settle(editor), lengths()
    for scale in (2.0, 1.0):
        editor.window._ui_scale = scale
        editor._take(events.Exposed())
        shown = settle(editor)
        assert imgui.get_style().font_scale_dpi == scale
    assert lengths() == plain
    assert (shown == before).all()


@pytest.mark.parametrize(("scale", "size"), [(1.0, (1000, 640)), (2.0, (1024, 700))])
def test_numbers_of_properties_are_not_cut(opened, scale, size, monkeypatch):
    editor, asked, rooms = opened(scale, size), translated_imgui.drag_float, []

    def drag(label, value, *others):
        rooms.append(imgui.calc_item_width() - 2 * imgui.get_style().frame_padding.x)
        rooms.append(imgui.calc_text_size("0.000").x)
        return asked(label, value, *others)

    monkeypatch.setattr(translated_imgui, "drag_float", drag)
    editor.workspace.document.selection.set([find(editor, "Boiler")])
    settle(editor)
    assert rooms and all(room > text for room, text in zip(rooms[::2], rooms[1::2], strict=True))


def saved_sizes(opened, scale, size):
    """The sizes of the panels that an editor keeps when it is closed."""
    editor = opened(scale, size)
    save_layout(editor.workspace)
    editor.close()
    text = layout_path().read_text("utf-8")
    found = re.findall(r"\[Window\]\[(\w+)\]\nPos=\S+\nSize=(\d+),(\d+)", text)
    return {name: (int(wide), int(high)) for name, wide, high in found if name in PANELS}


@pytest.mark.parametrize("scale", [1.5, 2.0])
def test_a_layout_is_enlarged_for_a_finer_screen(opened, scale):
    small = saved_sizes(opened, 1.0, (500, 360))
    assert set(small) == set(PANELS)
    large = saved_sizes(opened, scale, (round(500 * scale), round(360 * scale)))
    for name, size in large.items():
        assert [side / scale for side in size] == pytest.approx(small[name], abs=6)


def test_a_layout_of_a_wider_window_is_not_used(opened):
    usual = saved_sizes(opened, 1.0, (700, 500))
    layout_path().unlink()
    saved_sizes(opened, 1.0, SIZE)
    assert saved_sizes(opened, 1.0, (700, 500)) == usual


def test_a_layout_too_wide_for_the_screen_is_not_used(opened):
    saved_sizes(opened, 1.0, SIZE)
    sizes = saved_sizes(opened, 2.0, SIZE)
    assert all(sizes[name][0] < SIZE[0] / 2 for name in ("Hierarchy", "Scene", "Properties"))
    assert sizes["Scene"][0] > SIZE[0] / 4
