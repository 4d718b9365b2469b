"""Instanced meshes: one mesh drawn many times in one call.

In: a mesh, a pose for each instance, optionally a colour for each. Out: read-only arrays that the
core reads directly; poses are rounded to float32 once, here.
"""

from __future__ import annotations

import math
import operator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import frozen
from ..._native.scene_graph import BOX, OBJECT_BOX, NativeTree, instance_boxes, union
from ...base.dirty_tracking import renew
from ...base.numbers import floats
from ...base.validation import CheckedAttribute, Closed
from ...errors import InvalidArgumentError
from ..geometry.mesh import Mesh
from ..materials.colors import eight_bit_or_linear, float32_of
from ..materials.linear_colors import marked

#: Drawing builds a tree of boxes for at least this many instances.
MANY = 1024


def _check_mesh(value: Mesh, what: str) -> Mesh:
    if not isinstance(value, Mesh):
        raise InvalidArgumentError(f"{what} must be a Mesh, not {type(value).__name__}")
    return value


class InstancedMesh(Closed):
    """A mesh at many poses: one node of a scene, which draws far faster than a node per pose.

    Parameters
    ----------
    mesh : Mesh
    poses : (N, 4, 4) or (N, 4) float
        node-from-instance matrices, or offset x, y, z and uniform scale. N may be 0.
    colors : (N, 3) or (N, 4) int or float, or N colours, optional
        Multiply the mesh's colours: as those of `Mesh`. Alpha is ignored.

    Attributes
    ----------
    poses, colors
        Read-only; assigning copies. Assign both with `replace` to change N.
    version : int
        Grows with every assignment.

    Raises
    ------
    InvalidArgumentError
    """

    mesh: CheckedAttribute[Mesh, Mesh] = CheckedAttribute(_check_mesh)
    version: int
    _poses: NDArray[np.float32]
    _colors: NDArray[Any] | None
    # Poses and positions, with the box derived from them.
    _box_of: tuple[Any, ...] | None = None
    _tree_of: tuple[Any, ...] | None = None
    _FORGOTTEN = ("_box_of", "_tree_of")

    def __init__(self, mesh: Mesh, poses: ArrayLike, *, colors: ArrayLike | None = None) -> None:
        self._ids: np.ndarray | None = None  # values of instance_id; None: the row numbers
        self.mesh = mesh
        self.replace(poses, colors)

    @property
    def poses(self) -> NDArray[np.float32]:
        """(N, 4, 4) or (N, 4) float32, as given."""
        return self._poses

    @poses.setter
    def poses(self, value: ArrayLike) -> None:
        poses = _check_poses(value)
        if self._colors is not None and len(self._colors) != len(poses):
            raise InvalidArgumentError(
                f"poses has {len(poses)} rows, but colors {len(self._colors)}: use replace()"
            )
        self._poses = poses
        renew(self)

    @property
    def colors(self) -> NDArray[np.uint8] | NDArray[np.float32] | None:
        """(N, 4) uint8 (sRGB) or float32 (linear), or None."""
        return self._colors

    @colors.setter
    def colors(self, value: ArrayLike | None) -> None:
        self._colors = _check_colors(value, len(self._poses))
        renew(self)

    def replace(self, poses: ArrayLike, colors: ArrayLike | None = None) -> None:
        """Set poses and colours together; their number may change."""
        checked = _check_poses(poses)
        self._ids = None
        self._colors = _check_colors(colors, len(checked))
        self._poses = checked
        renew(self)

    def bounds_in_node(self) -> NDArray[np.float64] | None:
        """Return the box around all instances in node space, (2, 3) float64, or None."""
        box = box_in_node(self)
        return box[:6].reshape(2, 3).copy() if box[0] <= box[3] else None

    def __len__(self) -> int:
        return len(self._poses)

    def __repr__(self) -> str:
        return f"InstancedMesh({self.mesh!r}, {len(self)} instances)"


def flat_poses(instances: InstancedMesh) -> NDArray[np.float32]:
    """Return the poses as C reads them, (N, 16) or (N, 4)."""
    poses = instances._poses
    return poses.reshape(len(poses), math.prod(poses.shape[1:]))


def shown_ids(instances: InstancedMesh) -> NDArray[np.int32] | None:
    """Return the values of ``instance_id``, (N,); None: the row numbers."""
    return instances._ids


def replace_by_rows(
    instances: InstancedMesh,
    rows: NDArray[np.intp],
    poses: NDArray[np.float32],
    colors: NDArray[Any] | None,
) -> None:
    """Draw the given rows of another's poses and colours, under their original numbers."""
    instances.replace(poses[rows], None if colors is None else colors[rows])
    instances._ids = rows.astype(np.int32)


def instance_matrices(poses: NDArray[np.float32]) -> NDArray[np.float64]:
    """Convert poses of instances, (N, 4, 4) or (N, 4), to matrices, (N, 4, 4)."""
    given = poses.astype(np.float64)
    if given.ndim == 3:
        return given
    matrices = np.zeros((len(given), 4, 4))
    matrices[:, range(3), range(3)] = given[:, 3:]
    matrices[:, :3, 3] = given[:, :3]
    matrices[:, 3, 3] = 1.0
    return matrices


def instance_tree(instances: InstancedMesh) -> tuple[NativeTree, NDArray[np.float32]]:
    """Return the tree of the instances' boxes, and its poses as C reads them."""
    state = instances._poses, instances.mesh.positions
    known = instances._tree_of
    if known is None or not _same(known[0], state):
        poses = flat_poses(instances)
        known = instances._tree_of = state, (NativeTree(_boxes(instances, poses)), poses)
    return known[1]


def box_in_node(instances: InstancedMesh) -> NDArray[np.float64]:
    """Return the box around all instances, (OBJECT_BOX,); cached until they change."""
    state = instances._poses, instances.mesh.positions
    known = instances._box_of
    if known is None or not _same(known[0], state):
        box = np.empty(OBJECT_BOX)
        union(_boxes(instances, flat_poses(instances)), box)
        known = instances._box_of = state, box
    return known[1]


def _boxes(instances: InstancedMesh, poses: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return the boxes of the instances in node space, (N, BOX), from poses as C reads them."""
    boxes = np.empty((len(poses), BOX))
    instance_boxes(poses, mesh_box(instances.mesh), boxes)
    return boxes


def _same(known: tuple[Any, ...], state: tuple[Any, ...]) -> bool:
    """Return whether cached data was derived from these very arrays."""
    return all(map(operator.is_, known, state))


def mesh_box(mesh: Mesh) -> np.ndarray:
    """Return a mesh's box as C reads it, (OBJECT_BOX,): lowest, highest, farthest from 0."""
    low, high = mesh.bounds if len(mesh.positions) else (np.full(3, np.inf), np.full(3, -np.inf))
    return np.concatenate([low, high, np.maximum(np.abs(low), np.abs(high))])


def _check_poses(value: ArrayLike) -> NDArray[np.float32]:
    poses = float32_of(floats(value, "poses"))
    if poses.shape == (0,):
        poses = poses.reshape(0, 4)
    if poses.shape[1:] not in ((4, 4), (4,)) or poses.ndim < 2:
        raise InvalidArgumentError(f"poses must be (N, 4, 4) or (N, 4), not {poses.shape}")
    if poses.ndim == 3 and not (poses[:, 3] == (0, 0, 0, 1)).all():
        raise InvalidArgumentError("poses must be affine: the last row of each is 0 0 0 1")
    return frozen(poses)


def _check_colors(value: ArrayLike | None, count: int) -> NDArray[Any] | None:
    if value is None:
        return None
    colors = eight_bit_or_linear(value, "colors")
    if colors.shape not in ((count, 3), (count, 4)):
        raise InvalidArgumentError(f"colors must be ({count}, 3 or 4), not {colors.shape}")
    opaque = 255 if colors.dtype == np.uint8 else 1
    result = np.full((count, 4), opaque, colors.dtype)
    result[:, : colors.shape[1]] = colors
    return marked(frozen(result))
