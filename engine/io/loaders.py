"""Reading files: meshes, textures, and documents that hold lights and cameras as well.

`load_mesh`, `load_texture` and `load_document` choose the reader by what the file holds and what it
is called. A format is one module of this package that defines ``READERS``; `registry` finds it.
"""

from __future__ import annotations

from .reading.companion_textures import companion_texture
from .reading.documents import CameraRecord, Document, LightRecord
from .reading.loading import load_document, load_mesh, load_texture
from .reading.reader_registry import formats

__all__ = [
    "CameraRecord",
    "Document",
    "LightRecord",
    "companion_texture",
    "formats",
    "load_document",
    "load_mesh",
    "load_texture",
]
