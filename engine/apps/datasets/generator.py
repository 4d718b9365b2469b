"""Reproducible random numbers from a seed and names: the same on every machine.

In: a seed and names, which say what the numbers are for. Out: whole numbers, float64 of 53 bits,
directions and rotations. The bits are those of Philox, a generator that counts, under a key that is
a hash of seed and names; nothing is made of them but by single IEEE operations and square roots.
Sources: Salmon et al. 2011 (Philox); Marsaglia 1972 (points on spheres).
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Sequence
from typing import Any, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from ...base.numbers import shown
from ...base.validation import finite, fraction
from ...errors import InvalidArgumentError

Item = TypeVar("Item")

_ULP = 2.0**-53
_MOST = 2**30  # numbers per call


class Generator:
    """A reproducible stream of random numbers from a seed.

    Parameters
    ----------
    seed : int
        Any whole number; other seeds give other streams.
    *names : str or int
        Other names give other streams of the same seed; see `fork`.

    Raises
    ------
    InvalidArgumentError

    Examples
    --------
    >>> generator = Generator(7)
    >>> generator.fork("camera").uniform(0.0, 6.28)  # whatever else is asked for
    """

    def __init__(self, seed: int, *names: str | int) -> None:
        for value in (seed, *names):
            allowed = (int, np.integer) if value is seed else (str, int, np.integer)
            if isinstance(value, bool) or not isinstance(value, allowed):
                raise InvalidArgumentError(f"seeds are whole numbers, not {shown(value)}")
        self._words = (int(seed), *(n if isinstance(n, str) else int(n) for n in names))
        # Texts have quotes, and numbers have none: different lists of words never look alike.
        key = hashlib.blake2b(repr(self._words).encode("utf-8"), digest_size=16).digest()
        self._bits = np.random.Philox(key=int.from_bytes(key, "little"))

    def fork(self, *names: str | int) -> Generator:
        """Return an independent generator for one purpose.

        Neither generator affects the other: one more random number for the light leaves the camera
        unchanged.
        """
        return Generator(*self._words, *names)

    @overload
    def uniform(self, low: float = 0.0, high: float = 1.0, size: None = None) -> float: ...

    @overload
    def uniform(
        self, low: float, high: float, size: int | tuple[int, ...]
    ) -> NDArray[np.float64]: ...

    def uniform(self, low=0.0, high=1.0, size=None):
        """Return uniformly distributed numbers.

        Parameters
        ----------
        low, high : float
            From ``low`` to less than ``high`` (equal to it where rounding says so).
        size : int or tuple of int, optional
            The shape of an array.

        Returns
        -------
        float, or ndarray of float64
        """
        low, high = finite(low, "low"), finite(high, "high")
        if size is None:
            return low + (high - low) * ((self._raw() >> 11) * _ULP)
        words = np.asarray(self._bits.random_raw(_shape(size)), np.uint64)
        return low + (high - low) * ((words >> np.uint64(11)) * _ULP)

    def integer(self, low: int, high: int) -> int:
        """Return a random integer from ``low`` to ``high - 1``.

        Raises
        ------
        InvalidArgumentError
            There is none.
        """
        low, high = _whole(low, "low"), _whole(high, "high")
        if not low < high:
            raise InvalidArgumentError(
                f"low must be less than high: {shown(low)} and {shown(high)}"
            )
        return low + (self._raw() * (high - low) >> 64)

    def integers(self, low: int, high: int, size: int | tuple[int, ...]) -> NDArray[np.int64]:
        """Return an array of integers from ``low`` to ``high - 1``, at most 2**32 values.

        Raises
        ------
        InvalidArgumentError
            There is none, or are more.
        """
        low, high = _whole(low, "low"), _whole(high, "high")
        if not 0 < high - low <= 2**32:
            raise InvalidArgumentError(
                f"low and high must be 1 to 2**32 apart, not {shown(low)} and {shown(high)}"
            )
        if not (low >= -(2**63) and high <= 2**63):
            raise InvalidArgumentError(f"low and high must be of 64 bits, not {shown(low)}")
        words = np.asarray(self._bits.random_raw(_shape(size)), np.uint64) >> np.uint64(32)
        return (words * np.uint64(high - low) >> np.uint64(32)).astype(np.int64) + low

    def chance(self, probability: float) -> bool:
        """Return True with a given probability, from 0 to 1."""
        return self.uniform() < fraction(probability, "probability")

    def choice(self, items: Sequence[Item]) -> Item:
        """Return one of the items, all equally likely."""
        listed = _listed(items)
        if len(listed) == 0:
            raise InvalidArgumentError("items must be one or more, not none")
        return listed[self.integer(0, len(listed))]

    def sample(self, items: Sequence[Item], count: int) -> list[Item]:
        """Return some of the items without repetition, in random order."""
        left = list(_listed(items))
        if not 0 <= _whole(count, "count") <= len(left):
            raise InvalidArgumentError(f"count must be 0 to {len(left)}, not {shown(count)}")
        return [left.pop(self.integer(0, len(left))) for _ in range(count)]

    def direction(self) -> NDArray[np.float64]:
        """Return a random unit vector, (3,), uniform over all directions."""
        x, y, square = self._in_disc()
        stretch = 2.0 * math.sqrt(1.0 - square)
        return np.array([x * stretch, y * stretch, 1.0 - 2.0 * square])

    def rotation(self) -> NDArray[np.float64]:
        """Return a random quaternion x, y, z, w, (4,), uniform over all rotations."""
        x, y, square = self._in_disc()
        z, w, other = self._in_disc()
        stretch = math.sqrt((1.0 - square) / other)
        return np.array([x, y, z * stretch, w * stretch])

    def _in_disc(self) -> tuple[float, float, float]:
        """Return a random point in the unit disc, and its squared distance from the centre."""
        while True:
            x, y = self.uniform(-1.0, 1.0), self.uniform(-1.0, 1.0)
            square = x * x + y * y
            if 0.0 < square < 1.0:
                return x, y, square

    def _raw(self) -> int:
        return int(self._bits.random_raw())

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("a Generator cannot be copied or pickled: make one of the same seed")

    def __repr__(self) -> str:
        return f"Generator({', '.join(map(repr, self._words))})"


def _whole(value: int, what: str) -> int:
    if not isinstance(value, (int, np.integer)):
        raise InvalidArgumentError(f"{what} must be a whole number, not {shown(value)}")
    return int(value)


def _listed(items: Sequence[Item]) -> Sequence[Item]:
    if not isinstance(items, Sequence) and not (isinstance(items, np.ndarray) and items.ndim):
        raise InvalidArgumentError(f"items must be a sequence, not {shown(items)}")
    return items


def _shape(size: int | tuple[int, ...] | None) -> tuple[int, ...] | None:
    """Return the shape of an array, checked."""
    if size is None:
        return None
    sides = tuple(size) if isinstance(size, (tuple, list)) else (size,)
    if not all(isinstance(side, (int, np.integer)) and type(side) is not bool for side in sides):
        raise InvalidArgumentError(f"size must be whole numbers, not {shown(size)}")
    if any(side < 0 for side in sides):
        raise InvalidArgumentError(f"size must be whole numbers, 0 or more, not {shown(size)}")
    if math.prod(map(int, sides)) > _MOST:
        raise InvalidArgumentError(f"size must be at most {_MOST} numbers, not {shown(size)}")
    return sides
