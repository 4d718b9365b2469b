"""Area, volume, centre and inertia of what is drawn.

In: anything drawable. Out: `Measures`. Sums are exactly rounded, so the order of faces does not
matter. Source of the integrals over tetrahedra: Tonon, "Explicit exact formulas for the 3-D
tetrahedron inertia tensor in terms of its vertex coordinates", 2004.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.calls import hinted, shows_annotations
from .checking import proper_faces
from .edges import edges_of, parts_of
from .surfaces import Surface, surface_of

_AXES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


@shows_annotations
class Measures(NamedTuple):
    """What can be measured of a surface, in the world's units.

    Attributes
    ----------
    bounds : (2, 3) float64
        Smallest and largest coordinates; zeros without faces.
    area : float
    watertight : bool
        Whether each edge has exactly two faces that show the same side.
    components : int
        How many parts hang together by common points.
    volume : float or None
        What a watertight surface encloses, negative where the faces look inward; else None.
    center : (3,) float64
        The centre of mass of a watertight body; of other surfaces that of their area.
    inertia : (3, 3) float64 or None
        The inertia tensor of a watertight body about its centre, with density 1; else None.
    """

    bounds: NDArray[np.float64]
    area: float
    watertight: bool
    components: int
    volume: float | None
    center: NDArray[np.float64]
    inertia: NDArray[np.float64] | None


@hinted
def measure(thing: Any) -> Measures:
    """Measure the surface of a mesh, of instances, of a node with its subtree, or of a scene.

    Lines and points are left out. Several bodies are measured as one.

    Parameters
    ----------
    thing : Mesh, InstancedMesh, Node, Scene, or an iterable of these
        Of nodes what they show, at their current poses.

    Raises
    ------
    InvalidArgumentError

    Examples
    --------
    >>> engine3d.measuring.measure(engine3d.box()).volume
    1.0
    """
    return measures_of(surface_of(thing))


@np.errstate(all="ignore")
def measures_of(surface: Surface) -> Measures:
    """Return the measures of a surface; see `measure`."""
    box, faces = surface.box, surface.faces[proper_faces(surface.faces)]
    watertight = len(faces) > 0 and edges_of(faces).are_closed
    parts = int(parts_of(faces).max(initial=-1)) + 1
    middle = (box[0] + box[1]) * 0.5
    corners = surface.points[faces] - middle
    areas = linalg.length(
        linalg.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    )
    area = _total(areas) * 0.5
    volume, mass = None, _moments(corners)
    if watertight and mass[0]:
        volume, center = mass[0], mass[1] / mass[0]
        inertia = _about_center(mass[2], center, volume)
    else:
        inertia = None
        volume = 0.0 if watertight else None
        weights = areas / (6.0 * area) if area else areas
        center = np.array([_total(corners[:, :, k].sum(axis=1) * weights) for k in range(3)])
        center = center if area else np.zeros(3)
    return Measures(box, area, watertight, parts, volume, center + middle + 0.0, inertia)


def _moments(corners: NDArray[np.float64]) -> tuple[float, NDArray[np.float64], list[float]]:
    """Return the integrals of 1, of x, y, z, and of their products over what corners enclose."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    volumes = linalg.dot(a, linalg.cross(b, c))  # six times
    total = a + b + c
    first = [_total(volumes * total[:, k]) / 24.0 for k in range(3)]
    second = []
    for i, j in _AXES:
        products = a[:, i] * a[:, j] + b[:, i] * b[:, j] + c[:, i] * c[:, j]
        second.append(_total(volumes * (total[:, i] * total[:, j] + products)) / 120.0)
    return _total(volumes) / 6.0, np.array(first), second


def _about_center(second: list[float], center: NDArray[np.float64], volume: float) -> Any:
    """Return the inertia tensor about the centre, (3, 3), as if all faces looked outward."""
    sign = 1.0 if volume > 0 else -1.0
    xx, yy, zz, xy, xz, yz = (
        sign * (moment - volume * float(center[i] * center[j]))
        for moment, (i, j) in zip(second, _AXES, strict=True)
    )
    return np.array([(yy + zz, -xy, -xz), (-xy, xx + zz, -yz), (-xz, -yz, xx + yy)]) + 0.0


def _total(values: NDArray[np.float64]) -> float:
    return math.fsum(values.tolist()) if np.isfinite(values).all() else math.inf
