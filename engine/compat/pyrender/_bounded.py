"""Properties derived from bounds, shared by pyrender's primitives, meshes and scenes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


class Bounded:
    """Base of objects with bounds."""

    @property
    def bounds(self) -> NDArray:
        """Lowest and highest corner, (2, 3)."""
        raise NotImplementedError

    @property
    def centroid(self) -> NDArray:
        """The centre of the bounds, (3,)."""
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
