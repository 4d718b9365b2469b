"""Shapes of revolution: UV sphere, cylinder, torus.

In: radii, heights, numbers of segments. Out: meshes with smooth normals. The column of vertices
where the texture's left and right edges meet is there twice. All sines and cosines come from
`linalg.unit_circle`, so that the shapes are symmetric to the bit.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...base import linalg
from ...errors import InvalidArgumentError
from ..geometry.mesh import Mesh
from .arguments import MAX_SEGMENTS, integer, names_itself, positive, segment_pair
from .faces import BoolArray, IntArray, grid_points, grid_quads, split_quads
from .forms import keeps_forms, shaped

FloatArray = npt.NDArray[np.float64]


def _meridians(count: int) -> FloatArray:
    """Return `count` + 1 unit vectors in the XZ plane from -Z eastward, by -X, +Z, +X, to -Z.

    Column ``k`` belongs to ``u = k / count``: the texture's middle faces +Z.
    """
    x, y = linalg.unit_circle(count)
    circle = np.stack((-y, np.zeros(count), -x), axis=1)
    return np.vstack((circle, circle[:1])) + 0.0


def _wedges(first: int, ring: int, count: int, upward: bool) -> tuple[IntArray, BoolArray]:
    """Return triangles between a pole that has one vertex per wedge and the ring next to it."""
    k = np.arange(count, dtype=np.int32)
    around = (ring + k, ring + k + 1) if upward else (ring + k + 1, ring + k)
    faces = np.stack((first + k, *around), axis=1).astype(np.int32)
    return faces, np.ones((count, 3), np.bool_)


@names_itself
def uv_sphere(radius: float = 0.5, segments: npt.ArrayLike = (32, 16)) -> Mesh:
    """Return a sphere of meridians and parallels, as on a globe.

    The texture is a map: u grows eastward with its middle at +Z, v from the south pole (-Y) to
    the north pole. Each pole has one vertex per wedge, with u in the wedge's middle.

    Parameters
    ----------
    radius : float
    segments : array_like, shape (2,)
        Wedges around, at least 3, and bands from pole to pole, at least 2.

    Returns
    -------
    Mesh
        With ``n, m = segments``: ``2 * n + (m - 1) * (n + 1)`` vertices, ``2 * n * (m - 1)``
        triangles.

    Raises
    ------
    InvalidArgumentError
        If the radius isn't finite and greater than 0, or a number of segments is out of range.
    """
    radius = positive("radius", radius)
    what = "wedges around", "bands from pole to pole"
    around, bands = segment_pair("segments", segments, (3, 2), what)
    normals, form = _globe(around, bands)
    return shaped(form, normals * radius)


@keeps_forms
def _globe(around: int, bands: int) -> tuple[FloatArray, Mesh]:
    """Return the sphere of radius 1, and its positions."""
    height, distance = (values[1:bands] for values in linalg.unit_circle(2 * bands))
    # From the south upwards, hence -height.
    rings = distance[:, np.newaxis, np.newaxis] * _meridians(around)
    rings[..., 1] = -height[:, np.newaxis]
    south, north = (np.tile((0.0, y, 0.0), (around, 1)) for y in (-1.0, 1.0))
    normals = np.vstack((south, rings.reshape(-1, 3), north))
    top = around + (bands - 1) * (around + 1)
    parts = (
        _wedges(0, around, around, upward=False),
        split_quads(grid_quads(bands - 2, around) + np.int32(around)),
        _wedges(top, top - around - 1, around, upward=True),
    )
    return normals, Mesh(
        normals,
        np.vstack([faces for faces, _ in parts]),
        normals=normals,
        uvs=_globe_uvs(around, bands),
        edge_visible=np.vstack([visible for _, visible in parts]),
        position_ids=_globe_points(around, bands),
        name="uv_sphere",
    )


def _globe_points(around: int, bands: int) -> IntArray:
    """Number the points of a globe: the south pole, the parallels, the north pole."""
    parallels = 1 + grid_points(bands - 2, around)
    poles = np.repeat((0, 1 + (bands - 1) * around), around)
    return np.concatenate((poles[:around], parallels, poles[around:])).astype(np.int32)


def _globe_uvs(around: int, bands: int) -> FloatArray:
    middles = (np.arange(around) + 0.5) / around
    v, u = np.meshgrid(np.arange(1, bands) / bands, np.arange(around + 1) / around, indexing="ij")
    rings = np.stack((u.ravel(), v.ravel()), axis=1)
    south, north = (np.stack((middles, np.full(around, v)), axis=1) for v in (0.0, 1.0))
    return np.vstack((south, rings, north))


@names_itself
def cylinder(radius: float = 0.5, height: float = 1.0, segments: int = 32) -> Mesh:
    """Return a closed cylinder about the Y axis.

    The texture runs once round the side, its middle at +Z; each cap shows the disc inscribed in
    it. The spokes of the caps are hidden edges.

    Parameters
    ----------
    radius, height : float
    segments : int
        Sides, at least 3.

    Returns
    -------
    Mesh
        ``4 * (segments + 1)`` vertices and ``4 * segments`` triangles: side, bottom, top.

    Raises
    ------
    InvalidArgumentError
        If a length isn't finite and greater than 0, or the number of segments is out of range.
    """
    radius, height = positive("radius", radius), positive("height", height)
    count = integer("segments", segments, 3, MAX_SEGMENTS)
    positions, form = _cylinder(count)
    return shaped(form, positions * (radius, 0.5 * height, radius))


@keeps_forms
def _cylinder(count: int) -> tuple[FloatArray, Mesh]:
    """Return the cylinder of radius 1 and height 2, and its positions."""
    outward = _meridians(count)
    ring = count + 1
    side_uvs = np.array([(k / count, v) for v in (0.0, 1.0) for k in range(ring)])
    normals = np.vstack((outward, outward, np.repeat([(0, -1, 0), (0, 1, 0)], ring, axis=0)))
    caps = outward.copy()
    caps[count] = 0.0  # the centre
    positions = np.vstack((outward, outward, caps, caps))
    positions[:, 1] = np.repeat((-1.0, 1.0, -1.0, 1.0), ring)
    cap_uvs = [0.5 + 0.5 * caps[:, [0, 2]] * (1.0, -up) for up in (-1.0, 1.0)]
    parts = (
        split_quads(grid_quads(1, count)),
        _fan(2 * ring, count, upward=False),
        _fan(3 * ring, count, upward=True),
    )
    return positions, Mesh(
        positions,
        np.vstack([faces for faces, _ in parts]),
        normals=normals,
        uvs=np.vstack((side_uvs, *cap_uvs)),
        edge_visible=np.vstack([visible for _, visible in parts]),
        position_ids=_cylinder_points(count),
        name="cylinder",
    )


def _cylinder_points(count: int) -> IntArray:
    """Number the points of a cylinder: its two rims, then the centres of the caps."""
    side = grid_points(1, count)
    bottom = np.append(np.arange(count), 2 * count)
    top = np.append(np.arange(count, 2 * count), 2 * count + 1)
    return np.concatenate((side, bottom, top)).astype(np.int32)


def _fan(first: int, count: int, upward: bool) -> tuple[IntArray, BoolArray]:
    """Return the triangles of a disc: `count` vertices from `first` on, then the centre."""
    k = np.arange(count, dtype=np.int32)
    following = (k + 1) % count
    rim = (k, following) if upward else (following, k)
    faces = first + np.stack((*rim, np.full_like(k, count)), axis=1)
    return faces.astype(np.int32), np.tile((True, False, False), (count, 1))


@names_itself
def torus(
    major_radius: float = 0.35, minor_radius: float = 0.15, segments: npt.ArrayLike = (48, 24)
) -> Mesh:
    """Return a ring in the XY plane, about the Z axis.

    Parameters
    ----------
    major_radius : float
        From the centre to the middle of the tube.
    minor_radius : float
        Of the tube, less than `major_radius`.
    segments : array_like, shape (2,)
        Numbers of quads around the ring and around the tube, at least 3 each.

    Returns
    -------
    Mesh
        With ``n, m = segments``: ``(n + 1) * (m + 1)`` vertices and ``2 * n * m`` triangles; u
        runs around the ring from +X counter-clockwise, v around the tube from its outer side.

    Raises
    ------
    InvalidArgumentError
        If a radius or a number of segments is out of its range.
    """
    major = positive("major_radius", major_radius)
    minor = positive("minor_radius", minor_radius)
    if not minor < major:
        raise InvalidArgumentError(
            f"minor_radius must be less than major_radius ({major}), not {minor}"
        )
    what = "around the ring", "around the tube"
    around, across = segment_pair("segments", segments, (3, 3), what)
    ring_x, ring_y, tube_x, tube_z, form = _torus(around, across)
    distance = major + minor * tube_x
    height = minor * tube_z + np.zeros_like(ring_x)
    positions = np.stack((distance * ring_x, distance * ring_y, height), axis=-1)
    return shaped(form, positions.reshape(-1, 3))


@keeps_forms
def _torus(around: int, across: int) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, Mesh]:
    """Return the points of both circles, x and y of each, and a torus."""
    ring_x, ring_y = (np.append(values, values[0]) for values in linalg.unit_circle(around))
    tube_x, tube_z = (np.append(values, values[0]) for values in linalg.unit_circle(across))
    tube_x, tube_z = tube_x[:, np.newaxis], tube_z[:, np.newaxis]
    normals = np.stack((tube_x * ring_x, tube_x * ring_y, tube_z + np.zeros_like(ring_x)), axis=-1)
    v, u = np.meshgrid(
        np.arange(across + 1) / across, np.arange(around + 1) / around, indexing="ij"
    )
    faces, edge_visible = split_quads(grid_quads(across, around))
    form = Mesh(
        normals.reshape(-1, 3),
        faces,
        normals=normals.reshape(-1, 3),
        uvs=np.stack((u.ravel(), v.ravel()), axis=1),
        edge_visible=edge_visible,
        position_ids=grid_points(across, around, closed_rows=True),
        name="torus",
    )
    return ring_x, ring_y, tube_x, tube_z, form
