"""glTF and other formats that the package trimesh reads, where it is installed.

In: the bytes of a file. Out: a `Document` with one object for each node. trimesh is imported when
the first such file is read. The files that one of them names are looked for as for any model: in
its folder only.
"""

from __future__ import annotations

import io
import json

from ..errors import Engine3DError, FileFormatError
from .documents import Document, DocumentObject
from .linked_files import LinkedFileError, LinkedFiles
from .registry import Reader
from .sources import Source, read_source
from .warning_list import WarningList

# What trimesh reads by itself, and what it reads with further packages.
_EXTENSIONS = (".glb", ".gltf", ".xyz", ".dxf", ".dae", ".zae", ".3mf", ".3dxml", ".xaml")
_GLB = b"glTF"
# What files of a kind begin with, if anything.
_BEGINNINGS = {"glb": _GLB, **dict.fromkeys(("3mf", "3dxml", "zae"), b"PK")}
_BEGINNINGS |= dict.fromkeys(("dae", "xaml"), b"<")
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
    warnings = WarningList(source.path)
    try:
        loaded = trimesh.load(
            io.BytesIO(source.data),
            file_type=kind,
            resolver=_resolver(trimesh, source, warnings),
            process=False,
        )
        scene = loaded if isinstance(loaded, trimesh.Scene) else trimesh.Scene(loaded)
        parts = scene_parts(scene)
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
    objects = [
        DocumentObject(part.name, part.mesh, part.pose)
        if split
        else DocumentObject(part.name, posed_mesh(part.mesh, part.pose))
        for part in parts
    ]
    if not any(len(entry.mesh.positions) for entry in objects):
        raise FileFormatError("no vertices in this file", source.path)
    counts = {
        "vertices": sum(len(entry.mesh.positions) for entry in objects),
        "faces": sum(len(entry.mesh.faces) for entry in objects),
        "triangles": sum(len(entry.mesh.faces) for entry in objects),
        "objects": [entry.name for entry in objects],
    }
    return Document(kind, objects, counts=counts, warnings=warnings.messages())


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
                return read_source(files.find(str(name))).data
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
