"""What an agent works on: objects, the edits that made them, the last picture.

In: files, scripts and edits. Out: records of the objects. Objects are immutable, so the history is
the objects of before. An error changes nothing: what a call answers is found before its objects are
kept.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.near_words import meant
from ...base.numbers import floats, real, shown
from ...errors import InvalidArgumentError, printable
from ...stage.open_model import open_model
from ...stage.views.viewpoint import UP_DIRECTIONS
from .pictures import MOST_LISTED, Picture, Studio
from .server_limits import Limits
from .shown_scene import shown_scene
from .things import Part, Thing, Things, thing_of, unused
from .view_cameras import rounded

if TYPE_CHECKING:
    from .grids import GridPicture

_MOST_STEPS = 100
#: Parts that a record of the scene lists.
_MOST_RECORDS = 200
#: Poses of larger numbers would show nothing.
_FARTHEST = 1e30
_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


class Session:
    """The scene of one client.

    Parameters
    ----------
    limits : Limits

    Attributes
    ----------
    limits : Limits
    things : Things
    studio : Studio
    last : Picture, GridPicture or None
        What was drawn last, for questions about its pixels.
    """

    def __init__(self, limits: Limits) -> None:
        self.limits = limits
        self.things = Things()
        self.studio = Studio(limits)
        self.last: Picture | GridPicture | None = None
        self._before: list[Things] = []

    def load(self, path: str, name: str = "", up: str = "auto") -> dict[str, Any]:
        """Add the model of a file; an object with this name is replaced.

        Raises
        ------
        FileAccessError, FileFormatError, InvalidArgumentError
        """
        if up != "auto" and up not in UP_DIRECTIONS:
            raise InvalidArgumentError(
                f"up must be auto or one of {', '.join(UP_DIRECTIONS)}, not {shown(up)}"
                f"{meant(str(up), UP_DIRECTIONS)}"
            )
        thing = self.opened(path, name)
        return self.add(thing if up == "auto" else replace(thing, up=up))

    def opened(self, path: str, name: str = "") -> Thing:
        """Return the object of a file, without adding it."""
        real = self.limits.path_to_read(path)
        with self.limits.reading():
            viewed = open_model(real, root=self.limits.root)
        stem = os.path.basename(path).partition(".")[0] or "model"
        named = self.checked_name(name) if name else unused(printable(stem), self.things)
        return thing_of(viewed, named, self.limits.shown(real))

    def checked_name(self, name: str) -> str:
        """Return a name for an object, or raise an error."""
        if not isinstance(name, str) or not name.isprintable() or "/" in name or len(name) > 100:
            raise InvalidArgumentError(
                f"name must be up to 100 letters without a slash, not {shown(name)}"
            )
        return name

    def add(self, thing: Thing) -> dict[str, Any]:
        """Add an object, and return its record."""
        others = [one for one in self.things.values() if one.name != thing.name]
        self.limits.check_triangles(thing.triangles + sum(one.triangles for one in others))
        told = list(thing.warnings)
        if not thing.parts:
            told.append(f"it has no mesh, {'only lights' if thing.lights else 'so nothing shows'}")
        for other in others[:1]:
            if other.up != thing.up:
                told.append(
                    f"{thing.name} counts {thing.up} as up, {other.name} {other.up}: both keep "
                    "their coordinates; give up= or rotate one"
                )
            if other.unit and thing.unit and other.unit != thing.unit:
                told.append(
                    f"{thing.name} is in {thing.unit}, {other.name} in {other.unit}: scale one"
                )
        record = {
            "name": thing.name,
            "format": thing.format,
            "triangles": thing.triangles,
            "parts": [thing.label(part) for part in thing.parts[:MOST_LISTED]],
            "part_count": len(thing.parts),
            "bounds": self.bounds_of([(thing, part) for part in thing.parts]),
            "unit": thing.unit,
            "up": thing.up,
            "warnings": told,
        }
        self.change(Things({**self.things, thing.name: thing}))
        return record

    def change(self, things: Things) -> None:
        """Take other objects; `undo` takes the old ones again."""
        self._before = [*self._before, self.things][-_MOST_STEPS:]
        self.things = things

    def undo(self) -> dict[str, Any]:
        """Take back the last load, script or edit.

        Raises
        ------
        InvalidArgumentError
            There is nothing to take back.
        """
        if not self._before:
            raise InvalidArgumentError("there is nothing to undo")
        self.things = self._before.pop()
        return {"objects": list(self.things), "steps_left": len(self._before)}

    def record(self) -> dict[str, Any]:
        """Return what the scene holds."""
        pairs = self.things.all_parts()
        records = [_record(self, thing, part) for thing, part in pairs[:_MOST_RECORDS]]
        bare = [_record(self, thing) for thing in self.things.values() if not thing.parts]
        return {
            "objects": [*bare, *records][:_MOST_RECORDS],
            "object_count": len(pairs) + len(bare),
            "bounds": self.bounds_of([pair for pair in pairs if pair[1].visible]),
            "lights": [
                type(light).__name__ for thing in self.things.values() for light, _ in thing.lights
            ],
            "up": next((thing.up for thing in self.things.values()), "+Y"),
            "unit": next((thing.unit for thing in self.things.values()), ""),
            "camera": None if self.last is None else self.last.record.get("camera"),
            "size": None if self.last is None else self.last.record["size"],
        }

    def bounds_of(self, parts: list[tuple[Thing, Part]]) -> list[list[float]] | None:
        """Return the smallest and the largest corner of parts, or None for none."""
        return rounded(shown_scene(parts).bounds) if parts else None

    def edit(self, name: str, changes: dict[str, Any]) -> dict[str, Any]:
        """Move, turn, scale, colour, hide or delete an object, or one of its parts.

        The lights of an object move with it, but not with one of several parts.

        Parameters
        ----------
        name : str
        changes : dict
            Some of ``translate``, ``rotate``, ``scale``, ``color``, ``visible``, ``delete``.

        Raises
        ------
        InvalidArgumentError
        """
        given = {key: value for key, value in changes.items() if value is not None}
        if not given or (given.get("delete") is False and len(given) == 1):
            raise InvalidArgumentError(f"edit: say what to change: {', '.join(changes)}")
        pairs = self.things.find(name, "edit", with_lamps=True)
        if given.pop("delete", False):
            removed = self.things.with_parts({id(part): None for _, part in pairs})
            self.change(removed.without(name))
            return {"name": name, "bounds": None, "objects": list(self.things)}
        if "color" in given and not pairs:
            raise InvalidArgumentError(f"edit: {shown(name)} has no mesh to color")
        moved = _motion(given, _middle(pairs, self.things.get(name)))
        changed = self.things.with_parts(
            {id(part): _edited(part, given, moved) for _, part in pairs}
        )
        if name in changed:
            changed[name] = _with_lights(changed[name], given, moved)
        bounds = self.bounds_of(changed.find(name, with_lamps=True))
        self.change(changed)
        return {"name": name, "bounds": bounds, "objects": list(changed)}


def _record(session: Session, thing: Thing, part: Part | None = None) -> dict[str, Any]:
    """Return the record of a part, or of an object without parts, which is lights alone."""
    materials = [] if part is None else [one.name for one in _mesh(part).materials if one.name]
    return {
        "name": thing.name if part is None else thing.label(part),
        "file": thing.source,
        "triangles": thing.triangles if part is None else part.triangles,
        "bounds": None if part is None else session.bounds_of([(thing, part)]),
        "color": None if part is None else part.color,
        "materials": [printable(name) for name in materials[:8]],
        "visible": thing.shines if part is None else part.visible,
    }


def _middle(parts: list[tuple[Thing, Part]], thing: Thing | None) -> NDArray[np.float64]:
    """Return the point about which parts turn, or else the lights of an object."""
    if parts:
        return shown_scene(parts).bounds.mean(axis=0)
    places = [pose[:3, 3] for _, pose in thing.lights] if thing is not None else []
    return np.mean(places, axis=0) if places else np.zeros(3)


def _with_lights(thing: Thing, given: dict[str, Any], moved: NDArray[np.float64]) -> Thing:
    """Return an object whose lights moved with it."""
    lights = tuple((light, _moved(pose, moved)) for light, pose in thing.lights)
    return replace(thing, lights=lights, shines=bool(given.get("visible", thing.shines)))


def _mesh(part: Part) -> Any:
    return getattr(part.drawn, "mesh", part.drawn)


def _edited(part: Part, given: dict[str, Any], moved: NDArray[np.float64]) -> Part:
    part = replace(part, pose=_moved(part.pose, moved))
    if "visible" in given:
        part = replace(part, visible=bool(given["visible"]))
    return part.colored(given["color"]) if "color" in given else part


def _moved(pose: NDArray[np.float64], moved: NDArray[np.float64]) -> NDArray[np.float64]:
    if np.array_equal(moved, np.eye(4)):
        return pose
    with np.errstate(over="ignore", invalid="ignore"):
        found = linalg.multiply(moved, pose)
    if not (np.abs(found) <= _FARTHEST).all():
        raise InvalidArgumentError("edit: that is too large or too far away to be drawn")
    return found


def _motion(given: dict[str, Any], middle: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the pose that scales and turns about a middle, and then moves."""
    there, back = linalg.translation(middle), linalg.translation(-middle)
    about = np.eye(4)
    if "scale" in given:
        about = linalg.multiply(linalg.scaling(_factors(given["scale"])), about)
    if "rotate" in given:
        about = linalg.multiply(_turn(given["rotate"]), about)
    moved = linalg.multiply(there, linalg.multiply(about, back))
    if "translate" in given:
        moved = linalg.multiply(linalg.translation(_vector(given["translate"], "translate")), moved)
    return moved


def _factors(value: Any) -> NDArray[np.float64]:
    factors = _vector([value] * 3 if not isinstance(value, list) else value, "scale")
    if not factors.all():
        raise InvalidArgumentError("scale: a factor must not be 0")
    return factors


def _turn(value: Any) -> NDArray[np.float64]:
    if not isinstance(value, dict) or set(value) != {"axis", "degrees"}:
        raise InvalidArgumentError(
            f'rotate must be like {{"axis": "z", "degrees": 90}}, not {shown(value)}'
        )
    axis = _AXES.get(value["axis"]) if isinstance(value["axis"], str) else value["axis"]
    if axis is None:
        raise InvalidArgumentError(
            f"rotate: axis must be x, y, z or [x, y, z], not {shown(value['axis'])}"
        )
    degrees = real(value["degrees"])
    direction = _vector(axis, "rotate: axis")
    if not np.isfinite(degrees) or not direction.any():
        raise InvalidArgumentError("rotate: needs a number of degrees and an axis that is not zero")
    return linalg.rotation_axis(direction, np.radians(degrees))


def _vector(value: Any, what: str) -> NDArray[np.float64]:
    vector = floats(value, what) if isinstance(value, Iterable) else np.zeros(0)
    if vector.shape != (3,) or not np.isfinite(vector).all():
        raise InvalidArgumentError(f"{what} must be three numbers, not {shown(value)}")
    return np.asarray(vector, np.float64)
