"""reg-cli's colour comparison: distance in YIQ, and detection of antialiasing.

In:  two pictures as they are shown. Out: the pixels that look different, for ``engine3d diff -M``.
     Sources: Kotsarenko and Ramos, Measuring perceived color difference using YIQ NTSC transmission
     color space, 2010, for the distance; Vysniauskas, Anti-aliased pixel and intensity slope
     detector, 2009, for what is antialiasing: both as pixelmatch uses them, which reg-cli calls.
"""

from __future__ import annotations

import numpy as np

# Rows: luma, in-phase, quadrature.
_YIQ = (
    (0.29889531, 0.58662247, 0.11448223),
    (0.59597799, -0.27417610, -0.32180189),
    (0.21147017, -0.52261711, 0.31114694),
)
_WEIGHTS = (0.5053, 0.299, 0.1957)
_FARTHEST = 35215.0  # the largest weighted squared distance: nearly that of black and white
_FEW, _MANY = 2, 3  # neighbours of the same colour
_NEIGHBOURS = [(y, x) for y in (-1, 0, 1) for x in (-1, 0, 1) if (y, x) != (0, 0)]


def looks_different(
    actual: np.ndarray, expected: np.ndarray, threshold: float, count_antialiasing: bool
) -> np.ndarray:
    """Return the pixels that look different.

    Parameters
    ----------
    actual, expected : (H, W, 4) uint8 arrays of one size
    threshold : float
        0 to 1: which distance passes, 1 being that of black and white.
    count_antialiasing : bool
        Whether pixels that look like antialiasing in one of the pictures count.

    Returns
    -------
    (H, W) bool array
    """
    a, b = _yiq(actual), _yiq(expected)
    distance = _weighted((a - b) ** 2, _WEIGHTS)
    mask = distance > _FARTHEST * threshold * threshold
    if count_antialiasing or not mask.any():
        return mask
    a_same, b_same = (_has_many_alike(one) for one in (actual, expected))
    smooth = _is_antialiased(a[..., 0], a_same & b_same)
    smooth |= _is_antialiased(b[..., 0], a_same & b_same)
    return mask & ~smooth


def _yiq(shown: np.ndarray) -> np.ndarray:
    """Return luma and chroma of a picture over white."""
    values = shown.astype(np.float64)
    alpha = values[..., 3:] / 255
    colors = 255 + (values[..., :3] - 255) * alpha
    return np.stack([_weighted(colors, row) for row in _YIQ], axis=-1)


def _weighted(values: np.ndarray, weights: tuple[float, float, float]) -> np.ndarray:
    """Return the weighted sums of three channels; NumPy's `@` may round otherwise elsewhere."""
    first, second, third = (values[..., channel] * weights[channel] for channel in range(3))
    return first + second + third


def _shifted(values: np.ndarray, y: int, x: int) -> np.ndarray:
    """Return the neighbour of each pixel; outside of the picture, the pixel at its edge."""
    rows = np.clip(np.arange(values.shape[0]) + y, 0, values.shape[0] - 1)
    columns = np.clip(np.arange(values.shape[1]) + x, 0, values.shape[1] - 1)
    return values[rows][:, columns]


def _inside(shape: tuple[int, ...], y: int, x: int) -> np.ndarray:
    rows, columns = np.arange(shape[0]) + y, np.arange(shape[1]) + x
    row_inside = (rows >= 0) & (rows < shape[0])
    column_inside = (columns >= 0) & (columns < shape[1])
    return row_inside[:, np.newaxis] & column_inside


def _on_edge(shape: tuple[int, ...]) -> np.ndarray:
    edge = np.zeros(shape[:2], bool)
    edge[[0, -1]] = edge[:, [0, -1]] = True
    return edge


def _has_many_alike(shown: np.ndarray) -> np.ndarray:
    """Return which pixels have at least three neighbours of exactly their colour."""
    colors = np.ascontiguousarray(shown).view(np.uint32)[..., 0]
    count = _on_edge(shown.shape).astype(np.int32)
    for y, x in _NEIGHBOURS:
        count += (_shifted(colors, y, x) == colors) & _inside(shown.shape, y, x)
    return count >= _MANY


def _is_antialiased(luma: np.ndarray, same: np.ndarray) -> np.ndarray:
    """Return which pixels are between a darker and a brighter neighbour on plain surfaces.

    ``same`` marks pixels with many equal neighbours in both pictures.
    """
    steps = np.stack([_shifted(luma, y, x) - luma for y, x in _NEIGHBOURS])
    inside = np.stack([_inside(luma.shape, y, x) for y, x in _NEIGHBOURS])
    steps[~inside] = 0.0
    equal = ((steps == 0.0) & inside).sum(axis=0) + _on_edge(luma.shape)
    plain = np.stack([_shifted(same, y, x) for y, x in _NEIGHBOURS]) & inside
    darkest, brightest = steps.argmin(axis=0), steps.argmax(axis=0)
    has_both = (steps.min(axis=0) < 0.0) & (steps.max(axis=0) > 0.0)
    beside = [np.take_along_axis(plain, one[np.newaxis], 0)[0] for one in (darkest, brightest)]
    return has_both & (equal <= _FEW) & (beside[0] | beside[1])
