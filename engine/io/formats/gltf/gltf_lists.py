"""Lists of a glTF file whose entries a picture can do without: cameras, lights, skins, animations.

In: the entries, and what reads one. Out: the records of those that are sound, and their numbers;
the others are left out with a warning.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from .gltf_file import Entry, GltfFile


class SoundList(NamedTuple):
    """The records of a list.

    Attributes
    ----------
    records : tuple
    number_of : dict of int to int
        From the number that the file has for an entry to that of its record.
    """

    records: tuple[Any, ...]
    number_of: dict[int, int]


def sound_list(
    file: GltfFile, name: str, entries: list[Entry], read: Callable[[Entry, str], Any]
) -> SoundList:
    """Return what is read of a list, each entry by ``read(entry, where)``."""
    records: list[Any] = []
    number_of: dict[int, int] = {}
    for index, entry in enumerate(entries):
        where = f"{name}[{index}]"
        record = file.sound(where, read, entry, where)
        if record is not None:
            number_of[index] = len(records)
            records.append(record)
    return SoundList(tuple(records), number_of)
