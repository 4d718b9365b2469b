"""Writers of mesh files: OBJ with MTL, PLY, STL, glTF.

`save_mesh` chooses the writer by the file's extension. A format is a module in `formats` that
defines ``WRITERS``; `writer_registry` finds it.
"""

from __future__ import annotations

from .writing.saving import save_mesh
from .writing.writer_registry import formats

__all__ = ["formats", "save_mesh"]
