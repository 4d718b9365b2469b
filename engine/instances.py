"""One mesh drawn many times in one go.

In: a mesh, a pose for each instance, perhaps a colour for each. Out: read-only float32 arrays that
the core reads directly; they are rounded to float32 once, here.
"""

from __future__ import annotations

import numpy as np

from .attributes import CheckedAttribute
from .errors import InvalidArgumentError
from .mesh import Mesh


def _check_mesh(value, what: str) -> Mesh:
    if not isinstance(value, Mesh):
        raise InvalidArgumentError(f"{what} must be a Mesh, not {type(value).__name__}")
    return value


class InstancedMesh:
    """A mesh at many poses; one node of a scene, drawn far faster than a node for each.

    Parameters
    ----------
    mesh : Mesh
    poses : (N, 4, 4) or (N, 4) float
        node-from-instance matrices, or offset x, y, z and uniform scale. N may be 0.
    colors : (N, 3) or (N, 4) uint8 or float, optional
        Multiplies the mesh's colours: ``uint8`` is sRGB, floats are linear. Alpha is ignored.

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

    mesh = CheckedAttribute(_check_mesh)

    def __init__(self, mesh: Mesh, poses, *, colors=None) -> None:
        self.mesh = mesh
        self.replace(poses, colors)

    @property
    def poses(self) -> np.ndarray:
        """(N, 4, 4) or (N, 4) float32, as given."""
        return self._poses

    @poses.setter
    def poses(self, value) -> None:
        poses = _check_poses(value)
        if self._colors is not None and len(self._colors) != len(poses):
            raise InvalidArgumentError(
                f"poses has {len(poses)} rows, but colors {len(self._colors)}: use replace()"
            )
        self._poses = poses
        self.version += 1

    @property
    def colors(self) -> np.ndarray | None:
        """(N, 4) uint8 (sRGB) or float32 (linear), or None."""
        return self._colors

    @colors.setter
    def colors(self, value) -> None:
        self._colors = _check_colors(value, len(self._poses))
        self.version += 1

    def replace(self, poses, colors=None) -> None:
        """Set poses and colours together; their number may change."""
        checked = _check_poses(poses)
        self._colors = _check_colors(colors, len(checked))
        self._poses = checked
        self.version += 1

    def bounds_in_node(self) -> np.ndarray | None:
        """Return the box around all instances in the node's space, (2, 3) float64, or None."""
        low, high = self.mesh.bounds
        if len(self.mesh.positions) == 0 or len(self._poses) == 0:
            return None
        center, half = (low + high) * 0.5, (high - low) * 0.5
        poses = self._poses.astype(np.float64)
        if poses.ndim == 2:
            scale = poses[:, 3:4]
            centers, halves = poses[:, :3] + scale * center, np.abs(scale) * half
        else:
            centers, halves = transform_box(poses, center, half)
        finite = np.isfinite(centers).all(axis=1) & np.isfinite(halves).all(axis=1)
        if not finite.any():
            return None
        centers, halves = centers[finite], halves[finite]
        return np.stack([(centers - halves).min(axis=0), (centers + halves).max(axis=0)])

    def __len__(self) -> int:
        return len(self._poses)

    def __repr__(self) -> str:
        return f"InstancedMesh({self.mesh!r}, {len(self)} instances)"


def transform_box(poses: np.ndarray, center, half) -> tuple[np.ndarray, np.ndarray]:
    """Return centres and half sizes of the boxes around a box at many poses.

    Parameters
    ----------
    poses : (N, 4, 4) float64, affine
    center, half : (3,) or (N, 3) float64

    Returns
    -------
    centers, halves : (N, 3) float64
    """
    center, half = np.atleast_2d(center), np.atleast_2d(half)
    centers = poses[:, :3, 3].copy()
    halves = np.zeros_like(centers)
    for axis in range(3):
        column = poses[:, :3, axis]
        centers = centers + column * center[:, axis : axis + 1]
        halves = halves + np.abs(column) * half[:, axis : axis + 1]
    return centers, halves


def _check_poses(value) -> np.ndarray:
    try:
        poses = np.array(value, np.float32, order="C")
    except (TypeError, ValueError) as error:
        raise InvalidArgumentError(f"poses must be numbers: {error}") from None
    if poses.shape[1:] not in ((4, 4), (4,)) or poses.ndim < 2:
        raise InvalidArgumentError(f"poses must be (N, 4, 4) or (N, 4), not {poses.shape}")
    if poses.ndim == 3 and not (poses[:, 3] == (0, 0, 0, 1)).all():
        raise InvalidArgumentError("poses must be affine: the last row of each is 0 0 0 1")
    poses.setflags(write=False)
    return poses


def _check_colors(value, count: int) -> np.ndarray | None:
    if value is None:
        return None
    colors = np.asarray(value)
    if colors.shape not in ((count, 3), (count, 4)):
        raise InvalidArgumentError(f"colors must be ({count}, 3 or 4), not {colors.shape}")
    if colors.dtype != np.uint8:
        if colors.dtype.kind != "f":
            raise InvalidArgumentError(f"colors must be uint8 or float, not {colors.dtype}")
        colors = colors.astype(np.float32)
    opaque = 255 if colors.dtype == np.uint8 else 1
    result = np.full((count, 4), opaque, colors.dtype)
    result[:, : colors.shape[1]] = colors
    result.setflags(write=False)
    return result
