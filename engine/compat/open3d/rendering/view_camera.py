"""The camera of an offscreen scene, with Open3D's three kinds of projections.

In: Open3D's calls. Out: matrices of OpenGL's conventions, as float32. The formulas are those of
Open3D's FilamentCamera.cpp and Camera.cpp, and of Filament, which draws perspectives without a far
plane.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....base import linalg
from ....base.numbers import floats, shown
from ....errors import InvalidArgumentError
from .._loading import load

_own = load().visualization.rendering.Camera
_LEAST_FAR = 1.0
NEAR = 0.1  # of cameras that setup_camera makes


class Camera:
    """A camera that looks along its -Z; ``Open3DScene.camera`` is one."""

    FovType, Projection = _own.FovType, _own.Projection
    Vertical, Horizontal = _own.FovType.Vertical, _own.FovType.Horizontal
    Perspective, Ortho = _own.Projection.Perspective, _own.Projection.Ortho

    def __init__(self) -> None:
        self._model = np.eye(4)
        self.set_projection(90.0, 4.0 / 3.0, 0.01, 1000.0, self.Horizontal)

    # ---- projection ----

    def set_projection(self, *given, **named) -> None:
        """Set the projection, in one of three ways.

        - ``field_of_view`` (degrees), ``aspect_ratio``, ``near_plane``, ``far_plane``,
          ``field_of_view_type``
        - ``projection_type``, ``left``, ``right``, ``bottom``, ``top``, ``near``, ``far``: at the
          near plane
        - ``intrinsics`` (3, 3), ``near_plane``, ``far_plane``, ``image_width``, ``image_height``
        """
        first = given[0] if given else None
        if isinstance(first, self.Projection) or "projection_type" in named:
            self._by_sides(*given, **named)
        elif np.ndim(first) == 2 or "intrinsics" in named:
            self._by_intrinsics(*given, **named)
        else:
            self._by_angle(*given, **named)

    def _by_angle(
        self, field_of_view, aspect_ratio, near_plane, far_plane, field_of_view_type
    ) -> None:
        if not aspect_ratio > 0:
            return
        near = _plane(near_plane, "near_plane")
        half = float(linalg.tan(math.radians(float(field_of_view)) / 2.0)) * near
        if not half > 0:
            raise InvalidArgumentError(f"no field of view: {field_of_view!r} degrees")
        is_wide = field_of_view_type == self.Horizontal
        width, height = (half, half / aspect_ratio) if is_wide else (half * aspect_ratio, half)
        self._frustum(-width, width, -height, height, near)
        self._near, self._far = near, float(far_plane)
        self._angle, self._angle_type = float(field_of_view), field_of_view_type

    def _by_sides(self, projection_type, left, right, bottom, top, near, far) -> None:
        left, right, bottom, top = (float(side) for side in (left, right, bottom, top))
        near, far = float(near), float(far)
        if left == right or bottom == top or near == far:
            raise InvalidArgumentError("a frustum needs sides and planes that differ")
        if projection_type == self.Ortho:
            self._matrix = np.eye(4)
            self._matrix[0, 0], self._matrix[0, 3] = _ortho(left, right)
            self._matrix[1, 1], self._matrix[1, 3] = _ortho(bottom, top)
            self._matrix[2, 2] = -2.0 / (far - near)
            self._matrix[2, 3] = -(far + near) / (far - near)
        else:
            self._frustum(left, right, bottom, top, _plane(near, "near"))
        self._near, self._far = near, far
        self._angle, self._angle_type = 0.0, self.Vertical

    def _by_intrinsics(self, intrinsics, near_plane, far_plane, image_width, image_height) -> None:
        matrix = np.asarray(intrinsics, np.float64)
        width, height = float(image_width), float(image_height)
        near = _plane(near_plane, "near_plane")
        if matrix.shape != (3, 3) or not (matrix[0, 0] > 0 and matrix[1, 1] > 0):
            raise InvalidArgumentError("intrinsics must be (3, 3), with focal lengths above 0")
        self._matrix = np.zeros((4, 4))
        self._matrix[0, 0] = 2.0 * matrix[0, 0] / width
        self._matrix[1, 1] = 2.0 * matrix[1, 1] / height
        self._matrix[0, 2] = 1.0 - 2.0 * matrix[0, 2] / width
        self._matrix[1, 2] = -1.0 + 2.0 * matrix[1, 2] / height
        self._matrix[2, 2] = self._matrix[3, 2] = -1.0
        self._matrix[2, 3] = -2.0 * near
        self._near, self._far = near, float(far_plane)
        self._angle = 180.0 / 3.141592 * 2.0 * math.atan(0.5 * height / matrix[1, 1])
        self._angle_type = self.Vertical

    def _frustum(self, left: float, right: float, bottom: float, top: float, near: float) -> None:
        """Set a perspective without a far plane."""
        self._matrix = np.zeros((4, 4))
        self._matrix[0, 0] = 2.0 * near / (right - left)
        self._matrix[1, 1] = 2.0 * near / (top - bottom)
        self._matrix[0, 2] = (right + left) / (right - left)
        self._matrix[1, 2] = (top + bottom) / (top - bottom)
        self._matrix[2, 2] = self._matrix[3, 2] = -1.0
        self._matrix[2, 3] = -2.0 * near

    # ---- place ----

    def look_at(self, center: ArrayLike, eye: ArrayLike, up: ArrayLike) -> None:
        """Stand at ``eye`` and look at ``center``; world space."""
        target, place, upwards = (
            _three(value, name) for name, value in (("center", center), ("eye", eye), ("up", up))
        )
        forward = _unit(target - place, "center and eye are one point")
        upwards = _unit(upwards, "up is zero")
        if abs(_dot(forward, upwards)) > 0.999:
            upwards = upwards[[2, 0, 1]]
        right = _unit(np.asarray(linalg.cross(forward, upwards)), "up is along the view")
        self._model = np.eye(4)
        self._model[:3, 0] = right
        self._model[:3, 1] = linalg.cross(right, forward)
        self._model[:3, 2] = -forward
        self._model[:3, 3] = place

    def set_extrinsic(self, extrinsic: ArrayLike) -> None:
        """Stand where a camera does that looks along +Z with +Y down: ``extrinsic`` is (4, 4)."""
        matrix = np.asarray(extrinsic, np.float64)
        if matrix.shape != (4, 4):
            raise InvalidArgumentError(f"extrinsic must be (4, 4), not {matrix.shape}")
        self._model = linalg.inverse(matrix) * np.array([1.0, -1.0, -1.0, 1.0])

    def far_plane(self, box) -> float:
        """Return the far plane that shows all of a box and the origin, as Open3D chooses it."""
        place = self._model[:3, 3]
        away = np.asarray(box.get_center()) - place
        extent = np.asarray(box.get_extent())
        farthest = max(math.sqrt(_dot(away, away)) * 2.5, math.sqrt(_dot(place, place)))
        return max(_LEAST_FAR, farthest + 4.0 * math.sqrt(_dot(extent, extent)))

    def copy_from(self, camera: Camera) -> None:
        """Take everything of another camera."""
        vars(self).update(vars(camera))

    # ---- what programs read ----

    def get_near(self) -> float:
        """Return the distance of the near plane."""
        return self._near

    def get_far(self) -> float:
        """Return the distance of the far plane, which perspectives don't draw by."""
        return self._far

    def get_field_of_view(self) -> float:
        """Return the field of view in degrees; 0 of a projection by its sides."""
        return self._angle

    def get_field_of_view_type(self):
        """Return whether the field of view is horizontal or vertical."""
        return self._angle_type

    def get_projection_matrix(self) -> NDArray[np.float32]:
        """Return clip_from_view, (4, 4)."""
        return self._matrix.astype(np.float32)

    def get_view_matrix(self) -> NDArray[np.float32]:
        """Return view_from_world, (4, 4)."""
        return linalg.inverse(self._model).astype(np.float32)

    def get_model_matrix(self) -> NDArray[np.float32]:
        """Return world_from_view, (4, 4)."""
        return self._model.astype(np.float32)

    def unproject(self, x, y, z, view_width, view_height) -> NDArray[np.float32]:
        """Return the world point, (3,), at a pixel from the top left and a depth from 0 to 1."""
        clip = [
            2.0 * float(x) / float(view_width) - 1.0,
            2.0 * (float(view_height) - float(y)) / float(view_height) - 1.0,
            2.0 * float(z) - 1.0,
        ]
        inverse = linalg.inverse(linalg.multiply(self._matrix, linalg.inverse(self._model)))
        return linalg.transform_points(inverse, np.array([clip]))[0].astype(np.float32)

    @property
    def is_parallel(self) -> bool:
        """Whether the projection is orthographic."""
        return self._matrix[3, 3] == 1.0

    @property
    def pose(self) -> NDArray[np.float64]:
        """world_from_view, (4, 4), rounded to float32."""
        return self._model.astype(np.float32).astype(np.float64)

    @property
    def reversed_depth(self) -> NDArray[np.float64]:
        """clip_from_view, (4, 4), whose depth is -1 at the near plane and 0 far away (R142).

        So float32 tells apart depths at any distance. A parallel projection is as it is.
        """
        matrix = self._matrix.copy()
        if not self.is_parallel:
            matrix[2] = 0.0, 0.0, 0.0, -self._near
        return matrix

    def up_to(self, far: float) -> NDArray[np.float64]:
        """Return clip_from_view, (4, 4), of a perspective that ends at a distance.

        Shadow maps need one. A parallel projection is as it is.
        """
        matrix, near = self._matrix.copy(), self._near
        if not self.is_parallel:
            far = max(far, 1.001 * near)
            matrix[2, 2] = -(far + near) / (far - near)
            matrix[2, 3] = -2.0 * far * near / (far - near)
        return matrix


def _ortho(low: float, high: float) -> tuple[float, float]:
    return 2.0 / (high - low), -(high + low) / (high - low)


def _plane(value, what: str) -> float:
    near = float(value)
    if not 0 < near < math.inf:
        raise InvalidArgumentError(f"{what} must be greater than 0, not {value!r}")
    return near


def _dot(a, b) -> float:
    return float((a[0] * b[0] + a[1] * b[1]) + a[2] * b[2])


def _three(value: ArrayLike, name: str) -> NDArray[np.float64]:
    """Return the numbers of a point or a direction, rounded to float32 as Open3D does."""
    given = floats(value, name)
    if given.size != 3 or not np.isfinite(given).all():
        raise InvalidArgumentError(
            f"look_at: {name} must be three finite numbers, not {shown(value)}"
        )
    return given.astype(np.float32).astype(np.float64).reshape(3)


def _unit(vector, fault: str):
    length = math.sqrt(_dot(vector, vector))
    if not 0 < length < math.inf:
        raise InvalidArgumentError(f"look_at: {fault}")
    return vector / length
