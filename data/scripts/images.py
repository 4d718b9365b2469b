"""Painting textures with arithmetic, and writing them as TGA or WebP.

In: float64 arrays, colours as sRGB values in [0, 1]. Out: bytes of files.
Pictures are functions of texture coordinates, sampled several times a pixel: `u` runs to the
right and `v` upwards, as in OBJ files.
"""

import io

import numpy as np
from PIL import Image


def rgb(code):
    """Turn "#1e6fa8" into three numbers in [0, 1]."""
    return np.array([int(code[k : k + 2], 16) / 255.0 for k in (1, 3, 5)])


def clamp(x):
    return np.minimum(np.maximum(x, 0.0), 1.0)


def smoothstep(low, high, x):
    """Rise smoothly from 0 at `low` to 1 at `high` (or fall, if `high` is the lower one)."""
    t = clamp((x - low) / (high - low))
    return t * t * (3.0 - 2.0 * t)


def lerp(a, b, amount):
    """Blend numbers; `amount` 0 gives `a`."""
    return a + (b - a) * amount


def mix(a, b, amount):
    """Blend colours, shape (..., 3), by amounts of shape (...); `amount` 0 gives `a`."""
    return lerp(np.asarray(a), np.asarray(b), np.asarray(amount)[..., np.newaxis])


def gradient(stops, x):
    """Look colours up on a ramp: `stops` are (position, colour) in ascending order."""
    color = np.broadcast_to(stops[0][1], (*np.shape(x), 3))
    for (low, _), (high, following) in zip(stops[:-1], stops[1:], strict=True):
        color = mix(color, following, smoothstep(low, high, x))
    return color


def bump(x, centre, width):
    """A soft line: 1 at the centre, 0 from `width` on."""
    return 1.0 - smoothstep(0.0, width, np.abs(x - centre))


def stroke(distance, half_width, softness):
    """Cover 1 within `half_width` of a curve, with an edge of `softness`."""
    return 1.0 - smoothstep(half_width - 0.5 * softness, half_width + 0.5 * softness, distance)


def paint(picture, width, height, samples=2, box=(0.0, 0.0, 1.0, 1.0)):
    """Sample a picture, `samples` squared times a pixel.

    `picture` is a function (u, v) -> (..., 3) and `box` the part (u0, v0, u1, v1) of its domain
    that fills the image. Returns float64, shape (height, width, 3), the top row first.
    """
    u0, v0, u1, v1 = box
    total = np.zeros((height, width, 3))
    for sub_y in range(samples):
        v = lerp(v1, v0, (np.arange(height) + (sub_y + 0.5) / samples) / height)
        for sub_x in range(samples):
            u = lerp(u0, u1, (np.arange(width) + (sub_x + 0.5) / samples) / width)
            total += picture(*np.meshgrid(u, v))
    return total / samples**2


def tga(pixels):
    """Encode an image in [0, 1] as a TGA file (24 bits, RLE)."""
    return _encoded(pixels, format="TGA", compression="tga_rle")


def webp(pixels):
    """Encode an image in [0, 1] as a WebP file without loss."""
    return _encoded(pixels, format="WEBP", lossless=True, quality=100, method=6)


def _encoded(pixels, **settings):
    quantised = np.floor(clamp(pixels) * 255.0 + 0.5).astype(np.uint8)
    file = io.BytesIO()
    Image.fromarray(quantised, "RGB").save(file, **settings)
    return file.getvalue()
