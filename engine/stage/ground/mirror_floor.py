"""The floor of the studio that reflects the model.

In: the model's bounds and its lowest place. Out: a node beside the scene: a square that shows, over
the background, a share of what a mirror would, and less of it the farther away it is.
"""

from __future__ import annotations

import functools

import numpy as np

from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from ...model.scene.nodes import Node
from ...model.scene.staged_scene import StagedScene

#: Half a side, in radii of the model; at this distance nothing is reflected any more.
_REACH = 3.0
#: The share of a mirror under the model.
_SHARE = 0.4
_SIDE = 64  # texels
#: How far below the model the floor lies, in radii, so that no face of the model lies in it.
_BELOW = 1 / 1000


class MirrorFloor:
    """A floor under a model; hidden until it is laid.

    Parameters
    ----------
    staged : StagedScene
        The floor is added beside it.
    """

    def __init__(self, staged: StagedScene) -> None:
        self._node: Node = staged.beside.add(_square(), name="floor", cast_shadows=False)
        self._node.receive_shadows = self._node.visible = False

    def lay(self, middle: np.ndarray, turn: np.ndarray, radius: float) -> None:
        """Lay the floor under a model.

        Parameters
        ----------
        middle : (3,) ndarray of float64
            Where the floor is nearest to the model's centre, in world space.
        turn : (3, 3) ndarray of float64
            Right, up and back, as columns.
        radius : float
            Of the model.
        """
        pose = np.eye(4)
        pose[:3, :3] = turn * radius
        pose[:3, 3] = middle - turn[:, 1] * (_BELOW * radius)
        if not np.array_equal(self._node.pose, pose):
            self._node.pose = pose
        self._node.visible = True

    def hide(self) -> None:
        """Hide the floor until it is laid again."""
        self._node.visible = False


def _square() -> Mesh:
    """Return the floor around its node's origin, in radii."""
    corners = [(-1, 1), (1, 1), (1, -1), (-1, -1)]
    return Mesh(
        [(_REACH * x, 0.0, _REACH * z) for x, z in corners],
        [(0, 1, 2), (0, 2, 3)],
        uvs=[(0, 0), (1, 0), (1, 1), (0, 1)],
        materials=[Material(alpha_mode="blend", mirror=1.0, texture=_fading())],
        name="floor",
    )


@functools.cache
def _fading() -> Texture:
    """Return white whose alpha is the share of a mirror, in the middle and away from it."""
    places = (np.arange(_SIDE) + 0.5) / _SIDE * 2.0 - 1.0
    inside = np.maximum(1.0 - (places**2 + places[:, np.newaxis] ** 2), 0.0)
    pixels = np.full((_SIDE, _SIDE, 4), 255, np.uint8)
    pixels[..., 3] = np.rint(255.0 * _SHARE * inside**2)
    return Texture(pixels, filter="bilinear", wrap="clamp")
