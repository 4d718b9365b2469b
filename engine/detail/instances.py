"""Instances that are drawn coarser the smaller they are on the screen.

In: meshes from fine to coarse with their errors, poses, and before each frame a camera. Out: an
`InstancedMesh` a level, of those instances whose error is then less than some pixels. An instance
turns coarser only well within the limit, so that it does not flicker between two levels.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from .. import linalg
from ..cameras import Camera
from ..errors import InvalidArgumentError
from ..instances import InstancedMesh
from ..mesh import Mesh
from ..scene import Node, Scene
from .simplification import simplify

RATIOS = (0.5, 0.2, 0.08)


class DetailedInstances:
    """A mesh at many poses, each drawn in the detail that its size on the screen needs.

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

    Attributes
    ----------
    levels : tuple of (Mesh, float)
    instances : tuple of InstancedMesh
        One a level.
    level : (N,) int
        The level of each instance.

    Raises
    ------
    InvalidArgumentError
    ImportError
        A mesh alone needs the package fast-simplification.
    """

    def __init__(
        self,
        levels: Mesh | Sequence[tuple[Mesh, float]],
        poses,
        *,
        colors=None,
        pixels: float = 1.0,
        hysteresis: float = 0.3,
    ) -> None:
        self.levels = _made_levels(levels) if isinstance(levels, Mesh) else _checked(levels)
        if not 0.0 < pixels < math.inf:
            raise InvalidArgumentError(f"pixels must be greater than 0, not {pixels!r}")
        if not 0.0 <= hysteresis < 1.0:
            raise InvalidArgumentError(f"hysteresis must be from 0 to below 1, not {hysteresis!r}")
        self.pixels, self.hysteresis = float(pixels), float(hysteresis)
        mesh = self.levels[0][0]
        self._center = (mesh.bounds[0] + mesh.bounds[1]) * 0.5
        lengths = linalg.length(mesh.positions - self._center)
        self._radius = float(lengths[np.isfinite(lengths)].max(initial=0.0))
        finest = InstancedMesh(mesh, poses, colors=colors)
        self._poses, self._colors = finest.poses, finest.colors
        self.level = np.zeros(len(self._poses), np.intp)
        none = self._chosen(np.zeros(0, np.intp))
        others = [InstancedMesh(mesh, none[0], colors=none[1]) for mesh, _ in self.levels[1:]]
        self.instances = (finest, *others)
        self._nodes: list[Node] = []

    def add_to(self, scene: Scene, *, name: str = "", parent: Node | None = None) -> Node:
        """Add a node for each level to a scene; returns the node that groups them."""
        group = scene.add(name=name, parent=parent)
        self._nodes.append(group)
        for instances in self.instances:
            scene.add(instances, parent=group)
        return group

    def update(self, camera: Camera, pose, size: tuple[int, int]) -> bool:
        """Choose the levels for a camera; returns whether any instance's changed.

        Parameters
        ----------
        camera : Camera
        pose : (4, 4) float
            World from camera.
        size : (int, int)
            Width and height of the picture in pixels.
        """
        errors = self._errors_on_screen(camera, np.asarray(pose, np.float64), size)
        # Refine what is too coarse now; coarsen what is fine enough by a margin.
        fine_enough = _coarsest(errors, self.pixels)
        safely = _coarsest(errors, self.pixels * (1.0 - self.hysteresis))
        level = np.maximum(np.minimum(self.level, fine_enough), safely)
        touched = set(level[level != self.level]) | set(self.level[level != self.level])
        self.level = level
        for number in touched:
            self.instances[number].replace(*self._chosen(np.flatnonzero(level == number)))
        return bool(touched)

    def _chosen(self, numbers: np.ndarray):
        return self._poses[numbers], None if self._colors is None else self._colors[numbers]

    def _errors_on_screen(self, camera, pose, size) -> np.ndarray:
        """Errors of each level of each instance in pixels, (levels, N)."""
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
        projection = camera.projection(*size)
        pixels = abs(float(projection[1, 1])) * size[1] * 0.5 * scale
        if float(projection[3, 3]) == 0.0:  # perspective: smaller with the distance
            near = linalg.length(centers - pose[:3, 3]) - radius * scale
            pixels = pixels / np.maximum(near, 1e-9)
        return np.array([error for _, error in self.levels])[:, np.newaxis] * pixels

    def __len__(self) -> int:
        return len(self._poses)

    def __repr__(self) -> str:
        counts = ", ".join(str(len(instances)) for instances in self.instances)
        return f"DetailedInstances({len(self)} instances; by level: {counts})"


def _coarsest(errors: np.ndarray, limit: float) -> np.ndarray:
    """The last level of each column up to which every error is at most the limit."""
    return (np.cumprod(errors[1:] <= limit, axis=0)).sum(axis=0)


def _made_levels(mesh: Mesh) -> tuple[tuple[Mesh, float], ...]:
    """A mesh and what it is simplified to, as far as that makes it smaller."""
    levels = [(mesh, 0.0)]
    for ratio in RATIOS:
        coarse, error = simplify(mesh, ratio)
        if len(coarse.faces) < 0.9 * len(levels[-1][0].faces):
            levels.append((coarse, max(error, levels[-1][1])))
    return tuple(levels)


def _checked(levels) -> tuple[tuple[Mesh, float], ...]:
    try:
        levels = tuple((mesh, float(error)) for mesh, error in levels)
    except (TypeError, ValueError):
        raise InvalidArgumentError(
            "levels must be a Mesh or pairs of a mesh and an error"
        ) from None
    errors = [error for _, error in levels]
    if not levels or errors[0] != 0.0 or errors != sorted(errors) or not math.isfinite(errors[-1]):
        raise InvalidArgumentError("the errors of levels must begin with 0 and never decrease")
    if not all(isinstance(mesh, Mesh) for mesh, _ in levels):
        raise InvalidArgumentError("levels must be meshes with their errors")
    return levels
