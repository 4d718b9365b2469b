"""Draco-compressed primitives, decoded by the optional package DracoPy.

In: a `GltfFile` and its buffers. Out: the vertices and indices of each primitive. DracoPy runs in a
separate process, see `limited_process`: a few bytes can encode any number of vertices. All
primitives of a file are decoded together, since a process is slow to start.
"""

from __future__ import annotations

import importlib.util
import pickle
from contextlib import suppress
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ....base.optional_packages import needed
from ...reading.limited_process import in_limited_process
from ...reading.sources import Source
from .gltf_buffers import GltfBuffers
from .gltf_file import DamagedError, Entry, GltfFile, whole_of

DRACO = "KHR_draco_mesh_compression"
#: The extension handled here.
READ = (DRACO,)
# Vertex indices or None, and arrays by their numbers; or an error message.
_Found: TypeAlias = tuple[np.ndarray | None, dict[int, np.ndarray]] | str


@dataclass
class Unpacked:
    """A decoded primitive.

    Attributes
    ----------
    arrays : dict of str to (V, N) array
        The attributes by name, with the dtypes of the compressed data.
    corners : (C,) uint32 or None
        None for points.
    """

    arrays: dict[str, np.ndarray]
    corners: np.ndarray | None


class GltfDraco:
    """The compressed primitives of a file, decoded on first use.

    Parameters
    ----------
    file : GltfFile
    buffers : GltfBuffers
    """

    def __init__(self, file: GltfFile, buffers: GltfBuffers) -> None:
        self._file, self._buffers = file, buffers
        self._meshes: dict[int, _Found] | None = None

    def unpacked(self, entry: Entry, where: str) -> Unpacked | None:
        """Return a primitive's decoded data; None if an uncompressed form exists."""
        packing = self._packing(entry, where)
        if packing is None:
            return None
        if importlib.util.find_spec("DracoPy") is None:
            if self._has_plain(entry, where) and not self._is_required():
                return None
            raise self._file.error(
                needed(f"{where} is packed by {DRACO}, which needs", "DracoPy", "draco")
            )
        if self._meshes is None:
            self._meshes = self._unpack_all()
        attributes = self._file.part(packing, "attributes", f"{where}.{DRACO}")
        index = self._file.number_in("bufferViews", packing["bufferView"], where)
        found = self._meshes.get(index, "not read")
        if isinstance(found, str):
            raise self._file.damaged(f"bufferViews[{index}] is not what Draco packs ({found})")
        corners, by_id = found
        arrays = {}
        for name, number in attributes.items():
            number = whole_of(number)
            if type(number) is not int or number not in by_id:
                raise self._file.damaged(f"{where}: Draco has no attribute for {name}")
            arrays[name] = by_id[number]
        return Unpacked(arrays, corners)

    def _packing(self, entry: Entry, where: str) -> Entry | None:
        extensions = self._file.spare_part(entry, "extensions", where)
        if DRACO not in extensions:
            return None
        packing = self._file.part(extensions, DRACO, where)
        self._file.entry("bufferViews", packing.get("bufferView"), f"{where}.{DRACO}")
        return packing

    def _add_view(self, primitive: Entry, views: dict[int, bytes]) -> None:
        packing = self._packing(primitive, "")
        if packing is not None:
            index = self._file.number_in("bufferViews", packing["bufferView"], "")
            views[index] = bytes(self._buffers.view(index, ""))

    def _is_required(self) -> bool:
        return DRACO in self._file.tree.get("extensionsRequired", ())

    def _has_plain(self, entry: Entry, where: str) -> bool:
        """Return whether the file also has the positions uncompressed."""
        attributes = self._file.part(entry, "attributes", where)
        accessor = self._file.entry("accessors", attributes.get("POSITION"), where)
        return "bufferView" in accessor

    def _unpack_all(self) -> dict[int, _Found]:
        file: GltfFile = self._file
        views: dict[int, bytes] = {}
        for mesh in file.entries("meshes"):
            with suppress(DamagedError):  # reported where the primitive is read
                for primitive in file.entries("primitives", mesh):
                    with suppress(DamagedError):
                        self._add_view(primitive, views)
        source = Source(file.path, pickle.dumps(views))
        found = in_limited_process(_unpack_here, source, True, size=source.size)
        for index, unpacked in found.items():
            if isinstance(unpacked, str):
                continue
            corners, arrays = unpacked
            held = [array for array in (corners, *arrays.values()) if array is not None]
            self._buffers.allow(sum(array.nbytes for array in held), f"bufferViews[{index}]")
        return found


def _unpack_here(source: Source, split: bool) -> dict[int, _Found]:
    """Decode views."""
    import DracoPy

    found: dict[int, _Found] = {}
    for index, data in pickle.loads(source.data).items():
        try:
            mesh = DracoPy.decode(data)
        except MemoryError:
            raise
        # DracoPy has its own exception, and passes on C++ exceptions.
        except Exception as error:
            found[index] = str(error)
            continue
        corners = getattr(mesh, "faces", None)
        arrays = {
            held["unique_id"]: np.ascontiguousarray(held["data"]).reshape(
                -1, held["num_components"]
            )
            for held in mesh.attributes
        }
        found[index] = (None if corners is None else np.asarray(corners, np.uint32).ravel(), arrays)
    return found
