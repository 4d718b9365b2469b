"""Colliders: shapes of nodes for queries by boxes, spheres and rays.

In: a collider assigned to ``node.collider``. Out: `Scene.overlap_box` and the other queries find
the node by it (collider_queries.py).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import frozen
from ...base.calls import shows_annotations
from ...base.validation import Closed, frozen_floats, positive, vector3
from ...errors import InvalidArgumentError
from ..geometry.mesh import Mesh

if TYPE_CHECKING:
    from ..scene.nodes import Node


class BoxCollider(Closed):
    """An axis-aligned box in the world, around a box in the node's space.

    Parameters
    ----------
    low, high : (3,) float, optional
        Corners in node space; by default those of the node's mesh.
    """

    box: NDArray[np.float64] | None

    def __init__(self, low: ArrayLike | None = None, high: ArrayLike | None = None) -> None:
        self.box = None
        if low is None and high is None:
            return
        if low is None or high is None:
            raise InvalidArgumentError("give both corners of a BoxCollider, low and high, or none")
        self.box = frozen(np.stack([vector3(low, "low"), vector3(high, "high")]))
        if (self.box[0] > self.box[1]).any():
            raise InvalidArgumentError("low must not be above high")


class SphereCollider(Closed):
    """A sphere around a point in node space; its radius grows with the largest scale.

    Parameters
    ----------
    radius : float
    center : (3,) float
    """

    radius: float
    center: NDArray[np.float64]

    def __init__(self, radius: float, center: ArrayLike = (0, 0, 0)) -> None:
        self.radius = positive(radius, "radius")
        self.center = frozen_floats(center, "center", (3,))


class MeshCollider(Closed):
    """The faces of a mesh, from both sides; a mesh collider has no inside.

    Parameters
    ----------
    mesh : Mesh, optional
        By default the node's mesh.
    """

    mesh: Mesh | None

    def __init__(self, mesh: Mesh | None = None) -> None:
        if mesh is not None and not isinstance(mesh, Mesh):
            raise InvalidArgumentError(f"mesh must be a Mesh, not {type(mesh).__name__}")
        self.mesh = mesh


Collider: TypeAlias = BoxCollider | SphereCollider | MeshCollider


@shows_annotations
class ColliderHit(NamedTuple):
    """The intersection of a ray with a collider.

    Attributes
    ----------
    node : Node
    distance : float
        From the ray's origin; 0 if it lies inside a box or sphere.
    position : (3,) float64
    """

    node: Node
    distance: float
    position: NDArray[np.float64]


def check_collider(obj: Any, collider: Any) -> None:
    """Raise unless a node with a given object can have the collider."""
    kinds = (BoxCollider, SphereCollider, MeshCollider)
    if collider is not None and not isinstance(collider, kinds):
        raise InvalidArgumentError(
            f"collider must be a BoxCollider, SphereCollider, MeshCollider or None, not "
            f"{type(collider).__name__}"
        )
    needs_mesh = isinstance(collider, BoxCollider) and collider.box is None
    needs_mesh = needs_mesh or (isinstance(collider, MeshCollider) and collider.mesh is None)
    if needs_mesh and not isinstance(obj, Mesh):
        raise InvalidArgumentError("a collider of the node's own mesh needs a node with a Mesh")
