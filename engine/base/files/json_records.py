"""Files of JSON that the program itself writes and reads again, whatever stands in them by then.

In: a path, or bytes, and the shape that the value should have. Out: a value of that shape, or an
error that names the file and the place. A shape is a function that returns where in a value it
finds something else, as ``.files[2]``, and None where it does not. Sealed files begin with the hash
of their rest: not a letter of them was changed, else they count as damaged.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import stat
from collections import Counter
from collections.abc import Callable, Iterable
from typing import Any, TypeAlias

from ...errors import FileAccessError, FileFormatError
from ..system import AT_ONCE, READ

Shape: TypeAlias = Callable[[Any], "str | None"]

LARGEST = 1 << 28  # bytes
_SEAL, _DIGITS = b'{"seal":"', 40
_LARGEST_WHOLE = 1 << 63
_LAST_SECOND = 1 << 37  # in the year 6325: on no system too late for a date


def parsed(data: str | bytes, path: str, shape: Shape | None = None) -> Any:
    """Return the value that a text holds.

    Raises
    ------
    FileFormatError
        It is not JSON, as RFC 8259 has it, or the value is of another shape; the message names the
        line, or the place.
    """
    try:
        value = json.loads(data, object_pairs_hook=_object, parse_constant=_no_constant)
    except RecursionError:
        raise FileFormatError("not read: its JSON is nested too deeply", path) from None
    except json.JSONDecodeError as error:
        raise FileFormatError(f"not JSON: {error.msg}", path, error.lineno) from None
    except UnicodeDecodeError:
        raise FileFormatError("not JSON: it is not in UTF-8", path) from None
    except ValueError as error:  # what the hooks say; a number of more digits than Python reads
        raise FileFormatError(f"not JSON: {error}", path) from None
    return value if shape is None else checked(value, path, shape)


def checked(value: Any, path: str, shape: Shape) -> Any:
    """Return a value that is of a shape, or raise `FileFormatError`."""
    where = shape(value)
    if where is not None:
        place = f"{where.removeprefix('.')}: " if where else ""
        raise FileFormatError(f"{place}not what engine3d writes there", path)
    return value


def read_json(
    path: str | os.PathLike[str], shape: Shape | None = None, *, regular: bool = True
) -> Any:
    """Return the value that a file holds.

    Raises
    ------
    FileAccessError
        It cannot be read; or it is no regular file, unless ``regular`` is false: whoever writes to
        a FIFO that nobody named might never begin.
    FileFormatError
    """
    return parsed(read_small(path, regular=regular), os.fspath(path), shape)


def read_small(path: str | os.PathLike[str], most: int = LARGEST, *, regular: bool = True) -> bytes:
    """Return the bytes of a file that is not large; raises as `read_json`."""
    data = start_of(path, most + 1, regular=regular)
    if len(data) > most:
        raise FileFormatError(f"not read: larger than {most} bytes", os.fspath(path))
    return data


def start_of(path: str | os.PathLike[str], size: int, *, regular: bool = True) -> bytes:
    """Return the first bytes of a file, so many at most.

    Raises `FileAccessError`, as `read_json`.
    """
    path = os.fspath(path)
    try:
        with open(path, "rb", opener=_opened_at_once if regular else None) as file:
            status = os.fstat(file.fileno())
            if not stat.S_ISREG(status.st_mode):
                if regular:
                    raise FileAccessError("cannot read: not a regular file", path)
                return file.read(size)
            # A buffer is made first; what a system makes up has a size of 0.
            return file.read(min(size, max(status.st_size, 1 << 16)))
    except FileAccessError:
        raise
    except (OSError, ValueError, MemoryError) as error:
        reason = getattr(error, "strerror", None) or str(error) or "out of memory"
        raise FileAccessError(f"cannot read: {reason}", path) from error


def sealed(value: dict[str, Any]) -> bytes:
    """Return the bytes of a file that `read_sealed` reads."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    rest = b'",' + text.removeprefix("{").encode("utf-8")
    return _SEAL + _digest(rest) + rest


def read_sealed(path: str | os.PathLike[str], shape: Shape) -> Any:
    """Return what `sealed` was given; raises as `read_json`, or where anything was changed."""
    data, name = read_small(path), os.fspath(path)
    start = len(_SEAL) + _DIGITS
    fits = data.startswith(_SEAL) and data[len(_SEAL) : start] == _digest(data[start:])
    value = parsed(data, name, members({}, more=True))
    if not fits:
        raise FileFormatError("damaged: its content does not fit its seal", name)
    del value["seal"]
    return checked(value, name, shape)


def _digest(data: bytes) -> bytes:
    return hashlib.blake2b(data, digest_size=_DIGITS // 2).hexdigest().encode("ascii")


def _opened_at_once(path: str, flags: int) -> int:
    return os.open(path, READ | AT_ONCE)


def _object(entries: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object, none of whose members is there twice: which one counts would be a guess."""
    found = dict(entries)
    if len(found) < len(entries):
        counts = Counter(key for key, _ in entries)
        name = counts.most_common(1)[0][0]
        raise ValueError(f"an object has {ascii(name[:40])} twice")
    return found


def _no_constant(name: str) -> None:
    raise ValueError(f"{name} is no number of JSON")


# Shapes


def anything(value: Any) -> str | None:
    """Whatever it is."""
    return None


def text(value: Any) -> str | None:
    """A text; of paths, which need not be UTF-8, it may hold what stands for their bytes."""
    return None if isinstance(value, str) else ""


def sound_text(value: Any) -> str | None:
    """A text that can be written as UTF-8."""
    try:
        return None if isinstance(value, str) and value.encode("utf-8") is not None else ""
    except UnicodeError:
        return ""


def path_text(value: Any) -> str | None:
    """A text that the system can take for a path."""
    try:
        return None if isinstance(value, str) and b"\0" not in os.fsencode(value) else ""
    except UnicodeError:
        return ""


def path_inside(value: Any) -> str | None:
    """A path that leads from a folder to what is in it."""
    if path_text(value) is not None or not value or os.path.isabs(value):
        return ""
    return "" if ".." in value.replace("\\", "/").split("/") else None


def whole(value: Any) -> str | None:
    """A whole number of 64 bits."""
    return None if type(value) is int and abs(value) < _LARGEST_WHOLE else ""


def count(value: Any) -> str | None:
    """A whole number from 0 on."""
    return None if whole(value) is None and value >= 0 else ""


def number(value: Any) -> str | None:
    """A finite number."""
    if type(value) is float:
        return None if math.isfinite(value) else ""
    return whole(value)


def time_of_day(value: Any) -> str | None:
    """Seconds since the epoch that a calendar has."""
    return None if number(value) is None and 0 <= value < _LAST_SECOND else ""


def one_of(*values: Any) -> Shape:
    """One of some values of the same type."""
    return lambda value: None if any(type(value) is type(v) and value == v for v in values) else ""


def maybe(shape: Shape) -> Shape:
    """A value, or null."""
    return lambda value: None if value is None else shape(value)


def listed(shape: Shape, exactly: int | None = None) -> Shape:
    """A list of values of one shape."""

    def check(value: Any) -> str | None:
        if not isinstance(value, list) or exactly not in (None, len(value)):
            return ""
        return _first((f"[{place}]", shape, one) for place, one in enumerate(value))

    return check


def row(*shapes: Shape) -> Shape:
    """A list of so many values, each of its own shape."""

    def check(value: Any) -> str | None:
        if not isinstance(value, list) or len(value) != len(shapes):
            return ""
        pairs = zip(shapes, value, strict=True)
        return _first((f"[{place}]", shape, one) for place, (shape, one) in enumerate(pairs))

    return check


def mapped(key: Shape, shape: Shape) -> Shape:
    """An object whose keys are of one shape, and its values of another."""

    def check(value: Any) -> str | None:
        if not isinstance(value, dict):
            return ""
        if any(key(name) is not None for name in value):
            return ""
        return _first((f".{ascii(name)[1:-1]}", shape, one) for name, one in value.items())

    return check


def members(
    needed: dict[str, Shape], optional: dict[str, Shape] | None = None, *, more: bool = False
) -> Shape:
    """An object with these members, and with others only where ``more`` says so."""
    known = {**needed, **(optional or {})}

    def check(value: Any) -> str | None:
        if not isinstance(value, dict) or needed.keys() - value.keys():
            return ""
        if not more and value.keys() - known.keys():
            return ""
        return _first((f".{name}", known.get(name, anything), one) for name, one in value.items())

    return check


def _first(found: Iterable[tuple[str, Shape, Any]]) -> str | None:
    """The place of the first value that is not of its shape."""
    for place, shape, value in found:
        where = shape(value)
        if where is not None:
            return place + where
    return None
