"""Meshes coloured by a number that their vertices have, such as a temperature, or a coordinate.

In: a `Document` whose meshes carry scalars, and which of them is wanted. Out: the same meshes,
which show it by a colour map, and what a bar tells of it. The colour map is a texture, so that what
is interpolated across a triangle is the number, not the colour.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import InvalidArgumentError
from ..linalg import transform_points
from ..loaders.documents import Document, DocumentObject
from ..materials.material import Material
from ..materials.textures import Texture
from .colormaps import MISSING

_AXES = ("x", "y", "z")
# Texture coordinates beyond this have no fine places left.
_FARTHEST = 1e4


class ScalarBar(NamedTuple):
    """What the colours mean.

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
    """Which numbers are shown, and how.

    Attributes
    ----------
    colors : (N, 3) uint8
        A colour map, that of the lowest number first.
    name : str or None
        A scalar of the file, or ``x``, ``y`` or ``z``, the file's coordinates; by default the first
        scalar of the file, and without any how high it is.
    range : (float, float) or None
        What the first and the last colour stand for; by default the lowest and the highest number.
    """

    colors: NDArray[np.uint8]
    name: str | None = None
    range: tuple[float, float] | None = None

    def dress(self, document: Document, up: str) -> ScalarBar:
        """Colour the meshes of a document; ``up`` is a key of `UP_DIRECTIONS`.

        Raises
        ------
        InvalidArgumentError
            No mesh has such a scalar.
        """
        name = self._chosen(document, up)
        meshes = {id(entry.mesh): entry for entry in document.objects}
        values = {key: _values(entry, name) for key, entry in meshes.items()}
        low, high = self.range or _range(values.values())
        texture = self._texture()
        for key, entry in meshes.items():
            self._show(entry, values[key], low, high, texture)
        unit = document.unit if name in _AXES else ""
        return ScalarBar(f"{name} [{unit}]" if unit else name, low, high, self.colors)

    def _chosen(self, document: Document, up: str) -> str:
        known = dict.fromkeys(name for scalars in document.scalars for name in scalars)
        if self.name is None:
            return next(iter(known), up[1:].lower())
        if self.name not in known and self.name not in _AXES:
            names = ", ".join([*known, *_AXES])
            raise InvalidArgumentError(f"there is no array {self.name!r}; there are {names}")
        return self.name

    def _texture(self) -> Texture:
        """The colour map in the lower row; above it the colour of what has no number."""
        pixels = np.empty((2, len(self.colors), 3), np.uint8)
        pixels[0], pixels[1] = MISSING, self.colors
        return Texture(pixels, filter="bilinear", wrap="clamp", name="colour map")

    def _show(
        self, entry: DocumentObject, values: NDArray, low: float, high: float, texture: Texture
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


def _values(entry: DocumentObject, name: str) -> NDArray[np.float64]:
    """The numbers of an object's vertices; NaN where it has none of that name."""
    mesh = entry.mesh
    if name in mesh._scalars:
        return mesh._scalars[name].astype(np.float64)
    if name not in _AXES:
        return np.full(len(mesh.positions), np.nan)
    positions = mesh.positions.astype(np.float64)
    if entry.pose is not None:
        positions = transform_points(entry.pose, positions)
    return positions[:, _AXES.index(name)]


def _range(arrays) -> tuple[float, float]:
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
