"""The folders around a folder."""

from __future__ import annotations

import os
from collections.abc import Iterator


def folders_above(folder: str) -> Iterator[str]:
    """Yield a folder and those around it.

    The last one is the root, whose folder is itself: that of a drive or a share on Windows, which
    need not exist. Around a relative folder it is the empty path.
    """
    while True:
        yield folder
        above = os.path.dirname(folder)
        if above == folder:
            return
        folder = above
