"""OpenEXR files of float32 channels, uncompressed: the same bytes everywhere, without a package.

In: planes by channel name. Out: the bytes of a scan-line file.
Source: "The OpenEXR File Layout", openexr.com, written anew.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

_MAGIC, _VERSION = 20000630, 2
_FLOAT, _NOT_COMPRESSED, _INCREASING = 2, b"\0", b"\0"


def encode_exr(planes: Mapping[str, NDArray[np.float32]]) -> bytes:
    """Return an OpenEXR file of planes, each (H, W) float32, by name of the channel."""
    names = sorted(planes)
    height, width = planes[names[0]].shape
    header = struct.pack("<ii", _MAGIC, _VERSION) + _header(names, width, height)
    rows = np.stack([planes[name] for name in names], axis=1).astype("<f4")
    size = rows[0].nbytes
    start = len(header) + 8 * height
    places = start + np.arange(height, dtype="<u8") * (8 + size)
    lines = (struct.pack("<ii", row, size) + rows[row].tobytes() for row in range(height))
    return b"".join([header, places.tobytes(), *lines])


def _header(names: list[str], width: int, height: int) -> bytes:
    channels = b"".join(
        name.encode() + b"\0" + struct.pack("<iBxxxii", _FLOAT, 0, 1, 1) for name in names
    )
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    rows = (
        ("channels", "chlist", channels + b"\0"),
        ("compression", "compression", _NOT_COMPRESSED),
        ("dataWindow", "box2i", window),
        ("displayWindow", "box2i", window),
        ("lineOrder", "lineOrder", _INCREASING),
        ("pixelAspectRatio", "float", struct.pack("<f", 1.0)),
        ("screenWindowCenter", "v2f", struct.pack("<ff", 0.0, 0.0)),
        ("screenWindowWidth", "float", struct.pack("<f", 1.0)),
    )
    texts = (
        name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
        for name, kind, value in rows
    )
    return b"".join(texts) + b"\0"
