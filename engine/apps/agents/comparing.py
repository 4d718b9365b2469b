"""Compares two objects, two files, or an object with a reference picture.

In: names or paths. Out: numbers, and a picture: one, the other, and what differs.
"""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import InvalidArgumentError
from ...io.loaders import load_texture
from ...io.output.animation_files import PICTURE_SUFFIXES
from ...rendering.canvas import Canvas
from ...stage.overlays.lettering import text_font
from ...stage.overlays.theme import LIGHT
from ..golden.comparison import compare
from ..golden.difference_picture import difference_picture
from .questions import deviation
from .session import Session
from .things import Part, Thing, Things
from .view_cameras import place_perspective, view_choice

_GAP, _INSET = 6, 8
_Parts = list[tuple[Thing, Part]]


def compared(
    session: Session, a: str, b: str, view: Any, size: Any
) -> tuple[NDArray[np.uint8], dict[str, Any]]:
    """Return a picture of both and of what differs, and the numbers.

    Parameters
    ----------
    session : Session
    a, b : str
        Names of objects, or paths of models or pictures. Two pictures are compared as they are; an
        object is drawn as large as the picture that it is compared with.
    view, size
        As of the tool ``render``.

    Raises
    ------
    InvalidArgumentError, FileAccessError, FileFormatError
    """
    sides = [_side(session, name) for name in (a, b)]
    given = [side for side in sides if isinstance(side, np.ndarray)]
    if given:
        size = [given[0].shape[1], given[0].shape[0]]
    both: Things = Things()
    for side in sides:
        if not isinstance(side, np.ndarray):
            both.update({f"{number}": thing for number, thing in _renamed(side, len(both))})
    pictures = [
        side if isinstance(side, np.ndarray) else _drawn(session, side, both, view, size)
        for side in sides
    ]
    difference = compare(*pictures)
    record = {
        "changed_pixels": difference.different,
        "pixels": difference.total,
        "largest": float(difference.largest) if np.isfinite(difference.largest) else None,
        "box": None if difference.box is None else list(difference.box),
        "hausdorff": None if given else deviation(*sides),
    }
    panes = [*pictures, difference_picture(pictures[1], difference)]
    return _side_by_side(panes, (a, b, "difference")), record


def _side(session: Session, name: str) -> Any:
    """Return the parts of an object or of a model's file, or the pixels of a picture."""
    if name in session.things or any(
        thing.label(part) == name for thing, part in session.things.all_parts()
    ):
        return session.things.find(name)
    if not os.path.splitext(name)[1]:
        return session.things.find(name, "compare")  # raises an error with a suggestion
    if os.path.splitext(name)[1].lower() in PICTURE_SUFFIXES:
        with session.limits.reading():
            pixels = load_texture(session.limits.path_to_read(name)).pixels
        return np.ascontiguousarray(pixels)
    thing = session.opened(name)
    session.limits.check_triangles(thing.triangles)
    if not thing.parts:
        raise InvalidArgumentError(f"compare: {name} has no mesh")
    return [(thing, part) for part in thing.parts]


def _renamed(parts: _Parts, first: int) -> list[tuple[int, Thing]]:
    """Return the objects of parts, each with only these, under numbers."""
    found = []
    for number, thing in enumerate(dict.fromkeys(thing for thing, _ in parts)):
        own = tuple(part for owner, part in parts if owner is thing)
        found.append((first + number, Thing(f"{first + number}", own, up=thing.up)))
    return found


def _drawn(
    session: Session, parts: _Parts, both: Things, view: Any, size: Any
) -> NDArray[np.uint8]:
    """Draw one side with the camera that shows both."""
    shown_both = session.studio.scene_of(both.all_parts())
    size = session.studio.checked_size(size)
    camera, pose = place_perspective(shown_both, both, view_choice(view, both), size)
    pose[:3, 3] += shown_both.origin
    drawn = session.studio.draw_with(parts, camera, pose, size)
    return np.ascontiguousarray(drawn)


def _side_by_side(panes: list[NDArray[np.uint8]], names: tuple[str, ...]) -> NDArray[np.uint8]:
    height = max(pane.shape[0] for pane in panes)
    width = sum(pane.shape[1] for pane in panes) + _GAP * (len(panes) - 1)
    canvas = Canvas((width, height))
    canvas.clear((255, 255, 255, 255))
    left = 0
    for pane, name in zip(panes, names, strict=True):
        canvas.pixels[: pane.shape[0], left : left + pane.shape[1]] = pane
        canvas.text(
            left + _INSET, _INSET, name, LIGHT.text, font=text_font(1), background=LIGHT.block
        )
        left += pane.shape[1] + _GAP
    return canvas.pixels
