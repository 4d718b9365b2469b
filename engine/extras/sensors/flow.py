"""Optical flow: how far the surface points of a picture's pixels move to another picture.

In: vectors and masks, from `Moment.flow_to`. Out: pictures of them, and the other picture warped.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...base.calls import checks_types
from ...base.numbers import as_array
from ...base.validation import optional_positive
from ...errors import InvalidArgumentError
from ...io.output.value_files import save_values

# Steps between the colours of the wheel: red, yellow, green, cyan, blue, magenta, red.
_STEPS = 15, 6, 4, 11, 13, 6


@dataclass(frozen=True)
class Flow:
    """How far what each pixel of a picture shows is from there in another picture.

    Attributes
    ----------
    vectors : (H, W, 2) float32
        Pixels to the right and down, from the place in this picture to that in the other; 0 where
        it is not known. The point at (x, y) of this picture is at ``(x, y) + vectors`` of the
        other, which may be outside of it.
    known : (H, W) bool
        Where the picture shows a triangle that also exists at the other moment, before the other
        camera; or an environment, which is infinitely far away, as background of both. Not where
        lines, points or a plain background show.
    visible : (H, W) bool
        Where the other picture shows the same point: it lies in that picture, and nothing is before
        it there.
    """

    vectors: NDArray[np.float32]
    known: NDArray[np.bool_]
    visible: NDArray[np.bool_]

    @property
    def occluded(self) -> NDArray[np.bool_]:
        """(H, W) bool: known, but not visible in the other picture."""
        return self.known & ~self.visible

    @checks_types
    def colors(self, largest: float | None = None) -> NDArray[np.uint8]:
        """Return the flow as a picture: the direction as hue, the length as saturation.

        Parameters
        ----------
        largest : float, optional
            The length, in pixels, of full saturation; by default the picture's largest.

        Returns
        -------
        (H, W, 3) uint8
            White where nothing moves, black where the flow is not known.

        Notes
        -----
        The wheel of Baker et al., "A database and evaluation methodology for optical flow" (2011),
        of the Middlebury benchmark; here it is closed, so that motion to the right has no seam.
        """
        u, v = self.vectors.astype(np.float64).reshape(-1, 2).T
        lengths = np.sqrt(u * u + v * v)
        most = optional_positive(largest, "largest") or lengths.max(initial=0.0) or 1.0
        share = np.minimum(lengths / most, 1.0)[:, np.newaxis]
        wheel = _wheel()
        turns = (linalg.atan2(-v, -u) / math.pi + 1.0) * (0.5 * len(wheel))
        turns = np.where(turns >= len(wheel), 0.0, turns)  # to the right
        low = turns.astype(np.intp)
        rest = (turns - low)[:, np.newaxis]
        hue = wheel[low] * (1.0 - rest) + wheel[(low + 1) % len(wheel)] * rest
        colors = np.floor((1.0 - share * (1.0 - hue)) * 255.0).astype(np.uint8)
        colors[~self.known.reshape(-1)] = 0
        return colors.reshape(*self.known.shape, 3)

    @checks_types
    def warp(self, picture: ArrayLike) -> NDArray[np.float32]:
        """Return the other picture as it looks from here: read where each pixel has gone.

        Parameters
        ----------
        picture : (h, w) or (h, w, channels) number
            Of the other moment.

        Returns
        -------
        (H, W) or (H, W, channels) float32
            Interpolated between its four pixels; outside of it, its edge. Where ``visible`` is
            false, it shows something else.

        Raises
        ------
        InvalidArgumentError
        """
        other = as_array(picture, "picture")
        if other.ndim not in (2, 3) or 0 in other.shape or other.dtype.kind not in "buif":
            raise InvalidArgumentError("picture must be (H, W) or (H, W, channels) numbers")
        rows, columns = np.indices(self.known.shape)
        x = columns + self.vectors[..., 0].astype(np.float64)
        y = rows + self.vectors[..., 1].astype(np.float64)
        height, width = other.shape[:2]
        if ((x >= width) | (y >= height))[self.visible].any():
            raise InvalidArgumentError(
                "picture must be that of the other moment: "
                f"visible pixels go beyond {width} x {height}"
            )
        x, y = np.clip(x, 0, width - 1), np.clip(y, 0, height - 1)
        left, top = np.floor(x).astype(np.intp), np.floor(y).astype(np.intp)
        right = np.minimum(left + 1, other.shape[1] - 1)
        low = np.minimum(top + 1, other.shape[0] - 1)
        extra = (1,) * (other.ndim - 2)
        across, down = ((one - np.floor(one)).reshape(*one.shape, *extra) for one in (x, y))
        above = other[top, left] * (1.0 - across) + other[top, right] * across
        below = other[low, left] * (1.0 - across) + other[low, right] * across
        return (above * (1.0 - down) + below * down).astype(np.float32)

    @checks_types
    def save(self, path: str | os.PathLike[str], *, only_visible: bool = False) -> None:
        """Write the flow to a file.

        Parameters
        ----------
        path : path-like
            The suffix decides the format: .flo (Middlebury), .png (KITTI, 16 bits, steps of 1/64
            pixel), .pfm (three channels, the third 0), .exr (channels R and G), .npy or .npz.
        only_visible : bool
            Mark what the other picture does not show as unknown, too.

        Raises
        ------
        InvalidArgumentError, FileAccessError
        """
        save_values(path, self.vectors, valid=self.visible if only_visible else self.known)


def _wheel() -> NDArray[np.float64]:
    """Return the colours of the directions, (55, 3) from 0 to 1."""
    corners = np.array([(1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1), (1, 0, 1)], float)
    rows = []
    for number, steps in enumerate(_STEPS):
        start, end = corners[number], corners[(number + 1) % 6]
        share = np.floor(255.0 * np.arange(steps) / steps)[:, np.newaxis] / 255.0
        rows.append(start + (end - start) * share)
    return np.concatenate(rows)
