"""Finds the pictures that an example of the site drew.

Sphinx-Gallery calls it after each block of an example. In: the block's names, and pictures that the
block wrote to files. Out: these, and the frames, canvases and images of Pillow among the names that
no block before had, as files of the site, and the reStructuredText that shows them.
"""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from sphinx_gallery.scrapers import figure_rst

from engine3d import Canvas, Frame

KINDS = (Canvas, Frame, Image.Image)
#: The files that examples write, and that are shown.
WRITTEN = (".gif", ".png", ".webp")


class FrameScraper:
    """Remembers what it showed of the example at hand, so that each picture comes once."""

    def __init__(self) -> None:
        self._source = ""
        self._shown: list[Any] = []

    def __repr__(self) -> str:
        return "FrameScraper()"  # Sphinx compares configurations by their text

    def __call__(self, block: Any, block_vars: dict, gallery_conf: dict) -> str:
        if block_vars["src_file"] != self._source:
            self._source, self._shown = block_vars["src_file"], []
        places = block_vars["image_path_iterator"]
        written = self._written(Path(self._source).parent, places)
        drawn = self._drawn(block_vars["example_globals"], places)
        title = Path(self._source).read_text("utf-8").split("\n")[1]
        return figure_rst([*written, *drawn], gallery_conf["src_dir"], fig_titles=title)

    def _drawn(self, names: dict, places: Any) -> list[str]:
        """Write the pictures among the names, and return the paths."""
        paths = []
        for thing in list(names.values()):
            if not isinstance(thing, KINDS) or self._has(thing):
                continue
            self._shown.append(thing)
            path = Path(next(places))
            if isinstance(thing, Image.Image):
                thing.save(path)
            else:
                path.write_bytes(thing._repr_png_())
            paths.append(str(path))
        return paths

    def _written(self, folder: Path, places: Any) -> list[str]:
        """Move the pictures that the block wrote beside the example, and return the paths."""
        paths = []
        for file in sorted(each for each in folder.iterdir() if each.suffix in WRITTEN):
            path = Path(next(places)).with_suffix(file.suffix)
            shutil.move(file, path)
            paths.append(str(path))
        return paths

    def _has(self, thing: Any) -> bool:
        """Whether this was shown, also under another name: canvases draw into frames."""
        pixels = pixels_of(thing)
        return any(thing is old or np.shares_memory(pixels, pixels_of(old)) for old in self._shown)


def pixels_of(thing: Any) -> np.ndarray:
    """Return the pixels of a frame, a canvas or an image."""
    return thing.pixels if isinstance(thing, Canvas) else np.asarray(thing)
