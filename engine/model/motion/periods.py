"""The time after which all motions of an animator repeat together.

In: motions. Out: seconds: the least common multiple of their periods, if it is not too long to wait
for.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..scene.animation import Motions

#: Seconds that a repetition may last before it is cut.
LONGEST = 60.0
_FINEST = 1000  # parts of a second, to which periods are rounded


def common_period(motions: Motions) -> float | None:
    """Return the seconds after which motions repeat; None if there are none.

    If that takes more than a minute, it is as many whole turns of the slowest as a minute has room
    for, and at least one.
    """
    periods = [period for period in _periods(motions) if 0.0 < period < math.inf]
    if not periods:
        return None
    slowest = max(periods)
    whole = Fraction(0)
    for period in periods:
        exact = Fraction(period).limit_denominator(_FINEST)
        whole = _least_common(whole, exact) if whole and exact else whole or exact
        if whole > LONGEST:
            return slowest * max(math.floor(LONGEST / slowest), 1)
    return float(whole) or slowest


def _periods(motions: Motions) -> Iterator[float]:
    yield from (abs(spin.period) for spin in motions.spins)
    yield from (abs(orbit.period) for orbit in motions.orbits)
    yield from (path.period for path in motions.paths)
    for track in motions.tracks:
        first, last = float(track.times[0]), float(track.times[-1])
        yield last - first if track.repeat else last


def _least_common(one: Fraction, other: Fraction) -> Fraction:
    """Return the least number that both divide."""
    over = math.lcm(one.denominator, other.denominator)
    return Fraction(math.lcm(int(one * over), int(other * over)), over)
