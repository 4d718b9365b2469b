"""Numbers that look random and follow from a seed and names: the same on every machine.

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

from .._support.numbers import shown
from .._support.validation import finite
from ..errors import InvalidArgumentError

Item = TypeVar("Item")

_ULP = 2.0**-53


class Generator:
    """A stream of numbers that follows from a seed.

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
        # Texts have quotes, and numbers have none: no two lists of words look alike.
        key = hashlib.blake2b(repr(self._words).encode("utf-8"), digest_size=16).digest()
        self._bits = np.random.Philox(key=int.from_bytes(key, "little"))

    def fork(self, *names: str | int) -> Generator:
        """Return a generator of its own for one purpose.

        It does not depend on what was asked of this one before, nor does this one on it: a further
        number for the light does not move the camera.
        """
        return Generator(*self._words, *names)

    @overload
    def uniform(self, low: float = 0.0, high: float = 1.0, size: None = None) -> float: ...

    @overload
    def uniform(
        self, low: float, high: float, size: int | tuple[int, ...]
    ) -> NDArray[np.float64]: ...

    def uniform(self, low=0.0, high=1.0, size=None):
        """Return numbers that are evenly distributed.

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
        words = np.asarray(self._bits.random_raw(size), np.uint64)
        return low + (high - low) * ((words >> np.uint64(11)) * _ULP)

    def integer(self, low: int, high: int) -> int:
        """Return a whole number from ``low`` to ``high - 1``.

        Raises
        ------
        InvalidArgumentError
            There is none.
        """
        if not low < high:
            raise InvalidArgumentError(f"no whole number is from {low} to {high - 1}")
        return low + (self._raw() * (high - low) >> 64)

    def integers(self, low: int, high: int, size: int | tuple[int, ...]) -> NDArray[np.int64]:
        """Return an array of whole numbers from ``low`` to ``high - 1``, at most 2**32 of them.

        Raises
        ------
        InvalidArgumentError
            There is none, or are more.
        """
        if not 0 < high - low <= 2**32:
            raise InvalidArgumentError(f"{low} to {high - 1} are not 1 to 2**32 whole numbers")
        words = np.asarray(self._bits.random_raw(size), np.uint64) >> np.uint64(32)
        return (words * np.uint64(high - low) >> np.uint64(32)).astype(np.int64) + low

    def chance(self, probability: float) -> bool:
        """Return True as often as ``probability``, from 0 to 1, says."""
        return self.uniform() < probability

    def choice(self, items: Sequence[Item]) -> Item:
        """Return one of the items, each as often as the others."""
        return items[self.integer(0, len(items))]

    def sample(self, items: Sequence[Item], count: int) -> list[Item]:
        """Return some of the items, none twice, in any order."""
        left = list(items)
        if not 0 <= count <= len(left):
            raise InvalidArgumentError(f"{count} of {len(left)} items cannot be taken")
        return [left.pop(self.integer(0, len(left))) for _ in range(count)]

    def direction(self) -> NDArray[np.float64]:
        """Return a vector of length 1, (3,): each direction as often as the others."""
        x, y, square = self._in_disc()
        stretch = 2.0 * math.sqrt(1.0 - square)
        return np.array([x * stretch, y * stretch, 1.0 - 2.0 * square])

    def rotation(self) -> NDArray[np.float64]:
        """Return a quaternion x, y, z, w, (4,): each rotation as often as the others."""
        x, y, square = self._in_disc()
        z, w, other = self._in_disc()
        stretch = math.sqrt((1.0 - square) / other)
        return np.array([x, y, z * stretch, w * stretch])

    def _in_disc(self) -> tuple[float, float, float]:
        """A point in the disc of radius 1, and the square of its distance from the middle."""
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
