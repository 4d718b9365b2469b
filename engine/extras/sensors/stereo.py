"""Stereo pairs: a left and a right camera side by side, and the disparity between their pictures.

In: a pinhole camera, a baseline, the left camera's pose. Out: two frames of rectified cameras (they
look the same way, and the baseline is along their rows), and disparities with masks: exact, from
depth (R185) and from the identities of both pictures (R184).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...base.calls import checks_types
from ...base.numbers import floats
from ...base.validation import CheckedAttribute, Closed, NumberAttribute, matrix4, positive
from ...errors import InvalidArgumentError
from ...model.scene.cameras import Camera
from ...model.scene.lenses.lens_camera import LensCamera
from ...model.scene.scene import Scene
from ...rendering.frame import Frame
from ...rendering.options import OptionKeywords, RenderOptions, checked_options
from ...rendering.renderer import Renderer
from .moments import Moment

if TYPE_CHECKING:
    from typing_extensions import Unpack


@dataclass(frozen=True)
class StereoPair:
    """The pictures of a stereo camera.

    Attributes
    ----------
    left, right : Frame
    left_disparity, right_disparity : (H, W) float32
        Pixels, for the pixels of the left and of the right picture, positive: what the left picture
        shows at (x, y) is at ``(x - left_disparity, y)`` of the right one, and what the right one
        shows at (x, y) is at ``(x + right_disparity, y)`` of the left one. 0 = background.
    left_visible, right_visible : (H, W) bool
        Where the other picture shows the same point.
    """

    left: Frame
    right: Frame
    left_disparity: NDArray[np.float32]
    right_disparity: NDArray[np.float32]
    left_visible: NDArray[np.bool_]
    right_visible: NDArray[np.bool_]


def _camera(value: Camera, what: str) -> Camera:
    if not isinstance(value, Camera):
        raise InvalidArgumentError(f"{what} must be a Camera, not {type(value).__name__}")
    if isinstance(value, LensCamera):
        raise InvalidArgumentError(
            f"{what} must be a pinhole camera, whose pair is rectified, not {type(value).__name__}"
        )
    return value


class StereoCamera(Closed):
    """Two equal cameras side by side: rectified, as stereo methods expect them.

    Parameters
    ----------
    camera : Camera
        Of both; a pinhole camera.
    baseline : float
        Distance of the right camera from the left one, along its +X, in world units.

    Raises
    ------
    InvalidArgumentError
    """

    camera: CheckedAttribute[Camera, Camera] = CheckedAttribute(_camera)
    baseline: NumberAttribute = CheckedAttribute(positive)

    @checks_types
    def __init__(self, camera: Camera, baseline: float) -> None:
        self.camera = camera
        self.baseline = baseline

    @checks_types
    def right_pose(self, pose: ArrayLike) -> NDArray[np.float64]:
        """Return the right camera's pose, world-from-camera, for one of the left camera.

        Raises
        ------
        InvalidArgumentError
            The pose is scaled along X, so that the baseline would be another one.
        """
        left = matrix4(pose, "pose")
        if abs(float(linalg.length(left[:3, 0])) - 1.0) > 1e-6:
            raise InvalidArgumentError("the pose of a stereo camera must not be scaled")
        return linalg.multiply(left, linalg.translation((self.baseline, 0.0, 0.0)))

    @checks_types
    def disparity(self, depth: ArrayLike, size: tuple[int, int]) -> NDArray[np.float32]:
        """Return the disparity of depths: focal length in pixels times baseline over depth.

        Parameters
        ----------
        depth : array of float
            As of ``frame.depth``, of either camera; 0 gives 0.
        size : (int, int)
            Width and height of the pictures.

        Returns
        -------
        array of float32
            Pixels.

        Raises
        ------
        InvalidArgumentError
            The camera has no perspective.
        """
        depths = floats(depth, "depth")
        focal = self._focal_length(size)
        with np.errstate(divide="ignore", invalid="ignore"):
            pixels = np.where(depths > 0.0, focal * self.baseline / depths, 0.0)
        return pixels.astype(np.float32)

    @checks_types
    def render(
        self,
        renderer: Renderer,
        scene: Scene,
        pose: ArrayLike,
        *,
        options: RenderOptions | None = None,
        **keywords: Unpack[OptionKeywords],
    ) -> StereoPair:
        """Draw both pictures.

        Parameters
        ----------
        renderer : Renderer
        scene : Scene
        pose : (4, 4) float
            World-from-camera of the left camera.
        options, **keywords
            As of `Renderer.render`. The frames hold the outputs that they name and, besides, depth
            and those of `Moment.OUTPUTS`.

        Returns
        -------
        StereoPair

        Raises
        ------
        InvalidArgumentError, OutOfMemoryError
        """
        chosen = checked_options(options, keywords)
        outputs = tuple(dict.fromkeys((*chosen.outputs, "depth", *Moment.OUTPUTS)))
        given: Any = {**vars(chosen), "outputs": outputs}
        self._focal_length(renderer.size)
        poses = matrix4(pose, "pose"), self.right_pose(pose)
        moments = []
        for one in poses:
            frame = renderer.render(scene, (self.camera, one), options=RenderOptions(**given))
            moments.append(Moment(frame, scene))
        return stereo_pair(self, *moments)

    def _focal_length(self, size: tuple[int, int]) -> float:
        """Return the focal length in pixels, across."""
        matrix = np.asarray(self.camera.projection(size), np.float64)
        scale = -float(matrix[3, 2])
        if scale <= 0.0 or matrix[3, [0, 1, 3]].any() or matrix[0, [1, 3]].any():
            raise InvalidArgumentError(
                "a stereo camera is a pinhole camera: only with perspective, and without "
                "skew, disparity is focal length times baseline over depth"
            )
        return float(matrix[0, 0]) / scale * (0.5 * size[0])

    def __repr__(self) -> str:
        return f"StereoCamera({self.camera!r}, {self.baseline:g})"


def stereo_pair(stereo: StereoCamera, left: Moment, right: Moment) -> StereoPair:
    """Return the pair of two moments that differ only in the camera."""
    size = left.frame.size
    return StereoPair(
        left.frame,
        right.frame,
        stereo.disparity(left.frame.depth, size),
        stereo.disparity(right.frame.depth, size),
        left.flow_to(right).visible,
        right.flow_to(left).visible,
    )
