"""Properties that follow from bounds, which primitives, meshes and scenes of pyrender share."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


class Bounded:
    """Something with bounds."""

    @property
    def bounds(self) -> NDArray:
        """Lowest and highest corner, (2, 3)."""
        raise NotImplementedError

    @property
    def centroid(self) -> NDArray:
        """The middle of the bounds, (3,)."""
        return np.mean(self.bounds, axis=0)

    @property
    def extents(self) -> NDArray:
        """The lengths of the bounds, (3,)."""
        bounds = self.bounds
        return bounds[1] - bounds[0]

    @property
    def scale(self) -> float:
        """The diagonal of the bounds."""
        return float(np.linalg.norm(self.extents))
