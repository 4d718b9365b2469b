"""Cameras: matrices from node space to OpenGL's clip space."""

from __future__ import annotations

import abc
import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ._held import Named, held, number_unless, optional
from .constants import DEFAULT_Z_FAR, DEFAULT_Z_NEAR


class Camera(Named, abc.ABC):
    """A camera that looks along the -Z of its node, +Y up. Programs can subclass it.

    Parameters
    ----------
    znear, zfar : float
        Distances of the near and far planes.
    name : str, optional
    """

    def __init__(self, znear=DEFAULT_Z_NEAR, zfar=DEFAULT_Z_FAR, name=None):
        self.name = name
        self.znear = znear
        self.zfar = zfar

    _near = number_unless(lambda near: near < 0, "z-near must be >= 0.0")
    znear = held("znear", _near, "Distance of the near plane.")

    @property
    def zfar(self) -> float | None:
        """Distance of the far plane."""
        return self._zfar

    @zfar.setter
    def zfar(self, value) -> None:
        self._zfar = self._checked_far(float(value))

    def _checked_far(self, number: float) -> float:
        if number <= 0 or number <= self.znear:
            raise ValueError("zfar must be >0 and >znear")
        return number

    @abc.abstractmethod
    def get_projection_matrix(self, width=None, height=None) -> NDArray[np.float64]:
        """Return clip-from-camera for a picture of some size, (4, 4)."""

    def _depth_rows(self, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
        """Fill in the depth rows of a perspective projection."""
        near, far = self.znear, self.zfar
        matrix[3, 2] = -1.0
        if far is None:
            matrix[2, 2:] = -1.0, -2.0 * near
        else:
            matrix[2, 2:] = (far + near) / (near - far), 2.0 * far * near / (near - far)
        return matrix


def _positive(what: str) -> Callable[[object], float]:
    return number_unless(lambda number: number <= 0.0, f"{what} must be positive")


class PerspectiveCamera(Camera):
    """A camera with a field of view.

    Parameters
    ----------
    yfov : float
        Vertical field of view in radians.
    znear : float
    zfar : float, optional
        None: there is no far plane.
    aspectRatio : float, optional
        Width over height. Where it isn't the picture's own, the picture is stretched.
    name : str, optional
    """

    def __init__(self, yfov, znear=DEFAULT_Z_NEAR, zfar=None, aspectRatio=None, name=None):
        super().__init__(znear=znear, zfar=zfar, name=name)
        self.yfov = yfov
        self.aspectRatio = aspectRatio

    yfov = held("yfov", _positive("Field of view"), "Vertical field of view in radians.")

    @property
    def zfar(self) -> float | None:
        """Distance of the far plane; None for none."""
        return self._zfar

    @zfar.setter
    def zfar(self, value) -> None:
        self._zfar = None if value is None else self._checked_far(float(value))

    _aspect = optional(_positive("Aspect ratio"))
    aspectRatio = held("aspectRatio", _aspect, "Width over height, or None for the picture's own.")

    def get_projection_matrix(self, width=None, height=None) -> NDArray[np.float64]:
        aspect = self.aspectRatio
        if aspect is None:
            if width is None or height is None:
                raise ValueError("Aspect ratio of camera must be defined")
            aspect = float(width) / float(height)
        slope = math.tan(self.yfov / 2.0)
        matrix = np.zeros((4, 4))
        matrix[0, 0], matrix[1, 1] = 1.0 / (aspect * slope), 1.0 / slope
        return self._depth_rows(matrix)


class OrthographicCamera(Camera):
    """A camera without perspective.

    Parameters
    ----------
    xmag, ymag : float
        Half the width and height of what is seen. In a picture, the width follows from ``ymag`` and
        the picture's aspect.
    znear, zfar : float
    name : str, optional
    """

    def __init__(self, xmag, ymag, znear=DEFAULT_Z_NEAR, zfar=DEFAULT_Z_FAR, name=None):
        super().__init__(znear=znear, zfar=zfar, name=name)
        self.xmag = xmag
        self.ymag = ymag

    xmag = held("xmag", _positive("X magnification"), "Half the width.")
    ymag = held("ymag", _positive("Y magnification"), "Half the height.")
    _near = number_unless(lambda near: near <= 0, "z-near must be > 0.0")
    znear = held("znear", _near, "Distance of the near plane, more than 0.")

    def get_projection_matrix(self, width=None, height=None) -> NDArray[np.float64]:
        across = self.xmag if width is None or height is None else width / height * self.ymag
        near, far = self.znear, self.zfar
        matrix = np.diag([1.0 / across, 1.0 / self.ymag, 2.0 / (near - far), 1.0])
        matrix[2, 3] = (far + near) / (near - far)
        return matrix


class IntrinsicsCamera(Camera):
    """A camera given in pixels, as calibration tools give it.

    Parameters
    ----------
    fx, fy : float
        Focal lengths.
    cx, cy : float
        The principal point, from the picture's left and top edges.
    znear, zfar : float
    name : str, optional
    """

    def __init__(self, fx, fy, cx, cy, znear=DEFAULT_Z_NEAR, zfar=DEFAULT_Z_FAR, name=None):
        super().__init__(znear=znear, zfar=zfar, name=name)
        self.fx, self.fy = fx, fy
        self.cx, self.cy = cx, cy

    fx = held("fx", float, "Focal length along x, in pixels.")
    fy = held("fy", float, "Focal length along y, in pixels.")
    cx = held("cx", float, "The principal point from the left edge, in pixels.")
    cy = held("cy", float, "The principal point from the top edge, in pixels.")

    def get_projection_matrix(self, width, height) -> NDArray[np.float64]:
        width, height = float(width), float(height)
        matrix = np.zeros((4, 4))
        matrix[0, 0], matrix[1, 1] = 2.0 * self.fx / width, 2.0 * self.fy / height
        matrix[0, 2], matrix[1, 2] = 1.0 - 2.0 * self.cx / width, 2.0 * self.cy / height - 1.0
        return self._depth_rows(matrix)


__all__ = ["Camera", "IntrinsicsCamera", "OrthographicCamera", "PerspectiveCamera"]
