"""Finds what is under the mouse (node, triangle, material), and the nodes in a rectangle.

In: a rendered frame, and pixels. Out: nodes of the scene. Lights, cameras and empties have no
surface: they are found by their positions in the picture.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..._native.scene_graph import ALIVE, SHOWN
from ...model.materials.material import Material
from ...model.scene.instances import InstancedMesh
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...model.spatial.rays import RayHit
from ...rendering.frame import Frame

#: Of more empties, the first ones are found.
MOST_EMPTIES = 200


class Pick(NamedTuple):
    """The node, triangle and material that a pixel shows.

    Attributes
    ----------
    node : Node
    hit : RayHit or None
        Face, position, normal and so on; None for what is found by its place.
    material : Material or None
        Of the face.
    """

    node: Node
    hit: RayHit | None = None
    material: Material | None = None


def pick(scene: Scene, frame: Frame, x: int, y: int, *, reach: float = 10.0) -> Pick | None:
    """Return the pick at a pixel.

    Parameters
    ----------
    scene : Scene
    frame : Frame
        Of the scene; exact with the outputs of `Scene.pick`.
    x, y : int
        Column and row, from the top left.
    reach : float
        Pixels within which nodes without surface are found by where they stand, before all faces.
    """
    beside = _nearest_origin(scene, frame, x, y, reach)
    if beside is not None:
        return Pick(beside)
    hit = scene.pick(frame, x, y)
    if hit is None and "object_id" in frame.outputs and frame.object_id[y, x] >= 0:
        hit = _behind(scene, frame, x, y)  # a line of the grid, perhaps before something
    if hit is None:
        return None
    obj = hit.node.object
    mesh = obj.mesh if isinstance(obj, InstancedMesh) else obj
    material = None
    if mesh is not None and hit.face_id >= 0:
        material = mesh.materials[mesh.material_ids[hit.face_id]]
    return Pick(hit.node, hit, material)


def enclosed(scene: Scene, frame: Frame, first, last) -> tuple[Node, ...]:
    """Return the nodes visible within a rectangle of a frame, in scene order.

    Parameters
    ----------
    scene : Scene
    frame : Frame
        With the output ``object_id``.
    first, last : (x, y) of int
        Opposite corners, both included; parts outside of the frame do not count.
    """
    (left, right), (top, bottom) = (sorted(pair) for pair in zip(first, last, strict=True))
    if right < 0 or bottom < 0:
        return ()
    ids = frame.object_id[max(top, 0) : bottom + 1, max(left, 0) : right + 1]
    numbers = set(np.unique(ids).tolist()) - {-1}
    nodes, places, depths = _origins(scene, frame)
    inside = (
        (depths > 0)
        & (places >= (left, top)).all(axis=1)
        & (places <= (right + 1, bottom + 1)).all(axis=1)
    )
    numbers.update(nodes[k].id for k in np.flatnonzero(inside).tolist())
    found = (scene.data.node_of(number) for number in sorted(numbers))
    return tuple(node for node in found if node is not None)


def _behind(scene: Scene, frame: Frame, x: int, y: int) -> RayHit | None:
    """Return what a ray through the middle of a pixel meets."""
    return scene.raycast(*frame.rays((x + 0.5, y + 0.5)))


def without_surface(scene: Scene) -> list[Node]:
    """Return the shown lights, cameras and empties: nodes that hold nothing, and no other nodes."""
    held = [*scene.data.lights.values(), *scene.data.cameras.values()]
    return [*(node for node in held if node.shown), *_empties(scene)]


def _empties(scene: Scene) -> list[Node]:
    scene.data.update()
    arrays = scene.data.arrays
    columns = {
        name: arrays.columns[name][: arrays.count] for name in ("flags", "object", "first_child")
    }
    flags = columns["flags"]
    is_bare = (flags & ALIVE != 0) & (flags & SHOWN != 0)
    is_bare &= (columns["object"] < 0) & (columns["first_child"] < 0)
    nodes = (arrays.nodes[slot] for slot in np.flatnonzero(is_bare).tolist())
    return [node for node in nodes if node.object is None][:MOST_EMPTIES]


def _origins(scene: Scene, frame: Frame) -> tuple[list[Node], np.ndarray, np.ndarray]:
    """Return the nodes without surface, and their positions: (N, 2) pixels, (N,) depths."""
    nodes = without_surface(scene)
    places = np.array([node.world_pose[:3, 3] for node in nodes]).reshape(-1, 3)
    return (nodes, *frame.project(places))


def _nearest_origin(scene: Scene, frame: Frame, x: int, y: int, reach: float) -> Node | None:
    nodes, places, depths = _origins(scene, frame)
    distances = np.hypot(*(places - (x + 0.5, y + 0.5)).T)
    distances[~(depths > 0)] = np.inf
    nearest = int(np.argmin(distances)) if nodes else -1
    return nodes[nearest] if nodes and distances[nearest] <= reach else None
