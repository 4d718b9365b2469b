"""Converters of option values: text to numbers, vectors and colours.

Each function converts a text, or raises ``ArgumentTypeError``, which the parser turns into a line
and exit status 2.
"""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Callable, Sequence

from ...stage.overlays.ui_scale import LEAST_SCALE, MOST_SCALE

MAX_SIDE = 16384
MAX_THREADS = 256
MAX_WIDTH = 256  # of lines and points
MAX_ANISOTROPY = 16
MAX_LOD_BIAS = 16
MAX_EXPOSURE = 64  # stops
MAX_BLOOM = 100
CITY_TRIANGLES = 20_000, 50_000_000
MAX_SUBDIVISIONS = 512
_MOST = 999_999_999


def size(text: str) -> tuple[int, int]:
    """Parse ``1280x720`` or ``1280,720``."""
    match = re.fullmatch(r"\s*(-?\d+)\s*[xX,]\s*(-?\d+)\s*", text)
    if not match:
        raise argparse.ArgumentTypeError(f"{text!r} is not WIDTHxHEIGHT, such as 1280x720")
    width, height = int(match[1]), int(match[2])
    if not (1 <= width <= MAX_SIDE and 1 <= height <= MAX_SIDE):
        raise argparse.ArgumentTypeError(f"{text!r}: each side must be from 1 to {MAX_SIDE} pixels")
    return width, height


def drawing_scale(text: str) -> float:
    """Parse the scale of a drawing, such as ``1:2``."""
    from ...errors import InvalidArgumentError
    from ..drawings.units import parse_scale

    try:
        return parse_scale(text)
    except InvalidArgumentError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def number(text: str) -> float:
    """Parse a finite number."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text!r} is not a number")
    return value


def _real(wanted: str, fits: Callable[[float], bool]) -> Callable[[str], float]:
    """Return a function that parses a finite number and refuses unsuitable ones."""

    def parse(text: str) -> float:
        value = number(text)
        if not fits(value):
            raise argparse.ArgumentTypeError(f"{text!r} is not {wanted}")
        return value

    return parse


positive = _real("above zero", lambda value: value > 0.0)
not_negative = _real("zero or more", lambda value: value >= 0.0)
fraction = _real("a number from 0 to 1", lambda value: 0.0 <= value <= 1.0)
#: Width of a line or size of a point, in pixels.
width = _real(f"above 0 and at most {MAX_WIDTH} pixels", lambda value: 0.0 < value <= MAX_WIDTH)
#: Offset of textures' level of detail.
lod_bias = _real(f"in -{MAX_LOD_BIAS} to {MAX_LOD_BIAS}", lambda value: abs(value) <= MAX_LOD_BIAS)
#: Exposure in stops.
stops = _real(
    f"a number from -{MAX_EXPOSURE} to {MAX_EXPOSURE}", lambda value: abs(value) <= MAX_EXPOSURE
)
bloom = _real(f"a number from 0 to {MAX_BLOOM}", lambda value: 0.0 <= value <= MAX_BLOOM)
#: Factor on the size of texts and panels.
ui_scale = _real(
    f"a number from {LEAST_SCALE:g} to {MOST_SCALE:g}",
    lambda value: LEAST_SCALE <= value <= MOST_SCALE,
)
#: Slope of ground in degrees.
slope = _real("from 0 to less than 90 degrees", lambda value: 0.0 <= value < 90.0)
#: A vertical field of view in degrees.
yfov = _real("from 0.1 to 170 degrees", lambda value: 0.1 <= value <= 170.0)


def _whole(least: int = -_MOST, most: int = _MOST) -> Callable[[str], int]:
    """Return a function that parses an integer of up to nine digits, in a range."""
    wanted = f" of at least {least}" if least > -_MOST else ""
    wanted = f" from {least:,} to {most:,}" if most < _MOST else wanted

    def parse(text: str) -> int:
        if not (re.fullmatch(r"-?\d{1,9}", text) and least <= int(text) <= most):
            raise argparse.ArgumentTypeError(f"{text!r} is not a whole number{wanted}")
        return int(text)

    return parse


integer = _whole()
#: Index of an animation; -1 for all.
index = _whole(-1)
#: Component of a vector; -1 for its length, -2 for colours.
component = _whole(-2)
whole = _whole(0)
count = _whole(1)
#: Pictures of a series.
picture_count = _whole(1, 100_000)
#: Maximum anisotropy of textures.
anisotropy = _whole(1, MAX_ANISOTROPY)
city_triangles = _whole(*CITY_TRIANGLES)
#: Number of parts into which edges are cut.
subdivisions = _whole(1, MAX_SUBDIVISIONS)
#: Number of threads; 0 for as many as the process may use.
thread_count = _whole(0, MAX_THREADS)


def thread_counts(text: str) -> list[int]:
    """Parse comma-separated numbers of threads."""
    return [thread_count(part) for part in text.split(",")]


def some_of(names: Sequence[str]) -> Callable[[str], list[str]]:
    """Return a function that parses some comma-separated names of a set."""

    def parse(text: str) -> list[str]:
        chosen = text.split(",")
        for name in chosen:
            if name not in names:
                raise argparse.ArgumentTypeError(f"{name!r} is not one of {', '.join(names)}")
        return chosen

    return parse


def vector(text: str) -> tuple[float, float, float]:
    """Parse ``X,Y,Z``."""
    parts = text.split(",")
    if len(parts) != 3:
        raise argparse.ArgumentTypeError(f"{text!r} is not like 1,2,3")
    return number(parts[0]), number(parts[1]), number(parts[2])


def direction(text: str) -> tuple[float, float, float]:
    """Parse ``X,Y,Z`` of a direction."""
    parsed = vector(text)
    if not any(parsed):
        raise argparse.ArgumentTypeError(f"{text!r} is no direction")
    return parsed


def limits(text: str) -> tuple[float, float]:
    """Parse ``LOW,HIGH``, zero or more each."""
    parts = text.split(",")
    if len(parts) != 2:
        raise argparse.ArgumentTypeError(f"{text!r} is not LOW,HIGH")
    low, high = map(not_negative, parts)
    if low > high:
        raise argparse.ArgumentTypeError(f"{text!r}: the first number is the lower one")
    return low, high


def interval(text: str) -> tuple[float, float]:
    """Parse ``MIN,MAX``, the first less than the second."""
    parts = text.split(",")
    if len(parts) != 2:
        raise argparse.ArgumentTypeError(f"{text!r} is not MIN,MAX")
    low, high = map(number, parts)
    if not low < high:
        raise argparse.ArgumentTypeError(f"{text!r}: the first number is the lower one")
    return low, high


def joint(text: str) -> tuple[str, float | tuple[float, ...]]:
    """Parse ``NAME=VALUE``: one number or several, with ``deg`` for degrees instead of radians."""
    name, mark, value = text.rpartition("=")
    if not (mark and name):
        raise argparse.ArgumentTypeError(f"{text!r} is not NAME=VALUE, such as elbow=0.4")
    numbers = tuple(_angle(word.strip()) for word in value.split(","))
    return name, numbers if len(numbers) > 1 else numbers[0]


def _angle(text: str) -> float:
    from ...base.angles import Angle

    unit = next((unit for unit in ("deg", "°", "rad") if text.endswith(unit)), "")
    try:
        value = number(text.removesuffix(unit))
    except argparse.ArgumentTypeError:  # tell of the whole word: 1grad ends with rad, too
        raise argparse.ArgumentTypeError(f"{text!r} is not a number") from None
    if not unit:
        return value
    return Angle(value if unit == "rad" else math.radians(value))


def names(text: str) -> tuple[str, ...]:
    """Parse comma-separated names."""
    return tuple(filter(None, (part.strip() for part in text.split(","))))


def crease_angle(text: str) -> float:
    """Parse an angle between faces in degrees; return radians."""
    value = not_negative(text)
    if value > 180.0:
        raise argparse.ArgumentTypeError(f"{text!r} is more than 180 degrees")
    return math.radians(value)


def up_direction(text: str) -> str:
    """Parse ``+Y``, ``-z``, ``X`` and the like."""
    from ...stage.views.viewpoint import UP_DIRECTIONS

    name = text.upper()
    name = name if name[:1] in ("+", "-") else "+" + name
    if name not in UP_DIRECTIONS:
        raise argparse.ArgumentTypeError(f"{text!r} is not one of {', '.join(UP_DIRECTIONS)}")
    return name


def color(text: str) -> tuple[int, int, int]:
    """Parse ``0.2,0.4,0.6``, ``51,102,153``, ``#336699`` or a name, in sRGB.

    Numbers are 0 to 1, or 0 to 255 if one of them is above 1.
    """
    parts = text.split(",")
    if len(parts) == 3:
        values = [not_negative(part) for part in parts]
        scale = 1.0 if max(values) > 1.0 else 255.0
        if max(values) > 255.0:
            raise argparse.ArgumentTypeError(f"{text!r}: a component is above 255")
        red, green, blue = (int(value * scale + 0.5) for value in values)
        return red, green, blue
    from ...errors import InvalidArgumentError
    from ...model.materials.color_names import color_meant, color_of_word

    try:
        red, green, blue = map(int, color_of_word(text)[:3])
    except InvalidArgumentError:
        message = f"{text!r} is neither R,G,B nor #rrggbb nor the name of a colour"
        message += color_meant(text)
        raise argparse.ArgumentTypeError(message) from None
    return red, green, blue
