"""Selections: poses, parts, switches and boxes of many nodes at once, as arrays.

In: arrays with one row per node. Out: copies. Only creating a selection loops over nodes in Python.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, NoReturn, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.scene_graph import VISIBLE
from ...base.numbers import as_array, floats, shown
from ...base.validation import Closed
from ...errors import InvalidArgumentError
from .node_arrays import matrices_of
from .nodes import Node

if TYPE_CHECKING:
    from .scene import Scene


class NodeSelection(Closed):
    """Some nodes of a scene, read and moved together; made by `Scene.select`.

    An assigned array has a row for each node, in the order of the selection, or one row for all.
    Reading returns copies.

    Attributes
    ----------
    nodes : tuple of Node
    """

    nodes: tuple[Node, ...]

    def __init__(self, scene: Scene, nodes: Iterable[Node]) -> None:
        self.nodes = tuple(nodes)
        self._scene = scene
        self._removals = -1
        self._slots = self._rows  # this checks the nodes

    @property
    def _rows(self) -> np.ndarray:
        """The nodes' current slots."""
        scene = self._scene
        if self._removals != scene.data.removals:
            for node in self.nodes:
                if not isinstance(node, Node) or node._scene is not scene:
                    raise InvalidArgumentError(
                        f"nodes: {shown(node)} is not a node of this scene, or not now"
                    )
            self._slots = scene.data.slots_of(self.nodes)
            self._removals = scene.data.removals
        return self._slots

    def __len__(self) -> int:
        return len(self.nodes)

    @property
    def poses(self) -> NDArray[np.float64]:
        """parent-from-node, (N, 4, 4) float64."""
        return matrices_of(self._scene.data.arrays.columns["pose"][self._rows])

    @poses.setter
    def poses(self, value: ArrayLike) -> None:
        poses = self._checked(value, "poses", (4, 4))
        if not (poses[:, 3] == (0.0, 0.0, 0.0, 1.0)).all():
            raise InvalidArgumentError("poses must be affine: the last row of each is 0 0 0 1")
        self._scene.data.arrays.set_poses(self._rows, poses)

    @property
    def translations(self) -> NDArray[np.float64]:
        """(N, 3) float64."""
        return self._scene.data.arrays.columns["pose"][self._rows].reshape(-1, 3, 4)[:, :, 3].copy()

    @translations.setter
    def translations(self, value: ArrayLike) -> None:
        translations = self._checked(value, "translations", (3,))
        self._scene.data.arrays.set_translations(self._rows, translations)

    @property
    def rotations(self) -> NDArray[np.float64]:
        """Quaternions x, y, z, w, (N, 4) float64."""
        return self._part("rotation")

    @rotations.setter
    def rotations(self, value: ArrayLike) -> None:
        rotations = self._checked(value, "rotations", (4,))
        with np.errstate(over="ignore"):
            squares = (rotations * rotations).sum(axis=1)
        if not ((squares > 0.0) & (squares < np.inf)).all():
            raise InvalidArgumentError("rotations must not be zero quaternions, nor overflow")
        self._scene.data.arrays.set_many_parts(self._rows, rotations, None)

    @property
    def scales(self) -> NDArray[np.float64]:
        """Scale factors along the nodes' axes, (N, 3) float64; (N, 1) or a number works too."""
        return self._part("scale")

    @scales.setter
    def scales(self, value: ArrayLike) -> None:
        scales = self._checked(value, "scales", (3,))
        self._scene.data.arrays.set_many_parts(self._rows, None, scales)

    @property
    def visible(self) -> NDArray[np.bool_]:
        """The nodes' own visibility, (N,) bool."""
        return self._scene.data.arrays.columns["flags"][self._rows] & VISIBLE != 0

    @visible.setter
    def visible(self, value: ArrayLike) -> None:
        given = as_array(value, "visible")
        fits = given.shape in ((), (1,), (len(self),)) and given.dtype.kind in "biu"
        if not fits or not np.isin(given, (0, 1)).all():
            raise InvalidArgumentError(
                f"visible must be one bool or {len(self)}, not {shown(value)}"
            )
        on = np.ascontiguousarray(np.broadcast_to(given.astype(bool), len(self)))
        self._scene.data.arrays.set_flags(self._rows, VISIBLE, on.view(np.uint8))

    @property
    def world_poses(self) -> NDArray[np.float64]:
        """world-from-node, (N, 4, 4) float64."""
        self._scene.data.update()
        return self._scene.data.arrays.world_poses(self._rows)

    @property
    def bounds(self) -> NDArray[np.float64]:
        """The boxes of `Node.bounds`, (N, 2, 3) float64; NaN if a node has none."""
        self._scene.data.update()
        bounds = self._scene.data.arrays.columns["bounds"][self._rows, :6]
        bounds[bounds[:, 0] > bounds[:, 3]] = np.nan
        return bounds.reshape(-1, 2, 3)

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        raise TypeError("a NodeSelection belongs to its Scene: it cannot be copied or pickled")

    def __repr__(self) -> str:
        return f"NodeSelection({len(self)} nodes)"

    def _part(self, name: str) -> np.ndarray:
        self._scene.data.arrays.find_parts(self._rows)
        return self._scene.data.arrays.columns[name][self._rows]

    def _checked(self, value: ArrayLike, what: str, row: tuple[int, ...]) -> np.ndarray:
        shape = (len(self), *row)
        array = floats(value, what)
        try:
            array = np.ascontiguousarray(np.broadcast_to(array, shape))
        except ValueError:
            raise InvalidArgumentError(
                f"{what} must have shape {shape}, not {array.shape}"
            ) from None
        if not np.isfinite(array).all():
            raise InvalidArgumentError(f"{what} must be finite")
        return array
