"""The keymap: the only list of keys, for the loop and the help.

A key is named by what it types ("W"), as in SDL; walking keys are read by position and defined in
`fps`. Digits also work by position, for keyboards that type them with Shift.
"""

from __future__ import annotations

from typing import NamedTuple


class Binding(NamedTuple):
    """Keys bound to one action of `actions`, and their help text."""

    keys: tuple[str, ...]
    action: str
    help: str


#: The bindings, by theme.
SECTIONS = {
    "Drawing": (
        Binding(("W",), "cycle_wireframe", "wireframe: off, overlay, only"),
        Binding(("E",), "toggle_edges", "edges over the faces"),
        Binding(("M",), "cycle_mode", "next drawing mode (Shift: previous)"),
        Binding(("N",), "toggle_normals_mode", "normals as colours"),
        Binding(("U",), "toggle_unlit", "with or without light"),
        Binding(("T",), "toggle_textures", "with or without textures"),
        Binding(("L",), "cycle_lights", "next lights (Shift: previous)"),
        Binding(("Ctrl+L",), "toggle_occlusion", "ambient occlusion"),
        Binding(("Ctrl+T",), "cycle_tone_mapping", "next tone mapping (Shift: previous)"),
        Binding(("F",), "toggle_flat", "flat, facets or smooth"),
        Binding(("B",), "cycle_cull", "cull back faces, front faces, none"),
        Binding(("Y",), "cycle_culling", "what is left out before drawing"),
        Binding(("V",), "cycle_hidden_surfaces", "depth buffer, painter, neither"),
        Binding(("A",), "cycle_samples", "samples: as time allows, 1, 4, 16"),
        Binding(("+", "="), "widen_lines", "wider lines and points"),
        Binding(("-",), "narrow_lines", "thinner lines and points"),
    ),
    "View": (
        Binding(("1",), "view_front", "front"),
        Binding(("3",), "view_right", "right"),
        Binding(("7",), "view_top", "top"),
        Binding(("9",), "view_isometric", "isometric"),
        Binding(("5",), "toggle_orthographic", "orthographic or perspective"),
        Binding(("4",), "quarter_left", "a quarter to the left"),
        Binding(("6",), "quarter_right", "a quarter to the right"),
        Binding(("8",), "quarter_up", "a quarter up"),
        Binding(("2",), "quarter_down", "a quarter down"),
        Binding(("Shift+Left",), "orbit_left", "turn left"),
        Binding(("Shift+Right",), "orbit_right", "turn right"),
        Binding(("Shift+Up",), "orbit_up", "turn up"),
        Binding(("Shift+Down",), "orbit_down", "turn down"),
        Binding(("Ctrl+Y",), "turn_y_up", "+Y is up (Shift: -Y)"),
        Binding(("Ctrl+Z",), "turn_z_up", "+Z is up (Shift: -Z)"),
        Binding(("R", "Return", "Enter"), "reset_view", "reset"),
        Binding(("Tab",), "toggle_walking", "walk, by keys and mouse"),
        Binding(("C",), "freeze_culling", "while held: cull, count as from here"),
        Binding(("Space",), "toggle_playing", "pause or play"),
        Binding(("J",), "cycle_animations", "next animation (Shift: previous)"),
    ),
    "Overlays": (
        Binding(("H",), "toggle_help", "this help"),
        Binding(("Z",), "cycle_statistics", "speed: a line, all, off"),
        Binding(("I",), "toggle_metadata", "what the file holds"),
        Binding(("G",), "toggle_grid", "grid"),
        Binding(("X",), "toggle_axes", "axes"),
        Binding(("Shift+X",), "toggle_axes_grid", "grid with numbers"),
        Binding(("S",), "toggle_split", "nine outputs side by side"),
        Binding(("D",), "cycle_debug", "boxes, tree of boxes, frustum"),
        Binding(("O",), "cycle_lists", "objects, materials: hide, show"),
        Binding(("K",), "cycle_theme", "dark or light"),
    ),
    "Inspection": (
        Binding(("Ctrl+X",), "toggle_section", "section: cut by a plane"),
        Binding(("Ctrl+E",), "toggle_explosion", "explode: parts apart"),
        Binding(("Ctrl+M",), "toggle_measuring", "measure by clicks"),
        Binding(("Ctrl+B",), "toggle_dimensions", "box with dimensions"),
    ),
    "Files": (
        Binding(("Ctrl+O",), "open_file", "open (Shift: opened before)"),
        Binding(("Right", "PageDown"), "next_file", "next model of the folder"),
        Binding(("Left", "PageUp"), "previous_file", "the one before"),
        Binding(("Up",), "load_again", "load the model again"),
    ),
    "Window": (
        Binding(("F11",), "toggle_fullscreen", "full screen"),
        Binding(("F12",), "save_screenshot", "screenshot"),
        Binding(("Ctrl+F12",), "save_turntable", "a turn, to a GIF"),
        Binding(("Q",), "quit", "quit"),
    ),
}
BINDINGS = tuple(binding for section in SECTIONS.values() for binding in section)

#: Mouse gestures, for the help.
GESTURES = (
    ("left drag", "orbit"),
    ("click", "select what is there"),
    ("double click", "turn round what is there"),
    ("wheel", "zoom there (also middle drag)"),
    ("right drag", "pan (also Shift+left)"),
    ("Shift+right", "turn the light"),
    ("drop", "open files"),
)
#: Walking, for the help: positions of keys, as on a US keyboard, and what they do.
WALKING = (
    (("W", "A", "S", "D"), "walk"),
    (("E", "Q"), "up, down, without a ground"),
)
WALKING_GESTURES = (
    ("mouse, arrows", "look around"),
    ("Shift", "faster"),
    ("wheel", "speed"),
    ("Tab Escape", "orbit again"),
)
#: Actions that repeat while their key is held.
REPEATED = ("orbit_left", "orbit_right", "orbit_up", "orbit_down")

_ACTIONS = {key: binding.action for binding in BINDINGS for key in binding.keys}


def action_for(
    key: str, position: str = "", control: bool = False, shift: bool = False
) -> str | None:
    """Return the action bound to a key, or None.

    Parameters
    ----------
    key : str
        What the key types, e.g. ``"W"``, ``"Return"``, ``"Keypad 7"``.
    position : str
        What the key would type on a US keyboard; asked only for digits.
    control : bool
        Whether Ctrl is held: only keys named with ``"Ctrl+"`` answer then.
    shift : bool
        Whether Shift is held: keys named with ``"Shift+"`` answer before those without.
    """
    if control:
        return _ACTIONS.get(f"Ctrl+{key}")
    if shift and f"Shift+{key}" in _ACTIONS:
        return _ACTIONS[f"Shift+{key}"]
    action = _ACTIONS.get(key.removeprefix("Keypad "))
    if action is None and position.isdigit():
        action = _ACTIONS.get(position)
    return action
