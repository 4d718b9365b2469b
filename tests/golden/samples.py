"""Small pictures for the tests of golden images."""

import numpy as np

from engine3d.base.files.png import encode_pixels


def colors(height=6, width=8, channels=4, dtype=np.uint8, seed=0):
    """Random codes."""
    generator = np.random.default_rng(seed)
    top = np.iinfo(dtype).max
    return generator.integers(0, top, (height, width, channels), dtype, endpoint=True)


def changed(pixels, x=3, y=2, by=1):
    """The same but for one pixel."""
    other = pixels.copy()
    other[y, x] += np.array(by).astype(pixels.dtype)
    return other


def write_png(path, pixels):
    """Write a PNG as any program would, without chunks of our own."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(encode_pixels(pixels))
    return path


def slope(shift):
    """A black area under a slope, its edge smoothed."""
    y, x = np.mgrid[0:20, 0:30]
    covered = np.clip(y - 0.45 * x - 3.0 - shift, 0.0, 1.0)
    picture = np.full((20, 30, 4), 255, np.uint8)
    picture[..., :3] = (255 * (1 - covered) + 0.5).astype(np.uint8)[..., np.newaxis]
    return picture
