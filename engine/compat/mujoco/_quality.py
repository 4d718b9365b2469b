"""The fields of a context that pictures are drawn by, read anew before each of them.

In: a context, of which programs write the fields. Out: checked numbers.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ...base.validation import finite, finite_floats, whole_number
from ...errors import warn

_MOST = 2**31 - 1
_MOST_SHADOW_SIZE = 16000


class Quality(NamedTuple):
    """What a context says of shadows, lines, fog and samples.

    Attributes
    ----------
    samples : int
        Of a pixel: one or four.
    shadow_size : int
        The side of maps of shadows, in texels; 0: no light has shadows.
    shadow_clip, shadow_scale : float
        How far maps of directional lights reach, and the share of a spot's cone.
    line_width : float
    fog_start, fog_end : float
    fog : tuple of float
        Red, green and blue.
    """

    samples: int
    shadow_size: int
    shadow_clip: float
    shadow_scale: float
    line_width: float
    fog_start: float
    fog_end: float
    fog: tuple[float, ...]


def quality_of(context: Any) -> Quality:
    """Return what a context's fields say now."""
    size = whole_number(context.shadowSize, "shadowSize", 0, _MOST)
    if size > _MOST_SHADOW_SIZE:
        warn(f"shadowSize {size} is drawn as {_MOST_SHADOW_SIZE}")
    fog = context.fogRGBA
    if not (isinstance(fog, np.ndarray) and fog.dtype == np.float32):
        fog = finite_floats(fog, "fogRGBA", (4,))
    return Quality(
        samples=4 if whole_number(context.offSamples, "offSamples", 0, _MOST) else 1,
        shadow_size=min(size, _MOST_SHADOW_SIZE),
        shadow_clip=finite(context.shadowClip, "shadowClip"),
        shadow_scale=finite(context.shadowScale, "shadowScale"),
        line_width=finite(context.lineWidth, "lineWidth"),
        fog_start=finite(context.fogStart, "fogStart"),
        fog_end=finite(context.fogEnd, "fogEnd"),
        fog=tuple(fog[:3].tolist()),
    )
