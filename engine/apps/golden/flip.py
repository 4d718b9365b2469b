"""The perceptual difference FLIP, by NVIDIA's own ``flip-evaluator``, where that is installed.

In:  two pictures as they are shown. Out: the mean of its error over all pixels, 0 to 1. Source:
     Andersson et al., FLIP: A Difference Evaluator for Alternating Images, 2020.
"""

from __future__ import annotations

import numpy as np

from ...base.optional_packages import needed
from ...errors import InvalidArgumentError


def mean_flip(actual: np.ndarray, expected: np.ndarray) -> float:
    """Return the mean FLIP error of two (H, W, 4) uint8 pictures of one size, over white.

    Raises `InvalidArgumentError` where flip-evaluator is not installed.
    """
    try:
        import flip_evaluator
    except ImportError:
        raise InvalidArgumentError(needed("FLIP needs", "flip-evaluator", "flip")) from None
    pair = (_over_white(expected), _over_white(actual))
    return float(flip_evaluator.evaluate(*pair, "LDR", applyMagma=False)[1])


def _over_white(shown: np.ndarray) -> np.ndarray:
    values = shown.astype(np.float32) / 255
    alpha = values[..., 3:]
    return np.ascontiguousarray(values[..., :3] * alpha + (1 - alpha))
