"""Reading and writing of the program's own JSON files, with checks of their content.

In: a path, or bytes, and the expected shape. Out: a value of that shape, or an error that names the
file and the place. A shape is a function that returns the place of the first mismatch in a value,
such as ``.files[2]``, or None. Sealed files begin with a hash of their rest; if it does not match,
they count as damaged.
"""

from __future__ import annotations

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
_LAST_SECOND = 1 << 37  # in the year 6325: all systems accept this date


def parsed(data: str | bytes, path: str, shape: Shape | None = None) -> Any:
    """Return the value of a JSON text, checked.

    Raises
    ------
    FileFormatError
        The text is not JSON (RFC 8259), or the value has another shape; the message names the line
        or the place.
    """
    try:
        value = json.loads(data, object_pairs_hook=_object, parse_constant=_no_constant)
    except RecursionError:
        raise FileFormatError("not read: its JSON is nested too deeply", path) from None
    except json.JSONDecodeError as error:
        raise FileFormatError(f"not JSON: {error.msg}", path, error.lineno) from None
    except UnicodeDecodeError:
        raise FileFormatError("not JSON: it is not in UTF-8", path) from None
    except ValueError as error:  # from the hooks, or for numbers with too many digits
        raise FileFormatError(f"not JSON: {error}", path) from None
    return value if shape is None else checked(value, path, shape)


def checked(value: Any, path: str, shape: Shape) -> Any:
    """Return a value if it has a shape, or raise `FileFormatError`."""
    where = shape(value)
    if where is not None:
        place = f"{where.removeprefix('.')}: " if where else ""
        raise FileFormatError(f"{place}not what engine3d writes there", path)
    return value


def read_json(
    path: str | os.PathLike[str], shape: Shape | None = None, *, regular: bool = True
) -> Any:
    """Return the value of a JSON file.

    Raises
    ------
    FileAccessError
        The file cannot be read, or is not a regular file (unless ``regular`` is false): a FIFO
        might never get a writer.
    FileFormatError
    """
    return parsed(read_small(path, regular=regular), os.fspath(path), shape)


def read_small(path: str | os.PathLike[str], most: int = LARGEST, *, regular: bool = True) -> bytes:
    """Return the bytes of a small file; raise as `read_json` does."""
    data = start_of(path, most + 1, regular=regular)
    if len(data) > most:
        raise FileFormatError(f"not read: larger than {most} bytes", os.fspath(path))
    return data


def start_of(path: str | os.PathLike[str], size: int, *, regular: bool = True) -> bytes:
    """Return the first bytes of a file, at most ``size``.

    Raises `FileAccessError` as `read_json` does.
    """
    path = os.fspath(path)
    try:
        with open(path, "rb", opener=_opened_at_once if regular else None) as file:
            status = os.fstat(file.fileno())
            if not stat.S_ISREG(status.st_mode):
                if regular:
                    raise FileAccessError("cannot read: not a regular file", path)
                return file.read(size)
            # read() allocates its buffer first; virtual files have size 0.
            return file.read(min(size, max(status.st_size, 1 << 16)))
    except FileAccessError:
        raise
    except (OSError, ValueError, MemoryError) as error:
        reason = getattr(error, "strerror", None) or str(error) or "out of memory"
        raise FileAccessError(f"cannot read: {reason}", path) from error


def sealed(value: dict[str, Any]) -> bytes:
    """Return a value as the bytes of a sealed file, which `read_sealed` reads."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    rest = b'",' + text.removeprefix("{").encode("utf-8")
    return _SEAL + _digest(rest) + rest


def read_sealed(path: str | os.PathLike[str], shape: Shape) -> Any:
    """Return the value of a sealed file; raise as `read_json` does, or if it was modified."""
    data, name = read_small(path), os.fspath(path)
    start = len(_SEAL) + _DIGITS
    fits = data.startswith(_SEAL) and data[len(_SEAL) : start] == _digest(data[start:])
    value = parsed(data, name, members({}, more=True))
    if not fits:
        raise FileFormatError("damaged: its content does not fit its seal", name)
    del value["seal"]
    return checked(value, name, shape)


def _digest(data: bytes) -> bytes:
    import hashlib  # here, because it takes milliseconds

    return hashlib.blake2b(data, digest_size=_DIGITS // 2).hexdigest().encode("ascii")


def _opened_at_once(path: str, flags: int) -> int:
    return os.open(path, READ | AT_ONCE)


def _object(entries: list[tuple[str, Any]]) -> dict[str, Any]:
    """Build a JSON object; refuse duplicate members, which are ambiguous."""
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
    """Accept any value."""
    return None


def text(value: Any) -> str | None:
    """Accept a text; for paths it may contain surrogates for bytes that are not UTF-8."""
    return None if isinstance(value, str) else ""


def sound_text(value: Any) -> str | None:
    """Accept a text that can be encoded as UTF-8."""
    try:
        return None if isinstance(value, str) and value.encode("utf-8") is not None else ""
    except UnicodeError:
        return ""


def path_text(value: Any) -> str | None:
    """Accept a text that the system can use as a path."""
    try:
        return None if isinstance(value, str) and b"\0" not in os.fsencode(value) else ""
    except UnicodeError:
        return ""


def path_inside(value: Any) -> str | None:
    """Accept a relative path that stays inside its folder."""
    if path_text(value) is not None or not value or os.path.isabs(value):
        return ""
    return "" if ".." in value.replace("\\", "/").split("/") else None


def whole(value: Any) -> str | None:
    """Accept a 64-bit integer."""
    return None if type(value) is int and abs(value) < _LARGEST_WHOLE else ""


def count(value: Any) -> str | None:
    """Accept an integer from 0 on."""
    return None if whole(value) is None and value >= 0 else ""


def number(value: Any) -> str | None:
    """Accept a finite number."""
    if type(value) is float:
        return None if math.isfinite(value) else ""
    return whole(value)


def time_of_day(value: Any) -> str | None:
    """Accept seconds since the epoch that a calendar can represent."""
    return None if number(value) is None and 0 <= value < _LAST_SECOND else ""


def one_of(*values: Any) -> Shape:
    """Return a shape: one of some values of the same type."""
    return lambda value: None if any(type(value) is type(v) and value == v for v in values) else ""


def maybe(shape: Shape) -> Shape:
    """Return a shape: a value of another shape, or null."""
    return lambda value: None if value is None else shape(value)


def listed(shape: Shape, exactly: int | None = None) -> Shape:
    """Return a shape: a list of values of one shape."""

    def check(value: Any) -> str | None:
        if not isinstance(value, list) or exactly not in (None, len(value)):
            return ""
        return _first((f"[{place}]", shape, one) for place, one in enumerate(value))

    return check


def row(*shapes: Shape) -> Shape:
    """Return a shape: a list of fixed length, with a shape for each value."""

    def check(value: Any) -> str | None:
        if not isinstance(value, list) or len(value) != len(shapes):
            return ""
        pairs = zip(shapes, value, strict=True)
        return _first((f"[{place}]", shape, one) for place, (shape, one) in enumerate(pairs))

    return check


def mapped(key: Shape, shape: Shape) -> Shape:
    """Return a shape: an object whose keys have one shape and whose values another."""

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
    """Return a shape: an object with these members; others are allowed if ``more``."""
    known = {**needed, **(optional or {})}

    def check(value: Any) -> str | None:
        if not isinstance(value, dict) or needed.keys() - value.keys():
            return ""
        if not more and value.keys() - known.keys():
            return ""
        return _first((f".{name}", known.get(name, anything), one) for name, one in value.items())

    return check


def _first(found: Iterable[tuple[str, Shape, Any]]) -> str | None:
    """Return the place of the first value that does not have its shape."""
    for place, shape, value in found:
        where = shape(value)
        if where is not None:
            return place + where
    return None
