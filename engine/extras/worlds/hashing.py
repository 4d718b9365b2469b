"""Hash-based random numbers from coordinates: the same on every machine.

In: a seed and integer coordinates. Out: 32-bit hashes, or numbers in [0, 1) made of their upper 24
bits, which a float64 holds exactly. The results depend neither on the order of calls nor on a
generator whose stream may change.

Each word w turns the state h into mix(h xor w * 0x9E3779B9), modulo 2**32, where mix is Chris
Wellons's "lowbias32": x ^= x >> 16; x *= 0x7FEB352D; x ^= x >> 15; x *= 0x846CA68B; x ^= x >> 16.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

_GOLDEN = np.uint32(0x9E3779B9)
_FIRST, _SECOND = np.uint32(0x7FEB352D), np.uint32(0x846CA68B)
_HALF, _OTHER = np.uint32(16), np.uint32(15)


def hash_words(seed: int, *words: ArrayLike) -> np.ndarray:
    """Return the hash of a seed and of integers, all taken modulo 2**32.

    Parameters
    ----------
    seed : int
    *words : int or array of int
        Broadcast against each other.

    Returns
    -------
    hashes : ndarray of uint32, of the words' common shape
    """
    state = _mix(np.atleast_1d(_word(seed)))
    for word in words:
        state = _mix(state ^ (_word(word) * _GOLDEN))
    return state


def unit_floats(seed: int, *words: ArrayLike) -> np.ndarray:
    """Return the upper 24 bits of `hash_words` as float64 in [0, 1)."""
    return (hash_words(seed, *words) >> np.uint32(8)) * (1.0 / (1 << 24))


def _word(value: ArrayLike) -> np.ndarray:
    return np.atleast_1d(np.asarray(value, np.int64) & 0xFFFFFFFF).astype(np.uint32)


def _mix(state: np.ndarray) -> np.ndarray:
    state = (state ^ (state >> _HALF)) * _FIRST
    state = (state ^ (state >> _OTHER)) * _SECOND
    return state ^ (state >> _HALF)
