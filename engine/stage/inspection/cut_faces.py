"""The faces that a section lays bare: flat meshes, hatched as cut material is in drawings.

In: the outline of a cut. Out: a mesh in the plane, or None where the outline has no inside.
"""

from __future__ import annotations

import functools

import numpy as np
from numpy.typing import NDArray

from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from ...model.measuring.cutting import Outline, Plane, gaps_of
from ...model.measuring.filling import fill

#: Colours of cut material and its hatching.
CUT, HATCH = (232, 164, 124), (150, 78, 44)
#: Texels a side of the hatching's texture, and how many of them a line takes.
_SIDE, _LINE = 128, 11
#: A trapezoid reaches beyond its sides by this share of the outline's extent: no gap shows.
_MARGIN = 1e-5


@functools.cache
def hatching() -> Material:
    """Return the material of cut faces."""
    rows, columns = np.indices((_SIDE, _SIDE))
    stripes = (rows + columns) % _SIDE < _LINE
    pixels = np.where(stripes[..., np.newaxis], HATCH, CUT).astype(np.uint8)
    texture = Texture(pixels, wrap="repeat", name="hatching")
    return Material(texture=texture, two_sided=True, name="cut")


def cut_face(outline: Outline, plane: Plane, pitch: float, lift: float = 0.0) -> Mesh | None:
    """Return the face of a cut, in world space, that looks to where its plane is seen from.

    Parameters
    ----------
    outline : Outline
        Gaps in it are closed by straight lines.
    plane : Plane
    pitch : float
        World units between lines of the hatching, along an edge.
    lift : float
        How far before the plane the face lies, in world units.

    Returns
    -------
    Mesh or None
        None where the outline is open all round, or too intricate.
    """
    gaps = gaps_of(outline.segments)
    if gaps is None:
        return None
    closed = np.concatenate([outline.segments, gaps])
    across, upward = (plane.axis + 1) % 3, (plane.axis + 2) % 3
    flat = closed[..., [across, upward]]
    extent = float((flat.max(axis=(0, 1)) - flat.min(axis=(0, 1))).max())
    triangles = fill(flat, extent * _MARGIN)
    if triangles is None or not len(triangles):
        return None
    corners = triangles.reshape(-1, 2)
    points = np.empty((len(corners), 3))
    sign = 1.0 if plane.from_above else -1.0
    points[:, plane.axis] = plane.coordinate + sign * lift
    points[:, across], points[:, upward] = corners[:, 0], corners[:, 1]
    faces = np.arange(len(corners), dtype=np.int32).reshape(-1, 3)
    normal = np.zeros(3)
    normal[plane.axis] = sign
    return Mesh(
        points,
        faces if plane.from_above else faces[:, ::-1],
        normals=np.tile(normal, (len(points), 1)),
        uvs=_places_on_hatching(corners, outline.node, pitch),
        materials=[hatching()],
        edge_visible=np.zeros(faces.shape, bool),
    )


def _places_on_hatching(
    corners: NDArray[np.float64], node: int, pitch: float
) -> NDArray[np.float64]:
    """Return texture coordinates; neighbours are hatched in two directions, by their numbers."""
    sign = -1.0 if node % 2 else 1.0
    return corners * (np.array([sign, 1.0]) / pitch)
