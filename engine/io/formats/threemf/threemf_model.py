"""The model parts of a 3MF file: objects, property groups and the build, as in the XML.

In: the XML of a part. Out: a `ModelPart`. It reads the drawable content of the core specification
1.3 and the extensions for materials, production and beam lattices; other elements give warnings.
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ...reading.text import shown
from ...reading.warning_list import WarningList
from ...reading.xml_events import SEPARATOR, Attributes, XmlFault
from .threemf_properties import PropertyGroup, PropertyParser

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
_PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
_BEAMS = "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"
#: Units of length, in metres, and their symbols.
UNITS = {
    "micron": (1e-6, "µm"),
    "millimeter": (1e-3, "mm"),
    "centimeter": (1e-2, "cm"),
    "inch": (0.0254, "in"),
    "foot": (0.3048, "ft"),
    "meter": (1.0, "m"),
}
#: The symbol of a unit -> metres.
METRES = {symbol: metres for metres, symbol in UNITS.values()}
_MOST_INDEX = 2**31 - 1
# Elements without effect on the appearance.
_SILENT = frozenset({"metadata", "metadatagroup"})


@dataclass
class Placement:
    """A component, or an item of the build.

    Attributes
    ----------
    object : int
    pose : (4, 4) float64
    path : str
        The part that contains the object; empty for the referring part.
    """

    object: int
    pose: np.ndarray
    path: str


@dataclass
class ObjectRecord:
    """An object: a mesh, or a composition of others.

    Attributes
    ----------
    name : str
    group, index : int
        The default property of triangles; -1 for none.
    positions : array of float64
        Three numbers per vertex.
    corners : array of int32
        Three vertices per triangle.
    properties : dict of int to tuple
        By triangle: the group, and the indices of three corners.
    beams : array of int32
        Two vertices per beam.
    components : list of Placement
    """

    name: str
    group: int
    index: int
    positions: array[float] = field(default_factory=lambda: array("d"))
    corners: array[int] = field(default_factory=lambda: array("i"))
    properties: dict[int, tuple[int, int, int, int]] = field(default_factory=dict)
    beams: array[int] = field(default_factory=lambda: array("i"))
    components: list[Placement] = field(default_factory=list)


@dataclass
class ModelPart:
    """A model part: objects, property groups and the build.

    Attributes
    ----------
    unit : str
        A key of `UNITS`.
    objects : dict of int to ObjectRecord
    groups : dict of int to PropertyGroup
    items : list of Placement
        The build.
    """

    unit: str = "millimeter"
    objects: dict[int, ObjectRecord] = field(default_factory=dict)
    groups: dict[int, PropertyGroup] = field(default_factory=dict)
    items: list[Placement] = field(default_factory=list)


class ModelParser:
    """Handles the elements of a part; `read_xml` calls `begin` and `end`.

    Parameters
    ----------
    warnings : WarningList
    lists : dict of int to (N, 3) float64
        Vertices and triangles cut out of the text; see `cut_lists`.

    Attributes
    ----------
    part : ModelPart
        The parsed part.
    """

    def __init__(self, warnings: WarningList, lists: dict[int, np.ndarray]) -> None:
        self.part = ModelPart()
        self._lists, self._place = lists, 0
        self._warnings = warnings
        self._properties = PropertyParser(self.part.groups, warnings)
        self._object: ObjectRecord | None = None
        self._skipped = 0
        self._is_model = False
        core = {
            "model": self._model,
            "object": self._begin_object,
            "vertices": self._vertices,
            "vertex": self._vertex,
            "triangles": self._triangles,
            "triangle": self._triangle,
            "component": self._component,
            "item": self._item,
        }
        known = ("resources", "mesh", "components", "build")
        self._handlers: dict[str, Callable[[Attributes], object]]
        self._handlers = {_name(CORE, local): handler for local, handler in core.items()}
        self._handlers |= {_name(CORE, local): _nothing for local in known}
        self._handlers |= {
            _name(_BEAMS, "beamlattice"): self._beam_lattice,
            _name(_BEAMS, "beams"): _nothing,
            _name(_BEAMS, "beam"): self._beam,
        }
        self._handlers |= self._properties.handlers(CORE)

    def begin(self, name: str, attributes: Attributes, place: int) -> None:
        """Handle the start of an element."""
        self._place = place
        if self._skipped:
            self._skipped += 1
            return
        handler = self._handlers.get(name)
        if handler is not None and (self._is_model or handler == self._model):
            handler(attributes)
            return
        if not self._is_model:
            raise XmlFault("no 3MF model: it begins with another element")
        local = name.rpartition(SEPARATOR)[2]
        if local not in _SILENT:
            self._warnings.add_once(f"{local!r} is left out")
        self._skipped = 1

    def end(self, name: str) -> None:
        """Handle the end of an element."""
        if self._skipped:
            self._skipped -= 1
        elif name == _name(CORE, "object"):
            self._object = None

    def _model(self, attributes: Attributes) -> None:
        self._is_model = True
        unit = attributes.get("unit", "millimeter")
        if unit not in UNITS:
            raise XmlFault(f"unit is none of {', '.join(UNITS)}: {shown(unit)}")
        self.part.unit = unit

    def _begin_object(self, attributes: Attributes) -> None:
        number = whole(attributes, "id")
        if number in self.part.objects:
            raise XmlFault(f"id {number} is given twice")
        if number in self.part.groups:
            self._warnings.add_once(f"id {number} is of an object and of properties")
        name = attributes.get("name") or attributes.get("partnumber") or f"object {number}"
        group = self._property(attributes, "pid", -1)
        self._object = ObjectRecord(name, group, self._property(attributes, "pindex", 0))
        self.part.objects[number] = self._object

    def _current(self, what: str) -> ObjectRecord:
        if self._object is None:
            raise XmlFault(f"a {what} outside of an object")
        return self._object

    def _vertices(self, attributes: Attributes) -> None:
        values = self._lists.get(self._place)
        if values is not None:
            self._current("vertex").positions.frombytes(values.tobytes())

    def _triangles(self, attributes: Attributes) -> None:
        values = self._lists.get(self._place)
        if values is None or not len(values):
            return
        record = self._current("triangle")
        _check_vertex(int(values.max()), record)
        record.corners.frombytes(values.astype(np.int32).tobytes())

    def _vertex(self, attributes: Attributes) -> None:
        record = self._current("vertex")
        try:
            x, y, z = attributes["x"], attributes["y"], attributes["z"]
            if "_" in x or "_" in y or "_" in z:  # Python would ignore underscores
                raise ValueError(f"{x} {y} {z}")
            record.positions.extend((float(x), float(y), float(z)))
        except KeyError as error:
            raise XmlFault(f"a vertex without {error}") from None
        except ValueError as error:
            raise XmlFault(f"a vertex of no numbers: {error}") from None

    def _triangle(self, attributes: Attributes) -> None:
        record = self._current("triangle")
        corners = [whole(attributes, key) for key in ("v1", "v2", "v3")]
        _check_vertex(max(corners), record)
        if len(attributes) > 3:
            self._triangle_property(record, attributes)
        record.corners.extend(corners)

    def _triangle_property(self, record: ObjectRecord, attributes: Attributes) -> None:
        known = {"v1", "v2", "v3", "pid", "p1", "p2", "p3"}
        for key in attributes.keys() - known:
            self._warnings.add_once(f"{key.rpartition(SEPARATOR)[2]!r} of triangles is left out")
        group = self._property(attributes, "pid", record.group)
        first = self._property(attributes, "p1", record.index if group == record.group else 0)
        if group < 0 and "p1" in attributes:
            self._warnings.add_once("properties of triangles without a group are left out")
        if "p1" in attributes or "pid" in attributes:
            second, third = (self._property(attributes, key, first) for key in ("p2", "p3"))
            record.properties[len(record.corners) // 3] = group, first, second, third

    def _property(self, attributes: Attributes, key: str, default: int) -> int:
        """Return an optional index or ID of a property."""
        try:
            return whole(attributes, key, default)
        except XmlFault as fault:
            self._warnings.add_once(f"{fault}; left out")
            return default

    def _component(self, attributes: Attributes) -> None:
        self._current("component").components.append(_placement(attributes))

    def _item(self, attributes: Attributes) -> None:
        self.part.items.append(_placement(attributes))

    def _beam_lattice(self, attributes: Attributes) -> None:
        self._warnings.add_once("beams are drawn as lines, whatever their radius")

    def _beam(self, attributes: Attributes) -> None:
        record = self._current("beam")
        ends = whole(attributes, "v1"), whole(attributes, "v2")
        _check_vertex(max(ends), record)
        record.beams.extend(ends)


def _check_vertex(index: int, record: ObjectRecord) -> None:
    count = len(record.positions) // 3
    if index >= count:
        raise XmlFault(f"vertex {index} where there are {count}")


def _nothing(attributes: Attributes) -> None:
    """Do nothing: the element only contains others."""


def _name(namespace: str, local: str) -> str:
    return f"{namespace}{SEPARATOR}{local}"


def whole(attributes: Attributes, key: str, default: int | None = None) -> int:
    """Return an attribute that is an index or ID.

    Raises
    ------
    XmlFault
        It is missing without a default, or not an integer.
    """
    text = attributes.get(key)
    if text is None:
        if default is None:
            raise XmlFault(f"{key!r} is missing")
        return default
    if text.isdigit() and text.isascii() and len(text) < 11 and int(text) <= _MOST_INDEX:
        return int(text)
    raise XmlFault(f"{key!r} is no index: {shown(text)}")


def _placement(attributes: Attributes) -> Placement:
    path = attributes.get(_name(_PRODUCTION, "path"), "")
    return Placement(whole(attributes, "objectid"), _pose(attributes.get("transform")), path)


def _pose(text: str | None) -> np.ndarray:
    """Return the pose of a transform: twelve numbers, rows of a matrix for row vectors."""
    pose = np.eye(4)
    if text is None:
        return pose
    try:
        numbers = [float(word) for word in text.split()]
    except ValueError:
        numbers = []
    if len(numbers) != 12 or not all(map(math.isfinite, numbers)):
        raise XmlFault(f"a transform is twelve numbers: {shown(text)}")
    pose[:3] = np.array(numbers).reshape(4, 3).T
    return pose
