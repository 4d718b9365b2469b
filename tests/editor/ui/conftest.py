"""An editor with a train in it, in a window that nobody sees."""

from importlib.resources import files

import pytest

from engine3d import data


@pytest.fixture
def editor(monkeypatch, tmp_path):
    from editor.ui.editor_hands import SIZE, settle  # which skip the tests that lack the extra
    from imgui_bundle import imgui

    from engine3d.apps.editor.ui.editor_window import EditorWindow

    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    for variable in ("XDG_STATE_HOME", "XDG_CACHE_HOME"):
        monkeypatch.setenv(variable, str(tmp_path / variable))
    path = files(data) / "models" / "train.asc"
    with EditorWindow(str(path), size=SIZE) as editor:
        editor.window.present = lambda pixels: None  # nobody looks, and nobody waits for a screen
        editor._scene._overlays.shown |= dict.fromkeys(
            ("icons", "names", "outlines", "grid", "preview", "ball"), False
        )
        editor._scene._draw_times = lambda corner: None
        imgui.get_io().key_repeat_delay = 1e9  # a busy machine holds no key
        settle(editor)
        yield editor
