"""The commands of the viewer: the only list of them, for keys, the list of commands and the bar.

A key is named by what it types ("W"), as in SDL; walking keys are read by position and defined in
`fps`. Digits also work by position, for keyboards that type them with Shift.
"""

from __future__ import annotations

from typing import NamedTuple

from . import command_values as now
from .command_values import Present


class Binding(NamedTuple):
    """A command: its keys, the action of `actions` that they call, its name in lists.

    Attributes
    ----------
    keys : tuple of str
    action, help : str
    value : callable, optional
        Returns what it switches, as it is now.
    button : str
        Its name on the bar; empty if it is not there.
    """

    keys: tuple[str, ...]
    action: str
    help: str
    value: Present | None = None
    button: str = ""


#: The commands, by theme.
SECTIONS = {
    "Drawing": (
        Binding(("W",), "cycle_wireframe", "wireframe", now.option("wireframe"), "Wireframe"),
        Binding(
            ("E",), "toggle_edges", "edges over the faces", now.option_is("wireframe", "overlay")
        ),
        Binding(("M",), "cycle_mode", "drawing mode", now.option("mode")),
        Binding(
            ("N",), "toggle_normals_mode", "normals as colours", now.option_is("mode", "normal")
        ),
        Binding(("U",), "toggle_unlit", "without light", now.option_is("mode", "unlit")),
        Binding(("T",), "toggle_textures", "textures", now.setting("textures")),
        Binding(("L",), "cycle_lights", "lights", now.lights),
        Binding(("Shift+Home",), "light_left", "light to the left"),
        Binding(("Shift+End",), "light_right", "light to the right"),
        Binding(("Shift+PageUp",), "light_up", "light up"),
        Binding(("Shift+PageDown",), "light_down", "light down"),
        Binding(
            ("Ctrl+L",),
            "toggle_occlusion",
            "ambient occlusion",
            now.option_is("ambient_occlusion", True),
        ),
        Binding(("Ctrl+T",), "cycle_tone_mapping", "tone mapping", now.option("tone_mapping")),
        Binding(("F",), "toggle_flat", "normals: flat, facet, smooth", now.option("normals")),
        Binding(("B",), "cycle_cull", "faces that are culled", now.option("cull")),
        Binding(("Y",), "cycle_culling", "culling before drawing", now.option("culling")),
        Binding(("V",), "cycle_hidden_surfaces", "hidden surfaces", now.option("hidden_surfaces")),
        Binding(("A",), "cycle_samples", "samples per pixel", now.samples),
        Binding(("+", "="), "widen_lines", "wider lines and points", now.line_width),
        Binding(("-",), "narrow_lines", "thinner lines and points", now.line_width),
    ),
    "View": (
        Binding(("1",), "view_front", "front"),
        Binding(("3",), "view_right", "right"),
        Binding(("7",), "view_top", "top"),
        Binding(("9",), "view_isometric", "isometric"),
        Binding(("5",), "toggle_orthographic", "projection", now.projection),
        Binding(("4",), "quarter_left", "a quarter to the left"),
        Binding(("6",), "quarter_right", "a quarter to the right"),
        Binding(("8",), "quarter_up", "a quarter up"),
        Binding(("2",), "quarter_down", "a quarter down"),
        Binding(("Shift+Left",), "orbit_left", "turn left"),
        Binding(("Shift+Right",), "orbit_right", "turn right"),
        Binding(("Shift+Up",), "orbit_up", "turn up"),
        Binding(("Shift+Down",), "orbit_down", "turn down"),
        Binding(("Ctrl+Shift+Left",), "pan_left", "move left"),
        Binding(("Ctrl+Shift+Right",), "pan_right", "move right"),
        Binding(("Ctrl+Shift+Up",), "pan_up", "move up"),
        Binding(("Ctrl+Shift+Down",), "pan_down", "move down"),
        Binding(("Ctrl++", "Ctrl+="), "zoom_in", "zoom in"),
        Binding(("Ctrl+-",), "zoom_out", "zoom out"),
        Binding(("Ctrl+Y",), "turn_y_up", "Y is up (Shift: -Y)", now.up_axis("Y")),
        Binding(("Ctrl+Z",), "turn_z_up", "Z is up (Shift: -Z)", now.up_axis("Z")),
        Binding(("R", "Return", "Enter"), "reset_view", "reset"),
        Binding(("Tab",), "toggle_walking", "walk, by keys and mouse", now.walking),
        Binding(("C",), "freeze_culling", "while held: cull, count as from here", now.frozen),
    ),
    "Motion": (
        Binding(("Space",), "toggle_playing", "pause or play", now.playing, "Play"),
        Binding(("J",), "cycle_animations", "animation", now.animation),
        Binding(("Ctrl+Right",), "later", "later", now.time),
        Binding(("Ctrl+Left",), "earlier", "earlier", now.time),
        Binding(("Ctrl+Up",), "play_faster", "faster", now.speed),
        Binding(("Ctrl+Down",), "play_slower", "slower", now.speed),
    ),
    "Overlays": (
        Binding(("H", "F1", "/"), "toggle_help", "all commands", None, "Help"),
        Binding(("Z",), "cycle_statistics", "statistics", now.statistics),
        Binding(("I",), "toggle_metadata", "what the file holds", now.setting("metadata")),
        Binding(("G",), "toggle_grid", "grid", now.setting("grid")),
        Binding(("X",), "toggle_axes", "axes", now.setting("axes")),
        Binding(("Shift+X",), "toggle_axes_grid", "grid with numbers", now.setting("axes_grid")),
        Binding(("S",), "toggle_split", "nine outputs side by side", now.split),
        Binding(("D",), "cycle_debug", "boxes, tree of boxes, frustum", now.debug_drawing),
        Binding(("O",), "cycle_lists", "lists: objects, materials"),
        Binding(("K",), "cycle_theme", "dark or light", now.theme),
    ),
    "Inspection": (
        Binding(("P",), "toggle_pointing", "point by keys"),
        Binding(("Ctrl+X",), "toggle_section", "section: cut by a plane", now.section),
        Binding(("Ctrl+E",), "toggle_explosion", "explode: parts apart", now.explosion),
        Binding(("Ctrl+M",), "toggle_measuring", "measure by clicks or keys", now.measured),
        Binding(("Ctrl+B",), "toggle_dimensions", "box with dimensions", now.setting("dimensions")),
    ),
    "Files": (
        Binding(("Ctrl+O",), "open_file", "open (Shift: opened before)", None, "Open"),
        Binding(("Right", "PageDown"), "next_file", "next model of the folder"),
        Binding(("Left", "PageUp"), "previous_file", "the one before"),
        Binding(("Up",), "load_again", "load the model again"),
    ),
    "Window": (
        Binding(("F10",), "toggle_controls", "bar, ball of axes, time line", now.controls),
        Binding(("F11",), "toggle_fullscreen", "full screen"),
        Binding(("F12",), "save_screenshot", "screenshot", None, "Picture"),
        Binding(("Ctrl+F12",), "save_turntable", "a turn, to a GIF"),
        Binding(("Q",), "quit", "quit"),
    ),
}
BINDINGS = tuple(binding for section in SECTIONS.values() for binding in section)

#: Mouse gestures, for the list of commands.
GESTURES = (
    ("left drag", "orbit"),
    ("click", "select what is there"),
    ("double click", "turn round what is there"),
    ("wheel", "zoom there (also middle drag)"),
    ("right drag", "pan (also Shift+left)"),
    ("Shift+right", "turn the light"),
    ("drop", "open files"),
)
#: Walking, for the same: positions of keys, as on a US keyboard, and what they do.
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
REPEATED = (
    "orbit_left",
    "orbit_right",
    "orbit_up",
    "orbit_down",
    "later",
    "earlier",
    "pan_left",
    "pan_right",
    "pan_up",
    "pan_down",
    "light_left",
    "light_right",
    "light_up",
    "light_down",
    "zoom_in",
    "zoom_out",
)

_ACTIONS = {key: binding.action for binding in BINDINGS for key in binding.keys}
#: Commands by signs that some layouts type with Shift and another key.
TYPED_KEYS = {"/": "toggle_help"}


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
        Whether Ctrl is held: only keys named with ``"Ctrl+"`` or ``"Ctrl+Shift+"`` answer then.
    shift : bool
        Whether Shift is held: keys named with ``"Shift+"`` answer before those without.
    """
    if control:
        shifted = _ACTIONS.get(f"Ctrl+Shift+{key}") if shift else None
        return shifted or _ACTIONS.get(f"Ctrl+{key}")
    if shift and f"Shift+{key}" in _ACTIONS:
        return _ACTIONS[f"Shift+{key}"]
    action = _ACTIONS.get(key.removeprefix("Keypad "))
    if action is None and position.isdigit():
        action = _ACTIONS.get(position)
    return action
