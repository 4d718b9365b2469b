"""Shapes that nodes put around themselves, to be found by boxes, spheres and rays.

In: a collider assigned to ``node.collider``, and queries in world space. Out: the nodes whose
colliders are met, in the order in which the nodes were added. Everything is float64, an element at
a time: all colliders at once for boxes and spheres, and through the mesh's tree for its faces.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .. import linalg
from ..attributes import positive, vector3
from ..errors import InvalidArgumentError
from ..mesh import Mesh
from ..nodes import Node
from .shapes import faces_in_box
from .triangles import sphere_meets_triangles, triangles_meet_box


class BoxCollider:
    """An axis-aligned box in the world, around a box in the node's space.

    Parameters
    ----------
    low, high : (3,) float, optional
        Corners in the node's space; those of the node's own mesh if left out.
    """

    def __init__(self, low=None, high=None) -> None:
        if (low is None) != (high is None):
            raise InvalidArgumentError("give both corners of a BoxCollider, or none")
        self.box = None if low is None else np.stack([vector3(low, "low"), vector3(high, "high")])
        if self.box is not None and (self.box[0] > self.box[1]).any():
            raise InvalidArgumentError("low must not be above high")


class SphereCollider:
    """A sphere around a point of the node's space; its radius grows with the largest scale.

    Parameters
    ----------
    radius : float
    center : (3,) float
    """

    def __init__(self, radius: float, center=(0, 0, 0)) -> None:
        self.radius, self.center = positive(radius, "radius"), vector3(center, "center")


class MeshCollider:
    """The faces of a mesh, from both sides; they have no inside.

    Parameters
    ----------
    mesh : Mesh, optional
        The node's own if left out.
    """

    def __init__(self, mesh: Mesh | None = None) -> None:
        if mesh is not None and not isinstance(mesh, Mesh):
            raise InvalidArgumentError(f"mesh must be a Mesh, not {type(mesh).__name__}")
        self.mesh = mesh


class ColliderHit(NamedTuple):
    """Where a ray meets a collider.

    Attributes
    ----------
    node : Node
    distance : float
        From the ray's origin; 0 if that is inside of a box or a sphere.
    position : (3,) float64
    """

    node: Node
    distance: float
    position: np.ndarray


def check_collider(node: Node, collider) -> None:
    """Raise unless a node can have the collider."""
    kinds = (BoxCollider, SphereCollider, MeshCollider)
    if collider is not None and not isinstance(collider, kinds):
        raise InvalidArgumentError(
            f"collider must be a BoxCollider, SphereCollider, MeshCollider or None, not "
            f"{type(collider).__name__}"
        )
    needs_mesh = isinstance(collider, BoxCollider) and collider.box is None
    needs_mesh = needs_mesh or (isinstance(collider, MeshCollider) and collider.mesh is None)
    if needs_mesh and not isinstance(node.object, Mesh):
        raise InvalidArgumentError("a collider of the node's own mesh needs a node with a Mesh")


class _Placed:
    """The colliders of a scene where they are now: world boxes of all, spheres, meshes."""

    def __init__(self, scene) -> None:
        self.nodes = [node for node in scene._colliders.values() if node.shown]
        poses = scene.select(self.nodes).world_poses
        self.boxes = np.empty((len(self.nodes), 2, 3))
        self.centers = np.zeros((len(self.nodes), 3))
        self.radii = np.full(len(self.nodes), -1.0)  # of spheres
        self.meshes: dict[int, tuple[Mesh, np.ndarray]] = {}
        for row, (node, pose) in enumerate(zip(self.nodes, poses, strict=True)):
            self._place(row, node, pose)

    def _place(self, row: int, node: Node, pose: np.ndarray) -> None:
        collider = node.collider
        if isinstance(collider, SphereCollider):
            axes = linalg.length(pose[:3, :3].T)
            self.centers[row] = linalg.transform_points(pose, collider.center)
            self.radii[row] = collider.radius * float(axes.max())
            self.boxes[row] = self.centers[row] + np.array([[-1.0], [1.0]]) * self.radii[row]
            return
        if isinstance(collider, MeshCollider):
            self.meshes[row] = _mesh_of(node), pose
        mesh = _mesh_of(node)
        box = collider.box if mesh is None else mesh.bounds
        center, half = (box[0] + box[1]) * 0.5, (box[1] - box[0]) * 0.5
        middle = linalg.transform_points(pose, center)
        around = linalg.transform_directions(np.abs(pose), half)
        self.boxes[row] = middle - around, middle + around


def _placed(scene) -> _Placed:
    """The colliders, found anew when something moved or a mesh changed."""
    scene._update()
    meshes = (_mesh_of(node) for node in scene._colliders.values())
    versions = [None if mesh is None else mesh.version for mesh in meshes]
    state = scene._arrays, scene._arrays.changes, versions
    if scene._placed_colliders is None or scene._placed_colliders[0] != state:
        scene._placed_colliders = state, _Placed(scene)
    return scene._placed_colliders[1]


def _mesh_of(node: Node) -> Mesh | None:
    """The mesh that a node's collider depends on."""
    collider = node.collider
    if isinstance(collider, MeshCollider):
        return collider.mesh or node.object
    return node.object if isinstance(collider, BoxCollider) and collider.box is None else None


def overlap_box(scene, low, high) -> tuple[Node, ...]:
    """See `Scene.overlap_box`."""
    low, high = vector3(low, "low"), vector3(high, "high")
    if (low > high).any():
        raise InvalidArgumentError("low must not be above high")
    placed = _placed(scene)
    meets = ((placed.boxes[:, 0] <= high) & (placed.boxes[:, 1] >= low)).all(axis=1)
    nearest = np.minimum(np.maximum(placed.centers, low), high) - placed.centers
    spheres = placed.radii >= 0
    meets &= ~spheres | (linalg.dot(nearest, nearest) <= placed.radii * placed.radii)
    return _those(placed, meets, lambda mesh, pose: _mesh_meets_box(mesh, pose, low, high))


def overlap_sphere(scene, center, radius) -> tuple[Node, ...]:
    """See `Scene.overlap_sphere`."""
    center, radius = vector3(center, "center"), positive(radius, "radius")
    placed = _placed(scene)
    nearest = np.minimum(np.maximum(center, placed.boxes[:, 0]), placed.boxes[:, 1]) - center
    meets = linalg.dot(nearest, nearest) <= radius * radius
    spheres = placed.radii >= 0
    apart, reach = placed.centers - center, placed.radii + radius
    meets &= ~spheres | (linalg.dot(apart, apart) <= reach * reach)
    return _those(placed, meets, lambda mesh, pose: _mesh_meets_sphere(mesh, pose, center, radius))


def _those(placed: _Placed, meets: np.ndarray, mesh_meets) -> tuple[Node, ...]:
    rows = np.flatnonzero(meets).tolist()
    rows = [row for row in rows if row not in placed.meshes or mesh_meets(*placed.meshes[row])]
    return tuple(placed.nodes[row] for row in rows)


def _mesh_meets_box(mesh: Mesh, pose, low, high) -> bool:
    return bool(triangles_meet_box(_corners_near(mesh, pose, low, high), low, high).any())


def _mesh_meets_sphere(mesh: Mesh, pose, center, radius: float) -> bool:
    corners = _corners_near(mesh, pose, center - radius, center + radius)
    return bool(sphere_meets_triangles(corners, center, radius).any())


def _corners_near(mesh: Mesh, pose, low, high) -> np.ndarray:
    """Corners in the world of the faces whose boxes are near a world box, (N, 3, 3)."""
    try:
        back = linalg.inverse(pose)
    except InvalidArgumentError:  # flat: no space to go back into
        faces = np.arange(len(mesh.faces))
    else:
        middle = linalg.transform_points(back, (low + high) * 0.5)
        around = linalg.transform_directions(np.abs(back), (high - low) * 0.5)
        around = around + 1e-9 * (np.abs(middle) + around)
        faces = faces_in_box(mesh, middle - around, middle + around)
    return linalg.transform_points(pose, mesh.positions[mesh.faces[faces]])


def raycast_colliders(scene, origin, direction, max_distance) -> ColliderHit | None:
    """See `Scene.raycast_colliders`."""
    origin, direction = vector3(origin, "origin"), vector3(direction, "direction")
    if not direction.any() or not max_distance >= 0:
        raise InvalidArgumentError("a ray needs a direction, and a max_distance of 0 or more")
    direction = linalg.normalize(direction)
    placed = _placed(scene)
    distances = _into_boxes(placed.boxes, origin, direction)
    spheres = placed.radii >= 0
    into = _into_spheres(placed.centers, placed.radii, origin, direction)
    distances = np.where(spheres, into, distances)
    nearest, row = max_distance, -1
    for candidate in np.argsort(distances, kind="stable").tolist():
        if not distances[candidate] <= nearest or math.isinf(distances[candidate]):
            break
        distance = float(distances[candidate])
        if candidate in placed.meshes:
            distance = _into_mesh(*placed.meshes[candidate], origin, direction)
        if distance < nearest or (distance == nearest and (row < 0 or candidate < row)):
            nearest, row = distance, candidate
    if row < 0 or math.isinf(nearest):
        return None
    return ColliderHit(placed.nodes[row], nearest, origin + direction * nearest)


def _into_boxes(boxes: np.ndarray, origin, direction) -> np.ndarray:
    """Where a ray enters boxes (N, 2, 3): 0 from inside, infinite where it does not."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ways = (boxes - origin) / direction
    along = direction != 0.0
    inside = ((boxes[:, 0] <= origin) & (boxes[:, 1] >= origin))[:, ~along].all(axis=1)
    enters = ways.min(axis=1)[:, along].max(axis=1)
    leaves = ways.max(axis=1)[:, along].min(axis=1)
    return np.where(inside & (enters <= leaves) & (leaves >= 0.0), np.maximum(enters, 0.0), np.inf)


def _into_spheres(centers: np.ndarray, radii: np.ndarray, origin, direction) -> np.ndarray:
    """Where a ray of unit length enters spheres: 0 from inside, infinite where it does not."""
    away = centers - origin
    along = linalg.dot(away, direction)
    beside = linalg.dot(away, away) - along * along
    half = np.sqrt(np.maximum(radii * radii - beside, 0.0))
    meets = (beside <= radii * radii) & (along + half >= 0.0)
    return np.where(meets, np.maximum(along - half, 0.0), np.inf)


def _into_mesh(mesh: Mesh, pose, origin, direction) -> float:
    """How far a ray goes to a mesh, through a scene that holds nothing else."""
    from ..scene import Scene

    scene = Scene()
    scene.add(mesh, pose=pose)
    hit = scene.raycast(origin, direction)
    return math.inf if hit is None else hit.distance
