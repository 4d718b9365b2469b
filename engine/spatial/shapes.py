"""What meshes and instances are to rays: trees of boxes, made when a ray first meets them.

In: `Mesh`, `InstancedMesh`. Out: native trees, one for each version of the object, forgotten with
it.
"""

from __future__ import annotations

from weakref import WeakKeyDictionary

import numpy as np

from .._native.scene_graph import BOX, NativeShapes, NativeTree, triangle_boxes
from ..instances import InstancedMesh
from ..mesh import Mesh

_triangles: WeakKeyDictionary[Mesh, tuple[int, NativeTree]] = WeakKeyDictionary()


def triangle_tree(mesh: Mesh) -> NativeTree:
    """Return the tree of a mesh's faces as they are now."""
    version, tree = _triangles.get(mesh, (None, None))
    if version != mesh.version:
        boxes = np.empty((len(mesh.faces), BOX))
        triangle_boxes(mesh.positions, mesh.faces, boxes)
        tree = NativeTree(boxes)
        _triangles[mesh] = (mesh.version, tree)
    return tree


def faces_in_box(mesh: Mesh, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Return the numbers of the faces whose boxes meet a box of the mesh's space."""
    bits = np.zeros((len(mesh.faces) + 63) // 64, np.uint64)
    triangle_tree(mesh).overlaps(low, high, bits)
    return np.flatnonzero(np.unpackbits(bits.view(np.uint8), bitorder="little"))


def tell(shapes: NativeShapes, number: int, obj) -> None:
    """Tell the shape of a scene's object."""
    if isinstance(obj, InstancedMesh):
        mesh, poses, tree = obj.mesh, obj._flat_poses(), obj._tree()
    else:
        mesh, poses, tree = obj, None, None
    shapes.set(number, mesh.positions, mesh.faces, triangle_tree(mesh), poses, tree)
