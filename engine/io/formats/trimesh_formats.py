"""Packed COLLADA and other formats read by the optional package trimesh.

In: the bytes of a file. Out: a `Document` with one object for each node. trimesh and its libraries
run in a separate process, see `limited_process`: a few hundred bytes can make them use any amount
of memory and time. Files that a model names are searched in its folder only, as for any model.
"""

from __future__ import annotations

import contextlib
import importlib.util
import io
import logging
from collections.abc import Iterator
from typing import Any

from ...base.optional_packages import needed
from ...errors import Engine3DError, FileFormatError, InvalidArgumentError, printable
from ..addresses.linked_urls import linked_files
from ..reading.documents import Document
from ..reading.limited_process import in_limited_process
from ..reading.linked_files import LinkedFileError
from ..reading.posed_parts import MAX_REPEATED, PosedPart, counts_of, document_objects
from ..reading.reader_registry import Reader, find_reader
from ..reading.sources import Source
from ..reading.warning_list import WarningList
from ..reading.zip_archives import ZIP, ZipArchive

# Formats that trimesh reads by itself, and with further packages.
_EXTENSIONS = (".xyz", ".dxf", ".zae", ".3dxml", ".xaml")
# Signatures of formats, if known.
_BEGINNINGS = {
    **dict.fromkeys(("3dxml", "zae"), ZIP),
    "xaml": b"<",
}
# Characters of trimesh's messages that are passed on.
_SAID = 200
_BYTE_ORDER_MARKS = (b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff")


def read_with_trimesh(source: Source, split: bool = False) -> Document:
    """Read a file with trimesh in a separate process, as `Reader.read`; a node is an object."""
    kind = source.extension.removeprefix(".")
    _check_beginning(source, kind)
    if importlib.util.find_spec("trimesh") is None:
        raise FileFormatError(
            needed(f"{source.extension or 'such'} files need", "trimesh", "formats"), source.path
        )
    is_packed = source.head(len(ZIP)) == ZIP
    size = source.size
    if is_packed:
        archive = ZipArchive(source)
        archive.check_packings()
        size = archive.unpacked_size
    return in_limited_process(read_here, source, split, size=size)


def read_here(source: Source, split: bool) -> Document:
    """Read a file with trimesh in this process."""
    import trimesh

    kind = source.extension.removeprefix(".")
    if kind not in trimesh.available_formats():
        raise FileFormatError(
            f"trimesh needs further packages for {kind} files: pip install trimesh[easy]",
            source.path,
        )
    warnings = WarningList(source.path)
    parts = _parts(trimesh, source, kind, split, warnings)
    for part in parts:
        if not part.mesh.has_normals:
            part.mesh.crease_angle = source.crease_angle
    objects = document_objects(source, parts, MAX_REPEATED + source.size, split)
    return Document(kind, objects, counts=counts_of(objects), warnings=warnings.messages())


def _parts(
    trimesh: Any, source: Source, kind: str, split: bool, warnings: WarningList
) -> list[PosedPart]:
    """Return what trimesh reads; its errors become errors of the file."""
    from ..trimesh_conversion import scene_parts

    try:
        with _said(warnings):
            loaded = trimesh.load(
                io.BytesIO(source.data),
                file_type=kind,
                resolver=_resolver(trimesh, source, warnings),
                process=False,
            )
        scene = loaded if isinstance(loaded, trimesh.Scene) else trimesh.Scene(loaded)
        return scene_parts(scene, warnings, near=split)
    except InvalidArgumentError as error:
        raise FileFormatError(f"damaged: {error}", source.path) from error
    except (Engine3DError, MemoryError):
        raise
    except FileNotFoundError as error:
        raise FileFormatError(f"trimesh cannot read it: {error}", source.path) from error
    # For damaged files, trimesh raises errors of its libraries: KeyError, struct.error, ...
    except Exception as error:
        said = " ".join(str(error).split())
        reason = f"{type(error).__name__}: {said}" if said else type(error).__name__
        raise FileFormatError(
            f"damaged, or no {kind} file (trimesh ended with {printable(reason[:_SAID])})",
            source.path,
        ) from error


class _Teller(logging.Handler):
    """A log handler that turns messages into warnings."""

    def __init__(self, warnings: WarningList) -> None:
        super().__init__(logging.WARNING)
        self._warnings = warnings

    def emit(self, record: logging.LogRecord) -> None:
        self._warnings.add(printable(record.getMessage()[:_SAID]))


@contextlib.contextmanager
def _said(warnings: WarningList) -> Iterator[None]:
    """Turn trimesh's log messages into warnings within the block."""
    handler = _Teller(warnings)
    logger = logging.getLogger("trimesh")
    logger.addHandler(handler)
    try:
        yield
    finally:
        logger.removeHandler(handler)


def _check_beginning(source: Source, kind: str) -> None:
    """Refuse files of another format; trimesh's own errors would mislead."""
    head = source.head(64)
    is_marked = head.startswith(_BYTE_ORDER_MARKS) and kind == "xaml"
    if not is_marked and not head.lstrip().startswith(_BEGINNINGS.get(kind, b"")):
        raise FileFormatError(f"not a {kind} file", source.path)


def _resolver(trimesh: Any, source: Source, warnings: WarningList) -> Any:
    """Return a resolver that gives trimesh the images beside the model, and nothing else."""
    files = linked_files(source, warnings)

    class FolderResolver(trimesh.resolvers.Resolver):  # type: ignore[misc]  # it has no types
        def __init__(self) -> None:
            pass

        def get(self, name: str) -> bytes:
            try:
                return _image(files.read(files.find_uri(str(name))))
            except (LinkedFileError, Engine3DError) as error:
                warnings.add(f"{name!r}: {error}")
                raise FileNotFoundError(f"{name!r}: {error}") from None

        def keys(self) -> list[str]:
            return []

        def namespaced(self, namespace: str) -> FolderResolver:
            return self

        def write(self, name: str, data: bytes) -> None:
            raise PermissionError("a model is only read")

    return FolderResolver()


def _image(source: Source) -> bytes:
    """Return an image in a form that trimesh can open, decoded like all others."""
    from PIL import Image

    file = io.BytesIO()
    pixels = find_reader(source, "image").read(source)
    Image.fromarray(pixels).save(file, "PNG", compress_level=0)
    return file.getvalue()


READERS = (
    Reader(
        "trimesh",
        "packed COLLADA, DXF and others, through trimesh",
        "mesh",
        _EXTENSIONS,
        read_with_trimesh,
    ),
)
