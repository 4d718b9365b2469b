"""Compares a picture with a reference file, for tests of what is drawn.

In: RGBA pixels and a file. Out: the root mean square difference of the channels, 0 to 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..loaders import load_texture


@dataclass(frozen=True)
class Comparison:
    """How far two pictures differ; the text says it in a line."""

    difference: float
    differing: int
    total: int
    sizes: tuple[tuple[int, int], tuple[int, int]]

    def __str__(self) -> str:
        (width, height), (reference_width, reference_height) = self.sizes
        if self.sizes[0] != self.sizes[1]:
            return (
                f"the picture is {width}x{height}, the reference "
                f"{reference_width}x{reference_height}"
            )
        return (
            f"the picture differs by {self.difference:.6g} "
            f"({self.differing} of {self.total} pixels)"
        )


def compare(pixels: np.ndarray, path) -> Comparison:
    """Compare ``pixels`` with the picture in a file.

    Parameters
    ----------
    pixels : (H, W, 4) ndarray of uint8
        RGBA.
    path : path-like
        Whatever `load_texture` reads.

    Returns
    -------
    Comparison
        Pictures of different sizes differ by 1.

    Raises
    ------
    FileAccessError, FileFormatError
        The reference cannot be read.
    """
    reference = load_texture(path).pixels
    height, width = pixels.shape[:2]
    sizes = ((width, height), (reference.shape[1], reference.shape[0]))
    if sizes[0] != sizes[1]:
        return Comparison(1.0, width * height, width * height, sizes)
    offsets = pixels.astype(np.int32) - reference
    squares = int((offsets * offsets).sum(dtype=np.int64))
    difference = (squares / (offsets.size * 255.0 * 255.0)) ** 0.5
    differing = int((offsets != 0).any(axis=2).sum())
    return Comparison(difference, differing, width * height, sizes)
