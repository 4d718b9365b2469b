"""The links, joints and shapes that a URDF file states, without the files that it names.

In: a `UrdfText`. Out: plain records. Poses are (4, 4) float64 in metres and radians. Source:
http://wiki.ros.org/urdf/XML, and urdfdom, which reads it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....base import linalg
from ....model.motion.joints import turned
from ...reading.text import shown
from ...reading.xml_elements import Element
from .urdf_elements import UrdfText

_NOTHING = (0.0,)
#: The kinds of shapes -> their attributes, with the values of those that are missing.
SHAPES: dict[str, tuple[tuple[str, tuple[float, ...]], ...]] = {
    "box": (("size", (0.0, 0.0, 0.0)),),
    "cylinder": (("radius", _NOTHING), ("length", _NOTHING)),
    "sphere": (("radius", _NOTHING),),
    "capsule": (("radius", _NOTHING), ("length", _NOTHING)),
    "mesh": (("scale", (1.0, 1.0, 1.0)),),
}


class Look(NamedTuple):
    """A material.

    Attributes
    ----------
    name : str
    color : tuple of 4 float or None
        Display values and alpha, 0..1.
    texture : str or None
        The name of an image.
    line : int
    """

    name: str
    color: tuple[float, ...] | None
    texture: str | None
    line: int


class Shape(NamedTuple):
    """A visual or a collision of a link.

    Attributes
    ----------
    name : str
        Empty if the file gives none.
    is_collision : bool
    pose : (4, 4) float64
        link-from-shape.
    kind : str
        A key of `SHAPES`.
    sizes : tuple of float
        The numbers of the kind; of a mesh, its scale.
    file : str
        The name of a mesh; empty for others.
    look : Look or None
    line : int
    """

    name: str
    is_collision: bool
    pose: np.ndarray
    kind: str
    sizes: tuple[float, ...]
    file: str
    look: Look | None
    line: int


class Link(NamedTuple):
    """A link: its name, and all its shapes, in file order."""

    name: str
    shapes: list[Shape]
    line: int


def pose_of(text: UrdfText, origin: Element | None) -> np.ndarray:
    """Return the pose of an ``<origin>``: turned by roll, pitch, yaw about fixed axes x, y, z."""
    moved = text.numbers(origin, "xyz", (0.0, 0.0, 0.0))
    roll, pitch, yaw = text.numbers(origin, "rpy", (0.0, 0.0, 0.0))
    return linalg.multiply(linalg.translation(moved), turned(roll, pitch, yaw))


def read_links(text: UrdfText) -> dict[str, Link]:
    """Return the links of a robot by name.

    Raises
    ------
    FileFormatError
        A name is missing or given twice, a number is wrong, or there are none.
    """
    looks = _Looks(text)
    links: dict[str, Link] = {}
    for element in text.root.all("link"):
        name = text.name(element)
        if name in links:
            first = links[name].line
            raise text.fault(f"link {shown(name)} is in line {first} already", element)
        shapes = [
            shape
            for child in element.children
            if child.name in ("visual", "collision")
            if (shape := _shape(text, looks, child, name)) is not None
        ]
        links[name] = Link(name, shapes, element.line)
    if not links:
        raise text.fault("a robot without links", text.root)
    return links


def _shape(text: UrdfText, looks: _Looks, element: Element, link: str) -> Shape | None:
    """Return a shape; None, with a warning, if it is of no known kind."""
    where = f"a {element.name} of link {shown(link)}"
    geometry = element.first("geometry")
    if geometry is None or not geometry.children:
        text.leave_out(f"{where} has no geometry, and is left out", element)
        return None
    form = geometry.children[0]
    if form.name not in SHAPES:
        text.leave_out(f"{where} is a {shown(form.name)}, which is not drawn", form)
        return None
    sizes = tuple(
        number
        for attribute, usual in SHAPES[form.name]
        for number in text.numbers(form, attribute, usual)
    )
    if not (all(sizes) if form.name == "mesh" else min(sizes) > 0.0):
        text.leave_out(f"{where} has no size, and is left out", form)
        return None
    return Shape(
        name=element.attributes.get("name", ""),
        is_collision=element.name == "collision",
        pose=pose_of(text, element.first("origin")),
        kind=form.name,
        sizes=sizes,
        file=text.name(form, "filename") if form.name == "mesh" else "",
        look=looks.of(element.first("material")),
        line=form.line,
    )


class _Looks:
    """The materials of a robot, by name, wherever they are defined."""

    def __init__(self, text: UrdfText) -> None:
        self._text = text
        self._known: dict[str, Look] = {}
        self._stated_by: dict[int, Look] = {}  # an element is read once: its warnings come once
        inner = (
            material
            for link in text.root.all("link")
            for visual in link.all("visual")
            for material in visual.all("material")
        )
        for element in (*text.root.all("material"), *inner):
            look = self._stated(element)
            if look.color is not None or look.texture is not None:
                self._known.setdefault(look.name, look)

    def of(self, element: Element | None) -> Look | None:
        """Return the material of a visual: its own, or one that it names."""
        if element is None:
            return None
        look = self._stated(element)
        if look.color is not None or look.texture is not None or not look.name:
            return look
        if look.name not in self._known:
            self._text.warn(f"there is no material {shown(look.name)}", element)
        return self._known.get(look.name)

    def _stated(self, element: Element) -> Look:
        key = id(element)
        if key not in self._stated_by:
            self._stated_by[key] = self._read(element)
        return self._stated_by[key]

    def _read(self, element: Element) -> Look:
        color, texture = element.first("color"), element.first("texture")
        return Look(
            element.attributes.get("name", ""),
            None if color is None else self._color(color),
            None if texture is None else self._text.name(texture, "filename"),
            element.line,
        )

    def _color(self, element: Element) -> tuple[float, ...]:
        given = self._text.numbers(element, "rgba", (1.0, 1.0, 1.0, 1.0))
        color = tuple(min(max(part, 0.0), 1.0) for part in given)
        if color != given:
            told = shown(element.attributes["rgba"])
            self._text.warn(f"rgba {told} is beyond 0 to 1, and cut to it", element)
        return color
