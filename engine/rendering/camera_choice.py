"""Finds the camera to draw with, and its pose.

In: a scene and a choice of camera. Out: the camera and its pose, unless all of the scene must show.
"""

from __future__ import annotations

from typing import TypeAlias, cast, overload

import numpy as np
from numpy.typing import ArrayLike

from ..base.numbers import shown
from ..base.validation import matrix4
from ..errors import InvalidArgumentError
from ..model.scene.cameras import Camera
from ..model.scene.nodes import Node
from ..model.scene.staged_scene import AnyScene

#: A choice of camera: None for the scene's own, a node that holds one, or a camera and its pose.
CameraChoice: TypeAlias = Node | tuple[Camera, ArrayLike] | None


@overload
def find_camera(scene: AnyScene, camera: None) -> tuple[Camera, np.ndarray] | None: ...


@overload
def find_camera(
    scene: AnyScene, camera: Node | tuple[Camera, ArrayLike]
) -> tuple[Camera, np.ndarray]: ...


def find_camera(scene: AnyScene, camera: CameraChoice) -> tuple[Camera, np.ndarray] | None:
    """Return the camera to draw with, and its pose.

    Parameters
    ----------
    scene : Scene
    camera : None, Node or (Camera, pose)
        None is the scene's first visible camera; a node is one of this scene.

    Returns
    -------
    camera, pose : Camera, (4, 4) float64
        None if the scene must be framed automatically.

    Raises
    ------
    InvalidArgumentError
    """
    if camera is None:
        node = scene.data.camera_node()
        return None if node is None else (cast("Camera", node.object), node.world_pose)
    if isinstance(camera, Node):
        if not isinstance(camera.object, Camera):
            raise InvalidArgumentError(
                f"camera must be a node that holds a camera, not {shown(camera)}"
            )
        if camera.scene is not scene:
            raise InvalidArgumentError(
                f"{camera!r} is not a node of this scene: give (node.object, node.world_pose)"
            )
        return camera.object, camera.world_pose
    if isinstance(camera, Camera):
        raise InvalidArgumentError(
            "camera must be a node or a pair (camera, pose): a camera alone has no place"
        )
    try:
        what, pose = camera
    except (TypeError, ValueError):
        what = None
    if not isinstance(what, Camera):
        raise InvalidArgumentError(
            "camera, or culling_camera, must be None, a node or a pair (camera, pose), "
            f"not {shown(camera)}"
        )
    return what, matrix4(pose, "camera pose")
