"""Meshes coloured by a number that their vertices or faces have: a temperature, a coordinate.

In: a `Document` whose meshes carry arrays, which of them is wanted, and of vectors which part. Out:
the same meshes, which show it by a colour map, and what a bar tells of it. The colour map is a
texture, so that what is interpolated across a triangle is the number, not the colour.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..base.linalg import inverse, normalize, transform_directions, transform_points
from ..errors import InvalidArgumentError
from ..io.reading.documents import Document, DocumentObject
from ..model.geometry.mesh import Mesh, scalars_of
from ..model.materials.material import Material
from ..model.materials.textures import Texture
from .overlays.colormaps import MISSING

#: Components that are none.
MAGNITUDE, DIRECT = -1, -2
_AXES = ("x", "y", "z")
_NORMALS = "normals"
# Texture coordinates beyond this have no fine places left.
_FARTHEST = 1e4


class ScalarBar(NamedTuple):
    """The bar that explains the colours.

    Attributes
    ----------
    title : str
    low, high : float
        What the first and the last colour stand for.
    colors : (N, 3) uint8
    """

    title: str
    low: float
    high: float
    colors: NDArray[np.uint8]


@dataclass
class ScalarColoring:
    """The numbers that are shown as colours, and how.

    Attributes
    ----------
    colors : (N, 3) uint8
        A colour map, that of the lowest number first.
    name : str or None
        An array of the file; or ``x``, ``y`` or ``z``, the file's coordinates, or ``normals``. By
        default the file's first in alphabetical order, and without any how high it is.
    range : (float, float) or None
        What the first and the last colour stand for; by default the lowest and the highest number.
    component : int
        Of arrays with several numbers a vertex: which, from 0 on; `MAGNITUDE`: their length;
        `DIRECT`: none, the numbers are colours: grey, grey and alpha, RGB or RGBA.
    by_faces : bool
        Whether the array is one of faces.
    """

    colors: NDArray[np.uint8]
    name: str | None = None
    range: tuple[float, float] | None = None
    component: int = MAGNITUDE
    by_faces: bool = False

    @property
    def kind(self) -> Literal["vertices", "faces"]:
        """What the file's arrays must belong to."""
        return "faces" if self.by_faces else "vertices"

    def dress(self, document: Document, up: str) -> ScalarBar | None:
        """Colour the meshes of a document; ``up`` is a key of `UP_DIRECTIONS`.

        Returns what the colours mean; None where the numbers are colours.

        Raises
        ------
        InvalidArgumentError
            No mesh has such an array, or it has no such component.
        """
        name = self._chosen(document, up)
        meshes = {id(entry.mesh): entry for entry in document.objects}
        arrays = {key: _array(entry, name) for key, entry in meshes.items()}
        width = max((array.shape[1] for array in arrays.values()), default=1)
        if self.component >= width:
            raise InvalidArgumentError(
                f"the array {name!r} has no component {self.component}: the last is {width - 1}"
            )
        if self.component == DIRECT:
            for key, entry in meshes.items():
                _show_colors(entry.mesh, arrays[key])
            return None
        values = {key: self._values(array) for key, array in arrays.items()}
        low, high = self.range or _range(values.values())
        texture = self._texture()
        for key, entry in meshes.items():
            self._show(entry, values[key], low, high, texture)
        title, unit = self._title(name, width), document.unit if name in _AXES else ""
        return ScalarBar(f"{title} [{unit}]" if unit else title, low, high, self.colors)

    def _title(self, name: str, width: int) -> str:
        if width == 1:
            return name
        return f"|{name}|" if self.component == MAGNITUDE else f"{name}[{self.component}]"

    def _chosen(self, document: Document, up: str) -> str:
        known = sorted({name for scalars in document.scalars for name in scalars})
        own = () if self.by_faces else (*_AXES, _NORMALS)
        if self.name is None and (known or own):
            return known[0] if known else up[1:].lower()
        if self.name is None or self.name not in (*known, *own):
            lacking = "array of faces" if self.by_faces else "array"
            lacking += "" if self.name is None else f" {self.name!r}"
            names = f"there are {', '.join([*known, *own])}" if known or own else "there are none"
            raise InvalidArgumentError(f"there is no {lacking}; {names}")
        return self.name

    def _values(self, array: NDArray[Any]) -> NDArray[np.float64]:
        """One number of each row, NaN where it has none."""
        rows = array.astype(np.float64)
        if self.component >= rows.shape[1]:
            return np.full(len(rows), np.nan)
        if self.component >= 0:
            return rows[:, self.component]
        return rows[:, 0] if rows.shape[1] == 1 else np.sqrt((rows * rows).sum(axis=1))

    def _texture(self) -> Texture:
        """The colour map in the lower row; above it the colour of what has no number."""
        pixels = np.empty((2, len(self.colors), 3), np.uint8)
        pixels[0], pixels[1] = MISSING, self.colors
        return Texture(pixels, filter="bilinear", wrap="clamp", name="colour map")

    def _show(
        self, entry: DocumentObject, values: NDArray[Any], low: float, high: float, texture: Texture
    ) -> None:
        mesh, count = entry.mesh, len(self.colors)
        is_number = np.isfinite(values)
        shares = (np.where(is_number, values, low) - low) / (high - low)
        if len(mesh.faces):
            # Numbers out of range are cut off by the texture, in each pixel: else what lies between
            # one of them and another would be shown wrong.
            across = (0.5 + np.clip(shares, -_FARTHEST, _FARTHEST) * (count - 1)) / count
            mesh.colors = None
            mesh.uvs = np.stack([across, np.where(is_number, 0.25, 0.75)], axis=1)
            mesh.material_ids = np.zeros(len(mesh.faces), np.int32)
            mesh.materials = [Material(texture=texture)]
            return
        numbers = np.rint(np.clip(shares, 0.0, 1.0) * (count - 1)).astype(np.int64)
        chosen = self.colors[numbers]
        mesh.colors = np.where(is_number[:, np.newaxis], chosen, np.uint8(MISSING[0]))
        mesh.materials = [Material()]


def _show_colors(mesh: Mesh, array: NDArray[Any]) -> None:
    """Colour a mesh by numbers that are colours: of 0 to 255 if they are integers, else to 1."""
    scale = 1.0 if array.dtype.kind in "iu" else 255.0
    numbers = np.clip(np.nan_to_num(array.astype(np.float64)) * scale, 0.0, 255.0)
    channels = [0, 0, 0] if array.shape[1] < 3 else [0, 1, 2]
    mesh.colors = np.rint(numbers[:, channels]).astype(np.uint8)
    mesh.material_ids = np.zeros(len(mesh.faces), np.int32)
    mesh.materials = [Material()]


def _array(entry: DocumentObject, name: str) -> NDArray[Any]:
    """The numbers of an object's vertices, (V, N); NaN where it has none of that name."""
    mesh, pose = entry.mesh, entry.pose
    if name in scalars_of(mesh):
        return scalars_of(mesh)[name].reshape(len(mesh.positions), -1)
    if name == _NORMALS:
        normals = mesh.normals.astype(np.float64)
        if pose is None:
            return normals
        return normalize(transform_directions(inverse(pose).T, normals))
    if name not in _AXES:
        return np.full((len(mesh.positions), 1), np.nan)
    positions = mesh.positions.astype(np.float64)
    if pose is not None:
        positions = transform_points(pose, positions)
    return positions[:, [_AXES.index(name)]]


def _range(arrays: Iterable[NDArray[np.float64]]) -> tuple[float, float]:
    """The lowest and the highest number, apart from each other."""
    finite = [array[np.isfinite(array)] for array in arrays]
    finite = [array for array in finite if len(array)]
    if not finite:
        return 0.0, 1.0
    low = min(float(array.min()) for array in finite)
    high = max(float(array.max()) for array in finite)
    if low < high:
        return low, high
    # One number for all: it is the middle of what the bar shows, not the end of a range too narrow
    # to be written.
    around = abs(low) / 2 or 0.5
    return low - around, low + around
