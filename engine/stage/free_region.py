"""What a picture has left for the model, beside a bar at its right or at its bottom.

In: which part is taken, and how a view sees. Out: views that show the model in the rest. Planes of
the frustum that lie unevenly about the line of sight become even ones by a shear along it, so what
fits a model into even planes serves for both.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .. import linalg
from ..rendering.support_functions import SupportFunction

if TYPE_CHECKING:
    from .viewpoint import Viewpoint

_LEAST = 0.2  # of the picture: less is not kept for the model


class Taken(NamedTuple):
    """Which shares of a picture's width and height the model leaves free."""

    right: float = 0.0
    bottom: float = 0.0

    def narrowed(self, slopes: tuple[float, float]) -> tuple[float, float]:
        """Return the slopes of even planes around what is left."""
        return slopes[0] * (1.0 - self.right), slopes[1] * (1.0 - self.bottom)

    def shift(self, slopes: tuple[float, float]) -> tuple[float, float]:
        """Return how far right and up of what is left the picture's middle is, from 1 away."""
        return slopes[0] * self.right, -slopes[1] * self.bottom


NOTHING = Taken()


def sheared(
    support: SupportFunction, axes: np.ndarray, center: np.ndarray, shift: tuple[float, float]
) -> SupportFunction:
    """Return the support function of what a view sees aside, moved to before it.

    Parameters
    ----------
    support : callable
    axes : (3, 3) float64
        Right, up and back.
    center : (3,) float64
        Stays where it is.
    shift : (float, float)
        As `Taken.shift` returns it.
    """
    if shift == (0.0, 0.0):
        return support
    across, back = axes[0] * shift[0] + axes[1] * shift[1], axes[2]

    def of_sheared(directions: np.ndarray) -> np.ndarray:
        turned = directions - linalg.dot(directions, across)[:, np.newaxis] * back
        return support(turned) + linalg.dot(directions - turned, center)

    return of_sheared


def frame_beside(view: Viewpoint, points: np.ndarray, aspect: float, taken: Taken) -> None:
    """As `Viewpoint.frame`, in what is left; the target stays on the axis that views turn about."""
    if taken == NOTHING:
        view.frame(points, aspect)
        return
    slope = math.tan(view.yfov / 2)
    width, height = max(1.0 - 2.0 * taken.right, _LEAST), max(1.0 - taken.bottom, _LEAST)
    narrow = replace(view, yfov=2.0 * math.atan(slope * height))
    narrow.frame(points, aspect * width / height)
    view.target, view.distance = narrow.target, narrow.distance
    rise = float(linalg.dot(np.array(view.up), view.rotation()[:, 1]))
    view.target -= np.array(view.up) * (taken.bottom * slope * view.distance * rise)
