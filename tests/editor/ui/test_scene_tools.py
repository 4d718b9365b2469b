"""The rows of tools above the scene."""

import pytest
from editor.ui.editor_hands import settle

pytest.importorskip(
    "imgui_bundle", reason="it is an extra: pip install -e .[editor]", exc_type=ImportError
)

from imgui_bundle import imgui

from engine3d.apps.editor.ui import scene_tools


class Ruler:
    """Dear ImGui, but that the corners of boxes and buttons are noted."""

    def __init__(self):
        self.corners = []

    def __getattr__(self, name):
        return getattr(imgui, name)

    def _noted(self, shown):
        self.corners.append((imgui.get_item_rect_min().y, imgui.get_item_rect_min().x))
        return shown

    def radio_button(self, label, chosen):
        return self._noted(imgui.radio_button(label, chosen))

    def checkbox(self, label, chosen):
        return self._noted(imgui.checkbox(label, chosen))

    def button(self, label):
        return self._noted(imgui.button(label))

    def combo(self, label, chosen, names):
        return self._noted(imgui.combo(label, chosen, names))


def test_all_rows_of_tools_begin_below_one_another(editor, monkeypatch):
    ruler = Ruler()
    monkeypatch.setattr(scene_tools, "imgui", ruler)
    settle(editor)
    rows = {}
    for y, x in sorted(ruler.corners):
        rows.setdefault(y, x)
    assert len(rows) > 2 and len(set(rows.values())) == 1
