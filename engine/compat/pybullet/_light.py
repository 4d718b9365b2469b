"""The light of TinyRenderer's pictures.

In: what the calls of a client said; what one says holds for all later ones, as in PyBullet. Out:
a `Light`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...base import linalg


@dataclass(frozen=True)
class Light:
    """A directional light, with the values of TinyRenderer.

    Attributes
    ----------
    direction : tuple of 3 float
        Towards the light, in the world; any length.
    color : tuple of 3 float
        Multiplies what is diffuse and specular.
    distance : float
        Of the shadow map's eye from the origin.
    ambient, diffuse, specular : float
        Factors of the surface's colour.
    shadow : bool
    """

    direction: tuple[float, ...] = (-50.0, 30.0, 100.0)
    color: tuple[float, ...] = (1.0, 1.0, 1.0)
    distance: float = 2.0
    ambient: float = 0.6
    diffuse: float = 0.35
    specular: float = 0.05
    shadow: bool = False

    def changed(self, **values: Any) -> Light:
        """Return the light with those values that are not None."""
        return replace(self, **{name: held for name, held in values.items() if held is not None})

    @property
    def unit(self) -> np.ndarray:
        """The direction at length 1, (3,) float64."""
        return linalg.normalize(self.direction)

    def numbers(self) -> np.ndarray:
        """Return direction, colour, ambient, diffuse and specular, (9,) float32."""
        parts = *self.unit.tolist(), *self.color, self.ambient, self.diffuse, self.specular
        return np.array(parts, np.float32)

    def view(self) -> np.ndarray:
        """Return light-from-world: an eye that looks at the origin, with +Z up; (4, 4) float64."""
        toward = self.unit
        side = linalg.normalize(linalg.cross(-toward, (0.0, 0.0, 1.0)))
        up = linalg.cross(side, -toward)
        view = np.eye(4)
        view[:3, :3] = (side, up, toward)
        eye = toward * self.distance
        view[:3, 3] = [-linalg.dot(axis, eye) for axis in (side, up, toward)]
        return view
