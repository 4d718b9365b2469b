"""The materials used by an OBJ file, from its libraries.

In: the names in ``usemtl`` and ``mtllib`` with their lines. Out: `Material` objects. A library that
is missing, damaged or outside the folder gives a warning; its materials are plain.
"""

from __future__ import annotations

import os

from ....errors import Engine3DError
from ....model.materials.material import Material
from ...addresses.linked_urls import linked_files
from ...reading.linked_files import LinkedFileError, LinkedFiles
from ...reading.linked_textures import TextureCache
from ...reading.sources import Source
from ...reading.text import shown, words_of
from ...reading.warning_list import WarningList
from .mtl import read_mtl
from .obj_file import Setters


def read_library(
    source: Source, statements: Setters, is_used: bool, warnings: WarningList
) -> dict[str, Material]:
    """Read all material libraries of a model.

    If none exists, the library with the model's name replaces them.

    Parameters
    ----------
    source : Source
        The model.
    statements : Setters
        All ``mtllib`` statements.
    is_used : bool
        Whether the model uses any material.
    warnings : WarningList

    Returns
    -------
    library : dict of str to Material
        The first material of each name.
    """
    library: dict[str, Material] = {}
    files = linked_files(source)
    textures = TextureCache(files)
    paths: dict[str, int | None] = {}
    for names, line in zip(statements.names(), statements.lines, strict=True):
        for path in _library_paths(names, files, line, warnings):
            paths.setdefault(path, line)
    if not paths and (is_used or len(statements)):
        paths = dict.fromkeys(_namesake(source, files, warnings))
    for path, line in paths.items():
        try:
            found = read_mtl(files.read(path), textures, warnings)
        except Engine3DError as error:
            warnings.add(f"material library left out: {error}", line)
            continue
        for name, material in found.items():
            library.setdefault(name, material)
    return library


def _namesake(source: Source, files: LinkedFiles, warnings: WarningList) -> list[str]:
    """Return the library with the model's name: files get renamed, and some name no library."""
    path = _found_or_none(files, f"{source.stem}.mtl") if source.stem else None
    if path is None:
        return []
    warnings.add(f"no material library is found: {shown(os.path.basename(path))} is used")
    return [path]


def used_materials(
    uses: Setters, library: dict[str, Material], warnings: WarningList
) -> tuple[list[Material], list[int]]:
    """Return the materials that ``usemtl`` names, and the material number of each use.

    Parameters
    ----------
    uses : Setters
        All ``usemtl`` statements.
    """
    materials: list[Material] = []
    number: dict[str, int] = {}
    alike: dict[str, list[str]] = {}
    for name in library:
        alike.setdefault(name.casefold(), []).append(name)
    names = uses.names()
    for name, line in zip(names, uses.lines, strict=True):
        if name in number:
            continue
        number[name] = len(materials)
        materials.append(_named(name, library, alike, line, warnings))
    return materials, [number[name] for name in names]


def _named(
    name: str,
    library: dict[str, Material],
    alike: dict[str, list[str]],
    line: int,
    warnings: WarningList,
) -> Material:
    """Return the material with a name, or the only one that differs just by letter case."""
    if name in library:
        return library[name]
    others = alike.get(name.casefold(), [])
    if len(others) == 1:
        warnings.add(f"material {shown(name)} is in no library; {shown(others[0])} is used", line)
        return library[others[0]]
    if library:
        warnings.add(f"material {shown(name)} is in no library", line)
    return Material(name=name)


def only_material(library: dict[str, Material], warnings: WarningList) -> Material | None:
    """Return the material of a file without ``usemtl``: the only one in its libraries.

    If there are several, none is chosen, and a warning says so.
    """
    if not library:
        return None
    if len(library) > 1:
        warnings.add(f"no usemtl: none of the {len(library)} materials of the library is used")
        return None
    (material,) = library.values()
    warnings.add(f"no usemtl: the only material of the library, {shown(material.name)}, is used")
    return material


def _library_paths(names: str, files: LinkedFiles, line: int, warnings: WarningList) -> list[str]:
    """Return the files of ``mtllib``: one whose name contains blanks, or several."""
    try:
        return [files.find(names)]
    except LinkedFileError:
        pass
    words = words_of(names)
    found = []
    if len(words) > 1:
        found = [_found_or_none(files, word) for word in words]
    if any(path is not None for path in found):
        names_and_paths = zip(words, found, strict=True)
        near = [path or _near(files, word, line, warnings) for word, path in names_and_paths]
        return [path for path in near if path is not None]
    path = _near(files, names, line, warnings)
    return [] if path is None else [path]


def _found_or_none(files: LinkedFiles, name: str) -> str | None:
    try:
        return files.find(name)
    except LinkedFileError:
        return None


def _near(files: LinkedFiles, name: str, line: int, warnings: WarningList) -> str | None:
    """Return a file that can replace a missing library."""
    try:
        path, note = files.find_near(name)
    except LinkedFileError as error:
        warnings.add(f"material library {shown(name)}: {error}", line)
        return None
    warnings.add(f"material library {shown(name)}: {note}", line)
    return path
