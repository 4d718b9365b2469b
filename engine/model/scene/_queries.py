"""Queries of a scene: raycasts, picking and collider overlaps."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from ...choices import Cull

if TYPE_CHECKING:
    from ...rendering.frame import Frame
    from ..spatial.colliders import ColliderHit
    from ..spatial.rays import RayHit, RayHits
    from .nodes import Node


class SceneQueries:
    """The query methods of a `Scene`."""

    def raycast(
        self,
        origin: ArrayLike,
        direction: ArrayLike,
        *,
        max_distance: float = math.inf,
        cull: Cull = "none",
    ) -> RayHit | None:
        """Return the first intersection of a ray with a face of the visible objects.

        Parameters
        ----------
        origin, direction : (3,) float
            World space; the direction may have any nonzero length.
        max_distance : float
            World units.
        cull : {"none", "back", "front"}
            Which faces the ray ignores: none, back faces or front faces.

        Returns
        -------
        hit : RayHit or None
            Node, instance, face, distance, position, normal and barycentric coordinates. Among
            faces at the same distance, the first in drawing order wins.

        Raises
        ------
        InvalidArgumentError
        """
        from ..spatial.rays import raycast

        return raycast(self, origin, direction, max_distance, cull)

    def raycast_many(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        *,
        max_distance: float = math.inf,
        cull: Cull = "none",
    ) -> RayHits:
        """Cast many rays at once, like `raycast`; the results have one row per ray.

        Parameters
        ----------
        origins, directions : (N, 3) or (3,) float
            World space. One origin broadcasts to many directions, and vice versa.
        max_distance : float
        cull : {"none", "back", "front"}

        Returns
        -------
        hits : RayHits
            Arrays: object_id, instance, face, distance, position, normal, barycentric.

        Raises
        ------
        InvalidArgumentError
        """
        from ..spatial.rays import raycast_many

        return raycast_many(self, origins, directions, max_distance, cull)

    def pick(self, frame: Frame, x: int, y: int) -> RayHit | None:
        """Return the object that a pixel of a frame of this scene shows.

        A frame with the outputs ``object_id``, ``instance_id`` and ``face_id`` gives an exact
        answer. Otherwise, a ray is cast through the pixel's centre into the scene as it is now.

        Parameters
        ----------
        frame : Frame
        x, y : int
            Column and row, from the top left.

        Returns
        -------
        hit : RayHit or None
            The distance is measured from the camera, or from the near plane without perspective.
            For a line or a point, ``face`` is -1 and the position is NaN.

        Raises
        ------
        InvalidArgumentError
        """
        from ...rendering.picking import pick

        return pick(self, frame, x, y)

    def overlap_box(self, low: ArrayLike, high: ArrayLike) -> tuple[Node, ...]:
        """Return the visible nodes whose colliders intersect a box.

        Parameters
        ----------
        low, high : (3,) float
            Corners in world space.

        Returns
        -------
        nodes : tuple of Node
            In the order in which they were added.

        Raises
        ------
        InvalidArgumentError
        """
        from ..spatial.collider_queries import overlap_box

        return overlap_box(self, low, high)

    def overlap_sphere(self, center: ArrayLike, radius: float) -> tuple[Node, ...]:
        """Return the visible nodes whose colliders intersect a ball; as `overlap_box`.

        Parameters
        ----------
        center : (3,) float
        radius : float
        """
        from ..spatial.collider_queries import overlap_sphere

        return overlap_sphere(self, center, radius)

    def raycast_colliders(
        self, origin: ArrayLike, direction: ArrayLike, *, max_distance: float = math.inf
    ) -> ColliderHit | None:
        """Return the first intersection of a ray with the collider of a visible node.

        Parameters
        ----------
        origin, direction : (3,) float
            World space; the direction may have any nonzero length.
        max_distance : float

        Returns
        -------
        hit : ColliderHit or None
            Node, distance, position.

        Raises
        ------
        InvalidArgumentError
        """
        from ..spatial.collider_queries import raycast_colliders

        return raycast_colliders(self, origin, direction, max_distance)
