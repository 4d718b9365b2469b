"""Loaders: meshes, textures, and documents that also hold lights and cameras.

`load_mesh`, `load_texture` and `load_document` choose the reader by the file's content and name. A
format is a module in `formats` that defines ``READERS``; `reader_registry` finds it.
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
