"""Manifests: files of JSON that list the tasks of a batch.

In: a file (docs/batches.md tells its format). Out: tasks, and the writer of the data set. Faults
raise a `FileFormatError` that names the place, such as ``tasks[2].camera``.
"""

from __future__ import annotations

import inspect
import os
from collections.abc import Callable, Iterator
from dataclasses import fields
from typing import Any, NamedTuple

from ...base.calls import checks_types
from ...base.files.portable_names import common_name, folded
from ...errors import InvalidArgumentError
from ...io.reading.json_values import JsonValue, parsed_json
from ...io.reading.sources import read_source
from ..datasets.kinds import KINDS, made_writer, writer_class
from ..datasets.writer import DatasetWriter
from .cameras import calibrated_size
from .matrix import Value, combinations, name_from, value_of
from .members import MemberError
from .task import Task, check_look, checked, task_of

VERSION = 1
_KEYS = {one.name for one in fields(Task)} - {"index", "folder"}
_MOST = 10_000_000  # tasks


class Manifest(NamedTuple):
    """The contents of a manifest.

    Attributes
    ----------
    tasks : list of Task
    writer : DatasetWriter or None
        None where the pictures are no data set.
    """

    tasks: list[Task]
    writer: DatasetWriter | None


@checks_types
def read_manifest(path: str | os.PathLike[str]) -> Manifest:
    """Read the tasks of a batch; paths are relative to the manifest's folder.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    manifest : Manifest

    Raises
    ------
    FileFormatError
        The message names the place in the file.
    FileAccessError
    """
    whole = parsed_json(read_source(path))
    _check_keys(whole, {"version", "defaults", "tasks", "dataset"})
    version = whole.need("version")
    if version.value != VERSION or isinstance(version.value, bool):
        raise version.wrong(f"{VERSION}, the only version of manifests")
    dataset, defaults = whole.get("dataset"), whole.get("defaults")
    writer = None if dataset is None else _writer(dataset)
    shared = {} if defaults is None else _values(defaults, _KEYS - {"name"}, dataset is not None)
    folder = os.path.dirname(os.path.abspath(os.fspath(path)))
    tasks, names = [], {}
    for entry in whole.entries("tasks"):
        for values in _combined(entry, shared, len(tasks), dataset is not None):
            tasks.append(_task(entry, values, len(tasks), folder))
            _check_name(entry, tasks[-1].name, names)
    if not tasks:
        raise whole.need("tasks").error("there are no tasks")
    return Manifest(tasks, writer)


def _check_keys(value: JsonValue, known: set[str]) -> None:
    for key, member in value.members().items():
        if key not in known:
            raise member.error(f"is none of {', '.join(sorted(known))}")


def _told(place: JsonValue, do: Callable[[], Any], member: str = "") -> Any:
    """Add the place in the file, which ends with ``member``, to errors within the block."""
    try:
        return do()
    except (InvalidArgumentError, TypeError) as error:
        keys = error.keys if isinstance(error, MemberError) else ()
        text = str(error)
        for key in (member, *keys):
            text = text.removeprefix(f"{key}: ")
        raise place.at(keys).error(text) from None


def _writer(entry: JsonValue) -> DatasetWriter:
    kind = entry.need("writer")
    if not (isinstance(kind.value, str) and kind.value in KINDS):
        raise kind.wrong(f"one of {', '.join(KINDS)}")
    make = writer_class(kind.value)
    known = set(inspect.signature(make).parameters)
    _check_keys(entry, {"writer", *known})
    given = {key: one.value for key, one in entry.members().items() if key != "writer"}
    try:
        return made_writer(kind.value, **given)
    except (InvalidArgumentError, TypeError) as error:
        text = str(error)  # it begins with the faulty parameter
        key = next((key for key in given if text.startswith(f"{key} ")), None)
        raise entry.at([] if key is None else [key]).error(text) from None


def _values(entry: JsonValue, known: set[str], of_dataset: bool) -> dict[str, Value]:
    """Return the values of an object's members, checked."""
    _check_keys(entry, known)
    members = entry.members()
    if of_dataset and "outputs" in members:
        raise members["outputs"].error(
            "a data set's writer says what is written: see dataset.outputs"
        )
    return {key: _value(key, member, 0) for key, member in members.items() if key != "matrix"}


def _value(key: str, member: JsonValue, number: int) -> Value:
    if key == "name":
        if not isinstance(member.value, str):
            raise member.wrong("a text")
        return Value(member.value, member.value)
    value = _told(member, lambda: checked(key, member.value), key)
    return value_of(key, value, number)


def _combined(
    entry: JsonValue, shared: dict[str, Value], number: int, of_dataset: bool
) -> Iterator[dict[str, Value]]:
    """Return the values of each task that an entry describes."""
    own = {**shared, **_values(entry, _KEYS | {"matrix"}, of_dataset)}
    matrix = entry.get("matrix")
    lists = {} if matrix is None else _matrix(matrix, number, of_dataset)
    if matrix is not None and "name" not in own:
        own["name"] = Value("_".join(f"{{{key}}}" for key in _naming(own, lists)), "")
    for values in combinations(lists):
        yield {**own, **values}


def _naming(own: dict[str, Value], lists: dict[str, list[Value]]) -> list[str]:
    """Return the keys that distinguish a matrix's tasks, after the model or script."""
    shown = [key for key in ("model", "script") if key in own and key not in lists]
    return [*shown[:1], *lists]


def _matrix(entry: JsonValue, number: int, of_dataset: bool) -> dict[str, list[Value]]:
    lists: dict[str, Any] = {}
    count = 1
    for key, member in entry.members().items():
        if key not in _KEYS - {"name"} or (of_dataset and key == "outputs"):
            raise member.error("is no key whose values may be combined")
        if key == "seed" and isinstance(member.value, dict):
            lists[key] = _seeds(member)
        else:
            lists[key] = [_value(key, one, n) for n, one in enumerate(member)]
        if not lists[key]:
            raise member.error("holds no values")
        count *= len(lists[key])
    if number + count > _MOST:
        raise entry.error(f"these are {count:,} tasks; a manifest has up to {_MOST:,}")
    if isinstance(seeds := lists.get("seed"), range):
        lists["seed"] = [Value(seed, str(seed)) for seed in seeds]
    return lists


def _seeds(member: JsonValue) -> range:
    """Return consecutive seeds: ``{"from": 0, "count": 1000}``."""
    _check_keys(member, {"from", "count"})
    first, count = member.get("from"), member.need("count")
    start = 0 if first is None else _told(first, lambda: checked("seed", first.value))
    if not (type(count.value) is int and 1 <= count.value <= _MOST):
        raise count.wrong(f"a whole number from 1 to {_MOST:,}")
    return range(start, start + count.value)


def _task(entry: JsonValue, values: dict[str, Value], index: int, folder: str) -> Task:
    given = {key: one.value for key, one in values.items()}
    texts = {key: one.text for key, one in values.items() if key != "name"}
    texts["index"] = str(index)
    pattern = given.pop("name", "{model}" if "model" in given else "{script}")
    if not {"model", "script"} & given.keys():
        raise entry.error("a task needs a model or a script")
    size = calibrated_size(given.get("camera"))
    if size is not None and "size" not in given:
        given["size"] = _told(entry, lambda: checked("size", size))
    place = entry.get("name") or entry
    name = _told(place, lambda: checked("name", name_from(pattern, texts)))
    task = task_of({**given, "name": name, "index": index, "folder": folder})
    _told(entry, lambda: check_look(task))
    return task


def _check_name(entry: JsonValue, name: str, names: dict[str, tuple[str, str]]) -> None:
    if (key := folded(name)) in names:
        other, where = names[key]
        raise entry.error(
            f"two tasks have {common_name(name, other)}, the other is of {where}: give each a "
            '"name", such as "{model}_{index}"'
        )
    names[key] = name, entry.where
