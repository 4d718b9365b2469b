"""Shapes of meshes and instances for rays: trees of boxes, built when a ray first needs them.

In: `Mesh`, `InstancedMesh`. Out: native trees, rebuilt when arrays change, freed with the object.
"""

from __future__ import annotations

from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from ..._native.scene_graph import BOX, NativeShapes, NativeTree, triangle_boxes
from ..geometry.derived import arrays_of
from ..geometry.mesh import Mesh
from ..scene.instances import InstancedMesh, instance_tree
from ..scene.shown import as_shown

_triangles: WeakKeyDictionary[Mesh, tuple[tuple[Any, ...], NativeTree]] = WeakKeyDictionary()


def triangle_tree(mesh: Mesh, arrays: dict[str, Any] | None = None) -> NativeTree:
    """Return the tree of a mesh's faces, for its current arrays or the given ones."""
    arrays = arrays_of(mesh) if arrays is None else arrays
    positions, faces = arrays["positions"], arrays["faces"]
    made_of, tree = _triangles.get(mesh, ((None, None), None))
    if tree is None or made_of[0] is not positions or made_of[1] is not faces:
        boxes = np.empty((len(faces), BOX))
        triangle_boxes(positions, faces, boxes)
        tree = NativeTree(boxes)
        _triangles[mesh] = (positions, faces), tree
    return tree


def faces_in_box(mesh: Mesh, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Return the numbers of the faces whose boxes intersect a box in mesh space."""
    bits = np.zeros((len(mesh.faces) + 63) // 64, np.uint64)
    triangle_tree(mesh).overlaps(low, high, bits)
    return np.flatnonzero(np.unpackbits(bits.view(np.uint8), bitorder="little"))


def way_to_face(
    mesh: Mesh, pose: np.ndarray, origin: np.ndarray, direction: np.ndarray, farthest: float
) -> float:
    """Return the distance along a unit ray to a face of a mesh; infinite if it misses."""
    arrays = arrays_of(mesh)
    tree = triangle_tree(mesh, arrays)
    return tree.nearest_triangle(
        arrays["positions"], arrays["faces"], pose, origin, direction, farthest
    )


def tell(shapes: NativeShapes, number: int, obj: Any) -> None:
    """Pass the current shape of a scene's object to the core."""
    mesh, poses, tree = as_shown(obj), None, None
    if isinstance(obj, InstancedMesh):
        mesh, (tree, poses) = obj.mesh, instance_tree(obj)
    arrays = arrays_of(mesh)
    triangles = triangle_tree(mesh, arrays)
    shapes.set(number, arrays["positions"], arrays["faces"], triangles, poses, tree)
