"""Where an agent's pictures are seen from.

In: a name, or angles. Out: a camera and its pose in the scene, and a record of both.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.box_corners import box_corners
from ...base.near_words import meant
from ...base.numbers import real, shown
from ...errors import InvalidArgumentError
from ...model.scene.cameras import Camera, PerspectiveCamera
from ...model.scene.orbiting import orbit_axes
from ...rendering.framing import frame_scene
from ...stage.views.viewpoint import UP_DIRECTIONS
from ..sheet.views import STANDARD
from .shown_scene import Shown, shown_scene
from .things import Things

#: The nearest plane, in distances of the farthest point: a nearer one costs depth too many bits.
_NEAREST = 1e-3
_KEYS = ("azimuth", "elevation", "distance", "fit")


class ViewChoice(NamedTuple):
    """A view: angles in degrees, what fills it, and perhaps the distance of its camera.

    Attributes
    ----------
    name : str
    azimuth, elevation : float
    fit : tuple of str
        Names of objects; empty for everything.
    distance : float or None
        From the camera to the middle of these.
    """

    name: str
    azimuth: float
    elevation: float
    fit: tuple[str, ...] = ()
    distance: float | None = None


def view_choice(view: Any, things: Things) -> ViewChoice:
    """Return the view that an agent asks for.

    Parameters
    ----------
    view : str or dict
        A name of `STANDARD`, the name of an object, which then fills the picture, or a dict with
        some of ``azimuth``, ``elevation`` (degrees), ``distance`` and ``fit``.
    things : Things

    Raises
    ------
    InvalidArgumentError
    """
    if isinstance(view, str):
        if view in STANDARD:
            return ViewChoice(view, *STANDARD[view])
        known = [*STANDARD, *things, *(thing.label(part) for thing, part in things.all_parts())]
        if view not in known:
            raise InvalidArgumentError(
                f"view: {shown(view)} is none of {', '.join(STANDARD)}, nor an object"
                f"{meant(view, known)}"
            )
        return ViewChoice(view, *STANDARD["iso"], fit=(view,))
    if not isinstance(view, dict):
        raise InvalidArgumentError(f"view must be a name or angles, not {shown(view)}")
    for key in view:
        if key not in _KEYS:
            hint = meant(str(key), _KEYS)
            raise InvalidArgumentError(f"view: {shown(key)} is none of {', '.join(_KEYS)}{hint}")
    azimuth, elevation = STANDARD["iso"]
    azimuth = _number(view.get("azimuth", azimuth), "view: azimuth")
    elevation = _number(view.get("elevation", elevation), "view: elevation")
    if abs(elevation) > 90.0:
        raise InvalidArgumentError("view: an elevation is from -90 to 90 degrees")
    fit = view.get("fit") or ()
    fit = (fit,) if isinstance(fit, str) else fit
    things.find(fit, "view: fit")
    distance = view.get("distance")
    if distance is not None and not _number(distance, "view: distance") > 0.0:
        raise InvalidArgumentError("view: a distance is above 0")
    return ViewChoice(f"{azimuth:g}, {elevation:g}", azimuth, elevation, tuple(fit), distance)


def _number(value: Any, what: str) -> float:
    number = real(value)
    if not math.isfinite(number):
        raise InvalidArgumentError(f"{what} must be a number, not {shown(value)}")
    return number


def camera_axes(shown_: Shown, choice: ViewChoice) -> NDArray[np.float64]:
    """Return the axes of a view's camera: (3, 3), columns right, up and back."""
    up = UP_DIRECTIONS[shown_.viewed.up]
    return orbit_axes(up, math.radians(choice.azimuth), math.radians(choice.elevation))


def place_perspective(
    shown_: Shown, things: Things, choice: ViewChoice, size: tuple[int, int]
) -> tuple[Camera, NDArray[np.float64]]:
    """Return a perspective camera and its pose in the scene, and what fits fills the picture."""
    fitted = shown_
    if choice.fit:
        fitted = shown_scene(things.find(choice.fit, "view: fit"))
    axes = camera_axes(shown_, choice)
    aspect = size[0] / size[1]
    camera, pose = frame_scene(
        fitted.viewed.scene, aspect=aspect, direction=-axes[:, 2], up=axes[:, 1]
    )
    pose[:3, 3] += fitted.origin - shown_.origin
    if choice.distance is not None:
        middle = fitted.bounds.mean(axis=0) - shown_.origin
        pose[:3, 3] = middle + axes[:, 2] * choice.distance
    if choice.fit or choice.distance is not None:
        camera = _reaching_all(camera, pose, shown_)
    return camera, pose


def _reaching_all(
    camera: PerspectiveCamera, pose: NDArray[np.float64], shown_: Shown
) -> PerspectiveCamera:
    """Return a camera whose depth range holds all of a scene that is before it."""
    corners = box_corners(np.asarray(shown_.viewed.scene.bounds, np.float64))
    depths = linalg.dot(corners - pose[:3, 3], -pose[:3, 2])
    far = max(float(depths.max()) * 1.01, 1e-9)
    near = max(float(depths.min()) * 0.99, far * _NEAREST)
    return PerspectiveCamera(camera.yfov, znear=near, zfar=far)


def camera_record(
    shown_: Shown, choice: ViewChoice, camera: Camera, pose: NDArray[np.float64]
) -> dict[str, Any]:
    """Return a camera as an agent reads it, in the objects' coordinates."""
    middle = shown_.bounds.mean(axis=0)
    position = pose[:3, 3] + shown_.origin
    away = float(linalg.dot(position - middle, pose[:3, 2]))
    record = {
        "view": choice.name,
        "azimuth": choice.azimuth,
        "elevation": choice.elevation,
        "position": rounded(position),
        "target": rounded(position - pose[:3, 2] * away),
        "up": rounded(pose[:3, 1]),
        "projection": "parallel",
    }
    if isinstance(camera, PerspectiveCamera):
        record |= {"projection": "perspective", "yfov": round(math.degrees(camera.yfov), 4)}
    return record


def rounded(values: Any) -> list[Any]:
    """Return numbers with seven digits, which is what positions of vertices hold."""
    if np.ndim(values) > 1:
        return [rounded(row) for row in values]
    return [float(f"{float(value):.7g}") + 0.0 for value in values]
