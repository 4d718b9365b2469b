"""The materials that an OBJ file uses, from its libraries.

In: the names in ``usemtl`` and ``mtllib`` with their lines. Out: `Material` objects. A library that
is missing, damaged or out of bounds is a warning; its materials are plain then.
"""

from __future__ import annotations

from ..errors import Engine3DError
from ..materials.material import Material
from .linked_files import LinkedFileError, LinkedFiles
from .linked_textures import TextureCache
from .mtl import read_mtl
from .obj_states import Setters
from .sources import Source
from .text import shown
from .warning_list import WarningList


def read_library(source: Source, statements: Setters, warnings: WarningList) -> dict[str, Material]:
    """Read all material libraries of a model.

    Parameters
    ----------
    source : Source
        The model.
    statements : Setters
        All ``mtllib``.
    warnings : WarningList

    Returns
    -------
    library : dict of str to Material
        Of materials with the same name, the first.
    """
    library: dict[str, Material] = {}
    files = LinkedFiles(source.folder)
    textures = TextureCache(files)
    seen = set()
    for names, line in zip(statements.names(), statements.lines, strict=True):
        for path in _library_paths(names, files, line, warnings):
            if path in seen:
                continue
            seen.add(path)
            try:
                found = read_mtl(files.read(path), textures, warnings)
            except Engine3DError as error:
                warnings.add(f"material library left out: {error}", line)
                continue
            for name, material in found.items():
                library.setdefault(name, material)
    return library


def used_materials(
    uses: Setters, library: dict[str, Material], warnings: WarningList
) -> tuple[list[Material], list[int]]:
    """Return the materials that ``usemtl`` names, and the number of each use's material.

    Parameters
    ----------
    uses : Setters
        All ``usemtl``.
    """
    materials: list[Material] = []
    number: dict[str, int] = {}
    names = uses.names()
    for name, line in zip(names, uses.lines, strict=True):
        if name in number:
            continue
        number[name] = len(materials)
        materials.append(library.get(name) or Material._plain(name))
        if library and name not in library:
            warnings.add(f"material {shown(name)} is in no library", line)
    return materials, [number[name] for name in names]


def _library_paths(names: str, files: LinkedFiles, line: int, warnings: WarningList) -> list[str]:
    """``mtllib`` names one file, whose name may hold blanks, or several files."""
    try:
        return [files.find(names)]
    except LinkedFileError as error:
        reason = str(error)
    words = names.split()
    if len(words) < 2:
        warnings.add(f"material library {shown(names)}: {reason}", line)
        return []
    found = [_library_path(word, files, line, warnings) for word in words]
    return [path for path in found if path is not None]


def _library_path(name: str, files: LinkedFiles, line: int, warnings: WarningList) -> str | None:
    try:
        return files.find(name)
    except LinkedFileError as error:
        warnings.add(f"material library {shown(name)}: {error}", line)
        return None
