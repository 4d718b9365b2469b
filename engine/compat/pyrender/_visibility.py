"""Determines the visible triangle at each pixel and sample, by the engine's renderer.

In: primitives with their poses, and a camera's matrix. Out: IDs at each pixel's centre and samples.
Nodes and meshes are cached from picture to picture.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...model.scene.cameras import Camera
from ...model.scene.instances import InstancedMesh
from ...model.scene.scene import Scene
from ...rendering.options import RenderOptions
from ...rendering.renderer import Renderer
from ._shapes import mesh_of
from .primitive import Primitive

#: Offsets of Mesa's samples from the pixel's centre, in pixels, y down; then of the centre.
_OFFSETS = ((-0.125, 0.375), (0.375, 0.125), (-0.375, -0.125), (0.125, -0.375), (0.0, 0.0))
_MANY = 1 << 16  # IDs used before the scene is replaced by a new one


class Placed(NamedTuple):
    """Triangles of a primitive at a node.

    Attributes
    ----------
    key : tuple
        Tells them from others of the same scene.
    primitive : Primitive
    pose : (4, 4) float64
        world-from-node.
    two_sided, turned : bool
        As for `_shapes.mesh_of`.
    draw : int
        The number of their first instance among what the picture draws.
    """

    key: tuple
    primitive: Primitive
    pose: np.ndarray
    two_sided: bool
    turned: bool
    draw: int


class Visibility:
    """The cached visibility scene."""

    def __init__(self) -> None:
        self._forget()

    def _forget(self) -> None:
        self._scene = Scene()
        self._nodes: dict[tuple, tuple] = {}  # the node, its mesh, and its pose
        self._cameras = [Camera(np.eye(4)) for _ in range(len(_OFFSETS))]
        self._most = 0
        self._changes = 0  # changes of the placed triangles
        self._last: tuple | None = None  # the picture that they belong to
        self._found: dict[int, tuple] = {}  # by sample position
        self._frames: tuple = ((), [])  # drawn into again: of what kind, and a frame of each place

    def place(self, things: list[Placed]) -> np.ndarray:
        """Place the triangles to draw; return the draw for each object ID, or the only one."""
        if self._most > _MANY:
            self._forget()
        for key in self._nodes.keys() - {thing.key for thing in things}:
            self._scene.remove(self._nodes.pop(key)[0])
            self._changes += 1
        ids = [(self._node(thing).id, thing.draw) for thing in things]
        self._most = max((number for number, _ in ids), default=0)
        if self._is_single:
            return np.array([things[0].draw], np.int32)
        draws = np.zeros(self._most + 1, np.int32)
        for number, draw in ids:
            draws[number] = draw
        return draws

    @property
    def _is_single(self) -> bool:
        """Return whether there is one object without instances, so that triangle IDs suffice."""
        return len(self._nodes) == 1 and not self._has_instances

    @property
    def _has_instances(self) -> bool:
        return any(shows[1] is not None for _, shows, _ in self._nodes.values())

    def _node(self, thing: Placed):
        mesh = mesh_of(thing.primitive, two_sided=thing.two_sided, turned=thing.turned)
        poses = thing.primitive.poses
        node, shows, pose = self._nodes.get(thing.key, (None, None, None))
        if node is None:
            node = self._scene.add(None)
        if shows is None or shows[0] is not mesh or shows[1] is not poses:
            node.object = mesh if poses is None else InstancedMesh(mesh, poses)
            self._changes += 1
        if pose is None or not np.array_equal(pose, thing.pose):
            node.pose = thing.pose
            self._changes += 1
        self._nodes[thing.key] = node, (mesh, poses), thing.pose
        return node

    def find(self, renderer: Renderer, projection, pose, places: Sequence[int]) -> list[tuple]:
        """Return the visible IDs at given positions of each pixel.

        Parameters
        ----------
        renderer : Renderer
        projection : (4, 4) float64
            clip-from-camera.
        pose : (4, 4) float64
            world-from-camera.
        places : sequence of int
            Of `CENTRE` and the numbers of the samples.

        Returns
        -------
        shown : list of (object_id, face_id, instance_id)
            Arrays (H, W) int32; the first is None where there is one object, the last where nothing
            has instances.
        """
        size = renderer.size
        key = self._changes, size, projection.tobytes(), pose.tobytes()
        if key != self._last:
            self._last, self._found = key, {}
        for place in places:
            if place not in self._found:
                self._found[place] = self._look(renderer, projection, pose, place)
        return [self._found[place] for place in places]

    def _look(self, renderer: Renderer, projection, pose, place: int) -> tuple:
        """Return the visible IDs at one position; consecutive pictures share the scene."""
        names = [
            *(["face_id"] if self._is_single else ["object_id", "face_id"]),
            *(["instance_id"] if self._has_instances else []),
        ]
        kind = tuple(names), renderer.size
        if self._frames[0] != kind:
            self._frames = kind, [None] * len(_OFFSETS)
        frames, camera = self._frames[1], self._cameras[place]
        matrix = _moved(projection, _OFFSETS[place], renderer.width, renderer.height)
        if not np.array_equal(camera.matrix, matrix):
            camera.matrix = matrix
        options = RenderOptions(cull="back", outputs=names)
        frames[place] = frame = renderer.render(
            self._scene, (camera, pose), out=frames[place], options=options
        )
        every = ("object_id", "face_id", "instance_id")
        return tuple(getattr(frame, name) if name in names else None for name in every)

    def depths(self, renderer: Renderer, projection, pose) -> np.ndarray:
        """Return z_ndc at pixel centres, (H, W) float32, infinite for background."""
        camera = self._cameras[-1]
        camera.matrix = projection
        options = {"cull": "back", "outputs": ("ndc_depth",)}
        return renderer.render(self._scene, (camera, pose), **options).ndc_depth


def _moved(projection: np.ndarray, offset, width: int, height: int) -> np.ndarray:
    """Return the projection of a picture shifted by some pixels."""
    matrix = projection.copy()
    matrix[0] -= matrix[3] * (2.0 * offset[0] / width)
    matrix[1] += matrix[3] * (2.0 * offset[1] / height)
    return matrix
