"""Makes a viewed scene of anything that can be drawn."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import Any

from ..base.numbers import real, shown
from ..errors import InvalidArgumentError
from ..model.materials.material import Material
from ..model.scene.scene import Scene
from .coloring import show_numbers
from .filtering import Filtering
from .look import Look, LookChoice, check_look
from .open_models import open_models
from .overlays.numbers import NO_MARKS, Marks
from .played_clips import play_clips
from .scenes_of_things import is_lit, scene_of
from .stage_settings import Settings
from .viewed_scene import ViewedScene
from .views.viewpoint import UP_DIRECTIONS

_BLACK = (0, 0, 0)  # the background of new scenes


def viewed_of(thing: Any) -> ViewedScene | None:
    """Return the viewed scene of a thing; None for unsuitable things.

    Parameters
    ----------
    thing : path-like, binary file object, or what `scene_of` takes
        A file is opened as by ``engine3d render``.
    """
    if is_file(thing):
        return open_models([thing])
    scene = scene_of(thing)
    if scene is None:
        return None
    title = getattr(thing, "name", "") or type(thing).__name__.lower()
    return ViewedScene(scene, title, themed=not is_lit(scene))


def viewed_thing(
    thing: object,
    *,
    title: str | None,
    up: str | None,
    update: Callable[[float], None] | None,
    period: float,
    marks: Marks = NO_MARKS,
) -> ViewedScene | None:
    """Return the viewed scene that `show` displays for a thing; None for unsuitable things."""
    viewed = viewed_of(thing)
    if viewed is None:
        return None
    check_motion(update, "update")
    if up is not None and up not in UP_DIRECTIONS:
        raise InvalidArgumentError(f"up must be one of {', '.join(UP_DIRECTIONS)}, not {up!r}")
    if not real(period) > 0:
        raise InvalidArgumentError(f"period must be a positive number, not {shown(period)}")
    viewed.title, viewed.up = title or viewed.title, up or viewed.up
    show_numbers(viewed, marks)
    if update is not None:
        viewed.update, viewed.period, viewed.plays = update, period, True
    elif not is_file(thing):
        viewed.period = period
        play_clips(viewed)
    return viewed


def settings_for(
    thing: Any,
    look: LookChoice,
    options: Mapping[str, Any] | None = None,
    material: Material | None = None,
    marks: Marks = NO_MARKS,
) -> Settings:
    """Return the settings with which a thing wears a look, as in ``engine3d render``.

    Parameters
    ----------
    thing : object
        What `viewed_of` takes. A scene keeps the background that a program gave it.
    look : str or Look
    options : mapping, optional
        Drawing options that override those of the look.
    material : Material, optional
        Replaces the thing's own materials.
    marks : Marks, optional
        Numbers to show beside it.

    Raises
    ------
    InvalidArgumentError
    """
    # The textures of a program's own meshes must not change.
    filtering = Filtering(is_usual=is_file(thing))
    worn = _fitting_look(check_look(look), thing)
    return Settings(
        dict(options or {}),
        look=worn,
        material=material,
        filtering=filtering,
        bar=marks.bar,
        axes_grid=marks.axes_grid,
    )


def _fitting_look(look: Look, thing: Any) -> Look:
    """Return a look without a background of its own, if the thing is a scene that has one."""
    if not isinstance(thing, Scene) or look.background != "auto":
        return look
    if thing.background is None or thing.background != _BLACK:
        return look.replace(background=None if thing.background is None else "scene")
    return look


def is_file(thing: Any) -> bool:
    """Return whether a thing is a path or a file object."""
    return isinstance(thing, (str, os.PathLike)) or hasattr(thing, "read")


def check_motion(function: object, what: str) -> None:
    """Raise `InvalidArgumentError` unless the argument is None or callable."""
    if function is not None and not callable(function):
        raise InvalidArgumentError(f"{what} must be a function of the time, not {shown(function)}")
