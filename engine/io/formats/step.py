"""STEP and IGES, the exchange formats of CAD, as far as the package cascadio reads them.

In: the bytes of a file. Out: a `Document` of triangles that follow its curved surfaces closely. The
package, which holds Open CASCADE, is given a process of its own, see `limited_process`. It makes
glTF of the file: the tree of its parts, their names and colours; coordinates are metres, +Z is up.
"""

from __future__ import annotations

import functools
import importlib.util

from ...errors import FileFormatError
from ..reading.documents import Document
from ..reading.limited_process import in_limited_process
from ..reading.reader_registry import Reader
from ..reading.sources import Source
from .gltf.gltf import read_gltf

# How far a triangle's edge may be from its curve, as a share of its length, and how far its normals
# may turn, in radians.
_LINEAR, _ANGULAR = 0.001, 0.25
_STEP = b"ISO-10303-21"
# Open CASCADE takes several times what other readers take of a file; its limits go by this.
_SIZE_FACTOR = 8


def read_step(source: Source, split: bool = False, kind: str = "step") -> Document:
    """Read a STEP or an IGES file with cascadio, as `Reader.read`; each part is an object."""
    if kind == "step" and not source.head(64).lstrip().startswith(_STEP):
        raise FileFormatError("not a step file", source.path)
    if importlib.util.find_spec("cascadio") is None:
        raise FileFormatError(
            f"{kind} files need the package cascadio: pip install engine3d[step]", source.path
        )
    convert = functools.partial(_converted, kind=kind)
    size = _SIZE_FACTOR * source.size
    content = in_limited_process(convert, source, split, size=size)
    if not content:
        raise FileFormatError(f"damaged, or no {kind} file: cascadio cannot read it", source.path)
    converted = source._replace(path=f"<{source.path}>", content=content)
    try:
        document = read_gltf(converted, split)
    except FileFormatError as error:
        raise FileFormatError(error.message, source.path) from error
    for material in document.tree.materials if document.tree is not None else ():
        # Only colours are the file's own; what metals are like the converter leaves to glTF.
        material.metallic = material.roughness = None
    document.format, document.unit = kind, "m"
    return document


def _converted(source: Source, split: bool, kind: str) -> bytes:
    """The file as a binary glTF file; empty if it cannot be read."""
    import cascadio

    return cascadio.load(
        source.data,
        kind,
        tol_linear=_LINEAR,
        tol_angular=_ANGULAR,
        tol_relative=True,
        use_parallel=False,  # threads would take addresses that the process may not have
    )


def _read_iges(source: Source, split: bool = False) -> Document:
    return read_step(source, split, "iges")


def _is_step(head: bytes) -> bool:
    return head.startswith(_STEP)


READERS = (
    Reader(
        "step", "STEP, through cascadio", "mesh", (".step", ".stp"), read_step, _is_step, up="+Z"
    ),
    Reader("iges", "IGES, through cascadio", "mesh", (".iges", ".igs"), _read_iges, up="+Z"),
)
