"""Optional lists of a glTF file: cameras, lights, skins, animations.

In: the entries, and a function that reads one. Out: the records of sound entries, and their
numbers; others are left out with a warning.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from .gltf_file import Entry, GltfFile


class SoundList(NamedTuple):
    """The records of a list's sound entries.

    Attributes
    ----------
    records : tuple
    number_of : dict of int to int
        Maps the file's number of an entry to that of its record.
    """

    records: tuple[Any, ...]
    number_of: dict[int, int]


def sound_list(
    file: GltfFile, name: str, entries: list[Entry], read: Callable[[Entry, str], Any]
) -> SoundList:
    """Return the records of a list, each read by ``read(entry, where)``."""
    records: list[Any] = []
    number_of: dict[int, int] = {}
    for index, entry in enumerate(entries):
        where = f"{name}[{index}]"
        record = file.sound(where, read, entry, where)
        if record is not None:
            number_of[index] = len(records)
            records.append(record)
    return SoundList(tuple(records), number_of)
