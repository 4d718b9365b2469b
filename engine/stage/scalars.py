"""Colours meshes by a number of their vertices or faces, such as a temperature or a coordinate.

In: a `Document` whose meshes have arrays, the array to show, and for vectors the component. Out:
the same meshes, coloured by a colour map, and the content of a colour bar. The colour map is a
texture, so that numbers are interpolated across triangles, not colours.
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

#: Special values of the component.
MAGNITUDE, DIRECT = -1, -2
_AXES = ("x", "y", "z")
_NORMALS = "normals"
# Texture coordinates beyond this lose precision.
_FARTHEST = 1e4


class ScalarBar(NamedTuple):
    """The data of the colour bar.

    Attributes
    ----------
    title : str
    low, high : float
        The numbers of the first and last colour.
    colors : (N, 3) uint8
    """

    title: str
    low: float
    high: float
    colors: NDArray[np.uint8]


@dataclass
class ScalarColoring:
    """Which numbers to show as colours, and how.

    Attributes
    ----------
    colors : (N, 3) uint8
        A colour map, lowest number first.
    name : str or None
        An array of the file; or ``x``, ``y`` or ``z``, the file's coordinates, or ``normals``. By
        default the file's first array in alphabetical order, or else the height.
    range : (float, float) or None
        The numbers of the first and last colour; by default the lowest and highest number.
    component : int
        For arrays with several numbers per vertex: the component, from 0 on; `MAGNITUDE`: the
        length; `DIRECT`: the numbers are colours: grey, grey and alpha, RGB or RGBA.
    by_faces : bool
        Whether the array belongs to faces.
    """

    colors: NDArray[np.uint8]
    name: str | None = None
    range: tuple[float, float] | None = None
    component: int = MAGNITUDE
    by_faces: bool = False

    @property
    def kind(self) -> Literal["vertices", "faces"]:
        """The elements that the file's arrays belong to."""
        return "faces" if self.by_faces else "vertices"

    def dress(self, document: Document, up: str) -> ScalarBar | None:
        """Colour the meshes of a document; ``up`` is a key of `UP_DIRECTIONS`.

        Return the data of the colour bar; None if the numbers are colours.

        Raises
        ------
        InvalidArgumentError
            No mesh has such an array, or the array lacks the component.
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
        """Return one number of each row, NaN where it has none."""
        rows = array.astype(np.float64)
        if self.component >= rows.shape[1]:
            return np.full(len(rows), np.nan)
        if self.component >= 0:
            return rows[:, self.component]
        return rows[:, 0] if rows.shape[1] == 1 else np.sqrt((rows * rows).sum(axis=1))

    def _texture(self) -> Texture:
        """Return the colour map as a texture: its lower row; the upper has the missing colour."""
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
            # The texture clamps out-of-range numbers per pixel: clamping per vertex would falsify
            # the interpolation.
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
    """Colour a mesh by numbers that are colours: 0 to 255 if integers, else 0 to 1."""
    scale = 1.0 if array.dtype.kind in "iu" else 255.0
    numbers = np.clip(np.nan_to_num(array.astype(np.float64)) * scale, 0.0, 255.0)
    channels = [0, 0, 0] if array.shape[1] < 3 else [0, 1, 2]
    mesh.colors = np.rint(numbers[:, channels]).astype(np.uint8)
    mesh.material_ids = np.zeros(len(mesh.faces), np.int32)
    mesh.materials = [Material()]


def _array(entry: DocumentObject, name: str) -> NDArray[Any]:
    """Return an array of an object's vertices, (V, N); NaN if it lacks the array."""
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
    """Return the lowest and highest number, made distinct."""
    finite = [array[np.isfinite(array)] for array in arrays]
    finite = [array for array in finite if len(array)]
    if not finite:
        return 0.0, 1.0
    low = min(float(array.min()) for array in finite)
    high = max(float(array.max()) for array in finite)
    if low < high:
        return low, high
    # A constant array: put its value in the middle of the bar, in a range wide enough to be
    # written.
    around = abs(low) / 2 or 0.5
    return low - around, low + around
