"""Round numbers along a range, for axes and bars."""

from __future__ import annotations

import math

# Numbers beyond these are written with powers of ten.
_FINEST, _LARGEST = 1e-5, 1e9


def ticks(low: float, high: float, most: int) -> list[float]:
    """Return multiples of 1, 2 or 5 times a power of ten in a range, at most ``most``.

    If the range is too narrow for distinct numbers, return both ends.
    """
    rough = (high - low) / max(most, 1)
    if not 0.0 < rough < math.inf or low + rough == low:
        return [low, high]
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(k * power for k in (1.0, 2.0, 5.0, 10.0) if k * power >= rough * 0.999)
    first = math.ceil(low / step - 1e-9)
    last = math.floor(high / step + 1e-9)
    return [number * step for number in range(first, last + 1)]


def label(value: float, step: float) -> str:
    """Return a number with just enough digits to differ from the next one, ``step`` away."""
    if value == 0.0:
        return "0"
    power = math.floor(math.log10(step) + 1e-9)
    if step >= _FINEST and abs(value) < _LARGEST:
        return f"{value:.{max(-power, 0)}f}"
    digits = math.floor(math.log10(abs(value))) - power
    return f"{value:.{max(digits, 0)}e}"
