"""Records of finished pictures: their inputs, and the files written.

In: a task, its files. Out: ``.batch/NAME.json``, written with the files and after them: a picture
with a record is complete. A picture is done if its record has the task's key, and files and inputs
still match the record.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ...base.files import json_records as shapes
from ...base.files.atomic_write import AtomicFiles
from ...base.files.making_folders import make_folder_of
from ...base.plugins.registry import are_here
from ...errors import FileAccessError, FileFormatError, warn
from ..datasets.kinds import named_in_errors
from ..datasets.writer import Content, DatasetWriter, Note, contents, own_files
from .file_digests import Inputs, are_as_before
from .task import Task

if TYPE_CHECKING:
    from ...stage.blank import Reason

FOLDER = ".batch"


def record_path(task: Task) -> str:
    """Return the path of a task's record, relative to the batch's folder."""
    return os.path.join(FOLDER, f"{task.name}.json")


def write_picture(
    out: str,
    task: Task,
    key: str,
    inputs: Inputs,
    files: Mapping[str, Content],
    said: Any,
    blank: Reason | None = None,
) -> None:
    """Write a picture's files and then its record: all of them, or none.

    If the picture is blank, the record and a warning say why.
    """
    hashes = {path: hashlib.sha256(data).hexdigest() for path, data in own_files(files).items()}
    record = {"key": key, "inputs": inputs.digests(), "files": hashes, "said": said}
    if inputs.plugins():
        record["plugins"] = inputs.plugins()
    if blank is not None:
        record |= {"blank": True, "why": blank.word}
        warn(f"{task.name}: nothing shows: {blank.sentence}")
    with AtomicFiles() as parts:
        whole = {**files, record_path(task): shapes.sealed(record)}
        for target, data in contents(out, whole):
            make_folder_of(target, below=out)
            parts.create(target, below=out).write(data)


def read_record(
    out: str, task: Task, writer: DatasetWriter, *, tell: bool = False
) -> dict[str, Any] | None:
    """Return a task's record; None if missing or damaged, optionally with a warning."""
    path = os.path.join(out, record_path(task))
    if not os.path.lexists(path):
        return None
    try:
        return shapes.read_sealed(path, _record(writer.note_shape))
    except (FileAccessError, FileFormatError) as error:
        if tell:
            warn(f"{error}: the picture is drawn again")
        return None


_DIGEST = shapes.sound_text


def _record(said: shapes.Shape) -> shapes.Shape:
    """Return the shape of records whose writer's data has a given shape."""
    return shapes.members(
        {
            "key": shapes.text,
            "inputs": shapes.mapped(shapes.path_text, shapes.maybe(_DIGEST)),
            "files": shapes.mapped(shapes.path_inside, _DIGEST),
            "said": said,
        },
        {
            "plugins": shapes.listed(shapes.row(*[shapes.text] * 4)),
            "blank": shapes.one_of(True),
            "why": shapes.text,
        },
    )


def note_of(task: Task, record: dict[str, Any]) -> Note:
    """Return a record's note on a picture, as writers take it."""
    return Note(task.name, task.index, list(record["files"]), record["said"])


def _is_stored(out: str, note: Note, digests: dict[str, str], writer: DatasetWriter) -> bool:
    """Return whether a picture's files exist as they were written."""
    for path, digest in digests.items():
        data = writer.stored(out, note, path)
        if data is None or hashlib.sha256(data).hexdigest() != digest:
            return False
    return writer.is_whole(out, note)


def is_done(out: str, task: Task, writer: DatasetWriter) -> bool:
    """Return whether a picture exists, made from the current inputs."""
    record = read_record(out, task, writer, tell=True)
    if record is None or record["key"] != task.key(writer):
        return False
    with named_in_errors(writer):
        if not _is_stored(out, note_of(task, record), record["files"], writer):
            return False
    return are_here(record.get("plugins", ())) and are_as_before(task.folder, record["inputs"])
