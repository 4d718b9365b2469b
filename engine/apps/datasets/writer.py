"""The base of all data set writers.

In: a `Sample`. Out: the files that belong to that picture alone, and a note of it in JSON's types,
from whichever process drew it; at the end, from all notes in the order of the data set, the files
that belong to all of it. So the bytes depend neither on who drew what nor in which order.
"""

from __future__ import annotations

import json
import os
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, ClassVar, NamedTuple, TypeAlias

from ...base.calls import checks_types
from ...base.files.atomic_write import AtomicFiles
from ...base.files.json_records import Shape, anything
from ...base.files.making_folders import make_folder_of
from ...base.files.portable_names import fault_of
from ...base.numbers import shown
from ...errors import InvalidArgumentError
from ...rendering.frame import Output
from .samples import Sample


class Note(NamedTuple):
    """A picture's notes, kept until the data set is complete.

    Attributes
    ----------
    name : str
    index : int
    files : list of str
        The picture's own files, relative to the data set's folder.
    said : object
        What `DatasetWriter.describe` said of it, in JSON's types.
    """

    name: str
    index: int
    files: list[str]
    said: Any


class Shared(NamedTuple):
    """A file shared by several pictures, whose path identifies its content.

    Attributes
    ----------
    make : callable
        Returns the bytes.
    is_whole : callable
        Returns whether a path holds them.
    """

    make: Callable[[], bytes]
    is_whole: Callable[[str], bool]


#: A file's content, or the recipe that creates it if missing.
Content: TypeAlias = bytes | Shared


def own_files(files: Mapping[str, Content]) -> dict[str, bytes]:
    """Return those of a picture's files that belong to it alone."""
    return {path: data for path, data in files.items() if isinstance(data, bytes)}


def contents(folder: str, files: Mapping[str, Content]) -> Iterator[tuple[str, bytes]]:
    """Yield the files to write for a picture: paths in the folder, and bytes."""
    for path, data in files.items():
        if (fault := fault_of(path.replace(os.sep, "/"))) is not None:
            raise InvalidArgumentError(f"files of data sets have names for every system: {fault}")
        target = os.path.join(folder, path)
        if isinstance(data, bytes):
            yield target, data
        elif not data.is_whole(target):
            yield target, data.make()


class DatasetWriter(ABC):
    """Defines the files of a data set.

    A writer keeps no data of pictures, since it is sent to any number of processes.

    Attributes
    ----------
    kind : str
        Its name in manifests.
    outputs : tuple of str
        What frames must hold.
    note_shape : callable
        The shape of what `describe` says of a picture (`json_records`), by which a note that was
        stored is known to be whole.
    """

    kind: ClassVar[str]
    note_shape: ClassVar[Shape] = staticmethod(anything)
    outputs: tuple[Output, ...] = ("color",)

    @abstractmethod
    @checks_types
    def describe(self, sample: Sample) -> tuple[Mapping[str, Content], Any]:
        """Return a picture's files, by path in the data set, and a note for `finish`.

        Files that are `Shared` are created if missing or damaged.
        """

    @checks_types
    def is_whole(self, folder: str, note: Note) -> bool:
        """Return whether the files that a picture shares with others exist."""
        return True

    @checks_types
    def finish(self, folder: str, notes: Iterable[Note]) -> Iterator[str]:
        """Write the files of the whole data set; yield their paths in it.

        Parameters
        ----------
        folder : str
            Of the data set; the pictures' own files are there.
        notes : iterable of Note
            In the order of the data set; may be gone through several times.
        """
        for _ in notes:
            pass
        yield from ()

    @checks_types
    def beside(self, sample: Sample, end: str) -> str:
        """Return the path of a further file of a picture, with this suffix."""
        return f"extra/{sample.name}.{end}"

    def said(self) -> dict[str, Any]:
        """Return the writer's settings, in JSON types."""
        return {"kind": self.kind, **dict(sorted(vars(self).items()))}

    @checks_types
    def stored(self, folder: str, note: Note, path: str) -> bytes | None:
        """Return the bytes of one of a picture's own files; None if it is missing.

        Parameters
        ----------
        folder : str
            Of the data set.
        note : Note
            Of the picture.
        path : str
            One of ``note.files``.
        """
        try:
            with open(os.path.join(folder, path), "rb") as file:
                return file.read()
        except (OSError, ValueError):  # a name with a zero byte
            return None


class JsonParts:
    """Writes a JSON file value by value, to save memory: whole or not at all.

    Parameters
    ----------
    folder, path : str
        The file is at ``path`` in ``folder``.
    """

    def __init__(self, folder: str, path: str) -> None:
        target = os.path.join(folder, path)
        make_folder_of(target, below=folder)
        self._files = AtomicFiles()
        self._file = self._files.create(target, below=folder)

    def __enter__(self) -> JsonParts:
        return self

    def __exit__(self, *error) -> None:
        self._files.__exit__(*error)

    def text(self, text: str) -> None:
        """Write a piece of JSON verbatim."""
        self._file.write(text.encode("utf-8"))

    def all(self, values: Iterable[Any], brackets: str = "[]", keys: bool = False) -> None:
        """Write an array of values, or an object of (key, value) pairs."""
        start, end = brackets
        between = start
        for value in values:
            if keys:
                key, value = value
                self.text(f"{between}\n{json.dumps(key)}: {compact(value)}")
            else:
                self.text(f"{between}\n{compact(value)}")
            between = ","
        self.text(f"{start if between == start else ''}\n{end}")


def compact(value: Any) -> str:
    """Return a value as JSON on one line."""
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def checked_categories(names: Sequence[str] | None) -> list[str] | None:
    """Return distinct category names, checked; None if pictures define them."""
    if names is None:
        return None
    listed = list(names) if isinstance(names, Iterable) and not isinstance(names, str) else []
    are_names = all(isinstance(name, str) and name for name in listed)
    if not listed or not are_names or len(set(listed)) != len(listed):
        raise InvalidArgumentError(
            f"categories must be names, none empty and none twice, not {shown(names)}"
        )
    return listed


def category_numbers(listed: list[str] | None, found: Iterable[str]) -> dict[str, int]:
    """Return the number of each category, from 1 on; sorted by name unless listed."""
    names = sorted(set(found)) if listed is None else listed
    return {name: number for number, name in enumerate(names, start=1)}


def check_category(listed: list[str] | None, category: str) -> None:
    """Raise unless a category is in the list."""
    if listed is not None and category not in listed:
        known = ", ".join(listed)
        raise InvalidArgumentError(f"{category!r} is not one of the categories {known}")
