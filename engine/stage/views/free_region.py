"""The part of a picture that a bar at its right or bottom leaves free.

In: the part taken, and a view. Out: views that show the model in the rest. A shear along the line
of sight turns asymmetric frustum planes into symmetric ones, so the same fitting code serves for
both.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...base import linalg
from ...rendering.support_functions import SupportFunction

_LEAST = 0.2  # of the picture: the model gets at least this much


class Taken(NamedTuple):
    """Fractions of a picture's width and height that a bar takes from the model."""

    right: float = 0.0
    bottom: float = 0.0

    @property
    def around_middle(self) -> tuple[float, float]:
        """Return free fractions of the width, symmetric about the middle, and of the height."""
        return max(1.0 - 2.0 * self.right, _LEAST), max(1.0 - self.bottom, _LEAST)

    def narrowed(self, slopes: tuple[float, float]) -> tuple[float, float]:
        """Return the slopes of symmetric planes around the free part."""
        return slopes[0] * (1.0 - self.right), slopes[1] * (1.0 - self.bottom)

    def shift(self, slopes: tuple[float, float]) -> tuple[float, float]:
        """Return by how much, at distance 1, to shift the view so that the free part is centred."""
        return slopes[0] * self.right, -slopes[1] * self.bottom


NOTHING = Taken()


def sheared(
    support: SupportFunction, axes: np.ndarray, center: np.ndarray, shift: tuple[float, float]
) -> SupportFunction:
    """Return the support function of a sheared subject, which centres it in front of a view.

    Parameters
    ----------
    support : callable
    axes : (3, 3) float64
        Right, up and back.
    center : (3,) float64
        The fixed point of the shear.
    shift : (float, float)
        As returned by `Taken.shift`.
    """
    if shift == (0.0, 0.0):
        return support
    across, back = axes[0] * shift[0] + axes[1] * shift[1], axes[2]

    def of_sheared(directions: np.ndarray) -> np.ndarray:
        turned = directions - linalg.dot(directions, across)[:, np.newaxis] * back
        return support(turned) + linalg.dot(directions - turned, center)

    return of_sheared
