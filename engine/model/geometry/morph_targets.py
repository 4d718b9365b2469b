"""Morph targets: offsets added to the vertices of a mesh, times a weight.

In: offsets of positions, normals and tangents. Out: the same, checked and read-only.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base.validation import Closed, text
from ...errors import InvalidArgumentError
from ._arrays import check_indices, check_vectors3, require_range

_Offsets: TypeAlias = NDArray[np.float32] | None


class MorphTarget(Closed):
    """Offsets of a mesh's vertices; immutable.

    Parameters
    ----------
    positions, normals, tangents : (V, 3) float, optional
        One row a vertex; the target does not change an attribute that is left out. The fourth
        number of a tangent never changes.
    name : str

    Raises
    ------
    InvalidArgumentError
        A shape is wrong, the numbers of rows differ, an offset is not finite, or none is given.
    """

    def __init__(
        self,
        positions: ArrayLike | None = None,
        normals: ArrayLike | None = None,
        tangents: ArrayLike | None = None,
        name: str = "",
    ) -> None:
        self._name = text(name, "name")
        self._positions = _offsets(positions, "positions")
        self._normals = _offsets(normals, "normals")
        self._tangents = _offsets(tangents, "tangents")
        given = (self._positions, self._normals, self._tangents)
        counts = {len(offsets) for offsets in given if offsets is not None}
        if len(counts) != 1:
            raise InvalidArgumentError(
                "a morph target has offsets, and as many of one kind as of another"
            )
        self._count = counts.pop()

    @property
    def name(self) -> str:
        return self._name

    @property
    def positions(self) -> _Offsets:
        """Offsets of positions, (V, 3) float32, or None."""
        return self._positions

    @property
    def normals(self) -> _Offsets:
        """Offsets of normals, (V, 3) float32, or None."""
        return self._normals

    @property
    def tangents(self) -> _Offsets:
        """Offsets of tangents, (V, 3) float32, or None."""
        return self._tangents

    def rows(self, numbers: NDArray[np.integer]) -> MorphTarget:
        """Return the target for a mesh whose vertices are the given rows of this one's."""
        numbers = check_indices(numbers, "numbers")
        require_range(numbers, len(self), "numbers", "vertices")
        parts = (self._positions, self._normals, self._tangents)
        positions, normals, tangents = (None if p is None else p[numbers] for p in parts)
        return MorphTarget(positions, normals, tangents, name=self._name)

    def __len__(self) -> int:
        return self._count

    def __repr__(self) -> str:
        return f"MorphTarget({len(self)} vertices, name={self.name!r})"


def _offsets(value: ArrayLike | None, what: str) -> _Offsets:
    if value is None:
        return None
    offsets = check_vectors3(value, f"{what} of a morph target")
    if not np.isfinite(offsets).all():
        raise InvalidArgumentError(f"{what} of a morph target must be finite")
    return offsets
