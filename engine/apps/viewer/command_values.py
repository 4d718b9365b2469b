"""The present values of commands, for the list of commands and the bar.

In: a viewer. Out: what a command switches, as it is now; `keymap` names one of these for each
command that has one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from ...base.language import translated, translated_choice, translated_number
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
    return Value(translated("on" if is_on else "off"), is_on)


def option(name: str) -> Present:
    """Return a reader of a drawing option; what is not its default is lit."""

    def present(viewer: Viewer) -> Value:
        value = getattr(viewer.view_renderer.appearance, name)
        return Value(translated_choice(name, str(value or "off")), value != DEFAULTS[name])

    return present


def option_is(name: str, *values: object) -> Present:
    """Return a reader of whether a drawing option has one of these values."""
    return lambda viewer: switch(getattr(viewer.view_renderer.appearance, name) in values)


def setting(name: str) -> Present:
    """Return a reader of a switch among the settings."""
    return lambda viewer: switch(getattr(viewer.view_renderer.settings, name))


def line_width(viewer: Viewer) -> Value:
    return Value(translated_number(viewer.view_renderer.appearance.line_width, "g"))


def lights(viewer: Viewer) -> Value:
    return Value(translated_choice("lights", viewer.view_renderer.lighting.name))


def samples(viewer: Viewer) -> Value:
    fixed = viewer.sampling.fixed
    return Value(translated("automatic") if fixed is None else str(fixed), fixed is not None)


def projection(viewer: Viewer) -> Value:
    is_parallel = viewer.view.orthographic
    return Value(translated("orthographic" if is_parallel else "perspective"), is_parallel)


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
    return Value(translated("playing" if viewer.playing else "paused"), viewer.playing)


def speed(viewer: Viewer) -> Value:
    return Value(f"{translated_number(viewer.speed, 'g')}×", viewer.speed != 1.0)


def time(viewer: Viewer) -> Value:
    is_moving = viewer.view_renderer.viewed.update is not None
    return Value(f"{translated_number(viewer.time, '.2f')} s" if is_moving else "")


def animation(viewer: Viewer) -> Value:
    player = viewer.view_renderer.viewed.player
    if player is None:
        return Value(translated("none"))
    return Value(", ".join(clip.name for clip in player.playing))


def statistics(viewer: Viewer) -> Value:
    if viewer.statistics is None:
        return switch(False)
    return Value(translated("a line" if viewer.statistics == "short" else "all"), True)


def split(viewer: Viewer) -> Value:
    return switch(viewer.view_renderer.split)


def debug_drawing(viewer: Viewer) -> Value:
    drawing = viewer.view_renderer.culling.drawing
    if drawing is None:
        return switch(False)
    return Value(translated_choice("drawing", drawing), True)


def theme(viewer: Viewer) -> Value:
    return Value(translated_choice("theme", viewer.view_renderer.theme.name))


def controls(viewer: Viewer) -> Value:
    return switch(viewer.controls.shown)


def section(viewer: Viewer) -> Value:
    return switch(viewer.inspector.is_cut)


def explosion(viewer: Viewer) -> Value:
    amount = viewer.inspector.amount
    return Value(translated_number(amount, ".2f"), True) if amount else switch(False)


def measured(viewer: Viewer) -> Value:
    return switch(bool(viewer.view_renderer.settings.measured))
