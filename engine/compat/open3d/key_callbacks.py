"""Open3D's `VisualizerWithKeyCallback`: keys and the mouse call functions of a program."""

from __future__ import annotations

from collections.abc import Callable

from ._keys import RELEASE
from .visualizer import Visualizer


class VisualizerWithKeyCallback(Visualizer):
    """A `Visualizer` whose keys and mouse may call functions.

    Each function gets the visualizer first, and returns whether geometries have changed. Keys are
    GLFW's numbers: letters and digits as `ord` has them, 256 is Escape.
    """

    def __init__(self) -> None:
        super().__init__()
        self._on_keys: dict[int, Callable] = {}
        self._on_actions: dict[int, Callable] = {}
        self._on_move: Callable | None = None
        self._on_scroll: Callable | None = None
        self._on_button: Callable | None = None

    def register_key_callback(self, key: int, callback_func) -> None:
        """Call ``callback_func(vis)`` when a key goes down, instead of what it does else."""
        self._on_keys[int(key)] = callback_func

    def register_key_action_callback(self, key: int, callback_func) -> None:
        """Call ``callback_func(vis, action, mods)``; action 0 is up, 1 is down, 2 a repeat."""
        self._on_actions[int(key)] = callback_func

    def register_mouse_move_callback(self, callback_func) -> None:
        """Call ``callback_func(vis, x, y)`` when the mouse moves, in pixels from the top left."""
        self._on_move = callback_func

    def register_mouse_scroll_callback(self, callback_func) -> None:
        """Call ``callback_func(vis, x, y)`` when the wheel turns, by steps."""
        self._on_scroll = callback_func

    def register_mouse_button_callback(self, callback_func) -> None:
        """Call ``callback_func(vis, button, action, mods)``; 0 is left, 1 right, 2 the wheel."""
        self._on_button = callback_func

    def _call(self, function: Callable, *given: object) -> None:
        if function(self, *given):
            self.update_geometry()
        self.update_renderer()

    def _key(self, key: int, action: int, mods: int) -> None:
        if key in self._on_actions:
            self._call(self._on_actions[key], action, mods)
        elif key in self._on_keys:
            if action != RELEASE:
                self._call(self._on_keys[key])
        else:
            super()._key(key, action, mods)

    def _mouse_moved(self, x: float, y: float, dx: float, dy: float) -> None:
        if self._on_move is not None:
            self._call(self._on_move, float(x), float(y))
        else:
            super()._mouse_moved(x, y, dx, dy)

    def _scrolled(self, x: float, y: float) -> None:
        if self._on_scroll is not None:
            self._call(self._on_scroll, x, y)
        else:
            super()._scrolled(x, y)

    def _mouse_button(self, button: int, action: int, mods: int) -> None:
        if self._on_button is not None:
            self._call(self._on_button, button, action, mods)
        else:
            super()._mouse_button(button, action, mods)
