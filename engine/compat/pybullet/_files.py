"""The meshes and images of files, as TinyRenderer takes them.

In: names that Bullet gives. Out: a mesh of all parts of a file, with one texture: the first that a
material of it has. Faces without normals are flat. Files are read again when they changed.
"""

from __future__ import annotations

import functools
import os
import sys
import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...errors import Engine3DWarning, FileAccessError
from ...io.loaders import load_document, load_texture
from ...model.geometry.mesh import Mesh
from ...model.geometry.posing import posed_mesh
from ...model.materials.material import textures_of
from ...model.materials.textures import PlacedTexture, Texture

# Where Bullet looks for a name.
_PREFIXES = ("", "data", "../data", "../../data", "../../../data", "../../../../data")
_STL_HEAD, _STL_ROW = 84, 50
# What the last `setAdditionalSearchPath` of the process said: all clients share it, as in Bullet.
_search = {"folder": ""}
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])


class FileMesh(NamedTuple):
    """The mesh of a file, without material, and its texture."""

    mesh: Mesh
    texture: Texture | None


def search_in(folder: str) -> None:
    """Look for files in a folder, in place of the one before; resets of clients keep it."""
    _search["folder"] = folder


def search_folder() -> str:
    """Return the folder in which files are looked for; empty for none."""
    return _search["folder"]


def found_file(name: str, folder: str) -> str:
    """Return the path of a file that Bullet names.

    Parameters
    ----------
    name : str
    folder : str
        That of `setAdditionalSearchPath` when Bullet read the file; empty for none.

    Raises
    ------
    FileAccessError
        There is none.
    """
    data = sys.modules.get("pybullet_data")
    places = [*_PREFIXES, folder, *([] if data is None else [data.getDataPath()])]
    for place in places:
        path = os.path.join(place, name)
        if os.path.isfile(path):
            return os.path.abspath(path)
    raise FileAccessError("there is no such file", name)


def read_mesh(path: str) -> FileMesh:
    """Return the mesh of a file.

    Raises
    ------
    FileFormatError, FileAccessError
    """
    return _kept_mesh(*_key(path))


def read_texture(path: str) -> Texture:
    """Return the image of a file, for coordinates that are cut to whole texels.

    Raises
    ------
    FileFormatError, FileAccessError
    """
    return _kept_texture(*_key(path))


@functools.lru_cache(maxsize=512)
def _kept_mesh(path: str, changed: float, size: int) -> FileMesh:
    return _stl(path) or _document(path)


@functools.lru_cache(maxsize=128)
def _kept_texture(path: str, changed: float, size: int) -> Texture:
    return turned_texture(load_texture(path).pixels)


def _key(path: str) -> tuple[str, float, int]:
    try:
        state = os.stat(path)
    except OSError as error:
        raise FileAccessError(str(error.strerror), path) from None
    return path, state.st_mtime, state.st_size


def _stl(path: str) -> FileMesh | None:
    """Return the mesh of a binary STL file, with its own normals; None for others."""
    if not path.lower().endswith(".stl"):
        return None
    data = np.fromfile(path, np.uint8)
    count = int(data[80:_STL_HEAD].view("<u4")[0]) if len(data) >= _STL_HEAD else -1
    if len(data) != _STL_HEAD + _STL_ROW * count:
        return None
    facets = data[_STL_HEAD:].view(_FACET)
    corners = facets["corners"].reshape(-1, 3).astype(np.float64)
    normals = np.repeat(facets["normal"], 3, axis=0)
    lengths = (normals * normals).sum(axis=1)
    if not (np.isfinite(lengths).all() and lengths.all()):
        return None
    faces = np.arange(len(corners)).reshape(-1, 3)
    return FileMesh(plain_mesh(corners, faces, normals, None), None)


def _document(path: str) -> FileMesh:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", Engine3DWarning)  # Bullet tells nothing, either
        root = os.path.dirname(os.path.dirname(path))
        document = load_document(path, companion=_no_image, crease_angle=0.0, root=root)
    meshes = [
        one.mesh if one.pose is None else posed_mesh(one.mesh, one.pose) for one in document.objects
    ]
    mesh = meshes[0] if len(meshes) == 1 else Mesh.concatenate(meshes)
    # Bullet knows no smoothing groups.
    normals = mesh.normals if mesh.has_normals and not _is_flat(path) else None
    return FileMesh(plain_mesh(mesh.positions, mesh.faces, normals, mesh.uvs), _first_texture(mesh))


def plain_mesh(
    positions: ArrayLike, faces: ArrayLike, normals: ArrayLike | None, uvs: ArrayLike | None
) -> Mesh:
    """Return a mesh of one material; without texture coordinates it shows a texture's middle.

    Its texture coordinates count rows downwards, as `turned_texture` has them: at 0 and at each
    border between texels, TinyRenderer takes the upper one.
    """
    if uvs is None:
        uvs = np.full((len(np.asarray(positions)), 2), 0.5)
    downward = np.asarray(uvs, np.float64) * (1.0, -1.0) + (0.0, 1.0)
    return Mesh(positions, faces, normals=normals, uvs=downward, crease_angle=0.0)


def turned_texture(pixels: np.ndarray) -> Texture:
    """Return the texture of an image, upside down, for the coordinates of `plain_mesh`."""
    return Texture(np.ascontiguousarray(pixels[::-1]), filter="nearest")


@functools.lru_cache(maxsize=512)
def scaled_mesh(mesh: Mesh, scale: tuple[float, ...]) -> Mesh:
    """Return a mesh of another size; as in TinyRenderer, normals stay."""
    normals = mesh.normals if mesh.has_normals else None
    positions = mesh.positions.astype(np.float64) * scale
    return Mesh(positions, mesh.faces, normals=normals, uvs=mesh.uvs, crease_angle=0.0)


def _is_flat(path: str) -> bool:
    """Return whether a file is an OBJ without normals."""
    if not path.lower().endswith(".obj"):
        return False
    with open(path, "rb") as file:
        return not any(line.lstrip().startswith(b"vn") for line in file)


def _no_image(path: str) -> bool:
    return False


def _first_texture(mesh: Mesh) -> Texture | None:
    """Return the texture of the first face that has one."""
    numbers, places = np.unique(mesh.material_ids, return_index=True)
    for number in numbers[np.argsort(places)].tolist():
        texture = textures_of(mesh.materials[number]).get("texture")
        if isinstance(texture, PlacedTexture):
            texture = texture.texture
        if texture is not None:
            return turned_texture(texture.pixels)
    return None
