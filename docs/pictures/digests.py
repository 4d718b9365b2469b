"""Digests of pictures, by which a compressed file is known to show what is drawn now.

In: pictures by name, and a JSON file. Out: whether a picture is the one whose digest is recorded.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import numpy as np


class Digests:
    """The digests that a JSON file records, by the names of the pictures."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def knows(self, name: str, picture: np.ndarray) -> bool:
        """Whether a picture, (…, H, W, 3 or 4) uint8, is the one that was recorded."""
        return self._known().get(name) == _digest(picture)

    def record(self, name: str, picture: np.ndarray) -> None:
        known = self._known() | {name: _digest(picture)}
        self.path.write_text(json.dumps(known, indent=2, sort_keys=True) + "\n")

    def keep(self, names: set[str]) -> None:
        """Drop all others."""
        known = {name: one for name, one in self._known().items() if name in names}
        self.path.write_text(json.dumps(known, indent=2, sort_keys=True) + "\n")

    def _known(self) -> dict[str, str]:
        return json.loads(self.path.read_text()) if self.path.exists() else {}


def _digest(picture: np.ndarray) -> str:
    pixels = np.ascontiguousarray(picture[..., :3])
    return hashlib.sha256(str(pixels.shape).encode() + pixels.tobytes()).hexdigest()
