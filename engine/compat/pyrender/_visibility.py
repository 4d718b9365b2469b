"""Finds which triangle shows at each place of a picture, by the engine's renderer.

In: primitives with their places, and a camera's matrix. Out: IDs of what shows at each pixel's
centre and at its samples. Nodes and meshes stay from picture to picture.
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

#: Of the samples from the pixel's centre, in pixels, y down, as Mesa has them; then of the centre.
_OFFSETS = ((-0.125, 0.375), (0.375, 0.125), (-0.375, -0.125), (0.125, -0.375), (0.0, 0.0))
_MANY = 1 << 16  # ids that a scene gives out before another takes its place


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
    """Triangles that are drawn again and again."""

    def __init__(self) -> None:
        self._forget()

    def _forget(self) -> None:
        self._scene = Scene()
        self._nodes: dict[tuple, tuple] = {}  # the node, what it shows, and where
        self._cameras = [Camera(np.eye(4)) for _ in range(len(_OFFSETS))]
        self._most = 0
        self._changes = 0  # of what is placed
        self._last: tuple | None = None  # of what picture they are
        self._found: dict[int, tuple] = {}  # of places
        self._frames: tuple = ((), [])  # drawn into again: of what kind, and a frame of each place

    def place(self, things: list[Placed]) -> np.ndarray:
        """Take in what is to be drawn; return the draw of each object id, or of the only one."""
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
        """Whether there is one object without instances, so that triangles tell all."""
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
        """Return what shows at places of each pixel.

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
        shown : list of (object_id, triangle_id, instance_id)
            Arrays (H, W) int32; the first is None where there is one object, the last where nothing
            has instances.
        """
        size = renderer.width, renderer.height
        key = self._changes, size, projection.tobytes(), pose.tobytes()
        if key != self._last:
            self._last, self._found = key, {}
        for place in places:
            if place not in self._found:
                self._found[place] = self._look(renderer, projection, pose, place)
        return [self._found[place] for place in places]

    def _look(self, renderer: Renderer, projection, pose, place: int) -> tuple:
        """Find what shows at a place; pictures that follow one another share it."""
        names = [
            *(["triangle_id"] if self._is_single else ["object_id", "triangle_id"]),
            *(["instance_id"] if self._has_instances else []),
        ]
        kind = tuple(names), renderer.width, renderer.height
        if self._frames[0] != kind:
            self._frames = kind, [None] * len(_OFFSETS)
        frames, camera = self._frames[1], self._cameras[place]
        matrix = _moved(projection, _OFFSETS[place], renderer.width, renderer.height)
        if not np.array_equal(camera.matrix, matrix):
            camera.matrix = matrix
        options = RenderOptions(outputs=names)
        frames[place] = frame = renderer.render(
            self._scene, (camera, pose), out=frames[place], options=options
        )
        every = ("object_id", "triangle_id", "instance_id")
        return tuple(getattr(frame, name) if name in names else None for name in every)

    def depths(self, renderer: Renderer, projection, pose) -> np.ndarray:
        """Return z_ndc of what shows at the centres, (H, W) float32, infinite for nothing."""
        camera = self._cameras[-1]
        camera.matrix = projection
        return renderer.render(self._scene, (camera, pose), outputs=("ndc_depth",)).ndc_depth


def _moved(projection: np.ndarray, offset, width: int, height: int) -> np.ndarray:
    """The projection of a picture whose pixels' centres are off by so many pixels."""
    matrix = projection.copy()
    matrix[0] -= matrix[3] * (2.0 * offset[0] / width)
    matrix[1] += matrix[3] * (2.0 * offset[1] / height)
    return matrix
