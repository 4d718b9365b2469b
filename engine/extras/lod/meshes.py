"""Static meshes drawn with levels of detail by distance, such as a city's districts.

In: the same meshes at several levels, with errors, and before each frame a camera. Out: nodes, one
of which is visible for each mesh: the coarsest whose error is then below a limit in pixels.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import frozen
from ...base import linalg
from ...base.calls import checks_types
from ...base.numbers import real
from ...base.validation import Closed
from ...errors import InvalidArgumentError
from ...model.geometry.mesh import Mesh
from ...model.scene.cameras import Camera
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ._choosing import check_errors, check_limits, checked_view, choose_levels, pixels_a_unit


class DetailedMeshes(Closed):
    """Meshes, each drawn at the level of detail for its nearest point.

    Parameters
    ----------
    levels : sequence of (sequence of Mesh, float)
        From fine to coarse: the same meshes in the same order, and their error: how far they are
        from those of the first level, in their units; the first has error 0. `World.levels` gives
        those of a city.
    pixels, hysteresis : float
        As for `DetailedInstances`.

    Attributes
    ----------
    levels : tuple of (tuple of Mesh, float)
    level : (N,) int
        The level of each mesh.

    Raises
    ------
    InvalidArgumentError
    """

    levels: tuple[tuple[tuple[Mesh, ...], float], ...]
    pixels: float
    hysteresis: float
    level: NDArray[np.intp]

    def __init__(
        self,
        levels: Sequence[tuple[Sequence[Mesh], float]],
        *,
        pixels: float = 1.0,
        hysteresis: float = 0.3,
    ) -> None:
        check_limits(hysteresis, pixels=pixels)
        self.levels = _checked(levels)
        self.pixels, self.hysteresis = float(pixels), float(hysteresis)
        meshes = self.levels[0][0]
        self.level = frozen(np.zeros(len(meshes), np.intp))
        self._errors = np.array([error for _, error in self.levels])
        nothing = np.zeros((2, 3))
        boxes = [mesh.bounds if len(mesh.positions) else nothing for mesh in meshes]
        self._boxes = np.array(boxes, np.float64).reshape(-1, 2, 3)
        self._group: Node | None = None
        self._nodes: list[list[Node]] = []  # for each mesh, one node per level

    @checks_types
    def add_to(self, scene: Scene, *, name: str = "", parent: Node | None = None) -> Node:
        """Add all meshes to a scene, once; return their group node.

        It has a child for each mesh, whose ID frames show for all its levels. ``face_id``
        belongs to the level.

        Raises
        ------
        InvalidArgumentError
            They are in a scene already.
        """
        if self._group is not None:
            raise InvalidArgumentError("these meshes were added to a scene before")
        self._group = scene.add(name=name, parent=parent)
        for number, mesh in enumerate(self.levels[0][0]):
            place = scene.add(name=mesh.name, parent=self._group)
            nodes = [scene.add(meshes[number], parent=place) for meshes, _ in self.levels]
            for level, node in enumerate(nodes):
                scene.data.show_as(node, place)
                node.visible = level == self.level[number]
            self._nodes.append(nodes)
        return self._group

    def update(self, camera: Camera, pose: ArrayLike, size: tuple[int, int]) -> bool:
        """Choose the levels for a camera; return whether any changed.

        Parameters
        ----------
        camera, pose, size
            As for `DetailedInstances.update`.

        Raises
        ------
        InvalidArgumentError
        """
        pose, size = checked_view(camera, pose, size)
        world = np.eye(4) if self._group is None else self._group.world_pose
        eye = linalg.transform_points(linalg.inverse(world), pose[:3, 3])
        nearest = np.clip(eye, self._boxes[:, 0], self._boxes[:, 1])
        scales = linalg.length(world[:3, :3].T)
        distances = linalg.length(nearest - eye) * scales.min()
        pixels = pixels_a_unit(camera, size, distances) * scales.max()
        errors = self._errors[:, np.newaxis] * pixels
        level = frozen(choose_levels(self.level, errors, self.pixels, self.hysteresis))
        changed = np.flatnonzero(level != self.level)
        for number in changed.tolist() if self._nodes else ():
            self._nodes[number][self.level[number]].visible = False
            self._nodes[number][level[number]].visible = True
        self.level = level
        return len(changed) > 0

    def __repr__(self) -> str:
        counts = np.bincount(self.level, minlength=len(self.levels)).tolist()
        return f"DetailedMeshes({len(self.level)} meshes; by level: {counts})"


def _checked(
    levels: Iterable[tuple[Iterable[Mesh], float]],
) -> tuple[tuple[tuple[Mesh, ...], float], ...]:
    try:
        found = tuple((tuple(meshes), real(error)) for meshes, error in levels)
    except (TypeError, ValueError):
        raise InvalidArgumentError("levels must be pairs of meshes and an error") from None
    check_errors([error for _, error in found])
    if not all(isinstance(mesh, Mesh) for meshes, _ in found for mesh in meshes):
        raise InvalidArgumentError("levels must be meshes with their errors")
    if len({len(meshes) for meshes, _ in found}) != 1:
        raise InvalidArgumentError("every level must have the same meshes")
    return found
