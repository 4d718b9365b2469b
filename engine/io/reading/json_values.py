"""JSON values with their places in the file, checked on access.

In: the JSON parser's result. Out: texts, numbers, arrays and so on, or a `FileFormatError` that
names the place: ``nodes[3].rotation``.
"""

from __future__ import annotations

import base64
import math
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from ...base.files.json_records import parsed
from ...errors import FileFormatError
from .sources import Source
from .text import checked_text, shown

# Dtypes of arrays, by their names in files; little-endian.
ARRAY_TYPES = {
    "float32": "<f4",
    "int32": "<i4",
    "uint8": "u1",
    "bool": "?",
    "float64": "<f8",
    "int8": "i1",
    "int16": "<i2",
    "int64": "<i8",
    "uint16": "<u2",
    "uint32": "<u4",
    "uint64": "<u8",
}
_MAX_AXES = 3


class JsonValue:
    """A value of a JSON file.

    Attributes
    ----------
    value : object
        The parser's value.
    """

    __slots__ = ("_path", "_place", "value")

    def __init__(self, value: Any, path: str, place: tuple[Any, ...] = ()) -> None:
        self.value = value
        self._path = path
        self._place = place  # the container's place, and the key or number in it

    @property
    def where(self) -> str:
        """The value's place; empty for the whole file."""
        place, keys = self._place, []
        while place:
            place, key = place
            keys.append(f"[{key}]" if isinstance(key, int) else f".{key}")
        return "".join(reversed(keys)).removeprefix(".")

    def error(self, message: str) -> FileFormatError:
        """Return an error that names the file and the place."""
        where = self.where
        return FileFormatError(f"{where}: {message}" if where else message, self._path)

    def wrong(self, wanted: str) -> FileFormatError:
        """Return the error that something else was expected."""
        return self.error(f"{shown(repr(self.value))[1:-1]} is not {wanted}")

    def members(self) -> dict[str, JsonValue]:
        """Return the members of an object, by key."""
        if not isinstance(self.value, dict):
            raise self.wrong("an object")
        return {key: self._member(key) for key in self.value}

    def _member(self, key: str | int) -> JsonValue:
        return JsonValue(self.value[key], self._path, (self._place, key))

    def at(self, keys: Iterable[str | int]) -> JsonValue:
        """Return the value at the end of a path of keys and numbers."""
        place = self
        for key in keys:
            place = place._member(key)
        return place

    def get(self, key: str) -> JsonValue | None:
        """Return a member of an object; None if missing."""
        if not isinstance(self.value, dict):
            raise self.wrong("an object")
        return self._member(key) if key in self.value else None

    def need(self, key: str) -> JsonValue:
        """Return a required member of an object."""
        held = self.get(key)
        if held is None:
            raise self.error(f"{key!r} is missing")
        return held

    def __iter__(self) -> Iterator[JsonValue]:
        """Iterate over a list."""
        if not isinstance(self.value, list):
            raise self.wrong("a list")
        for number, value in enumerate(self.value):
            yield JsonValue(value, self._path, (self._place, number))

    def entries(self, key: str) -> list[JsonValue]:
        """Return the objects in a list under a key; none if missing."""
        held = self.get(key)
        found = [] if held is None else list(held)
        for entry in found:
            if not isinstance(entry.value, dict):
                raise entry.wrong("an object")
        return found

    def text(self) -> str:
        """Return a text, checked."""
        if not isinstance(self.value, str):
            raise self.wrong("a text")
        return self.value

    def flag(self) -> bool:
        """Return true or false, checked."""
        if not isinstance(self.value, bool):
            raise self.wrong("true or false")
        return self.value

    def index(self, count: int, of_what: str) -> int:
        """Return an integer from 0 to below ``count``, checked."""
        if type(self.value) is not int or not 0 <= self.value < count:
            raise self.wrong(f"the number of one of {count} {of_what}")
        return self.value

    def numbers(self, count: int) -> list[float]:
        """Return ``count`` finite numbers, checked."""
        value = self.value
        if not (isinstance(value, list) and len(value) == count and all(map(_is_number, value))):
            raise self.wrong(f"{count} finite numbers")
        return [float(number) for number in value]

    def base64(self) -> bytes:
        """Return the bytes of a base64 text."""
        try:
            return base64.b64decode(self.text(), validate=True)
        except ValueError:  # includes `binascii.Error`
            raise self.error("is not base64") from None

    def array(self) -> np.ndarray:
        """Return an array, given by dtype, shape and base64 bytes."""
        kind, shape = self.need("type").text(), self.need("shape")
        if kind not in ARRAY_TYPES:
            raise self.need("type").wrong(f"one of {', '.join(ARRAY_TYPES)}")
        axes = [axis.value for axis in shape]
        if not (len(axes) <= _MAX_AXES and all(type(n) is int and 0 <= n < 2**31 for n in axes)):
            raise shape.wrong(f"up to {_MAX_AXES} counts")
        data = self.need("base64")
        content = data.base64()
        dtype = np.dtype(ARRAY_TYPES[kind])
        if len(content) != math.prod(axes) * dtype.itemsize:
            raise self.error(f"{len(content)} bytes do not fill an array of shape {axes}")
        if dtype.kind == "b" and content.strip(b"\0\1"):
            raise data.error("holds bytes that are neither true nor false")
        return np.frombuffer(content, dtype).reshape(axes)


def parsed_json(source: Source) -> JsonValue:
    """Return the value of a JSON file.

    Raises
    ------
    FileFormatError
        The file is not JSON; the message names the line.
    """
    return JsonValue(parsed(checked_text(source), source.path), source.path)


def _is_number(value: Any) -> bool:
    try:
        return type(value) in (int, float) and math.isfinite(value)
    except OverflowError:
        return False
