"""Open3D's `OffscreenRenderer`, drawn by this engine."""

from __future__ import annotations

import math

import numpy as np

from ....base.image_size import check_size
from .._loading import load
from ._offscreen_pictures import Drawer
from .open3d_scene import Open3DScene
from .view_camera import NEAR


class OffscreenRenderer:
    """Renders a scene into images.

    Any number of them may live side by side.

    Parameters
    ----------
    width, height : int
        Pixels.
    resource_path : str
        Where environments are; by default those of the package open3d.
    headless : bool
        Taken and ignored: older versions of Open3D have it.
    """

    def __init__(
        self, width: int, height: int, resource_path: str = "", headless: bool = True
    ) -> None:
        self._size = check_size((width, height))
        self._scene = Open3DScene(resource_path=str(resource_path))
        self._drawer = Drawer()

    @property
    def scene(self) -> Open3DScene:
        """The scene."""
        return self._scene

    def setup_camera(self, *given, **named) -> None:
        """Place the camera, in one of three ways; the box of the scene decides what is far.

        - ``vertical_field_of_view`` (degrees), ``center``, ``eye``, ``up``, ``near_clip``,
          ``far_clip``
        - ``intrinsics`` (PinholeCameraIntrinsic), ``extrinsic_matrix`` (4, 4)
        - ``intrinsic_matrix`` (3, 3), ``extrinsic_matrix``, ``intrinsic_width_px``,
          ``intrinsic_height_px``
        """
        first = given[0] if given else None
        if "intrinsics" in named or hasattr(first, "intrinsic_matrix"):
            self._as_pinhole(*given, **named)
        elif "intrinsic_matrix" in named or np.ndim(first) == 2:
            self._as_matrices(*given, **named)
        else:
            self._as_view(*given, **named)

    def _as_view(
        self, vertical_field_of_view, center, eye, up, near_clip=-1.0, far_clip=-1.0
    ) -> None:
        camera = self._scene.camera
        far = far_clip if far_clip > 0 else camera.far_plane(self._scene.bounding_box)
        near = near_clip if near_clip > 0 else NEAR
        aspect = self._size[0] / self._size[1]
        camera.set_projection(vertical_field_of_view, aspect, near, far, camera.Vertical)
        camera.look_at(center, eye, up)

    def _as_pinhole(self, intrinsics, extrinsic_matrix) -> None:
        matrix = intrinsics.intrinsic_matrix
        self._as_matrices(matrix, extrinsic_matrix, intrinsics.width, intrinsics.height)

    def _as_matrices(
        self, intrinsic_matrix, extrinsic_matrix, intrinsic_width_px, intrinsic_height_px
    ) -> None:
        camera = self._scene.camera
        camera.set_extrinsic(extrinsic_matrix)
        far = camera.far_plane(self._scene.bounding_box)
        camera.set_projection(intrinsic_matrix, NEAR, far, intrinsic_width_px, intrinsic_height_px)

    def render_to_image(self):
        """Return the picture, ``open3d.geometry.Image``: (H, W, 3) uint8."""
        return _image(self._drawer.color(self._scene, self._size))

    def render_to_depth_image(self, z_in_view_space: bool = False):
        """Return depths, ``open3d.geometry.Image``: (H, W) float32.

        Parameters
        ----------
        z_in_view_space : bool
            False: from 0 at the near plane to 1, which is the background. True: distances along the
            view axis, infinite where nothing is. A parallel projection has Open3D's numbers, which
            are no distances.
        """
        depth = self._drawer.depth(self._scene, self._size)
        if z_in_view_space:
            near = np.float32(self._scene.camera.get_near())
            with np.errstate(divide="ignore"):
                return _image(np.where(depth > 0, near / depth, np.float32(math.inf)))
        return _image(np.float32(1.0) - depth)


def _image(array: np.ndarray):
    return load().geometry.Image(np.ascontiguousarray(array))
