"""Pictures of linear light, by what they begin with: Radiance or OpenEXR."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import FileFormatError
from .sources import Source

_OPENEXR = b"\x76\x2f\x31\x01"


def load_radiance(source: Source) -> NDArray[np.float32]:
    """Decode a picture.

    Returns
    -------
    pixels : (H, W, 3) float32
        Linear light, the top row first.

    Raises
    ------
    FileFormatError, FileAccessError
    """
    if source.head(2) == b"#?":
        from .hdr import read_hdr

        return read_hdr(source)
    if source.head(4) == _OPENEXR:
        from .exr import read_exr

        return read_exr(source)
    raise FileFormatError(
        "neither a Radiance picture (.hdr) nor OpenEXR (.exr) by its first bytes", source.path
    )
