"""STEP, IGES and BREP files of CAD, read by the optional packages cascadio and cadquery-ocp.

In: the bytes of a file. Out: a `Document` of triangles that follow its curved surfaces closely. The
packages, which include Open CASCADE, run in a separate process, see `limited_process`. cascadio
converts STEP and IGES to glTF: the tree of parts, their names and colours. Where it is missing, and
for BREP, cadquery-ocp reads files, and the edges of the model are known. Coordinates are
millimetres, whatever unit a file has; +Z is up.
"""

from __future__ import annotations

import functools
import importlib.util
import re

from ...base.optional_packages import needed
from ...errors import FileFormatError, located
from ..cad.document_scaling import scale_document
from ..cad.shape_files import read_parts
from ..reading.documents import Document
from ..reading.limited_process import in_limited_process
from ..reading.posed_parts import MAX_REPEATED, counts_of, document_objects
from ..reading.reader_registry import Reader
from ..reading.sources import Source
from ..reading.text import shown
from .gltf.gltf import read_gltf

# The largest deviation of a triangle's edge from its curve, as a fraction of its length, and of its
# normals, in radians.
_LINEAR, _ANGULAR = 0.001, 0.25
_STEP = b"ISO-10303-21"
# A file that holds a part of an assembly, or says something about it: Open CASCADE opens what this
# names, wherever it lies, but not what a word as long names that it does not know.
_ANY_OTHER = re.compile(rb"DOCUMENT_FILE", re.I)
_OTHER = re.compile(rb"\bDOCUMENT_FILE\b", re.I)
_UNKNOWN = b"DOCUMENT_FIL_"
_NAMED = re.compile(rb"\bDOCUMENT_FILE\s*\(\s*'((?:[^']|''){0,1024})'", re.I)
_MOST_NAMED = 5
_BREP = (
    b"DBRep_DrawableShape",
    b"\nCASCADE Topology",
    b"CASCADE Topology",
    b"Open CASCADE Topology",
)
# In a metre, the unit of glTF.
_MILLIMETRES = 1000.0
# Open CASCADE needs several times the memory and time of other readers; its limits scale by this.
_SIZE_FACTOR = 8
# And so much counts besides: the smallest file of a curved part needs more than limits allow.
_SIZE_BESIDE = 16 << 20


def read_step(source: Source, split: bool = False, kind: str = "step") -> Document:
    """Read a STEP or an IGES file with cascadio, as `Reader.read`; each part is an object."""
    if kind == "step" and not source.head(64).lstrip().startswith(_STEP):
        raise FileFormatError("not a step file", source.path)
    source, others = _alone(source) if kind == "step" else (source, "")
    try:
        document = _read(source, split, kind)
    except FileFormatError as error:
        if not others or others in error.message:
            raise
        raise FileFormatError(f"{error.message}; it {others}", source.path) from error
    if others:
        document.warnings.append(located(others, source.path))
    return document


def _alone(source: Source) -> tuple[Source, str]:
    """Return a source that names no other files, and what is said of them; empty if none was."""
    data = source.data
    if _ANY_OTHER.search(data) is None:
        return source, ""
    named = dict.fromkeys(name.decode("utf-8", "replace") for name in _NAMED.findall(data))
    source = source._replace(content=_OTHER.sub(_UNKNOWN, data))
    if not named:
        return source, ""
    listed = ", ".join(shown(name) for name in [*named][:_MOST_NAMED])
    more = ", …" * (len(named) > _MOST_NAMED)
    return source, f"names other files, which are not read: {listed}{more}"


def _read(source: Source, split: bool, kind: str) -> Document:
    if importlib.util.find_spec("cascadio") is None:
        if _has_ocp():
            return _read_with_ocp(source, split, kind)
        raise FileFormatError(needed(f"{kind} files need", "cascadio", "step"), source.path)
    convert = functools.partial(_converted, kind=kind)
    size = _SIZE_FACTOR * source.size + _SIZE_BESIDE
    content = in_limited_process(convert, source, split, size=size)
    if not content:
        raise FileFormatError(f"damaged, or no {kind} file: cascadio cannot read it", source.path)
    converted = source._replace(path=f"<{source.path}>", content=content)
    try:
        document = read_gltf(converted, split)
    except FileFormatError as error:
        raise FileFormatError(error.message, source.path) from error
    for material in document.tree.materials if document.tree is not None else ():
        # Only colours come from the file; metallic and roughness are the converter's defaults.
        material.metallic = material.roughness = None
    document.format, document.unit = kind, "mm"
    scale_document(document, _MILLIMETRES)
    return document


def _converted(source: Source, split: bool, kind: str) -> bytes:
    """Return the file as binary glTF; empty if it cannot be read."""
    import cascadio

    return cascadio.load(
        source.data,
        kind,
        tol_linear=_LINEAR,
        tol_angular=_ANGULAR,
        tol_relative=True,
        use_parallel=False,  # threads would take address space that the process may not have
    )


def _read_iges(source: Source, split: bool = False) -> Document:
    return read_step(source, split, "iges")


def _read_brep(source: Source, split: bool = False) -> Document:
    if not _has_ocp():
        raise FileFormatError(needed("brep files need", "cadquery-ocp", "cad"), source.path)
    return _read_with_ocp(source, split, "brep")


def _has_ocp() -> bool:
    return importlib.util.find_spec("OCP") is not None


def _read_with_ocp(source: Source, split: bool, kind: str) -> Document:
    size = _SIZE_FACTOR * source.size + _SIZE_BESIDE
    read = functools.partial(read_parts, kind=kind)
    parts = in_limited_process(read, source, split, size=size)
    objects = document_objects(source, parts, MAX_REPEATED + source.size, split)
    counts = counts_of(objects)
    return Document(kind, objects, counts=counts, unit="mm", model_edges=True)


def _is_step(head: bytes) -> bool:
    return head.startswith(_STEP)


def _is_brep(head: bytes) -> bool:
    return head.startswith(_BREP)


READERS = (
    Reader(
        "step", "STEP, through cascadio", "mesh", (".step", ".stp"), read_step, _is_step, up="+Z"
    ),
    Reader("iges", "IGES, through cascadio", "mesh", (".iges", ".igs"), _read_iges, up="+Z"),
    Reader(
        *("brep", "BREP of Open CASCADE, through cadquery-ocp", "mesh", (".brep", ".brp")),
        _read_brep,
        _is_brep,
        up="+Z",
    ),
)
