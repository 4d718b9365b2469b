"""Arrays that several primitives of a glTF file share.

In: the accessors that each of them names, and what makes an array. Out: the array, the same for
whoever asks for the same; so a file is made into no more numbers than it has. What only one
primitive names is not kept.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Iterable
from typing import Any

import numpy as np

from ...._native.loaders import frozen


class SharedArrays:
    """Arrays that were made from accessors, for primitives that name the same ones.

    Parameters
    ----------
    named : iterable of list of number
        The accessors of each primitive, as the JSON writes their numbers.
    """

    def __init__(self, named: Iterable[list[float]]) -> None:
        self._uses: Counter[float] = Counter(index for numbers in named for index in set(numbers))
        self._made: dict[tuple[Hashable, ...], Any] = {}

    def get(self, role: Hashable, index: Any, make: Callable[[], Any], *rest: Hashable) -> Any:
        """Return what ``make()`` made before of the same accessor in the same role, or makes now.

        Parameters
        ----------
        role : hashable
        index : int or None
            The accessor.
        make : callable
        *rest : hashable
            What else the result depends on.
        """
        if not isinstance(index, (int, float)) or self._uses[index] < 2:
            return make()
        key = role, index, *rest
        if key not in self._made:
            self._made[key] = _sealed(make())
        return self._made[key]


def _sealed(made: Any) -> Any:
    """Arrays that nobody can write to: meshes copy others."""
    if type(made) is tuple:
        return tuple(map(_sealed, made))
    return frozen(made) if isinstance(made, np.ndarray) else made
