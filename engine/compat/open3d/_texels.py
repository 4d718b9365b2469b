"""Textures as OpenGL samples them for Open3D: bilinear, black beyond the edges.

In: images, texture coordinates. Out: colours as displayed.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def texels(
    images: list[NDArray[np.uint8]], numbers: NDArray[np.intp], uvs: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return colours, (N, 3), of texture coordinates, (N, 2).

    Parameters
    ----------
    images : list of (H, W, C) uint8
        The first row lies at v = 0.
    numbers : (N,) int
        The image of each; samples of images that are not there are black.
    uvs : (N, 2) float64
    """
    colors = np.zeros((len(uvs), 3))
    for number, image in enumerate(images):
        where = np.flatnonzero(numbers == number)
        colors[where] = _sampled(_rgb(image), uvs[where])
    return colors


def _rgb(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return red, green and blue: an image of one channel is red, as OpenGL's GL_RED is."""
    if image.shape[2] >= 3:
        return image[..., :3]
    missing = np.zeros((*image.shape[:2], 3 - image.shape[2]), np.uint8)
    return np.concatenate([image, missing], axis=2)


def _sampled(image: NDArray[np.uint8], uvs: NDArray[np.float64]) -> NDArray[np.float64]:
    height, width = image.shape[:2]
    bordered = np.zeros((height + 2, width + 2, 3))
    bordered[1:-1, 1:-1] = image
    u = np.clip(np.nan_to_num(uvs[:, 0]) * width + 0.5, 0.0, width + 1.0)
    v = np.clip(np.nan_to_num(uvs[:, 1]) * height + 0.5, 0.0, height + 1.0)
    column, row = (
        np.minimum(np.floor(at), most).astype(np.intp) for at, most in ((u, width), (v, height))
    )
    across, down = (u - column)[:, np.newaxis], (v - row)[:, np.newaxis]
    upper = bordered[row, column] * (1.0 - across) + bordered[row, column + 1] * across
    lower = bordered[row + 1, column] * (1.0 - across) + bordered[row + 1, column + 1] * across
    return (upper * (1.0 - down) + lower * down) / 255.0
