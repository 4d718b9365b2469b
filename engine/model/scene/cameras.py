"""Cameras: projections from view space to clip space.

In: fields of view, sizes, distances. Out: 4x4 float64 projection matrices (clip_from_view) with
OpenGL's clip volume. A camera has no pose of its own: its node's pose is world-from-camera; it
looks along its -Z with +Y up. All arithmetic is float64, in single operations, so that a matrix has
the same bits on every machine.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...base.angles import field_of_view
from ...base.calls import hinted
from ...base.image_size import check_size, sides_of
from ...base.numbers import real, shown
from ...base.validation import (
    CheckedAttribute,
    Closed,
    NumberAttribute,
    OptionalNumberAttribute,
    VectorAttribute,
    finite,
    flag,
    frozen_floats,
    matrix4,
    optional_positive,
    positive,
)
from ...errors import InvalidArgumentError
from ._pinhole_pixels import directions_of, pixels_of

#: Near planes below this belong to models that are too small for the usual clip space.
_SMALL = 2.0**-18
#: The size of a picture if nobody says another.
PICTURE = (1280, 720)
_MOST = 100  # the highest power of two by which matrices are scaled


def far_depth(camera: Camera) -> float:
    """Return the depth of the far plane in clip space, divided by w; the near plane's is -1."""
    return 0.0 if isinstance(camera, PerspectiveCamera) and camera.reversed_depth else 1.0


def far_distance(value: float | None, what: str) -> float:
    """Return the distance of a far plane: positive, or infinity for None."""
    if value is None:
        return math.inf
    number = real(value)
    if not number > 0:
        raise InvalidArgumentError(f"{what} must be greater than 0, not {shown(value)}")
    return number


def check_range(camera: Any) -> None:
    """Raise an error unless a camera's near plane is nearer than its far plane."""
    if not camera.znear < camera.zfar:
        raise InvalidArgumentError(
            f"znear must be less than zfar: {camera.znear:g} and {camera.zfar:g}"
        )


def _sides(size: tuple[int, int]) -> tuple[int, int]:
    """Return an image's sides, checked quickly if they are integers: every frame does this."""
    width, height = sides_of(size)
    if width.__class__ is height.__class__ is int and 0 < width < 2**31 and 0 < height < 2**31:
        return width, height
    for side, what in ((width, "width"), (height, "height")):
        positive(side, what)
    return width, height


def _enlarged(matrix: NDArray[np.float64], znear: float) -> NDArray[np.float64]:
    """Scale a projection by a power of two if its near plane is very near.

    Points with a w below a millionth are clipped (WMIN in docs/exactness).
    """
    if znear >= _SMALL:
        return matrix
    return matrix * 2.0 ** min(-math.frexp(znear)[1], _MOST)


class Camera(Closed):
    """A camera given by its projection matrix.

    Parameters
    ----------
    projection : (4, 4) float
        clip_from_view, with OpenGL's clip volume ``-w <= z <= w``.

    Attributes
    ----------
    version : int
        Grows with every assignment.

    Raises
    ------
    InvalidArgumentError
    """

    version: int
    matrix: VectorAttribute = CheckedAttribute(
        lambda value, what: frozen_floats(value, what, (4, 4)),
        "clip_from_view, (4, 4) float64, read-only.",
    )
    znear: float | None = None
    zfar: float | None = None

    def __init__(self, projection: ArrayLike) -> None:
        self.matrix = matrix4(projection, "projection")

    @hinted
    def projection(self, size: tuple[int, int]) -> NDArray[np.float64]:
        """Return clip_from_view for an image of (width, height) pixels, (4, 4) float64."""
        _sides(size)
        return self.matrix

    @hinted
    def project(self, points: ArrayLike, size: tuple[int, int] = PICTURE) -> NDArray[np.float64]:
        """Return the pixel positions of points.

        Parameters
        ----------
        points : (3,) or (N, 3) float
            Camera space: x to the right, y up, z back.
        size : (int, int)
            Width and height of the picture; cameras given in pixels have no use for it.

        Returns
        -------
        pixels : (2,) or (N, 2) float64
            x to the right and y down from the picture's top left corner; the centre of the top left
            pixel is (0.5, 0.5). NaN for points that no pixel could show: behind the camera, or
            beyond what a lens sees.

        Raises
        ------
        InvalidArgumentError
        """
        sides = check_size(size)
        return pixels_of(self.projection(sides), sides, points)

    @hinted
    def rays(self, pixels: ArrayLike, size: tuple[int, int] = PICTURE) -> NDArray[np.float64]:
        """Return the directions in which pixels look: the inverse of `project`.

        Parameters
        ----------
        pixels : (2,) or (N, 2) float
        size : (int, int)
            Width and height of the picture; cameras given in pixels have no use for it.

        Returns
        -------
        directions : (3,) or (N, 3) float64
            Unit vectors in camera space; NaN where a lens sees nothing. Rays begin at the camera;
            without perspective, `Frame.rays` tells where they begin.

        Raises
        ------
        InvalidArgumentError
        """
        sides = check_size(size)
        return directions_of(self.projection(sides), sides, pixels)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._parameters()})"

    def _parameters(self) -> str:
        return repr(self.matrix.tolist())


class PerspectiveCamera(Camera):
    """A pinhole camera given by its vertical field of view.

    Parameters
    ----------
    yfov : float
        Vertical field of view in radians, between 0 and pi.
    znear, zfar : float
        Distances of the near and far planes, ``0 < znear < zfar``; ``zfar`` may be infinite.
    aspect : float, optional
        Width over height; by default the image's.
    reversed_depth : bool
        Reversed depth, with equal relative precision near and far: -1 at the near plane, 0 at the
        far plane, which then clips nothing. Distant surfaces close together stay distinct, however
        near the near plane is.

    Raises
    ------
    InvalidArgumentError
    """

    def __init__(
        self,
        yfov: float = 0.9,
        *,
        znear: float = 0.05,
        zfar: float = 100.0,
        aspect: float | None = None,
        reversed_depth: bool = False,
    ) -> None:
        self.yfov = yfov
        self.znear, self.zfar = znear, zfar
        self.aspect = aspect
        self.reversed_depth = reversed_depth
        check_range(self)

    yfov: NumberAttribute = CheckedAttribute(field_of_view)
    znear: NumberAttribute = CheckedAttribute(positive)
    zfar: CheckedAttribute[float | None, float] = CheckedAttribute(far_distance)
    aspect: OptionalNumberAttribute = CheckedAttribute(optional_positive)
    reversed_depth: CheckedAttribute[bool, bool] = CheckedAttribute(flag)

    @hinted
    def projection(self, size: tuple[int, int]) -> NDArray[np.float64]:
        check_range(self)
        width, height = _sides(size)
        aspect = width / height if self.aspect is None else self.aspect
        matrix = linalg.perspective(self.yfov, aspect, self.znear, self.zfar)
        if self.reversed_depth:
            ratio = self.znear / self.zfar
            matrix[2, 2] = -ratio / (1.0 - ratio)
            matrix[2, 3] = -self.znear / (1.0 - ratio)
        return _enlarged(matrix, self.znear)

    def _parameters(self) -> str:
        reversed_depth = ", reversed_depth=True" if self.reversed_depth else ""
        return f"yfov={self.yfov:g}, znear={self.znear:g}, zfar={self.zfar:g}{reversed_depth}"


class OrthographicCamera(Camera):
    """A camera without perspective.

    Parameters
    ----------
    ymag : float
        Half the visible height, in world units.
    xmag : float, optional
        Half the width; by default from ``ymag`` and the image's aspect.
    znear, zfar : float
        As for `PerspectiveCamera`, but they may be 0 or negative, and not infinite.

    Raises
    ------
    InvalidArgumentError
    """

    def __init__(
        self,
        ymag: float,
        *,
        xmag: float | None = None,
        znear: float = 0.05,
        zfar: float = 100.0,
    ) -> None:
        self.ymag = ymag
        self.xmag = xmag
        self.znear, self.zfar = znear, zfar
        check_range(self)

    ymag: NumberAttribute = CheckedAttribute(positive)
    xmag: OptionalNumberAttribute = CheckedAttribute(optional_positive)
    znear: NumberAttribute = CheckedAttribute(finite)
    zfar: NumberAttribute = CheckedAttribute(finite)

    @hinted
    def projection(self, size: tuple[int, int]) -> NDArray[np.float64]:
        check_range(self)
        width, height = _sides(size)
        xmag = self.ymag * (width / height) if self.xmag is None else self.xmag
        return linalg.orthographic(xmag, self.ymag, self.znear, self.zfar)

    def _parameters(self) -> str:
        return f"ymag={self.ymag:g}, znear={self.znear:g}, zfar={self.zfar:g}"


class IntrinsicsCamera(Camera):
    """A pinhole camera given in pixels, as calibration tools give it.

    Parameters
    ----------
    fx, fy : float
        Focal lengths in pixels.
    cx, cy : float
        Principal point in pixels from the image's left and top edges. The centre of the top left
        pixel is (0.5, 0.5): add 0.5 to values from OpenCV, which puts it at (0, 0).
    znear, zfar : float
        As for `PerspectiveCamera`.

    Notes
    -----
    The camera still looks along -Z with +Y up. To convert a pose from software whose cameras look
    along +Z with +Y down (OpenCV, COLMAP), negate its second and third columns.

    Raises
    ------
    InvalidArgumentError
    """

    def __init__(
        self,
        fx: float,
        fy: float,
        cx: float,
        cy: float,
        *,
        znear: float = 0.05,
        zfar: float = 100.0,
    ) -> None:
        self.fx, self.fy = fx, fy
        self.cx, self.cy = cx, cy
        self.znear, self.zfar = znear, zfar
        check_range(self)

    fx: NumberAttribute = CheckedAttribute(positive)
    fy: NumberAttribute = CheckedAttribute(positive)
    cx: NumberAttribute = CheckedAttribute(finite)
    cy: NumberAttribute = CheckedAttribute(finite)
    znear: NumberAttribute = CheckedAttribute(positive)
    zfar: CheckedAttribute[float | None, float] = CheckedAttribute(far_distance)

    @hinted
    def projection(self, size: tuple[int, int]) -> NDArray[np.float64]:
        check_range(self)
        # The depth rows are those of any perspective; only the pixel grid differs.
        width, height = _sides(size)
        matrix = linalg.perspective(1.0, 1.0, self.znear, self.zfar)
        matrix[0, 0] = 2.0 * self.fx / width
        matrix[1, 1] = 2.0 * self.fy / height
        matrix[0, 2] = 1.0 - 2.0 * self.cx / width
        matrix[1, 2] = 2.0 * self.cy / height - 1.0
        return _enlarged(matrix, self.znear)

    def _parameters(self) -> str:
        return f"fx={self.fx:g}, fy={self.fy:g}, cx={self.cx:g}, cy={self.cy:g}"
