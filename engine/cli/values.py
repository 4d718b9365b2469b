"""The values of options: text in, a number, a vector or a colour out.

Each function takes what was typed and returns the value, or raises ``ArgumentTypeError``, which the
parser turns into a line and exit status 2.
"""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Callable, Sequence

UPS = ("+X", "-X", "+Y", "-Y", "+Z", "-Z")
MAX_SIDE = 16384
MAX_THREADS = 256
MAX_WIDTH = 256  # of lines and points
MAX_UI_SCALE = 8
MAX_ANISOTROPY = 16
MAX_LOD_BIAS = 16
MAX_EXPOSURE = 64  # stops
MAX_BLOOM = 100
CITY_TRIANGLES = 20_000, 50_000_000
MAX_SUBDIVISIONS = 512


def resolution(text: str) -> tuple[int, int]:
    """Parse ``1280x720`` or ``1280,720``."""
    match = re.fullmatch(r"\s*(\d+)\s*[xX,]\s*(\d+)\s*", text)
    if not match:
        raise argparse.ArgumentTypeError(f"{text!r} is not like 1280x720")
    width, height = int(match[1]), int(match[2])
    if not (1 <= width <= MAX_SIDE and 1 <= height <= MAX_SIDE):
        raise argparse.ArgumentTypeError(f"{text!r}: each side must be from 1 to {MAX_SIDE}")
    return width, height


def number(text: str) -> float:
    """Parse a finite number."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text!r} is not a number")
    return value


def index(text: str) -> int:
    """Parse a whole number from -1 on."""
    try:
        value = int(text)
    except ValueError:
        value = -2
    if value < -1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number, -1 or greater")
    return value


def component(text: str) -> int:
    """Parse the number of a component, or what stands for their length or for colours."""
    try:
        value = int(text)
    except ValueError:
        value = -3
    if value < -2:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number, -2 or greater")
    return value


def positive(text: str) -> float:
    """Parse a finite number above zero."""
    value = number(text)
    if value <= 0.0:
        raise argparse.ArgumentTypeError(f"{text!r} is not above zero")
    return value


def width(text: str) -> float:
    """Parse the width of a line or a point in pixels."""
    value = positive(text)
    if value > MAX_WIDTH:
        raise argparse.ArgumentTypeError(f"{text!r} is above {MAX_WIDTH} pixels")
    return value


def anisotropy(text: str) -> int:
    """Parse the most places at which a texture is read, 1 to 16."""
    value = count(text)
    if value > MAX_ANISOTROPY:
        raise argparse.ArgumentTypeError(f"{text!r} is above {MAX_ANISOTROPY}")
    return value


def lod_bias(text: str) -> float:
    """Parse what is added to the level of detail of textures."""
    value = number(text)
    if abs(value) > MAX_LOD_BIAS:
        raise argparse.ArgumentTypeError(f"{text!r} is not in -{MAX_LOD_BIAS} to {MAX_LOD_BIAS}")
    return value


def not_negative(text: str) -> float:
    """Parse a finite number, zero or more."""
    value = number(text)
    if value < 0.0:
        raise argparse.ArgumentTypeError(f"{text!r} is negative")
    return value


def stops(text: str) -> float:
    """Parse a number of stops of exposure."""
    value = number(text)
    if not abs(value) <= MAX_EXPOSURE:
        raise argparse.ArgumentTypeError(
            f"{text!r} is not a number from -{MAX_EXPOSURE} to {MAX_EXPOSURE}"
        )
    return value


def bloom(text: str) -> float:
    """Parse the strength of a glow."""
    value = not_negative(text)
    if value > MAX_BLOOM:
        raise argparse.ArgumentTypeError(f"{text!r} is above {MAX_BLOOM}")
    return value


def fraction(text: str) -> float:
    """Parse a number from 0 to 1."""
    value = not_negative(text)
    if value > 1.0:
        raise argparse.ArgumentTypeError(f"{text!r} is above one")
    return value


def count(text: str) -> int:
    """Parse an integer of at least one."""
    if not re.fullmatch(r"\d{1,9}", text) or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of at least 1")
    return int(text)


def whole(text: str) -> int:
    """Parse a whole number, zero or more."""
    if not re.fullmatch(r"\d{1,9}", text):
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of at least 0")
    return int(text)


def ui_scale(text: str) -> int:
    """Parse a factor on the size of texts."""
    if not re.fullmatch(r"\d", text) or not 1 <= int(text) <= MAX_UI_SCALE:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1 to {MAX_UI_SCALE}")
    return int(text)


def city_triangles(text: str) -> int:
    """Parse how many triangles a city has."""
    value, (least, most) = count(text), CITY_TRIANGLES
    if not least <= value <= most:
        raise argparse.ArgumentTypeError(f"{text!r} is not from {least:,} to {most:,}")
    return value


def subdivisions(text: str) -> int:
    """Parse into how many parts edges are cut."""
    value = count(text)
    if not 1 <= value <= MAX_SUBDIVISIONS:
        raise argparse.ArgumentTypeError(f"{text!r} is not from 1 to {MAX_SUBDIVISIONS}")
    return value


def integer(text: str) -> int:
    """Parse an integer of up to nine digits."""
    if not re.fullmatch(r"-?\d{1,9}", text):
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number")
    return int(text)


def thread_count(text: str) -> int:
    """Parse a number of threads, 0 for as many as the process may use."""
    if not re.fullmatch(r"\d{1,3}", text) or int(text) > MAX_THREADS:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 0 to {MAX_THREADS}")
    return int(text)


def thread_counts(text: str) -> list[int]:
    """Parse numbers of threads with commas between them."""
    return [thread_count(part) for part in text.split(",")]


def some_of(names: Sequence[str]) -> Callable[[str], list[str]]:
    """Return a function that parses some of the names, with commas between them."""

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


def names(text: str) -> tuple[str, ...]:
    """Parse names with commas between them."""
    return tuple(filter(None, (part.strip() for part in text.split(","))))


def slope(text: str) -> float:
    """Parse an angle of ground in degrees."""
    value = not_negative(text)
    if value >= 90.0:
        raise argparse.ArgumentTypeError(f"{text!r} is not less than 90 degrees")
    return value


def crease_angle(text: str) -> float:
    """Parse an angle between faces in degrees; return radians."""
    value = not_negative(text)
    if value > 180.0:
        raise argparse.ArgumentTypeError(f"{text!r} is more than 180 degrees")
    return math.radians(value)


def view_angle(text: str) -> float:
    """Parse a vertical field of view in degrees."""
    value = number(text)
    if not 0.1 <= value <= 170.0:
        raise argparse.ArgumentTypeError(f"{text!r} is not from 0.1 to 170 degrees")
    return value


def up_direction(text: str) -> str:
    """Parse ``+Y``, ``-z``, ``X`` and the like."""
    name = text.upper()
    name = name if name[:1] in ("+", "-") else "+" + name
    if name not in UPS:
        raise argparse.ArgumentTypeError(f"{text!r} is not one of {', '.join(UPS)}")
    return name


def color(text: str) -> tuple[int, int, int]:
    """Parse ``0.2,0.4,0.6``, ``51,102,153``, ``#336699`` or a name, as seen on the screen (sRGB).

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
    from PIL import ImageColor

    try:
        return ImageColor.getrgb(text)[:3]
    except ValueError:
        message = f"{text!r} is neither R,G,B nor #rrggbb nor the name of a colour"
        raise argparse.ArgumentTypeError(message) from None
