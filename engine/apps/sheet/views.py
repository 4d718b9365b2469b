"""The views of a sheet: their directions and spelling.

In: text such as ``front,iso,under=0,1,0`` or ``x=50%``. Out: `ViewSpec` and `Section`, which are
independent of any model.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ...base import linalg
from ...base.near_words import meant
from ...errors import InvalidArgumentError
from ...model.scene.orbiting import home_axes, orbit_axes

#: Camera positions: azimuth and elevation of `engine3d.orbit`, in degrees. The isometric one
#: looks along the diagonal of a cube.
STANDARD = {
    "front": (0.0, 0.0),
    "right": (90.0, 0.0),
    "back": (180.0, 0.0),
    "left": (270.0, 0.0),
    "top": (0.0, 90.0),
    "bottom": (0.0, -90.0),
    "iso": (45.0, 35.264389682754654),
}
#: In two rows of two, this is the third-angle projection of technical drawings.
DEFAULT_VIEWS = "top,iso,front,right"
MOST_VIEWS = 24
_VIEW = re.compile(r"([^=,]+)(?:=([^=,]+(?:,\s*[-+.\d][^=,]*)*))?(?:,|$)")
_CAMERA = re.compile(r"camera(\d{1,6})")
_SECTION = re.compile(r"\s*(-?)\s*([xyz])\s*(?:=\s*([^%\s]+)\s*(%?))?\s*", re.I)


@dataclass(frozen=True)
class Section:
    """A plane across an axis of the file, and the side it is seen from.

    Attributes
    ----------
    axis : int
        0, 1 or 2.
    from_above : bool
        Whether what has greater coordinates is cut off and the rest seen from there; else the
        other way round.
    place : float
        Where the plane is: a coordinate of the file, or a share of the model.
    is_share : bool
    """

    axis: int
    from_above: bool
    place: float
    is_share: bool

    def coordinate(self, low: float, high: float) -> float:
        """Return the plane's coordinate in a model with given extent."""
        return low + (high - low) * self.place if self.is_share else self.place

    @property
    def sight(self) -> tuple[float, float, float]:
        """The view direction of the camera."""
        sight = [0.0, 0.0, 0.0]
        sight[self.axis] = -1.0 if self.from_above else 1.0
        return sight[0], sight[1], sight[2]


@dataclass(frozen=True)
class ViewSpec:
    """A requested view.

    Attributes
    ----------
    name : str
    angles : (float, float) or None
        Azimuth and elevation in degrees.
    sight : (3,) tuple of float or None
        Or the way the camera looks, in world space.
    camera : int or None
        Or the number of one of the file's cameras.
    section : Section or None
        What is cut off.
    is_oblique : bool
        Whether a section is seen as an isometric picture sees things, rather than from straight
        before its plane.
    """

    name: str
    angles: tuple[float, float] | None = None
    sight: tuple[float, float, float] | None = None
    camera: int | None = None
    section: Section | None = None
    is_oblique: bool = False

    @property
    def kind(self) -> str:
        """``"drawing"``, ``"isometric"``, ``"camera"``, ``"section"`` or ``"cutaway"``."""
        if self.section is not None:
            return "cutaway" if self.is_oblique else "section"
        if self.camera is not None:
            return "camera"
        return "isometric" if self.angles == STANDARD["iso"] else "drawing"

    @property
    def to_scale(self) -> bool:
        """Whether it is drawn at the sheet's scale."""
        return self.kind in ("drawing", "section")

    @property
    def is_picture(self) -> bool:
        """Whether it is a picture, as `engine3d.render` draws it, rather than a drawing."""
        return self.kind in ("isometric", "camera")

    def axes(self, up) -> np.ndarray:
        """Return the camera's axes in world space: (3, 3), columns right, up and back."""
        if self.is_oblique:
            return _oblique_axes(up, self.section.sight)
        if self.angles is not None:
            return _orbit_axes(up, *self.angles)
        up = home_axes(up)[1]
        back = -linalg.normalize(np.array(self.sight, np.float64))
        if float(linalg.length(linalg.cross(up, back))) < 1e-9:
            return orbit_axes(up, 0.0, math.copysign(math.pi / 2, float(linalg.dot(up, back))))
        return linalg.look_at(back, (0.0, 0.0, 0.0), up)[:3, :3]


def _orbit_axes(up, azimuth: float, elevation: float) -> np.ndarray:
    return orbit_axes(up, math.radians(azimuth), math.radians(elevation))


def _oblique_axes(up, sight) -> np.ndarray:
    """Return the axes of an isometric camera in front of a plane."""
    azimuth, elevation = STANDARD["iso"]
    choices = (
        _orbit_axes(up, azimuth + turn, raised)
        for raised in (elevation, -elevation)
        for turn in (0.0, -90.0, 90.0, 180.0)
    )
    return next(axes for axes in choices if float(linalg.dot(axes[:, 2], sight)) < -0.1)


def parse_views(text: str) -> list[ViewSpec]:
    """Return the views in a list.

    Raises `InvalidArgumentError` for an invalid view.
    """
    specs, place = [], 0
    while place < len(text):
        match = _VIEW.match(text, place)
        if match is None:
            raise InvalidArgumentError(f"views: {text[place:]!r} is not NAME or NAME=DIRECTION")
        specs.append(_view(match[1].strip(), match[2]))
        place = match.end()
    return specs


def _view(name: str, direction: str | None) -> ViewSpec:
    if direction is None:
        camera = _CAMERA.fullmatch(name)
        if camera is not None:
            return ViewSpec(name, camera=int(camera[1]))
        if name not in STANDARD:
            known = ", ".join(STANDARD)
            raise InvalidArgumentError(
                f"views: {name!r} is none of {known}, camera0, nor NAME=DIRECTION"
                + meant(name, STANDARD)
            )
        return ViewSpec(name, angles=STANDARD[name])
    if direction.strip() in STANDARD:
        return ViewSpec(name, angles=STANDARD[direction.strip()])
    numbers = [_number(part, f"views: {name}") for part in direction.split(",")]
    if len(numbers) == 2:
        if abs(numbers[1]) > 90.0:
            raise InvalidArgumentError(f"views: {name}: an elevation is from -90 to 90 degrees")
        return ViewSpec(name, angles=(numbers[0], numbers[1]))
    if len(numbers) != 3 or not any(numbers):
        raise InvalidArgumentError(
            f"views: {name}: {direction!r} is neither X,Y,Z nor AZIMUTH,ELEVATION"
        )
    largest = max(map(abs, numbers))  # avoids overflow of squares
    x, y, z = (number / largest for number in numbers)
    return ViewSpec(name, sight=(x, y, z))


def parse_section(text: str) -> Section:
    """Return the section for a text such as ``x=0.5``, ``-y=20%`` or ``z``.

    Raises `InvalidArgumentError` for other texts.
    """
    match = _SECTION.fullmatch(text)
    if match is None:
        raise InvalidArgumentError(f"section: {text!r} is not like x=0.5, -y=20% or z")
    axis = "xyz".index(match[2].lower())
    if match[3] is None:
        return Section(axis, not match[1], 0.5, True)
    place = _number(match[3], f"section: {text}")
    is_share = bool(match[4])
    if is_share and not 0.0 <= place <= 100.0:
        raise InvalidArgumentError(f"section: {text!r} is beyond the model: 0% to 100%")
    return Section(axis, not match[1], place / 100.0 if is_share else place, is_share)


def check_views(views: str | Iterable[str], sections: str | Iterable[str]) -> list[ViewSpec]:
    """Return all views of a sheet: those of a list, then two for each section.

    Raises `InvalidArgumentError` where there is none, or two have one name.
    """
    specs = [spec for text in _texts(views, "views") for spec in parse_views(text)]
    for text in _texts(sections, "sections"):
        section = parse_section(text)
        name = _section_name(section)
        specs.append(ViewSpec(f"section {name}", sight=section.sight, section=section))
        specs.append(ViewSpec(f"cutaway {name}", section=section, is_oblique=True))
    names = [spec.name for spec in specs]
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise InvalidArgumentError(f"views: {twice[0]!r} is there twice")
    if not 1 <= len(specs) <= MOST_VIEWS:
        raise InvalidArgumentError(f"views: a sheet has 1 to {MOST_VIEWS}, not {len(specs)}")
    return specs


def _texts(given: str | Iterable[str], what: str) -> list[str]:
    if isinstance(given, str):
        return [given]
    texts = list(given) if isinstance(given, Iterable) else [None]
    if not all(isinstance(text, str) for text in texts):
        raise InvalidArgumentError(f"{what} must be texts, not {given!r}")
    return texts


def _section_name(section: Section) -> str:
    sign = "" if section.from_above else "-"
    place = f"{section.place * 100:.6g}%" if section.is_share else f"{section.place:.6g}"
    return f"{sign}{'xyz'[section.axis]}={place}"


def _number(text: str, what: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InvalidArgumentError(f"{what}: {text.strip()!r} is not a number")
    return value
