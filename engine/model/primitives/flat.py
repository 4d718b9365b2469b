"""Shapes of flat faces: box, plane, quad.

In: sizes, corners, numbers of segments. Out: meshes whose vertices aren't shared across edges
where the normal changes.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...base import linalg
from ...base.numbers import as_array, floats
from ...errors import InvalidArgumentError
from ..geometry.mesh import Mesh
from .arguments import MAX_SEGMENTS, integer, names_itself, positives, segment_pair
from .faces import grid_quads, split_quads
from .forms import keeps_forms, shaped

FloatArray = npt.NDArray[np.float64]

# Texture coordinates of a quad's corners: lower left, lower right, upper right, upper left.
_CORNER_UVS = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])

# Of each face of a box: the outward normal, then the directions of growing u and growing v. Every
# side stands upright; top and bottom continue the front.
_BOX_FACES = np.array(
    [
        [(1, 0, 0), (0, 0, -1), (0, 1, 0)],
        [(-1, 0, 0), (0, 0, 1), (0, 1, 0)],
        [(0, 1, 0), (1, 0, 0), (0, 0, -1)],
        [(0, -1, 0), (1, 0, 0), (0, 0, 1)],
        [(0, 0, 1), (1, 0, 0), (0, 1, 0)],
        [(0, 0, -1), (-1, 0, 0), (0, 1, 0)],
    ],
    dtype=np.float64,
)


@names_itself
def box(size: float | npt.ArrayLike = (1.0, 1.0, 1.0)) -> Mesh:
    """Return an axis-aligned box with the whole texture on each face.

    Parameters
    ----------
    size : float or array_like of shape (3,)
        Edge lengths along x, y and z.

    Returns
    -------
    Mesh
        24 vertices and 12 triangles; faces in the order +X, -X, +Y, -Y, +Z, -Z, two triangles each.

    Raises
    ------
    InvalidArgumentError
        If a length isn't finite and greater than 0.
    """
    corners, form = _cube()
    return shaped(form, corners * (0.5 * np.array(positives("size", size, 3))))


@keeps_forms
def _cube() -> tuple[FloatArray, Mesh]:
    """Return the box from -1 to 1, and its positions."""
    normals, right, up = (_BOX_FACES[:, np.newaxis, k] for k in range(3))
    offset = 2.0 * _CORNER_UVS - 1.0
    corners = (normals + right * offset[:, :1] + up * offset[:, 1:]).reshape(-1, 3)
    faces, edge_visible = split_quads(np.arange(24, dtype=np.int32).reshape(6, 4))
    return corners, Mesh(
        corners,
        faces,
        normals=np.repeat(_BOX_FACES[:, 0], 4, axis=0),
        uvs=np.tile(_CORNER_UVS, (6, 1)),
        edge_visible=edge_visible,
        position_ids=_corner_numbers(corners),
        name="box",
    )


def _corner_numbers(corners: FloatArray) -> npt.NDArray[np.int32]:
    """Number corners of the cube from -1 to 1 by the octant that they lie in."""
    return ((corners > 0.0) * (1, 2, 4)).sum(axis=1).astype(np.int32)


@names_itself
def plane(size: float | npt.ArrayLike = (1.0, 1.0), segments: int | npt.ArrayLike = 1) -> Mesh:
    """Return a horizontal rectangle that faces +Y, such as a floor.

    The texture lies on it as seen from above with -Z (away from the viewer) at the top.

    Parameters
    ----------
    size : float or array_like of shape (2,)
        Lengths along x and z.
    segments : int or array_like of shape (2,)
        Numbers of quads along x and z, from 1 to 8192.

    Returns
    -------
    Mesh
        ``(sx + 1) * (sz + 1)`` vertices and ``2 * sx * sz`` triangles, rows from +Z to -Z.

    Raises
    ------
    InvalidArgumentError
        If a length or a number of segments is out of its range.
    """
    width, depth = positives("size", size, 2)
    segments = as_array(segments, "segments")
    if segments.ndim == 0:
        segments = (integer("segments", segments.item(), 1, MAX_SEGMENTS),) * 2
    columns, rows = segment_pair("segments", segments, (1, 1), ("along x", "along z"))
    u, v, form = _sheet(rows, columns)
    return shaped(form, np.stack(((u - 0.5) * width, np.zeros_like(u), (0.5 - v) * depth), axis=1))


@keeps_forms
def _sheet(rows: int, columns: int) -> tuple[FloatArray, FloatArray, Mesh]:
    """Return the texture coordinates of a plane, and a plane."""
    grid = np.meshgrid(np.arange(rows + 1) / rows, np.arange(columns + 1) / columns, indexing="ij")
    v, u = grid[0].ravel(), grid[1].ravel()
    faces, edge_visible = split_quads(grid_quads(rows, columns))
    form = Mesh(
        np.stack((u, np.zeros_like(u), v), axis=1),
        faces,
        normals=np.tile((0.0, 1.0, 0.0), (len(u), 1)),
        uvs=np.stack((u, v), axis=1),
        edge_visible=edge_visible,
        name="plane",
    )
    return u, v, form


@names_itself
def quad(
    p0: npt.ArrayLike = (-0.5, -0.5, 0.0),
    p1: npt.ArrayLike = (0.5, -0.5, 0.0),
    p2: npt.ArrayLike = (0.5, 0.5, 0.0),
    p3: npt.ArrayLike = (-0.5, 0.5, 0.0),
) -> Mesh:
    """Return a quadrilateral with the whole texture on it.

    It has one normal, perpendicular to both diagonals, so that its shade is one even where its
    corners don't lie in a plane.

    Parameters
    ----------
    p0, p1, p2, p3 : array_like, shape (3,)
        Corners, counter-clockwise: the texture's lower left, lower right, upper right, upper left.

    Returns
    -------
    Mesh
        4 vertices and 2 triangles.

    Raises
    ------
    InvalidArgumentError
        If a corner isn't a finite point, or the corners span no area.
    """
    try:
        corners = floats((p0, p1, p2, p3), "p0, p1, p2 and p3")
    except (TypeError, ValueError):
        raise InvalidArgumentError("p0, p1, p2 and p3 must be points of 3 numbers") from None
    if corners.shape != (4, 3) or not np.all(np.isfinite(corners)):
        raise InvalidArgumentError("p0, p1, p2 and p3 must be finite points of 3 numbers")
    normal = linalg.normalize(linalg.cross(corners[2] - corners[0], corners[3] - corners[1]))
    if not np.any(normal):
        raise InvalidArgumentError("the corners of a quad must span an area")
    faces, edge_visible = split_quads(np.arange(4, dtype=np.int32).reshape(1, 4))
    return Mesh(
        corners,
        faces,
        normals=np.tile(normal, (4, 1)),
        uvs=_CORNER_UVS,
        edge_visible=edge_visible,
        name="quad",
    )


# Of each face of a hexahedron, as of a box: lower left, lower right, upper right, upper left.
_HEXAHEDRON_FACES = np.array(
    [(5, 1, 2, 6), (0, 4, 7, 3), (7, 6, 2, 3), (0, 1, 5, 4), (4, 5, 6, 7), (1, 0, 3, 2)], np.int32
)


@names_itself
def hexahedron(corners: npt.ArrayLike) -> Mesh:
    """Return a box of any eight corners, with the whole texture on each face.

    Each face has one normal, perpendicular to both its diagonals, as that of `quad`. Corners may
    coincide, so that it is a wedge or a pyramid.

    Parameters
    ----------
    corners : array_like, shape (8, 3)
        Four at the back, then four at the front, each lower left, lower right, upper right, upper
        left as seen from the front: the order of VTK's hexahedron. Four of one side and the four
        across from them, in the same order, are taken from any two sides: where that would turn
        the box inside out, the two sides change places.

    Returns
    -------
    Mesh
        24 vertices and 12 triangles; faces in the order of `box`.

    Raises
    ------
    InvalidArgumentError
        If the corners aren't 8 finite points, or span no area.
    """
    points = floats(corners, "the corners")
    if points.shape != (8, 3) or not np.all(np.isfinite(points)):
        raise InvalidArgumentError("the corners of a hexahedron must be 8 finite points")
    quads, across = _sides(points)
    if linalg.dot(quads.mean(axis=1) - points.mean(axis=0), across).sum() < 0.0:
        quads, across = _sides(np.roll(points, 4, axis=0))
    normals = linalg.normalize(across)
    if not np.any(normals):
        raise InvalidArgumentError("the corners of a hexahedron must span an area")
    faces, edge_visible = split_quads(np.arange(24, dtype=np.int32).reshape(6, 4))
    return Mesh(
        quads.reshape(-1, 3),
        faces,
        normals=np.repeat(normals, 4, axis=0),
        uvs=np.tile(_CORNER_UVS, (6, 1)),
        edge_visible=edge_visible,
        position_ids=_HEXAHEDRON_FACES.reshape(-1),
        name="hexahedron",
    )


def _sides(points: npt.NDArray[np.float64]) -> tuple[npt.NDArray[np.float64], ...]:
    """Return the corners of the sides, (6, 4, 3), and the products of their diagonals, (6, 3)."""
    quads = points[_HEXAHEDRON_FACES]
    return quads, linalg.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1])
