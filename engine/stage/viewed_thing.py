"""Makes a viewed scene of a program's scene, node or mesh."""

from __future__ import annotations

from collections.abc import Callable

from ..base.numbers import real, shown
from ..errors import InvalidArgumentError
from .coloring import show_numbers
from .numbers import NO_MARKS, Marks
from .overlays.theme import DARK
from .played_clips import play_clips
from .scenes_of_things import scene_of
from .viewed_scene import ViewedScene
from .views.viewpoint import UP_DIRECTIONS


def viewed_thing(
    thing: object,
    *,
    title: str | None,
    up: str,
    update: Callable[[float], None] | None,
    period: float,
    marks: Marks = NO_MARKS,
) -> ViewedScene | None:
    """Return the viewed scene that `show` displays for a thing; None for unsuitable things."""
    scene = scene_of(thing)
    if scene is None:
        return None
    if scene is not thing:
        scene.background = DARK.background
    check_motion(update, "update")
    if up not in UP_DIRECTIONS:
        raise InvalidArgumentError(f"up must be one of {', '.join(UP_DIRECTIONS)}, not {up!r}")
    if not real(period) > 0:
        raise InvalidArgumentError(f"period must be a positive number, not {shown(period)}")
    title = title or getattr(thing, "name", "") or type(thing).__name__.lower()
    viewed = ViewedScene(scene, title, up, update=update, period=period, plays=update is not None)
    viewed.themed = scene is not thing
    show_numbers(viewed, marks)
    if update is None:
        play_clips(viewed)
    return viewed


def check_motion(function: object, what: str) -> None:
    """Raise `InvalidArgumentError` unless the argument is None or callable."""
    if function is not None and not callable(function):
        raise InvalidArgumentError(f"{what} must be a function of the time, not {shown(function)}")
