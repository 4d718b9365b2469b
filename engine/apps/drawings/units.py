"""Pages, units of length and scales: how many millimetres of paper a world unit takes."""

from __future__ import annotations

import math
import re
from typing import get_args

from ...base.near_words import meant
from ...choices import LengthUnit, PageSize
from ...errors import InvalidArgumentError

#: Millimetres.
UNITS = dict(zip(get_args(LengthUnit), (1.0, 10.0, 1000.0, 1e-3, 25.4, 304.8), strict=True))
#: The files that drawings are written to.
SUFFIXES = (".svg", ".pdf")
#: Width and height of pages in millimetres (ISO 216), with the long side level.
_SIDES = ((297.0, 210.0), (420.0, 297.0), (594.0, 420.0), (841.0, 594.0))
PAGES = dict(zip(get_args(PageSize), _SIDES, strict=True))
#: The scales that ISO 5455 recommends are powers of ten times these.
_STEPS = (1.0, 2.0, 5.0)
_SCALE = re.compile(r"\s*([0-9.eE+-]+)\s*(?:[:/]\s*([0-9.eE+-]+)\s*)?")


def millimetres(unit: str | None) -> float:
    """Return the length of a unit; without one, coordinates are millimetres.

    Raises `InvalidArgumentError` for an unknown one.
    """
    if not unit:
        return 1.0
    if unit not in UNITS:
        raise InvalidArgumentError(
            f"unit {unit!r} has no known length: it is none of {', '.join(UNITS)}"
            + meant(unit, UNITS)
        )
    return UNITS[unit]


def parse_scale(text: str) -> float:
    """Return the scale that ``1:2``, ``5:1`` or a number tells.

    Raises `InvalidArgumentError` for other texts.
    """
    match = _SCALE.fullmatch(text)
    try:
        scale = float(match[1]) / float(match[2] or 1.0) if match is not None else math.nan
    except (ValueError, ZeroDivisionError):
        scale = math.nan
    if not 0.0 < scale < math.inf:
        raise InvalidArgumentError(f"scale: {text!r} is not like 1:2, 5:1 or 0.5")
    return scale


def scale_text(scale: float) -> str:
    """Return a scale as drawings tell it: ``1:2``, ``5:1``."""
    return f"{scale:.6g}:1" if scale >= 1.0 else f"1:{1.0 / scale:.6g}"


def usual_scale(largest: float) -> float:
    """Return the largest recommended scale that is not above a limit."""
    power = 10.0 ** math.floor(math.log10(largest))
    # Of reductions 1:2, 1:5, 1:10 these are the inverses.
    steps = sorted({*_STEPS, *(10.0 / step for step in _STEPS[1:])} if largest < 1.0 else _STEPS)
    wanted = [step for step in steps if step * power <= largest * (1.0 + 1e-9)]
    return (wanted[-1] if wanted else 1.0) * power
