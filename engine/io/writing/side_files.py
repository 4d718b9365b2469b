"""Names of the files beside a written model: its material library, and the library's images.

In: the path of an OBJ file. Out: paths beside it that are free, or were written by engine3d for
this model before. Files of others are never replaced: the user did not choose these names.
"""

from __future__ import annotations

import os

from ...errors import Engine3DError
from ..formats.obj.mtl_statements import parse_map
from ..reading.sources import read_source
from .written_names import linkable_stem

LIBRARY_MARK = b"# written by engine3d\n"
# Bytes of an old library that are searched for image names.
_MOST_READ = 1 << 22


class SideFiles:
    """Names beside one model.

    Parameters
    ----------
    path : str
        The model.

    Attributes
    ----------
    library : str
        The path of the material library.
    folder : str
        The folder of the files.
    """

    def __init__(self, path: str) -> None:
        self._folder = os.path.dirname(path)
        self.folder = self._folder or os.curdir
        self._stem = linkable_stem(path)
        self._next = 0
        self._old_images: set[str] = set()
        self.library = self._find_library()

    @property
    def usual_library(self) -> str:
        """Return the library's usual path, even if another file has that name."""
        return os.path.join(self._folder, f"{self._stem}.mtl")

    def next_image(self) -> str:
        """Return a path for one more PNG file."""
        while True:
            name = f"{self._stem}_{self._next}.png"
            self._next += 1
            path = os.path.join(self._folder, name)
            if name in self._old_images or not os.path.lexists(path):
                return path

    def _find_library(self) -> str:
        path, number = self.usual_library, 0
        while os.path.lexists(path):
            text = _start_of(path)
            if text.startswith(LIBRARY_MARK):
                self._old_images = _images_of(text)
                break
            number += 1
            path = os.path.join(self._folder, f"{self._stem}_{number}.mtl")
        return path


def _start_of(path: str) -> bytes:
    try:
        with read_source(path) as source:
            return source.head(_MOST_READ)
    except Engine3DError:
        return b""


def _images_of(library: bytes) -> set[str]:
    """Return the images that one of our own libraries uses as textures."""
    lines = (line.partition(b" ") for line in library.splitlines())
    values = [value for keyword, _, value in lines if keyword == b"map_Kd"]
    return {parse_map(value.decode(errors="replace"))["name"] for value in values}
