"""A model file, opened as a `Subject`.

In: a path, and a texture or a colour for what the file leaves without. Out: a subject with a
neutral background, the up direction usual for the format, and the file's counts and warnings.
"""

from __future__ import annotations

import os
import warnings

from ..errors import Engine3DWarning
from ..loaders import companion_texture, load_document, load_texture
from ..materials import Material
from ..scene_loading import scene_from_document
from .subject import Subject

#: Formats whose models, by custom, stand on the XY plane.
Z_UP_FORMATS = ("asc", "stl")
BACKGROUND = (43, 46, 53)


def open_model(path, *, texture=None, color=None, progress=None) -> Subject:
    """Load a file to look at.

    Parameters
    ----------
    path : path-like or binary file object
        A file of any format that `engine3d.loaders` reads.
    texture : path-like, optional
        The base colour texture of the meshes without materials. Left out, an image beside the
        model that bears its name is taken.
    color : (3,) sequence, optional
        The base colour of the meshes without materials. If there are none, that is warned of.
    progress : callable, optional
        As in `engine3d.load_mesh`.

    Returns
    -------
    Subject

    Raises
    ------
    FileFormatError, FileAccessError
        The file (or the texture asked for) cannot be read.
    """
    document = load_document(path, progress=progress)
    path = None if hasattr(path, "read") else os.fspath(path)
    bare = [mesh for _, mesh, _ in document.objects if not has_materials(mesh)]
    if bare:
        image = texture
        if image is None and color is None and path is not None:
            image = companion_texture(path)
        _dress(bare, image, color)
    elif texture is not None or color is not None:
        message = "the model has materials of its own: it gets no other texture or colour"
        warnings.warn(message, Engine3DWarning, stacklevel=2)
    scene = scene_from_document(document)
    scene.background = BACKGROUND
    return Subject(
        scene,
        "model" if path is None else os.path.basename(path),
        up="+Z" if document.format in Z_UP_FORMATS else "+Y",
        path=path,
        details=document_lines(document),
        warnings=list(document.warnings),
    )


def has_materials(mesh) -> bool:
    """Return whether a mesh brought materials, rather than the default one."""
    default = mesh.materials[0]
    return len(mesh.materials) > 1 or bool(default.name) or default.texture is not None


def _dress(meshes, image, color) -> None:
    """Give the meshes a material with the image and the colour."""
    if image is None and color is None:
        return
    surface = {}
    if image is not None:
        surface["texture"] = load_texture(image)
    if color is not None:
        surface["color"] = color
    for mesh in meshes:
        # The facets of an STL file stay flat.
        mesh.materials = [Material(**surface, flat_shading=mesh.materials[0].flat_shading)]


def document_lines(document) -> list[str]:
    """Return the format and the counts of a document, a line each."""
    lines = [f"{'format':<12}{document.format:>11}"]
    for name, entries in document.counts.items():
        count = entries if isinstance(entries, int) else len(entries)
        if count:
            lines.append(f"{name:<12}{count:>11,d}")
    return lines
