"""Instances drawn with levels of detail by their size on the screen.

In: meshes from fine to coarse with their errors, poses, and before each frame a camera. Out: an
`InstancedMesh` per level, with the instances whose error is then below a limit in pixels.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import frozen
from ...base import linalg
from ...base.calls import checks_types
from ...base.numbers import real, shown
from ...base.validation import Closed
from ...errors import InvalidArgumentError
from ...model.geometry.mesh import Mesh
from ...model.scene.cameras import Camera
from ...model.scene.instances import InstancedMesh, replace_by_rows
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ._choosing import check_errors, check_limits, checked_view, choose_levels, pixels_a_unit
from .impostors import Impostor, bounding_ball
from .simplification import simplify

RATIOS = (0.5, 0.2, 0.08)


class DetailedInstances(Closed):
    """A mesh at many poses, each drawn at the level of detail for its size on the screen.

    Parameters
    ----------
    levels : Mesh, or sequence of (Mesh, float)
        From fine to coarse, each with its error: how far its surface is from the first mesh's, in
        its units; the first has error 0. A mesh alone is simplified to `RATIOS` of its triangles.
    poses : (N, 4, 4) or (N, 4) float
        As for `InstancedMesh`.
    colors : (N, 3) or (N, 4), optional
        As for `InstancedMesh`.
    pixels : float
        The largest error on the screen.
    hysteresis : float
        From 0 up to, not including, 1: an instance turns coarser when its error is then below
        ``pixels * (1 - hysteresis)``.
    impostor : Impostor, optional
        Of the first mesh: what is drawn instead of any level where its error is small enough. The
        picture changes.
    impostor_pixels : float
        The largest error of the impostor on the screen.

    Attributes
    ----------
    levels : tuple of (Mesh, float)
    instances : tuple of InstancedMesh
        One per level, then one per card of the impostor.
    level : (N,) int
        The level of each instance; the number of levels where it is the impostor.

    Raises
    ------
    InvalidArgumentError
    ImportError
        A mesh alone needs the package fast-simplification.
    """

    levels: tuple[tuple[Mesh, float], ...]
    pixels: float
    hysteresis: float
    level: NDArray[np.intp]
    instances: tuple[InstancedMesh, ...]

    def __init__(
        self,
        levels: Mesh | Sequence[tuple[Mesh, float]],
        poses: ArrayLike,
        *,
        colors: ArrayLike | None = None,
        pixels: float = 1.0,
        hysteresis: float = 0.3,
        impostor: Impostor | None = None,
        impostor_pixels: float = 4.0,
    ) -> None:
        self.levels = _made_levels(levels) if isinstance(levels, Mesh) else _checked(levels)
        check_limits(hysteresis, pixels=pixels, impostor_pixels=impostor_pixels)
        if impostor is not None and not isinstance(impostor, Impostor):
            raise InvalidArgumentError(f"impostor must be an Impostor, not {shown(impostor)}")
        self.pixels, self.hysteresis = float(pixels), float(hysteresis)
        mesh = self.levels[0][0]
        self._center, self._radius = bounding_ball(mesh)
        self._impostor = impostor
        errors = [error for _, error in self.levels]
        if impostor is not None:
            errors.append(max(impostor.error * pixels / impostor_pixels, errors[-1]))
        self._errors = np.array(errors)
        finest = InstancedMesh(mesh, poses, colors=colors)
        self._poses, self._colors = finest.poses, finest.colors
        self.level = frozen(np.zeros(len(self._poses), np.intp))
        self._drawn = self.level  # the level or card that each instance is drawn as
        cards = () if impostor is None else impostor.cards
        others = [InstancedMesh(mesh, finest.poses[:0]) for mesh, _ in self.levels[1:]]
        others += [InstancedMesh(card, finest.poses[:0]) for card in cards]
        self.instances = (finest, *others)
        self._nodes: list[Node] = []

    @checks_types
    def add_to(self, scene: Scene, *, name: str = "", parent: Node | None = None) -> Node:
        """Add a node for each level to a scene; return their group node.

        Frames show all of them under this node's ``object_id``; ``instance_id`` is the row of
        ``poses`` at any level.
        """
        group = scene.add(name=name, parent=parent)
        self._nodes.append(group)
        for instances in self.instances:
            scene.data.show_as(scene.add(instances, parent=group), group)
        return group

    def update(self, camera: Camera, pose: ArrayLike, size: tuple[int, int]) -> bool:
        """Choose the levels for a camera; return whether any instance's level changed.

        Parameters
        ----------
        camera : Camera
        pose : (4, 4) float
            World from camera.
        size : (int, int)
            Width and height of the picture in pixels.

        Raises
        ------
        InvalidArgumentError
        """
        pose, size = checked_view(camera, pose, size)
        errors = self._errors_on_screen(camera, pose, size)
        level = frozen(choose_levels(self.level, errors, self.pixels, self.hysteresis))
        drawn = (
            level
            if self._impostor is None
            else self._with_cards(self._impostor, level, camera, pose, size)
        )
        touched = set(drawn[drawn != self._drawn]) | set(self._drawn[drawn != self._drawn])
        self.level, self._drawn = level, drawn
        for number in touched:
            rows = np.flatnonzero(drawn == number)
            replace_by_rows(self.instances[number], rows, self._poses, self._colors)
        return bool(touched)

    def _with_cards(
        self,
        impostor: Impostor,
        level: np.ndarray,
        camera: Camera,
        pose: np.ndarray,
        size: tuple[int, int],
    ) -> np.ndarray:
        """Return the number of the level or card that each instance is drawn as."""
        far = np.flatnonzero(level == len(self.levels))
        drawn = level.copy()
        if len(far):
            towards = self._towards_viewer(self._poses[far].astype(np.float64), camera, pose, size)
            last = np.maximum(self._drawn[far] - len(self.levels), -1)
            drawn[far] += impostor.nearest(towards, last)
        return drawn

    def _towards_viewer(
        self, poses: np.ndarray, camera: Camera, pose: np.ndarray, size: tuple[int, int]
    ) -> np.ndarray:
        """Return directions from instances to the viewer, (N, 3), in instance space, any length."""
        perspective = float(camera.projection(size)[3, 3]) == 0.0
        world = linalg.inverse(self._nodes[0].world_pose) if self._nodes else np.eye(4)
        if perspective:
            eye, center = linalg.transform_points(world, pose[:3, 3]), self._center
        else:  # parallel projection: one direction for all instances
            eye, center = linalg.dot(world[:3, :3], pose[:3, 2]), np.zeros(3)
        if poses.ndim == 2:
            offset, scale = poses[:, :3] * float(perspective), poses[:, 3:4]
            return (eye - offset) * np.copysign(1.0, scale) - center * np.abs(scale)
        x, y, z, offset = (poses[:, :3, k] for k in range(4))
        back = [linalg.cross(y, z), linalg.cross(z, x), linalg.cross(x, y)]  # rows of the inverse
        volume = linalg.dot(x, back[0])[:, np.newaxis]
        way = eye - offset * float(perspective)
        local = np.stack([linalg.dot(row, way) for row in back], axis=1)
        return local * np.copysign(1.0, volume) - center * np.abs(volume)

    def _errors_on_screen(
        self, camera: Camera, pose: np.ndarray, size: tuple[int, int]
    ) -> np.ndarray:
        """Return the errors of each level of each instance in pixels, (levels, N)."""
        center, radius = self._center, self._radius
        poses = self._poses.astype(np.float64)
        if poses.ndim == 2:
            scale = np.abs(poses[:, 3])
            centers = poses[:, :3] + center * poses[:, 3:4]
        else:
            scale = linalg.length(poses[:, :3, :3].transpose(0, 2, 1)).max(axis=1)
            centers = linalg.dot(poses[:, :3, :3], center) + poses[:, :3, 3]
        if self._nodes:
            world = self._nodes[0].world_pose
            centers = linalg.transform_points(world, centers)
            scale = scale * linalg.length(world[:3, :3].T).max()
        near = linalg.length(centers - pose[:3, 3]) - radius * scale
        pixels = pixels_a_unit(camera, size, near) * scale
        return self._errors[:, np.newaxis] * pixels

    def __len__(self) -> int:
        return len(self._poses)

    def __repr__(self) -> str:
        counts = ", ".join(str(len(instances)) for instances in self.instances)
        return f"DetailedInstances({len(self)} instances; by level: {counts})"


def _made_levels(mesh: Mesh) -> tuple[tuple[Mesh, float], ...]:
    """Return a mesh and its simplifications, as far as each makes it smaller."""
    levels = [(mesh, 0.0)]
    for ratio in RATIOS:
        coarse, error = simplify(mesh, ratio)
        if len(coarse.faces) < 0.9 * len(levels[-1][0].faces):
            levels.append((coarse, max(error, levels[-1][1])))
    return tuple(levels)


def _checked(levels: Iterable[tuple[Mesh, float]]) -> tuple[tuple[Mesh, float], ...]:
    try:
        levels = tuple((mesh, real(error)) for mesh, error in levels)
    except (TypeError, ValueError):
        raise InvalidArgumentError(
            "levels must be a Mesh or pairs of a mesh and an error"
        ) from None
    check_errors([error for _, error in levels])
    if not all(isinstance(mesh, Mesh) for mesh, _ in levels):
        raise InvalidArgumentError("levels must be meshes with their errors")
    return levels
