"""The present values of commands, for the list of commands and the bar.

In: a viewer. Out: what a command switches, as it is now; `keymap` names one of these for each
command that has one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from ...stage.appearance import DEFAULTS

if TYPE_CHECKING:
    from .viewer import Viewer


class Value(NamedTuple):
    """What a command switches, in a word or two, and whether it is lit up as on."""

    text: str
    is_lit: bool = False


#: Returns the present value of a command.
Present: TypeAlias = "Callable[[Viewer], Value]"


def switch(is_on: bool) -> Value:
    """Return the value of what is on or off."""
    return Value("on" if is_on else "off", is_on)


def option(name: str) -> Present:
    """Return a reader of a drawing option; what is not its default is lit."""

    def present(viewer: Viewer) -> Value:
        value = getattr(viewer.view_renderer.appearance, name)
        return Value(str(value or "off"), value != DEFAULTS[name])

    return present


def option_is(name: str, *values: object) -> Present:
    """Return a reader of whether a drawing option has one of these values."""
    return lambda viewer: switch(getattr(viewer.view_renderer.appearance, name) in values)


def setting(name: str) -> Present:
    """Return a reader of a switch among the settings."""
    return lambda viewer: switch(getattr(viewer.view_renderer.settings, name))


def line_width(viewer: Viewer) -> Value:
    return Value(f"{viewer.view_renderer.appearance.line_width:g}")


def lights(viewer: Viewer) -> Value:
    return Value(viewer.view_renderer.lighting.name)


def samples(viewer: Viewer) -> Value:
    fixed = viewer.sampling.fixed
    return Value("automatic" if fixed is None else str(fixed), fixed is not None)


def projection(viewer: Viewer) -> Value:
    is_parallel = viewer.view.orthographic
    return Value("orthographic" if is_parallel else "perspective", is_parallel)


def up_axis(letter: str) -> Present:
    """Return a reader of which way along an axis is up, if one is."""

    def present(viewer: Viewer) -> Value:
        up = viewer.view_renderer.staging.up
        return Value(up, True) if up[1] == letter else Value("")

    return present


def walking(viewer: Viewer) -> Value:
    return switch(viewer.walker is not None)


def frozen(viewer: Viewer) -> Value:
    return switch(viewer.view_renderer.culling.camera is not None)


def playing(viewer: Viewer) -> Value:
    return Value("playing" if viewer.playing else "paused", viewer.playing)


def speed(viewer: Viewer) -> Value:
    return Value(f"{viewer.speed:g}×", viewer.speed != 1.0)


def time(viewer: Viewer) -> Value:
    is_moving = viewer.view_renderer.viewed.update is not None
    return Value(f"{viewer.time:.2f} s" if is_moving else "")


def animation(viewer: Viewer) -> Value:
    player = viewer.view_renderer.viewed.player
    if player is None:
        return Value("none")
    return Value(", ".join(clip.name for clip in player.playing))


def statistics(viewer: Viewer) -> Value:
    names = {None: "off", "short": "a line", "long": "all"}
    return Value(names[viewer.statistics], viewer.statistics is not None)


def split(viewer: Viewer) -> Value:
    return switch(viewer.view_renderer.split)


def debug_drawing(viewer: Viewer) -> Value:
    drawing = viewer.view_renderer.culling.drawing
    return Value(drawing or "off", drawing is not None)


def theme(viewer: Viewer) -> Value:
    return Value(viewer.view_renderer.theme.name)


def controls(viewer: Viewer) -> Value:
    return switch(viewer.controls.shown)


def section(viewer: Viewer) -> Value:
    return switch(viewer.inspector.is_cut)


def explosion(viewer: Viewer) -> Value:
    amount = viewer.inspector.amount
    return Value(f"{amount:.2f}" if amount else "off", amount != 0.0)


def measured(viewer: Viewer) -> Value:
    return switch(bool(viewer.view_renderer.settings.measured))
