"""The background of what mirrors reflect (docs/exactness, R215).

In: a scene and options. Out: an environment that takes the place of a plain background, which has
no radiance of its own.
"""

from __future__ import annotations

from typing import cast

import numpy as np

from ...base import linalg
from ...choices import Color, ColorSpace
from ...model.environments.environment import Environment
from ...model.materials.display_colors import shading_color
from ...model.scene.gradients import Gradient
from ...model.scene.staged_scene import AnyScene
from .._bare_scene import BareScene
from .._memo import Memo
from .._tone_inverse import light_that_shows
from ..options import RenderOptions

_ROWS = 64  # of a gradient


class MirrorBackgrounds:
    """The environments of one renderer; the last one is kept.

    Parameters
    ----------
    is_srgb : bool
        Whether 8-bit colours are decoded to linear light.
    """

    def __init__(self, is_srgb: bool) -> None:
        self._space: ColorSpace = "srgb" if is_srgb else "linear"
        self._made_of = Memo()
        self._made: Environment | None = None

    def beyond(self, scene: AnyScene | BareScene, options: RenderOptions) -> Environment | None:
        """Return the environment in place of a background; None if it has light, or is nothing."""
        background = scene.apart if isinstance(scene, BareScene) else scene.background
        if background is None or isinstance(background, Environment):
            return None
        if isinstance(background, Gradient):
            ends = background.bottom, background.top
        else:
            ends = background, background
        bottom, top = (shading_color(cast(Color, end), self._space) for end in ends)
        if self._made_of.differs(bottom, top, options.tone_mapping):
            low, high = (
                np.array(light_that_shows(end, options.tone_mapping)) for end in (bottom, top)
            )
            if bottom == top:
                pixels = low[np.newaxis, np.newaxis]
            else:  # rows are alike in angle, the share is the sine
                angles = (0.5 - (np.arange(_ROWS) + 0.5) / _ROWS) * np.pi
                shares = (linalg.sin(angles)[:, np.newaxis] + 1.0) * 0.5
                pixels = (low + (high - low) * shares)[:, np.newaxis]
            self._made = Environment(pixels)
            self._made_of.done()
        return self._made
