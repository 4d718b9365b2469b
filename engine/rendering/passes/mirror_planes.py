"""The planes of a scene's mirrors: flat faces whose material mirrors, as a view sees them.

In: an up-to-date draw list, its scene and a view. Out: planes in world space, towards the viewer,
each with the rectangles around its faces (docs/exactness, R214).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from ..._native.scene_graph import SHOWN
from ...base import linalg
from ...choices import FrameCull
from ...model.geometry.mesh import Mesh
from ...model.scene.instances import InstancedMesh
from ...model.scene.node_arrays import matrices_of
from ...model.scene.staged_data import AnyData
from .._memo import Memo
from .._told import Told
from .._view import View
from ..draw_list.draw_list import DrawList
from .protocol import Picture

#: How many mirrors a view may show: each is a picture of its own.
MOST_MIRRORS = 8
_SLACK = 2.0**-19  # how far from its plane a corner may lie, as a share of its coordinates
_WITHIN = 4.0  # a scene this many times as large as its mirror, or more, does not matter


class FlatFaces(NamedTuple):
    """Faces of a mesh in one plane.

    Attributes
    ----------
    normal : (3,) float64
        In object space, of unit length; the side that most of them show.
    rectangle : (4, 3) float64
        Corners of a rectangle around them, in the plane.
    shows_backs : bool
        Whether some of them are double-sided, or show the other side.
    """

    normal: NDArray[np.float64]
    rectangle: NDArray[np.float64]
    shows_backs: bool


class MirrorPlane(NamedTuple):
    """A plane of mirrors in world space: points p with ``normal . p = offset``.

    Attributes
    ----------
    normal : (3,) float64
        Towards the viewer, of unit length.
    offset : float
    rectangles : list of (4, 3) float64
    slack : float
        How far from the plane corners of the faces may lie, by the rounding of their coordinates.
    """

    normal: NDArray[np.float64]
    offset: float
    rectangles: list[NDArray[np.float64]]
    slack: float

    def height(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how far points are before the plane."""
        return np.asarray(linalg.dot(points, self.normal) - self.offset)


# ---- in a mesh ----

_State = tuple[object, ...]
_known: WeakKeyDictionary[Mesh, tuple[_State, list[FlatFaces] | None]] = WeakKeyDictionary()


def flat_faces_of(mesh: Mesh) -> list[FlatFaces] | None:
    """Return the planes of the faces that mirror; None if they are too many."""
    looks = tuple((one.mirror > 0, one.two_sided) for one in mesh.materials)
    state = mesh.positions, mesh.faces, mesh.material_ids, looks
    known = _known.get(mesh)
    if known is None or not _is_same(known[0], state):
        known = _known[mesh] = state, _find(mesh, looks)
    return known[1]


def _is_same(before: _State, state: _State) -> bool:
    arrays = all(one is other for one, other in zip(before[:3], state[:3], strict=True))
    return arrays and before[3] == state[3]


def _find(mesh: Mesh, looks: tuple[tuple[bool, bool], ...]) -> list[FlatFaces] | None:
    ids = np.zeros(len(mesh.faces), np.int64) if mesh.material_ids is None else mesh.material_ids
    mirrors, two_sided = np.array(looks, bool).T
    chosen = np.flatnonzero(mirrors[ids])
    corners = mesh.positions.astype(np.float64)[mesh.faces[chosen]]
    normals = linalg.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = linalg.length(normals)
    usable = np.isfinite(areas) & (areas > 0.0)
    corners, normals, areas = corners[usable], normals[usable], areas[usable]
    backs = two_sided[ids[chosen]][usable]
    found: list[FlatFaces] = []
    while len(corners):
        if len(found) == MOST_MIRRORS:
            return None
        largest = int(areas.argmax())
        normal = normals[largest] / areas[largest]
        heights = linalg.dot(corners - corners[largest, 0], normal)
        reaches = np.abs(corners).max(axis=(1, 2))
        slacks = _SLACK * np.maximum(reaches, reaches[largest])
        here = np.abs(heights).max(axis=1) <= slacks
        faces_away = linalg.dot(normals[here], normal) < 0.0
        shows_backs = bool((backs[here] | faces_away).any())
        found.append(FlatFaces(normal, _rectangle(corners[here], normal), shows_backs))
        corners, normals, areas, backs = (part[~here] for part in (corners, normals, areas, backs))
    return found


def _rectangle(corners: NDArray[np.float64], normal: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the corners of a rectangle around points of a plane, in turn."""
    axis = np.zeros(3)
    axis[int(np.abs(normal).argmin())] = 1.0
    across = linalg.normalize(linalg.cross(normal, axis))
    along = linalg.cross(normal, across)
    points = corners.reshape(-1, 3)
    u, v, height = (linalg.dot(points, one) for one in (across, along, normal))
    sides = [(u.min(), v.min()), (u.max(), v.min()), (u.max(), v.max()), (u.min(), v.max())]
    return np.stack([across * x + along * y + normal * height[0] for x, y in sides])


# ---- in the world ----


class MirrorFinder:
    """Finds the mirrors that a view may show.

    Parameters
    ----------
    draw_list : DrawList
    told : Told
    """

    def __init__(self, draw_list: DrawList, told: Told) -> None:
        self._draw_list, self._told = draw_list, told
        self._listed = Memo()
        self._flat: dict[int, list[FlatFaces]] = {}  # by the number of the object

    def find(self, picture: Picture) -> list[MirrorPlane]:
        """Return the planes of mirrors that a view may see the right side of.

        Warns if faces that should mirror are not flat.
        """
        data = picture.scene.data
        if self._listed.differs(data, data.objects.version, self._draw_list.renewals):
            self._list(data, data.objects.objects)
            self._listed.done()
        planes: list[MirrorPlane] = []
        reach = float(np.abs(picture.scene.bounds).max())
        columns, count = data.arrays.columns, data.arrays.count
        shown = columns["flags"][:count] & SHOWN != 0
        for number, flat in self._flat.items():
            backs = _shows_backs(picture.options.cull, self._draw_list.is_closed(number))
            slots = np.flatnonzero(shown & (columns["object"][:count] == number))
            for pose in matrices_of(columns["world"][slots]):
                for faces in flat:
                    _add(planes, _placed(faces, pose, picture.view, backs, reach))
        return planes

    def _list(self, data: AnyData, objects: Sequence[object]) -> None:
        self._flat = {}
        for number, obj in enumerate(objects):
            mesh = obj if isinstance(obj, Mesh) else getattr(obj, "mesh", None)
            if mesh is None or not any(material.mirror > 0 for material in mesh.materials):
                continue
            flat = flat_faces_of(mesh) if isinstance(obj, Mesh) else None
            if flat is None:
                names = ", ".join(one.name or "?" for one in mesh.materials if one.mirror > 0)
                kind = "instances" if isinstance(obj, InstancedMesh) else "faces that are not flat"
                self._told.warn(
                    data,
                    f"{mesh!r}: {kind} look as without Material.mirror (materials: {names}): a "
                    f"mirror is a mesh whose faces lie in at most {MOST_MIRRORS} planes",
                )
            elif flat:
                self._flat[number] = flat


def _shows_backs(cull: FrameCull, is_closed: bool) -> bool:
    return cull == "none" or cull == "front" or (cull == "auto" and not is_closed)


def _placed(
    faces: FlatFaces, pose: NDArray[np.float64], view: View, backs: bool, reach: float
) -> MirrorPlane | None:
    """Return flat faces in the world; None if their mirror shows nothing to a view.

    ``reach`` is the greatest coordinate of the scene's box.
    """
    rectangle = linalg.transform_points(pose, faces.rectangle)
    normal = linalg.dot(linalg.normal_matrix(pose), faces.normal)
    length = float(linalg.length(normal))
    if not (np.isfinite(rectangle).all() and 0.0 < length < np.inf):
        return None
    normal = normal / length
    offset = float(linalg.dot(normal, rectangle[0]))
    eye = np.array(view.eye[:3])
    height = float(linalg.dot(normal, eye)) - offset * view.eye[3]
    if height < 0.0 and (backs or faces.shows_backs):
        normal, offset, height = -normal, -offset, -height
    slack = _slack_of(pose, faces.rectangle, reach)
    return MirrorPlane(normal, offset, [rectangle], slack) if height > 0.0 else None


def _slack_of(pose: NDArray[np.float64], points: NDArray[np.float64], reach: float) -> float:
    """Return how far from their plane points may lie, once placed.

    It covers the rounding of their own coordinates, also of those that the pose takes back. That of
    the scene's, ``reach``, would take what stands on a mirror out of it if anything is far away.
    """
    own = float(linalg.transform_points(np.abs(pose), np.abs(points)).max())
    return _SLACK * max(min(max(reach, own / _WITHIN), own * _WITHIN), 2.0**-100)


def _add(planes: list[MirrorPlane], plane: MirrorPlane | None) -> None:
    """Add a plane, or its rectangles to one that it agrees with."""
    if plane is None:
        return
    for k, other in enumerate(planes):
        slack = max(other.slack, plane.slack)
        if np.abs(other.height(plane.rectangles[0])).max() <= slack:
            rectangles = other.rectangles + plane.rectangles
            planes[k] = other._replace(rectangles=rectangles, slack=slack)
            return
    planes.append(plane)
