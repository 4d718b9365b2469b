"""The public functions that load files."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from ...base.calls import checks_types, keywords_of
from ...base.memory import NEEDS_MORE, is_lack_of_memory
from ...base.validation import flag
from ...errors import FileFormatError, InvalidArgumentError, warn
from ...model.geometry.creases import CREASE_ANGLE, check_crease_angle
from ...model.geometry.mesh import Mesh
from ...model.geometry.origins import FileOrigin, remember_origin
from ...model.materials.textures import ImageFile, Texture, remember_image_file
from ..formats.images import images_of_one_model
from .documents import Document
from .extents import extent_warnings
from .linked_files import checked_root
from .reader_registry import find_reader
from .robot_options import RobotOptionError, RobotOptions, check_robot, robot_options
from .sources import File, Source, read_source

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ...model.materials.textures import TextureOptions


# Called with the fraction of the work done; its result is ignored.
Progress = Callable[[float], object]


@checks_types
def load_mesh(
    path: File,
    *,
    format: str | None = None,
    progress: Progress | None = None,
    crease_angle: float = CREASE_ANGLE,
    root: str | os.PathLike[str] | None = None,
    **robot: Unpack[RobotOptions],
) -> Mesh:
    """Load a model as one mesh with its materials, in the file's coordinates.

    Its axes and unit are those of the file, whatever they are: `load` turns files upright.

    Parameters
    ----------
    path : str, path-like, bytes, binary file object or Traversable
        See `engine3d.loaders.formats` for the formats. Files compressed by gzip are unpacked. A str
        may be an address, such as ``"https://…"``, which the package fsspec reads. Bytes are the
        content itself; without a folder, material libraries and textures are not found.
    format : str, optional
        The format's name, such as ``"obj"``; by default detected by content and name.
    progress : callable, optional
        ``progress(fraction)`` is called with the fraction of the work done: 0.0 once the file is
        open, 1.0 at the end, never decreasing. OBJ files call it every four megabytes; most formats
        only at the start and end. An exception from it ends loading.
    crease_angle : float, optional
        Radians, 0 to pi, for files with neither normals nor smoothing groups: edges whose triangles
        meet at a greater angle are drawn sharp, others smooth. 35 degrees by default; pi makes all
        edges smooth, 0 makes all faces flat.
    root : path-like, optional
        A second folder, besides the model's own, in which files named in the model are allowed,
        such as images in ``../images``. Relative names are also searched there. For a model given
        as bytes, it is the only folder searched. For a robot, it may hold packages.
    **robot
        Of robots (URDF): ``joints``, a dict of names and values, where joints stand (radians of
        turning, metres of sliding ones, others as in `Robot.set_joint`; 0 by default); and
        ``shapes``, ``"visual"`` (the default), ``"collision"`` or ``"both"``: what shows the links.

    Returns
    -------
    mesh : Mesh
        All objects of the file joined, triangles in file order. ``mesh.warnings`` lists what was
        omitted or replaced (such as a missing texture), and each is issued as `Engine3DWarning`.

    Raises
    ------
    FileAccessError
        The file cannot be read.
    FileFormatError
        The file is damaged or of an unknown format; the message names file and line.
    InvalidArgumentError
        ``format`` is unknown, or ``path`` has a wrong type.
    """
    given = robot_options("load_mesh", keywords_of(load_mesh), robot)
    root = checked_root(root)
    with read_source(path) as source:
        source = source._replace(crease_angle=check_crease_angle(crease_angle), root=root, **given)
        document = _read_document(source, format, progress, split=False)
    return whole_mesh(document, source, format)


@checks_types
def load_document(
    path: File,
    *,
    format: str | None = None,
    progress: Progress | None = None,
    companion: Callable[[str], bool] | None = None,
    crease_angle: float = CREASE_ANGLE,
    values: bool = True,
    root: str | os.PathLike[str] | None = None,
    **robot: Unpack[RobotOptions],
) -> Document:
    """Load everything in a model file: its objects one by one, lights and cameras.

    Other parameters and exceptions are those of `load_mesh`.

    Parameters
    ----------
    companion : callable, optional
        ``companion(path)`` returns whether an image beside a model without materials may become its
        texture by name alone (`companion_texture`); by default any may.
    values : bool
        Whether to read custom numbers of vertices and faces into ``mesh.values``: properties of PLY
        files, attributes of glTF files whose names begin with ``_``.
    """
    given = robot_options("load_document", keywords_of(load_document), robot)
    root = checked_root(root)
    with read_source(path) as source:
        source = source._replace(
            crease_angle=check_crease_angle(crease_angle),
            values=flag(values, "values"),
            root=root,
            **given,
        )
        if companion is not None:
            source = source._replace(companion=companion)
        document = _read_document(source, format, progress, split=True)
    if companion is None:
        parts_of(document, source, format)
    return document


def whole_mesh(document: Document, source: Source, format: str | None) -> Mesh:
    """Return all meshes of a document as one, with the file as its origin."""
    meshes = [entry.mesh for entry in document.objects]
    with _faults_of(source):
        mesh = meshes[0] if len(meshes) == 1 else Mesh.concatenate(meshes)
    mesh.name = mesh.name or source.stem
    mesh.warnings = list(document.warnings)
    _remember(mesh, document, source, format, None)
    return mesh


def parts_of(document: Document, source: Source, format: str | None) -> dict[tuple[str, int], Mesh]:
    """Return the meshes of a document, with their parts of the file as origins.

    A part is named by the object's name and its index among objects with that name.
    """
    parts: dict[tuple[str, int], Mesh] = {}
    seen: dict[str, int] = {}
    for name, mesh, _ in document.objects:
        part = name, seen.get(name, 0)
        seen[name] = part[1] + 1
        parts[part] = mesh
        _remember(mesh, document, source, format, part)
    return parts


def _remember(
    mesh: Mesh,
    document: Document,
    source: Source,
    format: str | None,
    part: tuple[str, int] | None,
) -> None:
    """Record which part of a file a mesh is, unless the file alone could not give it again.

    Scene files have no named parts, and content from another root can only be read with that root.
    """
    if source.has_path and document.scene is None and source.root is None:
        origin = FileOrigin(
            os.path.abspath(source.path), format, part, crease_angle=source.crease_angle
        )
        remember_origin(mesh, origin)


@checks_types
def load_texture(
    path: File, *, format: str | None = None, **options: Unpack[TextureOptions]
) -> Texture:
    """Load an image as a texture.

    Parameters
    ----------
    path : str, path-like, bytes, binary file object or Traversable
        TGA, PNG, JPEG and other formats of Pillow. Bytes are the content itself.
    format : str, optional
        The format's name, such as ``"tga"``; by default detected by content and name.
    **options
        Passed to `Texture`: ``color_space``, ``filter``, ``wrap``, ``name``, ``anisotropy``,
        ``lod_bias``.

    Raises
    ------
    FileAccessError
        The file cannot be read.
    FileFormatError
        The file is damaged, too large, or not an image.
    InvalidArgumentError
        ``format`` is unknown, or ``path`` has a wrong type.
    """
    with read_source(path) as source:
        return texture_of(source, format, **options)


def texture_of(
    source: Source,
    format: str | None = None,
    *,
    is_data: bool = False,
    **options: Unpack[TextureOptions],
) -> Texture:
    """Return the texture of an open image; otherwise as `load_texture`.

    If pixels are light, data and linear colours get codes proportional to it.
    """
    with _memory_of(source):
        reader = find_reader(source, "image", format)
    is_data = is_data or options.get("color_space") == "linear"
    with _faults_of(source):
        read = (reader.read_linear if is_data else None) or reader.read
        pixels = read(source)
    options.setdefault("name", os.path.basename(source.path) if source.has_name else "")
    texture = Texture(pixels, **options)
    if source.has_path:
        remember_image_file(texture, ImageFile(os.path.abspath(source.path)))
    return texture


def _read_document(
    source: Source, format: str | None, progress: Progress | None, *, split: bool
) -> Document:
    if progress is not None:
        source = source._replace(progress=progress)
    document = document_of(source, format, split=split)
    check_robot(source, document)
    for message in document.warnings:
        warn(message)
    return document


def document_of(source: Source, format: str | None, *, split: bool) -> Document:
    """Return the document of an open model file, without issuing warnings."""
    with _memory_of(source):
        reader = find_reader(source, "mesh", format)
    source.progress(0.0)
    # Out-of-range numbers become infinite, and are handled as such.
    with _faults_of(source), np.errstate(all="ignore"), images_of_one_model():
        document = reader.read(source, split=split)
        document.warnings.extend(extent_warnings(document))
    document.up = reader.up or document.up
    source.progress(1.0)
    return document


@contextlib.contextmanager
def _memory_of(source: Source) -> Iterator[None]:
    """Name the file if there is no memory for it, or for its reader's library."""
    try:
        yield
    except (MemoryError, ImportError, OSError) as error:
        if is_lack_of_memory(error):
            raise FileFormatError(NEEDS_MORE, source.path) from error
        raise


@contextlib.contextmanager
def _faults_of(source: Source) -> Iterator[None]:
    """Name the file in errors about its content."""
    try:
        with _memory_of(source):
            yield
    except RobotOptionError as error:
        raise RobotOptionError(f"{source.path}: {error}") from None
    except InvalidArgumentError as error:  # a count exceeds what a mesh can hold
        raise FileFormatError(str(error), source.path) from error
