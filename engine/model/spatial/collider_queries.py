"""Queries for the colliders of a scene that a box, sphere or ray intersects.

In: queries in world space. Out: the nodes whose colliders intersect, in the order of adding. A tree
of the colliders' boxes finds candidates; the exact tests are float64, element by element, and use
the mesh's own tree for its faces.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..._native.scene_graph import BOX, SHOWN, NativeTree
from ...base import linalg
from ...base.dirty_tracking import Watch
from ...base.validation import how_far, positive, vector3
from ...errors import InvalidArgumentError
from ..geometry.mesh import Mesh
from ..scene.node_arrays import NodeArrays
from ..scene.nodes import Node
from ..scene.scene_data import SceneData
from ..scene.shown import placing_poses, shown_object
from ._shapes import faces_in_box, way_to_face
from .colliders import BoxCollider, ColliderHit, MeshCollider, SphereCollider
from .triangles import sphere_meets_triangles, triangles_meet_box

_quiet = np.errstate(over="ignore", invalid="ignore")  # overflow means infinitely far away


class _Placed:
    """The colliders of a scene where they are now: world boxes, spheres, and a tree of them."""

    def __init__(self, data: SceneData) -> None:
        self.nodes = list(data.colliders.values())
        self._slots = data.slots_of(self.nodes)
        self._removals = data.removals
        self._state: tuple[Any, ...] | None = None
        count = len(self.nodes)
        self._middles, self._halves = np.zeros((count, 3)), np.zeros((count, 3))
        self._radii = np.full(count, -1.0)  # of spheres
        self._watch = Watch()
        self.meshes: dict[int, Mesh] = {}
        self._bent: list[int] = []  # rows placed by joints and morph targets
        for row, node in enumerate(self.nodes):
            self._describe(row, node)
        self._moment = _moment(data) if self._bent else 0

    def _describe(self, row: int, node: Node) -> None:
        """Store a collider's shape in node space."""
        collider: Any = node.collider
        if isinstance(collider, SphereCollider):
            self._middles[row], self._radii[row] = collider.center, collider.radius
            return
        mesh = _mesh_of(node)
        if mesh is not None and mesh is node.object:
            rest, mesh = mesh, shown_object(node)
            if mesh is not rest:
                self._bent.append(row)
        if isinstance(collider, MeshCollider):
            self.meshes[row] = mesh
        if mesh is not None:
            self._watch.add(mesh)
        low, high = collider.box if mesh is None else mesh.bounds
        self._middles[row], self._halves[row] = (low + high) * 0.5, (high - low) * 0.5

    def is_of(self, data: SceneData) -> bool:
        """Return whether these are still the scene's colliders."""
        posed = not self._bent or self._moment == _moment(data)
        return posed and self._removals == data.removals and not self._watch.found()

    def follow(self, arrays: NodeArrays) -> None:
        """Update the colliders' places if anything moved."""
        state = arrays, arrays.updated
        if self._state == state:
            return
        self.poses = poses = arrays.world_poses(self._slots)
        if self._bent:
            poses[self._bent] = placing_poses(arrays, self._slots[self._bent])
        shown = arrays.columns["flags"][self._slots] & SHOWN != 0
        self.centers = linalg.dot(poses[:, :3, :3], self._middles[:, np.newaxis]) + poses[:, :3, 3]
        around = linalg.dot(np.abs(poses[:, :3, :3]), self._halves[:, np.newaxis])
        scales = linalg.length(poses[:, :3, :3].transpose(0, 2, 1)).max(axis=1, initial=0.0)
        spheres = self._radii >= 0.0
        self.radii = np.where(spheres, self._radii * scales, -1.0)
        around = np.where(spheres[:, np.newaxis], self.radii[:, np.newaxis], around)
        self.boxes = np.stack([self.centers - around, self.centers + around], axis=1)
        rows = np.empty((len(poses), BOX))
        rows[:, :6] = self.boxes.reshape(-1, 6)
        rows[:, 6] = np.abs(rows[:, :6]).max(axis=1, initial=0.0)
        rows[~shown, :3], rows[~shown, 3:6] = np.inf, -np.inf
        self._tree = NativeTree(rows)
        self._state = state

    def in_box(self, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Return the rows of colliders whose boxes may intersect a box, in order."""
        bits = self._bits()
        self._tree.overlaps(low, high, bits)
        return self._rows_of(bits)

    def on_ray(self, origin: np.ndarray, direction: np.ndarray, farthest: float) -> np.ndarray:
        """Return the rows of colliders whose boxes a ray may hit, in order."""
        bits = self._bits()
        self._tree.on_ray(origin, direction, farthest, bits)
        return self._rows_of(bits)

    def _bits(self) -> np.ndarray:
        return np.zeros((len(self.nodes) + 63) // 64, np.uint64)

    def _rows_of(self, bits: np.ndarray) -> np.ndarray:
        return np.flatnonzero(np.unpackbits(bits.view(np.uint8), bitorder="little"))


def _moment(data: SceneData) -> int:
    """Return a counter that grows when meshes are deformed anew."""
    return 0 if data.posing is None else data.posing.moment


def _placed(data: SceneData) -> _Placed:
    """Return the colliders, updated if something moved or a mesh changed."""
    data.update()
    placed: _Placed | None = data.placed_colliders
    if placed is None or not placed.is_of(data):
        placed = data.placed_colliders = _Placed(data)
    placed.follow(data.arrays)
    return placed


def _mesh_of(node: Node) -> Any:
    """Return the mesh that a node's collider depends on."""
    collider = node.collider
    if isinstance(collider, MeshCollider):
        return collider.mesh or node.object
    return node.object if isinstance(collider, BoxCollider) and collider.box is None else None


@_quiet
def overlap_box(scene: Any, low: Any, high: Any) -> tuple[Node, ...]:
    """See `Scene.overlap_box`."""
    low, high = vector3(low, "low"), vector3(high, "high")
    if (low > high).any():
        raise InvalidArgumentError("low must not be above high")
    placed = _placed(scene.data)
    rows = placed.in_box(low, high)
    boxes, centers, radii = placed.boxes[rows], placed.centers[rows], placed.radii[rows]
    meets = ((boxes[:, 0] <= high) & (boxes[:, 1] >= low)).all(axis=1)
    nearest = np.minimum(np.maximum(centers, low), high) - centers
    meets &= (radii < 0) | (linalg.dot(nearest, nearest) <= radii * radii)
    return _those(placed, rows[meets], lambda mesh, pose: _mesh_meets_box(mesh, pose, low, high))


@_quiet
def overlap_sphere(scene: Any, center: Any, radius: Any) -> tuple[Node, ...]:
    """See `Scene.overlap_sphere`."""
    center, radius = vector3(center, "center"), positive(radius, "radius")
    placed = _placed(scene.data)
    rows = placed.in_box(center - radius, center + radius)
    boxes, centers, radii = placed.boxes[rows], placed.centers[rows], placed.radii[rows]
    nearest = np.minimum(np.maximum(center, boxes[:, 0]), boxes[:, 1]) - center
    meets = linalg.dot(nearest, nearest) <= radius * radius
    apart, reach = centers - center, radii + radius
    meets &= (radii < 0) | (linalg.dot(apart, apart) <= reach * reach)
    meshes = lambda mesh, pose: _mesh_meets_sphere(mesh, pose, center, radius)  # noqa: E731
    return _those(placed, rows[meets], meshes)


def _those(placed: _Placed, rows: np.ndarray, mesh_meets: Any) -> tuple[Node, ...]:
    meshes = placed.meshes
    return tuple(
        placed.nodes[row]
        for row in rows.tolist()
        if row not in meshes or mesh_meets(meshes[row], placed.poses[row])
    )


def _mesh_meets_box(mesh: Mesh, pose: Any, low: Any, high: Any) -> bool:
    return bool(triangles_meet_box(_corners_near(mesh, pose, low, high), low, high).any())


def _mesh_meets_sphere(mesh: Mesh, pose: Any, center: Any, radius: float) -> bool:
    corners = _corners_near(mesh, pose, center - radius, center + radius)
    return bool(sphere_meets_triangles(corners, center, radius).any())


def _corners_near(mesh: Mesh, pose: Any, low: Any, high: Any) -> np.ndarray:
    """Return world corners of the faces whose boxes are near a world box, (N, 3, 3)."""
    try:
        back = linalg.inverse(pose)
    except InvalidArgumentError:  # flat: the pose has no inverse
        faces = np.arange(len(mesh.faces))
    else:
        middle = linalg.transform_points(back, (low + high) * 0.5)
        around = linalg.transform_directions(np.abs(back), (high - low) * 0.5)
        around = around + 1e-9 * (np.abs(middle) + around)
        faces = faces_in_box(mesh, middle - around, middle + around)
    return linalg.transform_points(pose, mesh.positions[mesh.faces[faces]])


@_quiet
def raycast_colliders(
    scene: Any, origin: Any, direction: Any, max_distance: Any
) -> ColliderHit | None:
    """See `Scene.raycast_colliders`."""
    origin, direction = vector3(origin, "origin"), vector3(direction, "direction")
    max_distance = how_far(max_distance, "max_distance")
    if not direction.any():
        raise InvalidArgumentError("direction must not be the zero vector")
    direction = linalg.normalize(direction)
    placed = _placed(scene.data)
    rows = placed.on_ray(origin, direction, max_distance)
    distances = _into_boxes(placed.boxes[rows], origin, direction)
    radii = placed.radii[rows]
    into = _into_spheres(placed.centers[rows], radii, origin, direction)
    distances = np.where(radii >= 0, into, distances)
    nearest, row = max_distance, -1
    for number in np.argsort(distances, kind="stable").tolist():
        distance, candidate = float(distances[number]), int(rows[number])
        if not distance <= nearest or math.isinf(distance):
            break
        if candidate in placed.meshes:
            mesh, pose = placed.meshes[candidate], placed.poses[candidate]
            distance = way_to_face(mesh, pose, origin, direction, nearest)
        if distance < nearest or (distance == nearest and (row < 0 or candidate < row)):
            nearest, row = distance, candidate
    if row < 0 or math.isinf(nearest):
        return None
    return ColliderHit(placed.nodes[row], nearest, origin + direction * nearest)


def _into_boxes(boxes: np.ndarray, origin: Any, direction: Any) -> np.ndarray:
    """Return where a ray enters boxes (N, 2, 3): 0 from inside, infinite on a miss."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ways = (boxes - origin) / direction
    along = direction != 0.0
    inside = ((boxes[:, 0] <= origin) & (boxes[:, 1] >= origin))[:, ~along].all(axis=1)
    enters = ways.min(axis=1)[:, along].max(axis=1)
    leaves = ways.max(axis=1)[:, along].min(axis=1)
    return np.where(inside & (enters <= leaves) & (leaves >= 0.0), np.maximum(enters, 0.0), np.inf)


def _into_spheres(
    centers: np.ndarray, radii: np.ndarray, origin: Any, direction: Any
) -> np.ndarray:
    """Return the distance at which a unit ray enters spheres: 0 from inside, infinite on a miss."""
    away = centers - origin
    along = linalg.dot(away, direction)
    beside = linalg.dot(away, away) - along * along
    half = np.sqrt(np.maximum(radii * radii - beside, 0.0))
    meets = (beside <= radii * radii) & (along + half >= 0.0)
    return np.where(meets, np.maximum(along - half, 0.0), np.inf)
