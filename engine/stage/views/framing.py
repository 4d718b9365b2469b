"""Cameras that show all of a thing, whatever can be drawn.

In: what `render` takes, or a box. Out: a camera and its pose, as `engine3d.rendering.framing`
computes them.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...base.calls import hinted
from ...errors import InvalidArgumentError
from ...model.scene.cameras import PerspectiveCamera
from ...model.scene.orbiting import home_axes
from ...model.scene.scene import Scene
from ...rendering import framing
from ..near_origin import pose_in_file
from ..viewed_scene import ViewedScene
from ..viewed_thing import viewed_of
from .viewpoint import UP_DIRECTIONS


@hinted
def frame_bounds(
    bounds: Any,
    *,
    aspect: float = 1.0,
    yfov: float | None = None,
    direction: ArrayLike | None = None,
    up: ArrayLike | None = None,
    margin: float = 1.05,
) -> tuple[PerspectiveCamera, NDArray[np.float64]]:
    """Return a camera and its pose that show a whole box, as large as possible.

    Parameters
    ----------
    bounds : (2, 3) float, or path-like, Scene, Node, Mesh, InstancedMesh, or what trimesh holds
        Smallest and largest corner in world space, such as ``mesh.bounds`` or ``scene.bounds``; or
        what lies in the box.
    aspect : float
        Width over height of the image.
    yfov : float, optional
        Vertical field of view in radians; by default the longer side has 38 degrees.
    direction : (3,) float, optional
        The view direction; by default from the front, slightly from the right and above.
    up : (3,) float, optional
        The direction that points up in the image; by default +Y, or that of a file.
    margin : float
        Factor on the visible extent; 1 is a tight fit.

    Returns
    -------
    camera : PerspectiveCamera
        Its near and far planes enclose the box tightly, which keeps depth precise.
    pose : (4, 4) float64
        world-from-camera.

    Raises
    ------
    InvalidArgumentError, FileFormatError, FileAccessError
    """
    viewed = None if isinstance(bounds, (np.ndarray, list, tuple)) else viewed_of(bounds)
    box = bounds if viewed is None else viewed.scene.bounds
    direction, up = _directions(viewed, direction, up)
    camera, pose = framing.frame_bounds(
        box, aspect=aspect, yfov=yfov, direction=direction, up=up, margin=margin
    )
    return camera, pose if viewed is None else pose_in_file(viewed, pose)


@hinted
def frame_scene(
    scene: Any,
    *,
    aspect: float = 1.0,
    yfov: float | None = None,
    direction: ArrayLike | None = None,
    up: ArrayLike | None = None,
    margin: float = 1.05,
) -> tuple[PerspectiveCamera, NDArray[np.float64]]:
    """Return a camera and its pose that show a whole scene, as large as possible.

    It fits the vertices of visible objects, so round models fill the picture better than their
    bounding boxes would. Scenes with light of their own and no camera are drawn with this one.

    Parameters
    ----------
    scene : path-like, Scene, Node, Mesh, InstancedMesh, (N, 3) ndarray, or what trimesh holds
    aspect, yfov, direction, up, margin
        As for `frame_bounds`.

    Returns
    -------
    camera : PerspectiveCamera
    pose : (4, 4) float64
        world-from-camera.

    Raises
    ------
    InvalidArgumentError, FileFormatError, FileAccessError
    """
    viewed = None if isinstance(scene, Scene) else viewed_of(scene)
    if viewed is None and not isinstance(scene, Scene):
        raise InvalidArgumentError(
            f"scene must be a path, a scene, a node, a mesh or points, not {type(scene).__name__}"
        )
    direction, up = _directions(viewed, direction, up)
    drawn = scene if viewed is None else viewed.scene
    camera, pose = framing.frame_scene(
        drawn, aspect=aspect, yfov=yfov, direction=direction, up=up, margin=margin
    )
    return camera, pose if viewed is None else pose_in_file(viewed, pose)


def _directions(
    viewed: ViewedScene | None, direction: ArrayLike | None, up: ArrayLike | None
) -> tuple[ArrayLike, ArrayLike]:
    """Return a view direction and an up direction; the defaults are relative to a file's axes."""
    if viewed is None or viewed.up == "+Y":
        usual: ArrayLike = framing.DIRECTION
        upward: ArrayLike = framing.UP
    else:
        upward = UP_DIRECTIONS[viewed.up]
        usual = linalg.dot(home_axes(upward).T, framing.DIRECTION)
    return usual if direction is None else direction, upward if up is None else up
