"""Lengths as text, with the unit of the file."""

from __future__ import annotations

_DIGITS = 4


def length_text(value: float, unit: str | None, power: int = 1) -> str:
    """Return a length, an area or a volume with four digits, and its unit where there is one.

    Parameters
    ----------
    value : float
    unit : str or None
        Of lengths.
    power : int
        1 for lengths, 2 for areas, 3 for volumes.
    """
    text = f"{value:.{_DIGITS}g}"
    if "e" in text and 1e-6 <= abs(value) < 1e9:
        text = f"{value:.{max(0, _DIGITS - 1 - exponent(value))}f}"
    return text if not unit else f"{text} {unit}{('', '', '²', '³')[power]}"


def exponent(value: float) -> int:
    """Return the exponent of the first digit, since machines round logarithms differently."""
    return int(f"{value:.16e}".partition("e")[2])
