"""Open3D's environments: cube maps of floats in KTX files.

In: the name of a file. Out: an `Environment`. The layout is that of the KTX 1 specification, faces
as in OpenGL (+X, -X, +Y, -Y, +Z, -Z), texels as 11 + 11 + 10 bits.
"""

from __future__ import annotations

import functools
import math
import struct
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ....base import linalg
from ....errors import FileAccessError, FileFormatError
from ....model.environments.environment import Environment

_MAGIC = b"\xabKTX 11\xbb\r\n\x1a\n"
_R11G11B10 = 0x8C3A
_HEIGHT = 256


@functools.lru_cache(8)
def environment_of_ktx(path: str) -> Environment:
    """Return the environment of a KTX file, its first mip level.

    Raises
    ------
    FileAccessError, FileFormatError
    """
    try:
        data = Path(path).read_bytes()
    except OSError as error:
        raise FileAccessError(error.strerror or "cannot be read", path) from None
    return Environment(_equirectangular(_faces(data, path)), name=Path(path).stem)


def _faces(data: bytes, path: str) -> NDArray[np.float32]:
    """Return the six faces, (6, S, S, 3), the first row at the top."""
    if len(data) < 64 or data[:12] != _MAGIC:
        raise FileFormatError("no KTX file", path)
    numbers = struct.unpack_from("<13I", data, 12)
    internal, width, height, faces, extra = (numbers[at] for at in (4, 6, 7, 10, 12))
    start = 64 + extra + 4
    size = width * height * 4
    if internal != _R11G11B10 or faces != 6 or width != height or not width:
        raise FileFormatError("no cube map of 11 and 10 bits", path)
    if len(data) < start + 6 * size:
        raise FileFormatError("the file is cut off", path)
    texels = np.frombuffer(data, "<u4", 6 * width * height, start)
    channels = [_small_floats(texels >> at & (1 << bits) - 1, bits - 5) for at, bits in _LAYOUT]
    return np.stack(channels, axis=-1).reshape(6, height, width, 3)


_LAYOUT = ((0, 11), (11, 11), (22, 10))


def _small_floats(values: NDArray[np.uint32], mantissa_bits: int) -> NDArray[np.float32]:
    """Return floats without a sign, with 5 bits of exponent; infinite ones are the largest."""
    mantissa = (values & (1 << mantissa_bits) - 1).astype(np.float64) / (1 << mantissa_bits)
    exponent = np.minimum(values >> mantissa_bits, 30).astype(np.int64)
    small = np.ldexp(mantissa, -14)
    return np.where(exponent == 0, small, np.ldexp(1.0 + mantissa, exponent - 15)).astype(
        np.float32
    )


def _equirectangular(faces: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return a cube map as an equirectangular picture, bilinearly sampled."""
    height, width, side = _HEIGHT, 2 * _HEIGHT, faces.shape[1]
    turn = (np.arange(width) + 0.5) / width * (2.0 * math.pi) - math.pi
    rise = math.pi / 2.0 - (np.arange(height) + 0.5) / height * math.pi
    level = linalg.cos(rise)[:, np.newaxis]
    x, z = level * linalg.cos(turn), level * linalg.sin(turn)
    y = np.broadcast_to(linalg.sin(rise)[:, np.newaxis], x.shape)
    face, s, t = _on_faces(x, y, z)
    column = np.clip((s * 0.5 + 0.5) * side - 0.5, 0.0, side - 1.0)
    row = np.clip((t * 0.5 + 0.5) * side - 0.5, 0.0, side - 1.0)
    left, top = (np.minimum(at.astype(np.intp), max(side - 2, 0)) for at in (column, row))
    right, low = np.minimum(left + 1, side - 1), np.minimum(top + 1, side - 1)
    across, down = (column - left)[..., np.newaxis], (row - top)[..., np.newaxis]
    upper = faces[face, top, left] * (1.0 - across) + faces[face, top, right] * across
    lower = faces[face, low, left] * (1.0 - across) + faces[face, low, right] * across
    return (upper * (1.0 - down) + lower * down).astype(np.float32)


def _on_faces(x, y, z):
    """Return the face of each direction, and where there, from -1 to 1 to the right and down."""
    ax, ay, az = abs(x), abs(y), abs(z)
    on_x, on_y = (ax >= ay) & (ax >= az), (ay > ax) & (ay >= az)
    face = np.where(on_x, np.where(x > 0, 0, 1), 0)
    face = np.where(on_y, np.where(y > 0, 2, 3), face)
    face = np.where(on_x | on_y, face, np.where(z > 0, 4, 5))
    longest = np.where(on_x, ax, np.where(on_y, ay, az))
    s = np.select([face == 0, face == 1, face == 5], [-z, z, -x], x) / longest
    t = np.select([face == 2, face == 3], [z, -z], -y) / longest
    return face, s, t
