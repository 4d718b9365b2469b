"""Meshopt-compressed buffer views: EXT_meshopt_compression and KHR_meshopt_compression.

In: a view's description. Out: its uncompressed size, and its bytes; C decompresses them.
"""

from __future__ import annotations

from ...._native.loaders import unpack_meshopt
from ...reading.text import shown
from .gltf_file import Entry, GltfFile

#: The extensions handled here.
READ = ("KHR_meshopt_compression", "EXT_meshopt_compression")


def packing_of(file: GltfFile, view: Entry, where: str) -> Entry | None:
    """Return a view's compression parameters; None if it is uncompressed."""
    extensions = file.part(view, "extensions", where)
    for name in READ:
        if name in extensions:
            return file.part(extensions, name, where)
    return None


def unpacked_size(file: GltfFile, packing: Entry, where: str) -> int:
    """Return the uncompressed size of a view in bytes."""
    count, stride = (file.whole(packing, name, where) for name in ("count", "byteStride"))
    return count * stride


def unpacked(file: GltfFile, data: memoryview, packing: Entry, where: str) -> memoryview:
    """Return the uncompressed bytes of a view.

    Parameters
    ----------
    file : GltfFile
    data : memoryview
        The compressed bytes.
    packing : dict
        See `packing_of`.
    where : str

    Raises
    ------
    FileFormatError
    """
    count, stride = (file.whole(packing, name, where) for name in ("count", "byteStride"))
    mode, filter = packing.get("mode"), packing.get("filter", "NONE")
    if not isinstance(mode, str) or not isinstance(filter, str):
        raise file.damaged(f"{where} is packed in no mode that is known")
    elements = unpack_meshopt(data, mode, filter, count, stride)
    if elements is None:
        raise file.damaged(
            f"{where}, {count} elements of {stride} bytes packed by meshopt in the mode "
            f"{shown(mode)} with the filter {shown(filter)}"
        )
    return memoryview(elements.tobytes())
