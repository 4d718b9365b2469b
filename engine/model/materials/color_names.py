"""Colours as words: names of CSS, and ``#rgb``, ``#rrggbb`` and ``#rrggbbaa``.

In: a word. Out: 8-bit values. The functions of a program and the options of the command line read
colours here.
"""

from __future__ import annotations

import functools
from typing import Any

import numpy as np

from ...base.near_words import meant
from ...errors import InvalidArgumentError


@functools.lru_cache(maxsize=1024)
def color_of_word(word: str, what: str = "color") -> tuple[Any, ...]:
    """Return the 8-bit values of a colour: three, or four with alpha.

    Parameters
    ----------
    word : str
        In any letter case.
    what : str
        The name used in the message.

    Raises
    ------
    InvalidArgumentError
        It is neither of these.
    """
    from PIL import ImageColor

    try:
        codes = ImageColor.getrgb(word.strip())
    except ValueError:
        raise InvalidArgumentError(
            f"{what}: {word!r} is neither #rrggbb nor the name of a colour of CSS"
            + color_meant(word)
        ) from None
    # Python's integers that are all 0 or 1 would mean 0.0 and 1.0.
    return codes if max(codes) > 1 else tuple(map(np.uint8, codes))


def color_meant(word: str) -> str:
    """Return the end of a message that suggests the name of a colour, or ``""``."""
    from PIL import ImageColor

    return meant(word.strip().lower(), ImageColor.colormap)
