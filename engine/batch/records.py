"""What tells that a picture is there: a record of what it was made from and of what was written.

In: a task, its files. Out: ``.batch/NAME.json``, written together with the files and after them: a
picture with a record is whole. A picture is done if its record has the task's key, and files and
inputs still hold what the record says.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..datasets.writer import Content, DatasetWriter, Note, contents, own_files
from ..errors import warn
from ..files.atomic_write import AtomicFiles
from .file_digests import InputFiles, are_as_before
from .task import Task

if TYPE_CHECKING:
    from ..viewer.blank import Reason

FOLDER = ".batch"


def record_path(task: Task) -> str:
    """Return the path of a task's record, relative to the batch's folder."""
    return os.path.join(FOLDER, f"{task.name}.json")


def write_picture(
    out: str,
    task: Task,
    key: str,
    inputs: InputFiles,
    files: Mapping[str, Content],
    said: Any,
    blank: Reason | None = None,
) -> None:
    """Write a picture's files and then its record: all of them, or none.

    The record, and a warning, say why a picture shows nothing.
    """
    hashes = {path: hashlib.sha256(data).hexdigest() for path, data in own_files(files).items()}
    record = {"key": key, "inputs": inputs.digests(), "files": hashes, "said": said}
    if blank is not None:
        record |= {"blank": True, "why": blank.word}
        warn(f"{task.name}: nothing shows: {blank.sentence}")
    text = json.dumps(record, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    with AtomicFiles() as parts:
        whole = {**files, record_path(task): text.encode("utf-8")}
        for target, data in contents(out, whole):
            os.makedirs(os.path.dirname(target), exist_ok=True)
            parts.create(target).write(data)


def read_record(out: str, task: Task) -> dict[str, Any] | None:
    """Return a task's record; None where there is none."""
    try:
        with open(os.path.join(out, record_path(task)), encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return None


def note_of(task: Task, record: dict[str, Any]) -> Note:
    """Return what a record says of a picture, as writers take it."""
    return Note(task.name, task.index, list(record["files"]), record["said"])


def is_done(out: str, task: Task, writer: DatasetWriter) -> bool:
    """Return whether a picture is there, made of what there is now."""
    record = read_record(out, task)
    if record is None or record["key"] != task.key(writer):
        return False
    note = note_of(task, record)
    for path, digest in record["files"].items():
        data = writer.stored(out, note, path)
        if data is None or hashlib.sha256(data).hexdigest() != digest:
            return False
    if not writer.is_whole(out, note):
        return False
    return are_as_before(task.folder, record["inputs"])
