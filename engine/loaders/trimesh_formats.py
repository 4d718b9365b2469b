"""glTF and other formats that the package trimesh reads, where it is installed.

In: the bytes of a file. Out: a `Document` with one object for each node. trimesh is imported when
the first such file is read. The files that one of them names are looked for as for any model: in
its folder only.
"""

from __future__ import annotations

import contextlib
import io
import json
import logging
import os
from urllib.parse import unquote

import numpy as np

from ..errors import Engine3DError, FileFormatError, InvalidArgumentError, printable
from ..materials import says_something
from .documents import Document, DocumentObject
from .gltf_limits import announced
from .linked_files import LinkedFileError, LinkedFiles
from .linked_textures import give_companion_texture
from .registry import Reader
from .sources import Source
from .text import shown
from .warning_list import WarningList

# What trimesh reads by itself, and what it reads with further packages.
_EXTENSIONS = (".glb", ".gltf", ".xyz", ".dxf", ".dae", ".zae", ".3mf", ".3dxml", ".xaml")
_GLB = b"glTF"
# What files of a kind begin with, if anything.
_BEGINNINGS = {"glb": _GLB, **dict.fromkeys(("3mf", "3dxml", "zae"), b"PK")}
_BEGINNINGS |= dict.fromkeys(("dae", "xaml"), b"<")
# A file may announce, and its nodes may repeat, so many numbers and vertices, and besides as many
# as it has bytes. Assign another value to change it.
MAX_REPEATED = 1 << 20
# Letters of what trimesh says that are passed on.
_SAID = 200
_BYTE_ORDER_MARKS = (b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff")


def read_with_trimesh(source: Source, split: bool = False) -> Document:
    """Read a file with trimesh.

    Parameters
    ----------
    source : Source
    split : bool
        Make one object of each node, with its pose; otherwise the poses are applied.

    Raises
    ------
    FileFormatError
        It is damaged, or trimesh is not installed or lacks a package for it.
    """
    trimesh = _trimesh(source)
    from ..trimesh_conversion import posed_mesh, scene_parts

    kind = "glb" if source.data.startswith(_GLB) else source.extension.removeprefix(".") or "glb"
    _check_beginning(source, kind)
    if kind not in trimesh.available_formats():
        raise FileFormatError(
            f"trimesh needs further packages for {kind} files: pip install trimesh[easy]",
            source.path,
        )
    limit = _limit(source, kind)
    warnings = WarningList(source.path)
    try:
        with _said(warnings):
            loaded = trimesh.load(
                io.BytesIO(source.data),
                file_type=kind,
                resolver=_resolver(trimesh, source, warnings),
                process=False,
            )
        scene = loaded if isinstance(loaded, trimesh.Scene) else trimesh.Scene(loaded)
        parts = scene_parts(scene)
    except InvalidArgumentError as error:
        raise FileFormatError(f"damaged: {error}", source.path) from error
    except Engine3DError:
        raise
    except FileNotFoundError as error:
        raise FileFormatError(f"trimesh cannot read it: {error}", source.path) from error
    # Damaged files lead trimesh to whatever its libraries raise: KeyError, struct.error, ...
    except Exception as error:
        said = " ".join(str(error).split())
        reason = f"{type(error).__name__}: {said}" if said else type(error).__name__
        raise FileFormatError(
            f"damaged, or no {kind} file (trimesh ended with {reason})", source.path
        ) from error
    _check_parts(source, parts, None if split else limit)
    objects = [
        DocumentObject(part.name, part.mesh, part.pose)
        if split
        else DocumentObject(part.name, posed_mesh(part.mesh, part.pose))
        for part in parts
    ]
    if not any(len(entry.mesh.positions) for entry in objects):
        raise FileFormatError("no vertices in this file", source.path)
    materials = [material for entry in objects for material in entry.mesh.materials]
    if any(entry.mesh.uvs is not None for entry in objects) and not any(
        map(says_something, materials)
    ):
        give_companion_texture(source, materials, warnings)
    counts = {
        "vertices": sum(len(entry.mesh.positions) for entry in objects),
        "faces": sum(len(entry.mesh.faces) for entry in objects),
        "triangles": sum(len(entry.mesh.faces) for entry in objects),
        "objects": [entry.name for entry in objects],
    }
    return Document(kind, objects, counts=counts, warnings=warnings.messages())


def _limit(source: Source, kind: str) -> int:
    """How many vertices the file may have in the end; refuses glTF that announces more numbers."""
    if kind not in ("glb", "gltf"):
        return MAX_REPEATED + source.size
    numbers, names = announced(source.data)
    limit = MAX_REPEATED + source.size + _sizes_of(names, source)
    if numbers > limit:
        raise FileFormatError(
            f"announces {numbers} numbers, more than the limit for its size, {limit}", source.path
        )
    return limit


def _sizes_of(names: list[str], source: Source) -> int:
    """The bytes of the files beside the model that bear these names."""
    files, total = LinkedFiles(source.folder), 0
    for name in names:
        with contextlib.suppress(LinkedFileError, OSError):
            total += os.path.getsize(_find(files, name))
    return total


def _find(files: LinkedFiles, name: str) -> str:
    """A file that is named as it is, or as a URI."""
    try:
        return files.find(name)
    except LinkedFileError:
        plain = unquote(name)
        if plain == name:
            raise
        return files.find(plain)


def _check_parts(source: Source, parts, most_vertices: int | None) -> None:
    """Refuse poses that are none, and nodes that repeat their meshes without end."""
    for part in parts:
        if not (np.isfinite(part.pose).all() and np.array_equal(part.pose[3], (0, 0, 0, 1))):
            raise FileFormatError(f"node {shown(part.name)} has no affine pose", source.path)
    vertices = sum(len(part.mesh.positions) for part in parts)
    if most_vertices is not None and vertices > most_vertices:
        raise FileFormatError(
            f"{vertices} vertices where meshes are repeated: one mesh of them is limited to "
            f"{most_vertices}; load_scene keeps the meshes apart",
            source.path,
        )


@contextlib.contextmanager
def _said(warnings: WarningList):
    """Let what trimesh would print become warnings."""
    handler = logging.Handler(logging.WARNING)
    handler.emit = lambda record: warnings.add(printable(record.getMessage()[:_SAID]))
    logger = logging.getLogger("trimesh")
    logger.addHandler(handler)
    try:
        yield
    finally:
        logger.removeHandler(handler)


def _check_beginning(source: Source, kind: str) -> None:
    """Refuse what is no such file at all: trimesh would find fault with something else."""
    if kind == "gltf":
        try:
            is_sound = isinstance(json.loads(source.data), dict)
        except (ValueError, RecursionError):
            is_sound = False
    else:
        head = source.data[:64]
        is_marked = head.startswith(_BYTE_ORDER_MARKS) and kind in ("dae", "xaml")
        is_sound = is_marked or head.lstrip().startswith(_BEGINNINGS.get(kind, b""))
    if not is_sound:
        raise FileFormatError(f"not a {kind} file", source.path)


def _trimesh(source: Source):
    try:
        import trimesh
    except ImportError:
        raise FileFormatError(
            f"{source.extension or 'glTF'} files need the package trimesh: "
            "pip install engine3d[formats]",
            source.path,
        ) from None
    return trimesh


def _resolver(trimesh, source: Source, warnings: WarningList):
    """Gives trimesh the files beside the model, and no others."""
    files = LinkedFiles(source.folder)

    class FolderResolver(trimesh.resolvers.Resolver):
        def __init__(self):
            pass

        def get(self, name):
            try:
                return files.read(_find(files, str(name))).data
            except (LinkedFileError, Engine3DError) as error:
                warnings.add(f"{name!r}: {error}")
                raise FileNotFoundError(f"{name!r}: {error}") from None

        def keys(self):
            return []

        def namespaced(self, namespace):
            return self

        def write(self, name, data):
            raise PermissionError("a model is only read")

    return FolderResolver()


def _is_glb(head: bytes) -> bool:
    return head.startswith(_GLB)


READERS = (
    Reader(
        "trimesh",
        "glTF, COLLADA, 3MF and others, through trimesh",
        "mesh",
        _EXTENSIONS,
        read_with_trimesh,
        signature=_is_glb,
    ),
)
