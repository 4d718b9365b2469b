"""Arrays shared by several primitives of a glTF file.

In: the accessors of each primitive, and functions that build arrays. Out: one array for all that
request the same; so a file never expands to more numbers than it holds. Arrays of a single
primitive are not cached.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Iterable
from typing import Any

import numpy as np

from ...._native.loaders import frozen


class SharedArrays:
    """A cache of arrays built from accessors, for primitives that share accessors.

    Parameters
    ----------
    named : iterable of list of number
        The accessors of each primitive, as the JSON writes their numbers.
    """

    def __init__(self, named: Iterable[list[float]]) -> None:
        self._uses: Counter[float] = Counter(index for numbers in named for index in set(numbers))
        self._made: dict[tuple[Hashable, ...], Any] = {}

    def get(self, role: Hashable, index: Any, make: Callable[[], Any], *rest: Hashable) -> Any:
        """Return the cached result of ``make()`` for an accessor and role, or call it.

        Parameters
        ----------
        role : hashable
        index : int or None
            The accessor.
        make : callable
        *rest : hashable
            Further inputs of the result.
        """
        if not isinstance(index, (int, float)) or self._uses[index] < 2:
            return make()
        key = role, index, *rest
        if key not in self._made:
            self._made[key] = _sealed(make())
        return self._made[key]


def _sealed(made: Any) -> Any:
    """Return the arrays read-only, so that meshes need not copy them."""
    if type(made) is tuple:
        return tuple(map(_sealed, made))
    return frozen(made) if isinstance(made, np.ndarray) else made
