"""The scale of texts, panels and marks over pictures: one factor for all their lengths.

In: the size of a picture, and the factor of its screen. Out: a factor, and lengths in whole pixels.
"""

from __future__ import annotations

LEAST_SCALE, MOST_SCALE = 0.5, 4.0
#: Texts are larger in pictures of more rows than this, in proportion, up to twice.
_ROWS, _MOST_BY_ROWS = 700, 2.0
#: Larger texts need so many pixels in a row for each time that they are as large.
_COLUMNS = 320
_STEPS = 4


def limited_scale(scale: float) -> float:
    """Return the nearest factor that texts can have."""
    return min(max(scale, LEAST_SCALE), MOST_SCALE)


def scale_for(width: int, height: int, screen: float = 1.0) -> float:
    """Return the factor for a picture of some size on a screen with some factor.

    A large picture has larger texts, and a narrow one no larger ones than fit.
    """
    by_rows = min(_in_steps(height / _ROWS), _MOST_BY_ROWS)
    scale = max(screen, by_rows) if by_rows > 1.0 else screen
    return limited_scale(min(scale, max(_in_steps(width / _COLUMNS), 1.0)))


def scaled(length: float, scale: float) -> int:
    """Return a length in pixels, at least 1, from that at factor 1."""
    return max(round(length * scale), 1)


def _in_steps(scale: float) -> float:
    """Return a factor rounded down to quarters, so that few sizes of fonts are made."""
    return int(scale * _STEPS) / _STEPS
