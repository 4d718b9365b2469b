"""Finds the pictures that an example of the site drew.

Sphinx-Gallery calls it after each block of an example. In: the block's names. Out: the
frames and canvases among them that no block before had, as PNG files, and the reStructuredText
that shows them.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from sphinx_gallery.scrapers import figure_rst

from engine3d import Canvas, Frame


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
        paths = []
        for thing in list(block_vars["example_globals"].values()):
            if not isinstance(thing, (Canvas, Frame)) or any(thing is old for old in self._shown):
                continue
            self._shown.append(thing)
            path = Path(next(block_vars["image_path_iterator"]))
            path.write_bytes(thing._repr_png_())
            paths.append(str(path))
        return figure_rst(paths, gallery_conf["src_dir"])
