"""Polygons: Poly3DCollection, and patches made of straight lines.

In: artists and the view. Out: triangles of their faces in the pile, then their edges.
"""

from __future__ import annotations

from weakref import WeakKeyDictionary, ref

import numpy as np
from matplotlib.path import Path

from ...io.reading.triangulation import triangulate
from ._colors import codes_of
from ._limits import hidden_points
from ._lines import draw_runs
from ._pile import Pile, drop_broken
from ._view import View

_TOWARDS_MEAN = 0.002  # how far edges move towards the depth of their polygon


def colors_of(collection) -> tuple[np.ndarray, np.ndarray]:
    """Return the colours of faces and edges of a Poly3DCollection, in the order of its polygons."""
    collection.update_scalarmappable()
    face, edge = collection._facecolor3d, collection._edgecolor3d
    if collection._A is not None:
        face = collection._facecolors if collection._face_is_mapped else face
        edge = collection._edgecolors if collection._edge_is_mapped else edge
    count = len(collection._faces)
    # Other numbers of colours than of polygons: mplot3d takes the first.
    return codes_of(face if len(face) == count else face[:1]), codes_of(edge)


def vertex_count(collection) -> int:
    """Return about how many vertices `draw_faces` adds."""
    grid = getattr(collection, "_engine3d_grid", None)
    if grid is not None and len(collection._facecolor3d) == 1 and collection._A is None:
        return int(np.prod(grid[1]))
    return int(np.prod(collection._faces.shape[:2]))


def draw_faces(pile: Pile, view: View, collection) -> None:
    """Add the faces of a Poly3DCollection."""
    faces, colors = collection._faces, colors_of(collection)[0]
    count, corners = faces.shape[:2]
    if not count or not len(colors) or not colors[:, 3].any():
        return
    if len(colors) == 1 and (grid := _grid_of(collection)) is not None:
        pile.add_polygons(*grid, colors[0])
        return
    sizes, points = _polygons_of(collection)
    if corners > 3 and (colors[:, 3] < 255).any():
        _draw_clear(pile, view, sizes, points, colors)
        return
    triangles = _triangles_of(collection, sizes, points)
    colors = colors[0] if len(colors) == 1 else np.repeat(colors, sizes, 0)
    pile.add_polygons(points, triangles[::-1], colors, sizes)


#: The triangles of collections drawn before, with the polygons that they were cut from.
_cut: WeakKeyDictionary = WeakKeyDictionary()


def _triangles_of(collection, sizes: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return the triangles of polygons, which are cut once, unless some corners are left out."""
    faces = collection._faces
    if not np.may_share_memory(faces, points):
        return triangulate(sizes, points).corners
    if collection not in _cut or _cut[collection][0]() is not faces:
        _cut[collection] = ref(faces), triangulate(sizes, points).corners
    return _cut[collection][1]


def _draw_clear(
    pile: Pile, view: View, sizes: np.ndarray, points: np.ndarray, colors: np.ndarray
) -> None:
    """Add polygons that are cut on the page, so that none is laid over itself."""
    places = view.screen(points)
    drop_broken(places, sizes)
    cut = triangulate(sizes, np.nan_to_num(places) * (1.0, 1.0, 0.0))
    triangles, owners = cut.corners, np.repeat(np.arange(len(sizes)), sizes)
    if (sizes == 4).all():
        crossed, places, halves = _uncrossed(places)
        triangles = np.concatenate([triangles[~np.isin(cut.polygons, crossed)], halves])
        owners = np.concatenate([owners, crossed])
    pile.add(places, colors[0] if len(colors) == 1 else colors[owners], triangles[::-1])


def _uncrossed(places: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Cut quads whose edges cross on the page in two.

    Returns
    -------
    quads : (Q,) int
        Those, one for each place that is added.
    places : (V + Q, 3) float64
    triangles : (2 Q, 3) int32
    """
    quads, corners = [], places.reshape(-1, 4, 3)
    added, triangles = [places], []
    count = len(places)
    # Edges 1-2 and 3-0 cross, or edges 0-1 and 2-3.
    for first in (1, 0):
        a, b, c, d = ((first + k) % 4 for k in range(4))
        start, other = corners[:, a], corners[:, c]
        along, across, between = corners[:, b] - start, corners[:, d] - other, other - start
        with np.errstate(all="ignore"):
            area = along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0]
            s = (between[:, 0] * across[:, 1] - between[:, 1] * across[:, 0]) / area
            t = (between[:, 0] * along[:, 1] - between[:, 1] * along[:, 0]) / area
        found = np.flatnonzero((s > 0) & (s < 1) & (t > 0) & (t < 1))
        quads.append(found)
        added.append(0.5 * (start + s[:, None] * along + other + t[:, None] * across)[found])
        middle = count + np.arange(len(found))
        count += len(found)
        triangles += [
            np.stack([4 * found + b, 4 * found + c, middle], 1),
            np.stack([4 * found + d, 4 * found + a, middle], 1),
        ]
    return np.concatenate(quads), np.concatenate(added), np.concatenate(triangles).astype(np.int32)


def remember_grid(surface, shape: tuple[int, ...]) -> None:
    """Note that a surface has all cells of a grid of so many rows and columns of points."""
    rows, columns = shape
    faces = surface._faces
    if faces.shape == ((rows - 1) * (columns - 1), 4, 3) and not np.any(surface._invalid_vertices):
        surface._engine3d_grid = faces, shape


def _grid_of(surface) -> tuple[np.ndarray, np.ndarray] | None:
    """Return the points of a surface's grid, (V, 3), and triangles; None if some are hidden."""
    faces, shape = getattr(surface, "_engine3d_grid", (None, (0, 0)))
    if (
        faces is not surface._faces
        or faces is None
        or hidden_points(faces[:1], surface) is not None
    ):
        return None
    rows, columns = shape
    cells, points = faces.reshape(rows - 1, columns - 1, 4, 3), np.empty((rows, columns, 3))
    points[:-1, :-1] = cells[:, :, 0]
    points[:-1, -1], points[-1, -1], points[-1, :-1] = (
        cells[:, -1, 1],
        cells[-1, -1, 2],
        cells[-1, :, 3],
    )
    number = np.arange(rows * columns, dtype=np.int32).reshape(shape)
    triangles = np.empty((rows - 1, columns - 1, 2, 3), np.int32)
    triangles[..., 0], triangles[..., 0, 1] = number[:-1, :-1, None], number[:-1, 1:]
    triangles[..., 0, 2] = triangles[..., 1, 1] = number[1:, 1:]
    triangles[..., 1, 2] = number[1:, :-1]
    return points.reshape(-1, 3), triangles.reshape(-1, 3)[::-1]


def draw_edges(pile: Pile, view: View, collection) -> None:
    """Add the edges of a Poly3DCollection."""
    edges = colors_of(collection)[1]
    if not len(edges) or not edges[:, 3].any() or not np.any(collection.get_linewidth()):
        return
    if len(edges) == 1 and (grid := _grid_of(collection)) is not None:
        shape = collection._engine3d_grid[1]
        net = view.screen(grid[0]).reshape(*shape, 3)
        places = np.concatenate([net.reshape(-1, 3), net.transpose(1, 0, 2).reshape(-1, 3)])
        sizes = np.repeat([shape[1], shape[0]], shape)
        draw_runs(pile, view, places, sizes, collection, edges, of_faces=True)
        return
    sizes, points = _polygons_of(collection)
    places = view.screen(points)
    drop_broken(places, sizes)
    if len(sizes) and (sizes > 0).all():
        # Where two polygons meet, the edge of the nearer one shows, as if it were painted later.
        means = np.add.reduceat(places[:, 2], np.cumsum(sizes) - sizes) / sizes
        places[:, 2] += _TOWARDS_MEAN * (np.repeat(means, sizes) - places[:, 2])
    if getattr(collection, "_closed", True) or collection._codes3d is not None:
        places, sizes = _closed(places, sizes)
    draw_runs(pile, view, places, sizes, collection, edges, of_faces=True)


def _polygons_of(collection) -> tuple[np.ndarray, np.ndarray]:
    """Return the sizes of polygons, and all corners, (V, 3); hidden ones are not a number."""
    faces, codes = collection._faces, collection._codes3d
    count, corners = faces.shape[:2]
    sizes = np.full(count, corners)
    points = faces.reshape(-1, 3)
    invalid = np.broadcast_to(collection._invalid_vertices, (count, corners))
    if codes is not None and len(codes):
        ends = np.array([_length(one) for one in codes])
        invalid = invalid | (np.arange(corners) >= ends[:, None])
    if invalid.any():
        sizes = (~invalid).sum(1)
        points = points[~invalid.ravel()]
    hidden = hidden_points(points, collection)
    if hidden is not None and hidden.any():
        points = points.copy()
        points[hidden] = np.nan
    return sizes, np.ascontiguousarray(points, float)


def _length(codes) -> int:
    """Return how many vertices of a path of lines are corners."""
    codes = np.asarray(codes)
    return len(codes) - int(codes[-1] == Path.CLOSEPOLY) if len(codes) else 0


def is_plain(codes) -> bool:
    """Return whether codes are those of one polygon: a start, lines, perhaps an end."""
    codes = np.asarray(codes)
    inner = codes[1:-1]
    return bool(
        len(codes) > 2
        and codes[0] == Path.MOVETO
        and (inner == Path.LINETO).all()
        and codes[-1] in (Path.LINETO, Path.CLOSEPOLY)
    )


def _closed(places: np.ndarray, sizes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Repeat the first corner of each polygon at its end."""
    ends, has_any = np.cumsum(sizes), sizes > 0
    return np.insert(places, ends[has_any], places[(ends - sizes)[has_any]], 0), sizes + has_any
