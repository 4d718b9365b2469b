"""Makes a viewed scene of anything that can be drawn."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import Any

from ..base.numbers import real, shown
from ..errors import InvalidArgumentError
from ..io.scenes.other_libraries import CAD_LIBRARIES, library_of
from ..model.geometry.mesh import Mesh
from ..model.materials.material import Material
from ..model.scene.nodes import Node
from ..model.scene.scene import Scene
from .appearance import BARE
from .coloring import show_numbers
from .filtering import Filtering
from .look import LookChoice, check_look
from .open_models import open_models
from .overlays.numbers import NO_MARKS, Marks
from .played_clips import play_clips
from .scenes_of_things import is_lit, scene_of
from .stage_settings import Settings
from .viewed_scene import ViewedScene
from .views.flat_sides import has_no_front
from .views.viewpoint import UP_DIRECTIONS


def comes_from_file(thing: Any) -> bool:
    """Return whether a thing is a path, a file object, or a viewed scene made of one."""
    return is_file(thing) or (isinstance(thing, ViewedScene) and thing.format is not None)


def viewed_of(thing: Any) -> ViewedScene | None:
    """Return the viewed scene of a thing; None for unsuitable things.

    Parameters
    ----------
    thing : path-like, binary file object, or what `scene_of` takes
        A file is opened as by ``engine3d render``. A viewed scene is returned as it is.
    """
    if isinstance(thing, ViewedScene):
        return thing
    if is_file(thing):
        return open_models([thing])
    scene = scene_of(thing)
    if scene is None:
        return None
    title = str(getattr(thing, "name", "") or type(thing).__name__.lower())
    is_scene, is_dressed = isinstance(thing, Scene), not is_lit(scene)
    appearance = dict(BARE) if is_scene and not is_dressed else {}
    is_cad = library_of(thing) in CAD_LIBRARIES
    meshes = [node.object for node in scene.nodes if isinstance(node.object, Mesh)]
    may_turn = not isinstance(thing, Scene | Node) and all(map(has_no_front, meshes))
    return ViewedScene(
        scene,
        title,
        up="+Z" if is_cad else "+Y",
        may_turn=may_turn,
        themed=is_dressed,
        is_scene=is_scene,
        appearance=appearance,
        unit="mm" if is_cad else "",
        model_edges=is_cad,
    )


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
    look: LookChoice,
    options: Mapping[str, Any] | None = None,
    material: Material | None = None,
    marks: Marks = NO_MARKS,
) -> Settings:
    """Return the settings with which things wear a look, as in ``engine3d render``.

    Parameters
    ----------
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
    return Settings(
        dict(options or {}),
        look=check_look(look),
        material=material,
        filtering=Filtering(is_usual=True),
        bar=marks.bar,
        axes_grid=marks.axes_grid,
    )


def is_file(thing: Any) -> bool:
    """Return whether a thing is a path or a file object."""
    if isinstance(thing, (str, os.PathLike)):
        return True
    return hasattr(thing, "read") and library_of(thing) is None  # meshes of meshio have it, too


def check_motion(function: object, what: str) -> None:
    """Raise `InvalidArgumentError` unless the argument is None or callable."""
    if function is not None and not callable(function):
        raise InvalidArgumentError(f"{what} must be a function of the time, not {shown(function)}")
