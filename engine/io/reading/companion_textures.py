"""The image that belongs to a model by its name alone.

``head.obj`` without materials gets ``head_diffuse.png`` or ``head.tga`` beside it as its texture.
Of the images that bear the model's very name only TGA counts: others are as likely pictures of the
model. So is a TGA that engine3d wrote; it says so.
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
    """Return the path of the image beside a model that bears its name, or None.

    Parameters
    ----------
    path : str or path-like
        The model, such as ``head.obj``.
    accept : callable, optional
        ``accept(image)``: whether an image may be taken; the next one is looked for if not.

    Returns
    -------
    image : str or None
        The first that exists of ``head.tga`` and of ``head_diffuse``, ``head_texture``,
        ``head_color``, ``head_albedo``, ``head_basecolor``, each as TGA, PNG, JPEG and then the
        other formats. A TGA file that engine3d wrote is none.
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
        return False  # whoever takes it says what is wrong with it
