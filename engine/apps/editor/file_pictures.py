"""Thumbnails of model and image files, for file dialogs.

In: paths. Out: pixels, some time later: a separate thread loads and draws. Models look as with
``engine3d render``. The latest request is served first. Large or unreadable files have no
thumbnail.
"""

from __future__ import annotations

import os
import threading
from collections import OrderedDict
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ...base.side_by_side import Thread
from ...io.loaders import formats
from ...io.reading.loading import document_of, texture_of
from ...io.reading.sources import read_source, stem_and_extension
from ...stage.near_origin import moved_near
from ...stage.open_model import view_document
from ...stage.view_renderer import ViewRenderer
from ...stage.viewed_thing import settings_for
from .thumbnails import shrunk

#: Files above this size in bytes have no thumbnail.
LARGEST = 8 << 20
#: Number of thumbnails kept.
MOST = 64
#: Formats read by a separate process, which takes seconds.
_SLOW = frozenset({"trimesh", "step", "iges"})


class FilePictures:
    """Draws thumbnails of files, and caches them.

    Parameters
    ----------
    size : int
        Width and height in pixels.
    """

    def __init__(self, size: int = 160) -> None:
        self._size = size
        self._pictures: OrderedDict[tuple, NDArray[np.uint8] | None] = OrderedDict()
        self._wanted: tuple | None = None
        self._changed = threading.Condition()
        self._thread: Thread | None = None

    def get(self, path: str) -> tuple[NDArray[np.uint8] | None, bool]:
        """Return a file's thumbnail, (size, size, 4) uint8, and whether it is pending."""
        key = _key(path)
        if key is None:
            return None, False
        with self._changed:
            if key in self._pictures:
                self._pictures.move_to_end(key)
                return self._pictures[key], False
            self._wanted = key
            if self._thread is None:
                self._thread = Thread(target=self._work, daemon=True)
                self._thread.start()
            self._changed.notify()
        return None, True

    def _work(self) -> None:
        """Draw requested thumbnails, forever."""
        while True:
            with self._changed:
                while self._wanted is None:
                    self._changed.wait()
                key, self._wanted = self._wanted, None
            picture = _drawn(key[0], self._size)
            with self._changed:
                self._pictures[key] = picture
                while len(self._pictures) > MOST:
                    self._pictures.popitem(last=False)


def _key(path: str) -> tuple | None:
    """Return a key of a file's current state; None if it has no thumbnail."""
    if _drawer(path) is None:
        return None
    try:
        status = os.stat(path)
    except (OSError, ValueError):
        return None
    return (path, status.st_mtime_ns, status.st_size) if status.st_size <= LARGEST else None


def _drawer(path: str) -> Callable[[str, int], NDArray[np.uint8]] | None:
    extension = stem_and_extension(path)[1]
    if any(extension in entry.extensions for entry in formats("image")):
        return _draw_image
    meshes = (entry for entry in formats("mesh") if entry.name not in _SLOW)
    return _draw_model if any(extension in entry.extensions for entry in meshes) else None


def _drawn(path: str, size: int) -> NDArray[np.uint8] | None:
    try:
        draw = _drawer(path)
        return None if draw is None else draw(path, size)
    except Exception:  # whatever the error, the file has no thumbnail, and the thread goes on
        return None


def _draw_image(path: str, size: int) -> NDArray[np.uint8]:
    with read_source(path) as source:
        return shrunk(texture_of(source), size)


def _draw_model(path: str, size: int) -> NDArray[np.uint8]:
    with read_source(path) as source:
        document = document_of(source, None, split=True)
    viewed = moved_near(view_document(document, path))
    settings = settings_for("studio")
    quality = {"samples": 4, "antialiasing": "msaa", "threads": 1}
    with ViewRenderer(viewed, settings, (size, size), **quality) as view_renderer:
        view = view_renderer.view()
        view_renderer.fill(view)
        return view_renderer.draw(view).color.copy()
