"""What actors of VTK show: their parts, in view space.

In: a ``vtkActor`` and a view. Out: `Part`s: of faces, of lines, of points. Of a composite, each
block has its own.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy

from ...errors import warn
from ._block_surfaces import surfaces_of
from ._line_marks import strokes
from ._material_maps import maps_of, uvs_of
from ._parts import MANY, Paint, Part
from ._point_marks import dots
from ._properties import Property, property_of
from ._renderer_view import View, matrix_of, product, transformed, turned
from ._scalar_colors import paint_of, texture_of
from ._surfaces import (
    Segments,
    dots_of,
    outlines_of,
    segments_of,
    triangles_of,
    without_strips,
)

_POINTS, _WIRES = 0, 1


def parts_of(actor: Any, view: View, matrix: NDArray[np.float64] | None = None) -> Iterator[Part]:
    """Yield what an actor shows; ``matrix`` is world from actor, its own by default."""
    mapper = actor.GetMapper()
    if mapper is None:
        return
    if mapper.IsA("vtkPointGaussianMapper"):
        warn("engine3d draws splats (points_gaussian) as points of one size")
    look = property_of(actor.GetProperty())
    whole = product(view.view, matrix_of(actor.GetMatrix()) if matrix is None else matrix)
    back = actor.GetBackfaceProperty()
    for data, changed in surfaces_of(mapper, look):
        if not data.GetNumberOfPoints():
            continue
        one = _Shown(actor, mapper, without_strips(data), view, whole, changed)
        for part in one.parts():
            yield from _sides(part, None if back is None else property_of(back), view)


def _sides(part: Part, back: Property | None, view: View) -> Iterator[Part]:
    """Yield the sides of a part that show, with the look of each."""
    look = part.look
    if not (look.hides_back or look.hides_front or (back is not None and part.is_face)):
        yield part
        return
    if not look.hides_front:
        yield part.facing(True, view.is_parallel)
    if not look.hides_back:
        behind = part.facing(False, view.is_parallel)
        yield behind if back is None else replace(behind, look=back)


class _Shown:
    """A surface with its actor, in a view."""

    def __init__(
        self,
        actor: Any,
        mapper: Any,
        data: Any,
        view: View,
        matrix: NDArray[np.float64],
        look: Property,
    ) -> None:
        self._data, self._view, self._look = data, view, look
        points = vtk_to_numpy(data.GetPoints().GetData())

        self._places = transformed(matrix, points)
        self._paint, self._is_of_cells = paint_of(mapper, data)
        self._normals = self._normals_of(data, matrix)
        self._maps = maps_of(actor.GetProperty(), data) if look.is_physical else None
        self._wear(actor, data)

    def _normals_of(self, data: Any, matrix: NDArray[np.float64]) -> NDArray[np.float64] | None:
        normals = data.GetPointData().GetNormals()
        if self._look.is_flat or normals is None:
            return None
        return turned(matrix, vtk_to_numpy(normals))

    def _wear(self, actor: Any, data: Any) -> None:
        """Put the actor's texture on."""
        texture = actor.GetTexture() or actor.GetProperty().GetTexture("albedoTex")
        coordinates = data.GetPointData().GetTCoords()
        if texture is None:
            return
        if texture.GetCubeMap():
            warn("a cube map as the texture of an actor is not drawn")
            return
        image = texture_of(texture)
        if image is None or coordinates is None:
            return
        uvs = uvs_of(coordinates)
        if (transform := texture.GetTransform()) is not None:
            m = matrix_of(transform.GetMatrix())
            uvs = (uvs @ m[:2, :2].T + m[:2, 3]).astype(np.float32)
        baked = self._paint.baked()
        is_clear = baked.is_clear or bool((image.pixels[..., 3] != 255).any())
        if self._is_of_cells:
            warn("of a texture and colours of cells, the texture is drawn alone")
            baked = Paint()
            self._is_of_cells = False
        self._paint = Paint(baked.rgba, uvs, image, is_clear, not self._paint.is_plain)

    def parts(self) -> Iterator[Part]:
        style = self._look.style
        if style == _POINTS:
            yield from self._of_corners()
            return
        yield from self._of_dots(dots_of(self._data))
        yield from self._of_lines(segments_of(self._data))
        if style == _WIRES:
            yield from self._of_lines(outlines_of(self._data), is_wire=True)
        else:
            yield from self._of_faces()

    def _of_faces(self) -> Iterator[Part]:
        faces, cells, edges = triangles_of(self._data, self._places)
        if not len(faces):
            return
        paint = Paint() if self._is_of_cells else self._paint
        part = Part(self._places, faces, self._look, self._normals, paint, edges, is_face=True)
        part.maps = self._maps
        if self._is_of_cells and self._paint.rgba is not None:
            part.face_rgba = self._paint.rgba[cells]
            if len(faces) <= MANY or self._paint.is_clear:
                part = part.with_own_corners()
        yield part

    def _of_lines(self, segments: Segments, is_wire: bool = False) -> Iterator[Part]:
        if not len(segments.ends):
            return
        rows = segments.ends.reshape(-1)
        cells = np.repeat(segments.cells, 2)
        normals = None if self._normals is None else self._normals[rows].reshape(-1, 2, 3)
        ends = self._places[rows].reshape(-1, 2, 3)
        paint = self._paint.taken(cells if self._is_of_cells else rows)
        yield strokes(
            self._view, ends, paint, self._of_marks(is_wire or self._look.has_tubes), normals
        )

    def _of_dots(self, points: Segments) -> Iterator[Part]:
        if not len(points.ends):
            return
        rows = points.ends
        normals = None if self._normals is None else self._normals[rows]
        paint = self._paint.taken(points.cells if self._is_of_cells else rows)
        look = self._of_marks(self._look.has_balls)
        yield dots(self._view, self._places[rows], paint, look, normals)

    def _of_marks(self, is_lit: bool) -> Property:
        """Return the look of lines and points: without normals, VTK lights only some."""
        is_lit = is_lit or self._normals is not None
        is_unlit = self._look.is_unlit or not is_lit
        return replace(
            self._look, edge_width=0.0, is_unlit=is_unlit, hides_back=False, hides_front=False
        )

    def _of_corners(self) -> Iterator[Part]:
        """Yield the corners of all cells as points."""
        found = [dots_of(self._data)]
        for segments in (segments_of(self._data), outlines_of(self._data)):
            found.append(Segments(segments.ends[:, 0], segments.cells))
            if len(segments.ends):
                found.append(Segments(segments.ends[:, 1], segments.cells))
        ends = np.concatenate([one.ends for one in found])
        cells = np.concatenate([one.cells for one in found])
        _, first = np.unique(ends, return_index=True)
        yield from self._of_dots(Segments(ends[first], cells[first]))
