"""Keys of a `Visualizer`'s window: GLFW's numbers, and what Open3D does at each.

In: events of the engine's window. Out: changes of the view and of the options. The keys are those
of Open3D's VisualizerCallback.cpp.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ._color_maps import choose_map
from ._loading import load

if TYPE_CHECKING:
    from .visualizer import Visualizer

RELEASE, PRESS, REPEAT = 0, 1, 2
SHIFT, CONTROL = 1, 2
_NAMED = {
    "Space": 32,
    **{name: 256 + number for number, name in enumerate(("Escape", "Return", "Tab", "Backspace"))},
    **{
        name: 260 + number
        for number, name in enumerate(
            (
                *("Insert", "Delete", "Right", "Left", "Down", "Up"),
                *("PageUp", "PageDown", "Home", "End"),
            )
        )
    },
    "CapsLock": 280,
    "ScrollLock": 281,
    "Numlock": 282,
    "PrintScreen": 283,
    "Pause": 284,
    **{f"F{number}": 289 + number for number in range(1, 26)},
    **{f"Keypad {number}": 320 + number for number in range(10)},
    **{
        f"Keypad {name}": number
        for name, number in ((".", 330), ("/", 331), ("*", 332), ("-", 333), ("+", 334))
    },
    "Keypad Enter": 335,
    **{
        name: 340 + number
        for number, name in enumerate(
            (
                *("Left Shift", "Left Ctrl", "Left Alt", "Left GUI"),
                *("Right Shift", "Right Ctrl", "Right Alt", "Right GUI"),
            )
        )
    },
}
#: The colour options of Open3D's number keys.
_COLORS = {48: "Default", 49: "Color", 50: "XCoordinate", 51: "YCoordinate", 52: "ZCoordinate"}
_NORMAL = 57
_POINT_SIZES = 1.0, 25.0
_LINE_WIDTHS = 1.0, 10.0


def key_number(position: str) -> int | None:
    """Return GLFW's number of a key, named by its position as in `engine3d.events`."""
    if position in _NAMED:
        return _NAMED[position]
    return ord(position) if len(position) == 1 and 39 <= ord(position) <= 96 else None


def press(visualizer: Visualizer, key: int, mods: int) -> None:
    """Do what Open3D does when a key is pressed."""
    if key in _COLORS or key == _NORMAL:
        _color(visualizer, key, mods)
    elif key in _KEYS:
        _KEYS[key](visualizer, mods)
    visualizer.update_renderer()


def _color(visualizer: Visualizer, key: int, mods: int) -> None:
    option, visualization = visualizer.get_render_option(), load().visualization
    name = _COLORS.get(key, "Normal")
    if mods & CONTROL:
        option.mesh_color_option = getattr(visualization.MeshColorOption, name)
    elif mods & SHIFT:
        if key in _COLORS:
            choose_map(key - 48)
    else:
        option.point_color_option = getattr(visualization.PointColorOption, name)
    visualizer.update_geometry()


def _toggle(name: str) -> Callable[[Visualizer, int], None]:
    def change(visualizer: Visualizer, mods: int) -> None:
        option = visualizer.get_render_option()
        setattr(option, name, not getattr(option, name))
        if name == "point_show_normal":
            visualizer.update_geometry()

    return change


def _shading(visualizer: Visualizer, mods: int) -> None:
    option, shades = visualizer.get_render_option(), load().visualization.MeshShadeOption
    is_flat = option.mesh_shade_option == shades.Default
    option.mesh_shade_option = shades.Color if is_flat else shades.Default
    visualizer.update_geometry()


def _size(step: float) -> Callable[[Visualizer, int], None]:
    def change(visualizer: Visualizer, mods: int) -> None:
        option = visualizer.get_render_option()
        if mods & SHIFT:
            low, high = _LINE_WIDTHS
            option.line_width = min(max(option.line_width + step, low), high)
            return
        low, high = _POINT_SIZES
        option.point_size = min(max(option.point_size + step, low), high)
        if option.point_show_normal:
            visualizer.update_geometry()

    return change


def _lens(step: float) -> Callable[[Visualizer, int], None]:
    return lambda visualizer, mods: visualizer.get_view_control().change_field_of_view(step)


def _save_options(visualizer: Visualizer, mods: int) -> None:
    stamp = time.strftime("%Y-%m-%d-%H-%M-%S")
    visualizer.get_render_option().save_to_json(f"RenderOption_{stamp}.json")


def _copy(visualizer: Visualizer, mods: int) -> None:
    if mods & CONTROL:
        visualizer._window.clipboard = visualizer.get_view_status()


def _paste(visualizer: Visualizer, mods: int) -> None:
    if mods & CONTROL:
        visualizer.set_view_status(visualizer._window.clipboard)


def _help(visualizer: Visualizer, mods: int) -> None:
    print(
        "Drag turns, with Ctrl or the wheel's button it moves, with Shift it rolls; the wheel "
        "zooms.\n"
        "[ ] lens   R first view   Ctrl+C, Ctrl+V view as text   Q, Esc close\n"
        "P picture   D depths   O options, into files\n"
        "L light   + - points   Shift and + - lines   N normals   S smooth   W wires   B backs\n"
        "0 to 4, 9 colours of points, with Ctrl of meshes, with Shift colour maps"
    )


_KEYS: dict[int, Callable[[Visualizer, int], Any]] = {
    91: _lens(-1.0),
    93: _lens(1.0),
    ord("R"): lambda visualizer, mods: visualizer.reset_view_point(),
    ord("C"): _copy,
    ord("V"): _paste,
    256: lambda visualizer, mods: visualizer.close(),
    ord("Q"): lambda visualizer, mods: visualizer.close(),
    ord("H"): _help,
    ord("P"): lambda visualizer, mods: visualizer.capture_screen_image("", True),
    283: lambda visualizer, mods: visualizer.capture_screen_image("", True),
    ord("D"): lambda visualizer, mods: visualizer.capture_depth_image("", True),
    ord("O"): _save_options,
    ord("L"): _toggle("light_on"),
    ord("="): _size(1.0),
    ord("-"): _size(-1.0),
    ord("N"): _toggle("point_show_normal"),
    ord("S"): _shading,
    ord("W"): _toggle("mesh_show_wireframe"),
    ord("B"): _toggle("mesh_show_back_face"),
}
