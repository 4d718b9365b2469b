"""What a renderer of VTK sees: its rectangle of the picture, and the matrices of its camera.

In: a ``vtkRenderer``. Out: a `View`. All that is drawn stands in view space, in float64 until it is
placed, so that coordinates far from the origin stay exact.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base import linalg


@dataclass(frozen=True)
class View:
    """A rectangle of the picture, and what is seen in it.

    Attributes
    ----------
    left, top, width, height : int
        The rectangle, in pixels of the picture, y down.
    view : (4, 4) float64
        View from world: the camera looks along -Z.
    projection : (4, 4) float64
        Clip from view, as in OpenGL.
    is_parallel : bool
    clipping_range : (float, float)
        Distances of the near and the far plane.
    """

    left: int
    top: int
    width: int
    height: int
    view: NDArray[np.float64]
    projection: NDArray[np.float64]
    is_parallel: bool
    clipping_range: tuple[float, float]

    def placed(
        self, points: NDArray[Any], matrix: NDArray[np.float64] | None = None
    ) -> NDArray[np.float64]:
        """Return points in view space, (N, 3) float64; ``matrix`` is world from points."""
        whole = self.view if matrix is None else product(self.view, matrix)
        return transformed(whole, points)

    def pixels(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return where points of view space are: x and y in pixels, y down, and w, (N, 3)."""
        x, y, z = places.T
        m = self.projection
        w = m[3, 0] * x + m[3, 1] * y + m[3, 2] * z + m[3, 3]
        with np.errstate(divide="ignore", invalid="ignore"):
            across = (m[0, 0] * x + m[0, 1] * y + m[0, 2] * z + m[0, 3]) / w
            up = (m[1, 0] * x + m[1, 1] * y + m[1, 2] * z + m[1, 3]) / w
        return np.stack(
            [(0.5 + 0.5 * across) * self.width, (0.5 - 0.5 * up) * self.height, w], axis=-1
        )

    def pixel_sizes(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how large a pixel is at points of view space, (N,) float64."""
        m = self.projection
        w = m[3, 2] * places[:, 2] + m[3, 3]
        return 2.0 * np.abs(w) / (abs(m[1, 1]) * self.height)


def product(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the product of two 4x4 matrices, with the same bits on every machine."""
    return (a[:, :, None] * b[None]).sum(1)


def transformed(matrix: NDArray[np.float64], points: NDArray[Any]) -> NDArray[np.float64]:
    """Return points times an affine 4x4 matrix, (N, 3) float64."""
    x, y, z = (np.asarray(points[:, k], np.float64) for k in range(3))
    out = np.empty((len(points), 3))
    for k in range(3):
        row = matrix[k]
        out[:, k] = row[0] * x + row[1] * y + row[2] * z + row[3]
    return out


def turned(matrix: NDArray[np.float64], normals: NDArray[Any]) -> NDArray[np.float64]:
    """Return normals of a surface that a 4x4 matrix moves, (N, 3) float64, not of unit length."""
    a = matrix[:3, :3]
    # The cofactors: the inverse's transpose, without its determinant, whose sign is kept.
    cofactors = np.stack([linalg.cross(a[(k + 1) % 3], a[(k + 2) % 3]) for k in range(3)])
    sign = np.sign((a[0] * cofactors[0]).sum()) or 1.0
    whole = np.zeros((4, 4))
    whole[:3, :3] = cofactors * sign
    return transformed(whole, normals)


def matrix_of(given: Any) -> NDArray[np.float64]:
    """Return a ``vtkMatrix4x4`` as (4, 4) float64."""
    return np.array(given.GetData(), np.float64).reshape(4, 4)


def view_of(renderer: Any, size: tuple[int, int]) -> View | None:
    """Return what a renderer sees in a picture of given size; None where it has no pixels."""
    left, bottom, right, top = renderer.GetViewport()
    width, height = size
    x0, x1 = (int(edge * width + 0.5) for edge in (left, right))
    y0, y1 = (int(edge * height + 0.5) for edge in (bottom, top))
    if x1 <= x0 or y1 <= y0:
        return None
    camera = renderer.GetActiveCamera()
    aspect = (x1 - x0) / (y1 - y0)
    projection = matrix_of(camera.GetProjectionTransformMatrix(aspect, -1.0, 1.0))
    return View(
        left=x0,
        top=height - y1,
        width=x1 - x0,
        height=y1 - y0,
        view=matrix_of(camera.GetModelViewTransformMatrix()),
        projection=projection,
        is_parallel=bool(camera.GetParallelProjection()),
        clipping_range=camera.GetClippingRange(),
    )
