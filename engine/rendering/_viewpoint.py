"""The viewpoint of a renderer: the chosen camera, or one that shows the whole scene.

In: a scene, a choice of camera and the image's size. Out: a `View`; the previous one if nothing has
changed.
"""

from __future__ import annotations

import numpy as np

from ..errors import InvalidArgumentError
from ..model.scene.cameras import Camera
from ..model.scene.lenses.lens_camera import LensCamera
from ..model.scene.staged_scene import AnyScene
from ._lens_view import view_of
from ._view import View
from .camera_choice import CameraChoice, find_camera
from .draw_list.draw_list import DrawList
from .framing import frame_scene


class Viewpoint:
    """The view of one renderer.

    Parameters
    ----------
    draw_list : DrawList
        The renderer's draw list, which knows whether the scene has changed.
    """

    def __init__(self, draw_list: DrawList) -> None:
        self._draw_list = draw_list
        self._view: View | None = None
        self._framing: tuple[Camera, np.ndarray] | None = None
        self._framed: tuple[int, int, int] | None = None

    def look(self, scene: AnyScene, camera: CameraChoice, width: int, height: int) -> View:
        """Return the view of the chosen camera; an unchanged view is reused."""
        chosen, pose = find_camera(scene, camera) or self._frame_scene(scene, width, height)
        view = self._view
        if view is None or not view.is_of(chosen, pose, width, height):
            view = self._view = view_of(chosen, pose, width, height, view)
        return view

    def _frame_scene(self, scene: AnyScene, width: int, height: int) -> tuple[Camera, np.ndarray]:
        """Return a camera that shows the whole scene, kept until something changes or moves."""
        state = self._draw_list.changes, width, height
        if self._framing is None or self._framed != state or not self._draw_list.shows(scene.data):
            aspect = width / height
            # frame_scene refuses staged scenes, but these always come with a camera.
            self._framing = frame_scene(scene, aspect=aspect)  # type: ignore[arg-type]
            self._framed = state
        return self._framing


def frustum_of(scene: AnyScene, camera: CameraChoice, width: int, height: int) -> np.ndarray | None:
    """Return clip_from_world of a camera to cull by; None for no camera."""
    if camera is None:
        return None
    chosen, pose = find_camera(scene, camera)
    if isinstance(chosen, LensCamera):
        raise InvalidArgumentError("culling_camera must have a frustum, which no lens camera has")
    return View(chosen, pose, width, height).clip_from_world
