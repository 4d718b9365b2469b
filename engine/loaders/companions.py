"""The image that belongs to a model by its name alone.

``head.obj`` without materials gets ``head.tga`` or ``head_diffuse.tga`` beside it as its texture.
"""

from __future__ import annotations

import os

from .linked_files import LinkedFileError, LinkedFiles
from .registry import formats
from .sources import stem_and_extension

_SUFFIXES = ("", "_diffuse", "_texture", "_color", "_albedo", "_basecolor")
_PREFERRED = (".tga", ".png", ".jpg", ".jpeg")


def companion_texture(path: str | os.PathLike) -> str | None:
    """Return the path of the image beside a model that bears its name, or None.

    Parameters
    ----------
    path : str or path-like
        The model, such as ``head.obj``.

    Returns
    -------
    image : str or None
        The first that exists of ``head``, ``head_diffuse``, ``head_texture``, ``head_color``,
        ``head_albedo``, ``head_basecolor``, each as TGA, PNG, JPEG and then the other formats.
    """
    folder = os.path.dirname(os.fspath(path))
    stem = stem_and_extension(os.fspath(path))[0]
    try:
        present = {entry.lower(): entry for entry in sorted(os.listdir(folder or "."))}
    except OSError:
        return None
    files = LinkedFiles(folder or ".")
    others = (e for image in formats("image") for e in image.extensions if e not in _PREFERRED)
    extensions = (*_PREFERRED, *others)
    for suffix in _SUFFIXES:
        for extension in extensions:
            entry = present.get((stem + suffix + extension).lower())
            if entry is None:
                continue
            try:
                return files.find(entry)
            except LinkedFileError:
                continue
    return None
