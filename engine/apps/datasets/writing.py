"""Writes a whole data set in one process; `engine3d.batch` uses many.

In: a folder, a writer, samples one after the other. Out: its files.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable, Mapping

from ...base.calls import checks_types
from ...base.files.atomic_write import AtomicFiles, checked_path
from ...base.files.making_folders import make_folder_of
from ...base.files.portable_names import common_name, folded
from ...base.numbers import shown
from ...errors import InvalidArgumentError
from .kinds import named_in_errors
from .samples import Sample
from .writer import Content, DatasetWriter, Note, contents, own_files


@checks_types
def write_dataset(
    folder: str | os.PathLike[str], writer: DatasetWriter, samples: Iterable[Sample]
) -> list[str]:
    """Write a data set.

    Parameters
    ----------
    folder : path-like
        Is made where it is missing.
    writer : DatasetWriter
    samples : iterable of Sample
        With ascending indices; each is let go before the next is asked for.

    Returns
    -------
    list of str
        The paths of all files, relative to the folder.

    Raises
    ------
    InvalidArgumentError, FileAccessError
    """
    root, notes = checked_path(folder), []
    names: dict[str, tuple[str, bytes]] = {}
    for sample in samples:
        if not isinstance(sample, Sample):
            raise InvalidArgumentError(f"samples must be Samples, not {shown(sample)}")
        if notes and sample.index <= notes[-1].index:
            raise InvalidArgumentError(f"samples come in the order of their index: {sample.index}")
        with named_in_errors(writer):
            files, said = writer.describe(sample)
        _check_distinct(own_files(files), names)
        save_files(root, files)
        notes.append(Note(sample.name, sample.index, list(own_files(files)), said))
    written = [path for note in notes for path in note.files]
    with named_in_errors(writer):
        return written + list(writer.finish(root, notes))


def _check_distinct(files: Mapping[str, bytes], names: dict[str, tuple[str, bytes]]) -> None:
    """Raise `InvalidArgumentError` if a file would replace another one of an earlier picture."""
    for path, data in files.items():
        written = path, hashlib.sha256(data).digest()
        other = names.setdefault(folded(path), written)
        if other != written:
            raise InvalidArgumentError(f"files of two pictures have {common_name(path, other[0])}")


def save_files(folder: str, files: Mapping[str, Content]) -> None:
    """Write a picture's files, which appear together, and create their folder."""
    with AtomicFiles() as parts:
        for target, data in contents(folder, files):
            make_folder_of(target, below=folder)
            parts.create(target, below=folder).write(data)
