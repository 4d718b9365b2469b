"""Open3D's control of the view: where the camera of a `Visualizer` stands, and what it shows.

In: Open3D's calls. Out: matrices of OpenGL's conventions. The formulas, their order and their
limits are those of Open3D's ViewControl.cpp and GLHelper.cpp.
"""

from __future__ import annotations

import json
import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...errors import InvalidArgumentError, warn
from ._loading import load
from ._vectors import Vector, cos, dot, number, sin, tan_half, turned, unit, vector

_TOLERANCE = 1e-6  # pixels, by which principal points may differ


class ViewControl:
    """Where the camera stands; `Visualizer.get_view_control` returns it."""

    FIELD_OF_VIEW_MAX, FIELD_OF_VIEW_MIN = 90.0, 5.0
    FIELD_OF_VIEW_DEFAULT, FIELD_OF_VIEW_STEP = 60.0, 5.0
    ZOOM_DEFAULT, ZOOM_MIN, ZOOM_MAX, ZOOM_STEP = 0.7, 0.02, 2.0, 0.02
    ROTATION_RADIAN_PER_PIXEL = 0.003

    def __init__(self) -> None:
        self._size = 0, 0
        self._constant_near = self._constant_far = -1.0
        self.reset_bounding_box()
        self.reset()

    def __repr__(self) -> str:
        return "ViewControl"

    # ---- what is in view ----

    def reset_bounding_box(self) -> None:
        """Forget what `fit_in` took."""
        self._box = load().geometry.AxisAlignedBoundingBox()

    def fit_in(self, geometry) -> None:
        """Enlarge the box by a geometry's, as ``AxisAlignedBoundingBox`` adds them."""
        if hasattr(geometry, "get_axis_aligned_bounding_box"):
            self._box += geometry.get_axis_aligned_bounding_box()
        self._place()

    @property
    def box(self):
        """The box of what is shown, ``open3d.geometry.AxisAlignedBoundingBox``."""
        return self._box

    def change_window_size(self, width: int, height: int) -> None:
        """Take the size of the picture, in pixels."""
        self._size = width, height
        self._place()

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the picture, in pixels."""
        return self._size

    def reset(self) -> None:
        """Look at the middle of the box from +Z."""
        self._field_of_view = self.FIELD_OF_VIEW_DEFAULT
        self._zoom = self.ZOOM_DEFAULT
        self._lookat = np.array(self._box.get_center())
        self._up = np.array([0.0, 1.0, 0.0])
        self._front = np.array([0.0, 0.0, 1.0])
        self._place()

    # ---- what programs set ----

    def set_lookat(self, lookat: ArrayLike) -> None:
        """Set the point in the middle of the picture, world space."""
        self._lookat = vector(lookat, "lookat")
        self._place()

    def set_up(self, up: ArrayLike) -> None:
        """Set the direction that is upwards in the picture."""
        self._up = vector(up, "up")
        self._place()

    def set_front(self, front: ArrayLike) -> None:
        """Set the direction from the point looked at towards the camera."""
        self._front = vector(front, "front")
        self._place()

    def set_zoom(self, zoom: float) -> None:
        """Set the height of the picture, as half of it over the box's longest side."""
        self._zoom = number(zoom, "zoom")
        self._place()

    def set_constant_z_near(self, z_near: float) -> None:
        """Fix the near plane's distance."""
        self._constant_near = number(z_near, "z_near")

    def set_constant_z_far(self, z_far: float) -> None:
        """Fix the far plane's distance."""
        self._constant_far = number(z_far, "z_far")

    def unset_constant_z_near(self) -> None:
        """Let the near plane follow the box again."""
        self._constant_near = -1.0

    def unset_constant_z_far(self) -> None:
        """Let the far plane follow the box again."""
        self._constant_far = -1.0

    def get_field_of_view(self) -> float:
        """Return the vertical field of view in degrees; 5 is a parallel projection."""
        return self._field_of_view

    def change_field_of_view(self, step: float = 0.45) -> None:
        """Widen the view by 5 degrees times ``step``, within 5 to 90 degrees."""
        wanted = self._field_of_view + number(step, "step") * self.FIELD_OF_VIEW_STEP
        self._field_of_view = max(min(wanted, self.FIELD_OF_VIEW_MAX), self.FIELD_OF_VIEW_MIN)
        self._place()

    def scale(self, scale: float) -> None:
        """Zoom out by steps, as the wheel does."""
        wanted = self._zoom + number(scale, "scale") * self.ZOOM_STEP
        self._zoom = max(min(wanted, self.ZOOM_MAX), self.ZOOM_MIN)
        self._place()

    def rotate(self, x: float, y: float, xo: float = 0.0, yo: float = 0.0) -> None:
        """Turn the view as a drag by (x, y) pixels does."""
        across = x * self.ROTATION_RADIAN_PER_PIXEL
        along = y * self.ROTATION_RADIAN_PER_PIXEL
        self._front = unit(self._front * cos(across) - self._right * sin(across))
        self._right = unit(linalg.cross(self._up, self._front))
        self._front = unit(self._front * cos(along) + self._up * sin(along))
        self._up = unit(linalg.cross(self._front, self._right))
        self._place()

    def translate(self, x: float, y: float, xo: float = 0.0, yo: float = 0.0) -> None:
        """Move the view as a drag by (x, y) pixels with Ctrl does."""
        pixel = self._view_ratio * 2.0 / max(self._size[1], 1)
        self._lookat = self._lookat + self._right * (-x * pixel) + self._up * (y * pixel)
        self._place()

    def roll(self, x: float) -> None:
        """Turn the picture as a drag by x pixels with Shift does."""
        turn = x * self.ROTATION_RADIAN_PER_PIXEL
        along = self._front * (dot(self._front, self._up) * (1.0 - cos(turn)))
        self._up = self._up * cos(turn) + linalg.cross(self._front, self._up) * sin(turn) + along
        self._place()

    def camera_local_translate(self, forward: float, right: float, up: float) -> None:
        """Move the camera by world units along its own axes."""
        self._lookat = (
            self._lookat
            - unit(self._front) * number(forward, "forward")
            + unit(self._right) * number(right, "right")
            + unit(self._up) * number(up, "up")
        )
        self._place()

    def camera_local_rotate(self, x: float, y: float, xo: float = 0.0, yo: float = 0.0) -> None:
        """Turn the camera about itself, as a drag by (x, y) pixels with Alt does."""
        per_unit = math.radians(100.0 / self._distance)
        pixel = self._view_ratio * 2.0 / max(self._size[1], 1)
        start = self._start
        start["up_turn"] += y * pixel
        start["right_turn"] += -x * pixel
        self._front = turned(
            start["front"],
            (start["right"], -per_unit * start["up_turn"]),
            (start["up"], per_unit * start["right_turn"]),
        )
        self._lookat = start["eye"] - self._front * self._distance
        self._up = start["up"]
        kept = dict(start)
        self._place()
        self._start = kept

    def reset_camera_local_rotate(self) -> None:
        """Begin new turns of the camera from where it is now."""
        self._start = {
            "up": self._up,
            "right": self._right,
            "eye": self._eye,
            "front": self._front,
            "up_turn": 0.0,
            "right_turn": 0.0,
        }

    def _place(self) -> None:
        """Put the camera where zoom and field of view have it."""
        with np.errstate(invalid="ignore"):  # of boxes that are not finite
            self._place_eye()
        self.reset_camera_local_rotate()

    def _place_eye(self) -> None:
        self._front = unit(self._front)
        self._right = unit(linalg.cross(self._up, self._front))
        angle = self.FIELD_OF_VIEW_STEP if self.is_orthogonal else self._field_of_view
        self._view_ratio = self._zoom * self._box.get_max_extent()
        self._distance = self._view_ratio / tan_half(angle)
        self._eye = self._lookat + self._front * self._distance

    # ---- cameras and files ----

    @property
    def is_orthogonal(self) -> bool:
        """Whether the projection is parallel."""
        return self._field_of_view == self.FIELD_OF_VIEW_MIN

    def convert_to_pinhole_camera_parameters(self):
        """Return the view as ``open3d.camera.PinholeCameraParameters``.

        Without a window, or with a parallel projection, there is none: a warning says so, and the
        parameters are Open3D's defaults.
        """
        camera = load().camera
        parameters = camera.PinholeCameraParameters()
        if self.is_orthogonal or min(self._size) <= 0:
            reason = "a parallel projection" if self.is_orthogonal else "no window"
            warn(f"{reason} has no pinhole camera parameters")
            return parameters
        self._place()
        width, height = self._size
        focus = height / tan_half(self._field_of_view) / 2.0
        parameters.intrinsic = camera.PinholeCameraIntrinsic(
            width, height, focus, focus, width / 2.0 - 0.5, height / 2.0 - 0.5
        )
        extrinsic = np.zeros((4, 4))
        rows = unit(self._right), -unit(self._up), -unit(self._front)
        for place, row in enumerate(rows):
            extrinsic[place, :3] = row
            extrinsic[place, 3] = -dot(row, self._eye)
        extrinsic[3, 3] = 1.0
        parameters.extrinsic = extrinsic
        return parameters

    def convert_from_pinhole_camera_parameters(
        self, parameter, allow_arbitrary: bool = False
    ) -> bool:
        """Take a view from ``PinholeCameraParameters``; return whether it could be taken.

        Parameters
        ----------
        parameter : open3d.camera.PinholeCameraParameters
            Of the focal lengths, the vertical one counts, and the principal point is the middle.
        allow_arbitrary : bool
            Whether the size may differ from the window's, and zoom and field of view exceed their
            limits.
        """
        intrinsic = np.asarray(parameter.intrinsic.intrinsic_matrix)
        extrinsic = np.asarray(parameter.extrinsic)
        width, height = self._size
        given = parameter.intrinsic.width, parameter.intrinsic.height
        if not allow_arbitrary and (
            given != self._size
            or abs(intrinsic[0, 2] - (width / 2.0 - 0.5)) > _TOLERANCE
            or abs(intrinsic[1, 2] - (height / 2.0 - 0.5)) > _TOLERANCE
        ):
            warn(
                f"the camera's size {given[0]}x{given[1]} or principal point is not that of the "
                f"window, {width}x{height}: allow_arbitrary=True takes it"
            )
            return False
        before, half = self._field_of_view, height / (intrinsic[1, 1] * 2.0)
        self._field_of_view = math.degrees(float(linalg.atan2(half, 1.0)) * 2.0)
        if not allow_arbitrary:
            most, least = self.FIELD_OF_VIEW_MAX, self.FIELD_OF_VIEW_MIN
            self._field_of_view = max(min(self._field_of_view, most), least)
            if self.is_orthogonal:
                self._field_of_view = before
                warn("the camera's field of view is below 5 degrees: allow_arbitrary=True takes it")
                return False
        self._right, self._up, self._front = extrinsic[0, :3], -extrinsic[1, :3], -extrinsic[2, :3]
        self._right, self._up, self._front = map(np.array, (self._right, self._up, self._front))
        self._eye = linalg.transform_points(linalg.inverse(extrinsic), np.zeros((1, 3)))[0]
        extent = self._box.get_max_extent()
        away = abs(dot(self._eye - np.array(self._box.get_center()), self._front))
        tan = tan_half(self._field_of_view)
        self._zoom = away * tan / extent if extent else self.ZOOM_DEFAULT
        if not allow_arbitrary:
            self._zoom = max(min(self._zoom, self.ZOOM_MAX), self.ZOOM_MIN)
        self._view_ratio = self._zoom * extent
        self._distance = self._view_ratio / tan
        self._lookat = self._eye - self._front * self._distance
        return True

    def status(self) -> str:
        """Return the view as the JSON of a trajectory of one view."""
        view = {
            "boundingbox_max": list(self._box.max_bound),
            "boundingbox_min": list(self._box.min_bound),
            "field_of_view": self._field_of_view,
            "front": self._front.tolist(),
            "lookat": self._lookat.tolist(),
            "up": self._up.tolist(),
            "zoom": self._zoom,
        }
        whole = {
            "class_name": "ViewTrajectory",
            "interval": 29,
            "is_loop": False,
            "trajectory": [view],
            "version_major": 1,
            "version_minor": 0,
        }
        return json.dumps(whole, indent="\t")

    def take_status(self, status: str) -> None:
        """Take the view of a JSON of `status`.

        Raises
        ------
        InvalidArgumentError
            It is none.
        """
        try:
            (view,) = json.loads(status)["trajectory"]
            box = load().geometry.AxisAlignedBoundingBox(
                view["boundingbox_min"], view["boundingbox_max"]
            )
            angle, zoom = float(view["field_of_view"]), float(view["zoom"])
            vectors = [vector(view[name], name) for name in ("lookat", "up", "front")]
        except (KeyError, TypeError, ValueError) as error:
            raise InvalidArgumentError(f"no view status of Open3D: {error}") from None
        self._box, self._field_of_view, self._zoom = box, angle, zoom
        self._lookat, self._up, self._front = vectors
        self._place()

    # ---- matrices ----

    @property
    def planes(self) -> tuple[float, float]:
        """Distances of the near and far planes."""
        extent = self._box.get_max_extent()
        near = self._distance - 3.0 * extent
        if not self.is_orthogonal:
            near = max(0.01 * extent, near)
        near = self._constant_near if self._constant_near > 0 else near
        far = self._constant_far if self._constant_far > 0 else self._distance + 3.0 * extent
        return near, far

    @property
    def projection(self) -> NDArray[np.float64]:
        """clip_from_view, (4, 4), rounded to float32 as Open3D's."""
        near, far = self.planes
        if not near < far:  # an empty box: nothing can be in view
            near, far = 0.01, 1.0
        aspect = self._size[0] / self._size[1]
        matrix = np.zeros((4, 4))
        if self.is_orthogonal:
            matrix[0, 0] = 1.0 / (aspect * self._view_ratio or 1.0)
            matrix[1, 1] = 1.0 / (self._view_ratio or 1.0)
            matrix[2, 2] = -2.0 / (far - near)
            matrix[2, 3] = -(far + near) / (far - near)
            matrix[3, 3] = 1.0
        else:
            tan = tan_half(self._field_of_view)
            matrix[0, 0], matrix[1, 1] = 1.0 / aspect / tan, 1.0 / tan
            matrix[2, 2] = -(far + near) / (far - near)
            matrix[2, 3] = -2.0 * far * near / (far - near)
            matrix[3, 2] = -1.0
        return matrix.astype(np.float32).astype(np.float64)

    @property
    def view(self) -> NDArray[np.float64]:
        """view_from_world, (4, 4), rounded to float32 as Open3D's."""
        front = unit(self._eye - self._lookat)
        right = unit(linalg.cross(unit(self._up), front))
        up = unit(linalg.cross(front, right))
        matrix = np.eye(4)
        for place, row in enumerate((right, up, front)):
            matrix[place, :3] = row
            matrix[place, 3] = -dot(row, self._eye)
        return matrix.astype(np.float32).astype(np.float64)

    @property
    def axes(self) -> tuple[Vector, Vector, Vector]:
        """Right, up and front, world space: what places the lights."""
        return self._right, self._up, self._front
