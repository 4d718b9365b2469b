"""Skins: the nodes whose poses deform a mesh.

In: nodes as joints, and the mesh's rest pose relative to them. Out: the same, checked and
read-only.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NoReturn, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import frozen
from ...base.numbers import floats
from ...base.validation import Closed, text
from ...errors import InvalidArgumentError
from ..scene.nodes import Node


class Skin(Closed):
    """Joints for the vertices of meshes; assign it to ``node.skin``.

    A vertex's world position is the sum over its joints of ``weight * joint.world_pose @
    inverse_bind @ position``. The pose of the mesh's own node has no effect, as in glTF.

    Parameters
    ----------
    joints : iterable of Node
        Nodes of one scene; ``mesh.joints`` holds indices into this list.
    inverse_binds : (J, 4, 4) float, optional
        joint-from-mesh at rest, affine. By default, the joints' current world poses are the rest
        pose.
    name : str

    Raises
    ------
    InvalidArgumentError
        There are no joints, they are not nodes of one scene, or a matrix is not affine and finite.
    """

    def __init__(
        self, joints: Iterable[Node], inverse_binds: ArrayLike | None = None, name: str = ""
    ) -> None:
        self._joints = _check_joints(joints)
        if inverse_binds is None:
            from ...base import linalg

            poses = np.array([joint.world_pose for joint in self._joints])
            inverse_binds = linalg.inverse(poses)
        self._inverse_binds = _check_binds(inverse_binds, len(self._joints))
        self._name = text(name, "name")

    @property
    def joints(self) -> tuple[Node, ...]:
        return self._joints

    @property
    def inverse_binds(self) -> NDArray[np.float64]:
        """(J, 4, 4) float64, read-only."""
        return self._inverse_binds

    @property
    def name(self) -> str:
        return self._name

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        raise TypeError("a Skin belongs to the Scene of its joints: it cannot be copied or pickled")

    def __repr__(self) -> str:
        return f"Skin({len(self._joints)} joints, name={self._name!r})"


def _check_joints(value: Iterable[Node]) -> tuple[Node, ...]:
    if not isinstance(value, Iterable):
        raise InvalidArgumentError(f"joints must be several Node, not {value!r}")
    joints = tuple(value)
    if not joints:
        raise InvalidArgumentError("a skin needs a joint")
    for number, joint in enumerate(joints):
        if not isinstance(joint, Node) or joint.scene is None:
            raise InvalidArgumentError(f"joint {number} is no node of a scene: {joint!r}")
        if joint.scene is not joints[0].scene:
            raise InvalidArgumentError(f"joint {number} is a node of another scene: {joint!r}")
    return joints


def _check_binds(value: ArrayLike, count: int) -> np.ndarray:
    binds = floats(value, "inverse_binds")
    if binds.shape != (count, 4, 4):
        raise InvalidArgumentError(f"inverse_binds must be ({count}, 4, 4), not {binds.shape}")
    if not np.isfinite(binds).all():
        raise InvalidArgumentError("inverse_binds must be finite")
    if not (binds[:, 3] == (0.0, 0.0, 0.0, 1.0)).all():
        raise InvalidArgumentError("inverse_binds must be affine: the last row of each is 0 0 0 1")
    return frozen(binds)
