"""The free part of a picture, beside a bar at its right or at its bottom.

In: which part is taken, and how a view sees. Out: views that show the model in the rest. Planes of
the frustum that lie unevenly about the line of sight become even ones by a shear along it, so what
fits a model into even planes serves for both.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...base import linalg
from ...rendering.support_functions import SupportFunction

_LEAST = 0.2  # of the picture: less is not kept for the model


class Taken(NamedTuple):
    """Which shares of a picture's width and height the model leaves free."""

    right: float = 0.0
    bottom: float = 0.0

    @property
    def around_middle(self) -> tuple[float, float]:
        """Free shares of the width, evenly on both sides of the middle, and of the height."""
        return max(1.0 - 2.0 * self.right, _LEAST), max(1.0 - self.bottom, _LEAST)

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
