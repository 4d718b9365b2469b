"""Companion textures: images that belong to a model by name only.

``head.obj`` without materials uses ``head_diffuse.png`` or ``head.tga`` beside it as texture. Of
images with exactly the model's name only TGA counts: other formats are as likely pictures of the
model. A TGA written by engine3d is also a picture; a mark in it says so.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator

from ...base.calls import checks_types
from ...errors import Engine3DError
from ...rendering.picture_mark import MARKED_BYTES, is_own_picture
from .linked_files import LinkedFileError, LinkedFiles
from .reader_registry import formats
from .sources import stem_and_extension

_SUFFIXES = ("_diffuse", "_texture", "_color", "_albedo", "_basecolor")
_PREFERRED = (".tga", ".png", ".jpg", ".jpeg")


@checks_types
def companion_texture(
    path: str | os.PathLike[str], accept: Callable[[str], bool] | None = None
) -> str | None:
    """Return the path of a model's companion texture, or None.

    Parameters
    ----------
    path : str or path-like
        The model, such as ``head.obj``.
    accept : callable, optional
        ``accept(image)`` returns whether to use an image; if not, the next one is tried.

    Returns
    -------
    image : str or None
        The first existing one of ``head.tga`` and of ``head_diffuse``, ``head_texture``,
        ``head_color``, ``head_albedo``, ``head_basecolor``, each as TGA, PNG, JPEG and then the
        other formats. TGA files written by engine3d are skipped.
    """
    path = os.fsdecode(path)
    folder, stem = os.path.dirname(path), stem_and_extension(path)[0]
    try:
        present = {entry.lower(): entry for entry in sorted(os.listdir(folder or "."))}
    except (OSError, ValueError):
        return None
    files = LinkedFiles(folder or ".")
    for name in _names(stem):
        entry = present.get(name.lower())
        if entry is None:
            continue
        try:
            image = files.find(entry)
        except LinkedFileError:
            continue
        if (accept is None or accept(image)) and not _is_own_picture(files, image):
            return image
    return None


def _names(stem: str) -> Iterator[str]:
    others = (e for image in formats("image") for e in image.extensions if e not in _PREFERRED)
    extensions = (*_PREFERRED, *others)
    yield f"{stem}.tga"
    for suffix in _SUFFIXES:
        for extension in extensions:
            yield stem + suffix + extension


def _is_own_picture(files: LinkedFiles, image: str) -> bool:
    if not image.lower().endswith(".tga"):
        return False
    try:
        with files.read(image) as source:
            return is_own_picture(source.head(MARKED_BYTES))
    except Engine3DError:
        return False  # reading it later reports the fault
