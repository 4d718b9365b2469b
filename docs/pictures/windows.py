"""Draws what the viewer's window shows, without a screen.

In: the viewer, and models of data/models. Out: what the viewer presents to a window, with its
bar, lists and menus. screens.py has whole windows of all programs.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from places import MODELS

from engine3d.apps import events
from engine3d.apps.cli.options.picture_options import WINDOW
from engine3d.apps.cli.options.scene_options import viewed_scene
from engine3d.apps.cli.options.shared_options import viewing
from engine3d.apps.cli.parser import parse
from engine3d.apps.cli.verbose_report import Report
from engine3d.apps.viewer.sampling import AT_REST
from engine3d.apps.viewer.viewer import Viewer
from engine3d.base.language import speaking

#: Of the viewer's windows that pages show.
SHOWN_SIZE = (1280, 640)


class Glass:
    """What the programs ask of a window, and the last picture that it was given."""

    minimised, writes_text, title = False, False, ""

    def __init__(self, size: tuple[int, int], scale: float = 1.0) -> None:
        self.size, self.scale = size, scale

    def present(self, pixels: np.ndarray) -> None:
        self.pixels = pixels.copy()

    def key_at(self, position: str) -> str:
        return position

    def events(self, timeout: float) -> list:
        """Nothing happens until the program waits for it; then the window is closed."""
        return [events.CloseRequested()] if timeout else []


def in_a_viewer(name: str, use: Callable[[Viewer], object], glass: Glass) -> np.ndarray:
    """Return the window of ``engine3d run`` with a model, after a function has used the viewer."""
    given = parse(["run", str(MODELS / name)])
    asked = viewing(given)
    with asked.renderer(
        viewed_scene(given), glass.size, (WINDOW, AT_REST), Report(False)
    ) as view_renderer:
        viewer = Viewer(view_renderer, glass, view=asked.first_view.place(view_renderer))
        viewer.controls.shown = True
        viewer.draw()
        use(viewer)
        viewer.messages.said = ""
        viewer.draw()
        return glass.pixels


def viewer_help() -> np.ndarray:
    """The list of all commands, with what they are at present."""

    def open_list(viewer: Viewer) -> None:
        viewer.perform("toggle_edges")
        viewer.perform("toggle_help")

    return in_a_viewer("train.asc", open_list, Glass(SHOWN_SIZE))


def viewer_bar() -> np.ndarray:
    """The bar with an open menu, and the ball of axes."""

    def open_menu(viewer: Viewer) -> None:
        viewer.perform("cycle_wireframe")
        button = next(one for one in viewer.controls.buttons if one.text == "View")
        viewer.controls.open_menu(button)

    return in_a_viewer("island.obj", open_menu, Glass(SHOWN_SIZE))


def french() -> np.ndarray:
    """The list of all commands in French."""
    with speaking("fr"):
        return in_a_viewer(
            "island.obj", lambda viewer: viewer.perform("toggle_help"), Glass(SHOWN_SIZE)
        )


WINDOWS = {"viewer_help": viewer_help, "viewer_bar": viewer_bar, "french": french}
