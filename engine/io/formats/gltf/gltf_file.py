"""The structure of a glTF file: its JSON and, for .glb, its binary chunk.

In: the bytes of a file. Out: the JSON's objects, each checked when requested, and errors that name
the damaged place. Optional parts are left out with a warning; if nothing remains to draw, the first
error is raised. Source: Khronos, "glTF 2.0 Specification", 2021.
"""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Callable
from typing import Any, NoReturn, TypeAlias, TypeVar

from ....errors import FileFormatError
from ...reading.sources import Source
from ...reading.text import shown
from ...reading.warning_list import WarningList

GLB = b"glTF"
LIGHTS = "KHR_lights_punctual"
_HEADER, _CHUNK_HEADER = 12, 8
_LISTS = (
    *("accessors", "animations", "bufferViews", "buffers", "cameras", "images", "materials"),
    *("meshes", "nodes", "samplers", "scenes", "skins", "textures"),
)
# Non-object entries of these lists are left out: they are optional for a picture.
_SPARE_LISTS = {"animations", "cameras", "images", "materials", "samplers", "skins", "textures"}
_JSON, _BINARY = 0x4E4F534A, 0x004E4942
_Key = TypeVar("_Key")
_Value = TypeVar("_Value")

#: An object of the JSON with arbitrary content.
Entry: TypeAlias = dict[str, Any]


class DamagedError(FileFormatError):
    """A part of a file is damaged; other parts may be sound."""


class GltfFile:
    """A glTF file.

    Parameters
    ----------
    source : Source

    Attributes
    ----------
    path : str
        The path as messages show it.
    kind : {"glb", "gltf"}
    tree : dict
        The JSON.
    binary : memoryview or None
        The binary chunk of a .glb, if it has one.
    warnings : WarningList
    lost : DamagedError or None
        The first reason why something drawable was left out.

    Raises
    ------
    FileFormatError
        It is not a glTF file, or not version 2.
    """

    def __init__(self, source: Source) -> None:
        self.path = source.path
        self.warnings = WarningList(source.path)
        self.lost: DamagedError | None = None
        data = memoryview(source.data)
        is_binary = source.data.startswith(GLB)
        if source.extension == ".glb" and not is_binary:
            raise self.error("not a glb file")
        self.kind = "glb" if is_binary else "gltf"
        self.binary: memoryview | None = None
        self._checked: dict[str, list[Entry]] = {}
        if is_binary:
            data = self._first_chunk(data)
        self.tree = self._parsed(data)
        self._check_version()
        for name in _LISTS:
            self.entries(name)

    def error(self, message: str) -> FileFormatError:
        """Return an error that names the file."""
        return FileFormatError(message, self.path)

    def damaged(self, message: str) -> DamagedError:
        """Return an error that names the file and a damaged part."""
        return DamagedError(f"damaged: {message}", self.path)

    def leave_out(self, where: str, error: DamagedError) -> None:
        """Warn that something is left out, and why."""
        reason = error.message.removeprefix("damaged: ")
        for own in (f"{where}: ", f"{where} "):
            reason = reason.removeprefix(own)
        self.warnings.add_once(f"{where} is left out: {reason}")

    def lose(self, where: str, error: DamagedError) -> None:
        """Warn that something drawable is left out."""
        self.lost = self.lost or error
        self.leave_out(where, error)

    def sound(self, where: str, read: Callable[..., _Value], *args: Any) -> _Value | None:
        """Return a function's result for a part of the file; None, with a warning, if damaged."""
        try:
            return read(*args)
        except DamagedError as error:
            self.leave_out(where, error)
            return None

    def entries(self, name: str, parent: Entry | None = None, where: str = "") -> list[Entry]:
        """Return a list of objects in the JSON, or in an object of it; empty if missing."""
        if parent is None and name in self._checked:
            return self._checked[name]
        entries = (self.tree if parent is None else parent).get(name, [])
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            error = self.damaged(f"{where}{name} is no list of objects")
            if parent is not None or name not in _SPARE_LISTS:
                raise error
            self.leave_out(name, error)
            entries = entries if isinstance(entries, list) else []
            entries = [entry if isinstance(entry, dict) else {} for entry in entries]
        if parent is None:
            self._checked[name] = entries
        return entries

    def extension(self, name: str) -> Entry:
        """Return the file's own data for an extension; empty if missing."""
        return self.part(self.part(self.tree, "extensions", ""), name, "extensions")

    def entry(self, name: str, index: Any, where: str) -> Entry:
        """Return the object with an index; ``where`` is the place that refers to it."""
        entries = self._checked[name]
        if type(index) is int and 0 <= index < len(entries):  # the common case, and very frequent
            return entries[index]
        return entries[self.index(index, len(entries), name, where)]

    def number_in(self, name: str, value: Any, where: str) -> int:
        """Return the index of an entry in one of the file's lists, checked."""
        count = len(self._checked[name])
        if type(value) is int and 0 <= value < count:
            return value
        return self.index(value, count, name, where)

    def index(self, value: Any, count: int, name: str, where: str) -> int:
        """Return an index below ``count``, checked."""
        value = whole_of(value)
        if type(value) is not int or not 0 <= value < count:
            raise self.damaged(f"{where} names {name}[{_short(value)}], there are {count}")
        return value

    def lights(self) -> list[Entry]:
        """Return the lights of KHR_lights_punctual."""
        return self.sound(f"extensions.{LIGHTS}", self._lights) or []

    def _lights(self) -> list[Entry]:
        lights = self.extension(LIGHTS)
        if LIGHTS in self.part(self.tree, "extensions", "") and "lights" not in lights:
            raise self.damaged(f"extensions.{LIGHTS} has no lights")
        return self.entries("lights", lights, f"extensions.{LIGHTS}.")

    def name(self, entry: Entry, where: str) -> str:
        """Return a thing's name; empty if it has none or the name is not a text."""
        value = entry.get("name", "")
        if isinstance(value, str):
            return value
        self.leave_out(f"{where}.name", self.damaged(f"{_short(value)} is no text"))
        return ""

    def part(self, parent: Entry, name: str, where: str) -> Entry:
        """Return an object inside an object; empty if missing."""
        part = parent.get(name, {})
        if not isinstance(part, dict):
            raise self.damaged(f"{where}{'.' * bool(where)}{name} is no object")
        return part

    def spare_part(self, parent: Entry, name: str, where: str) -> Entry:
        """Return an object inside an object; empty, with a warning, if it is not an object."""
        part = parent.get(name)
        if part is None or isinstance(part, dict):
            return part or {}
        self.leave_out(f"{where}.{name}", self.damaged(f"{where}.{name} is no object"))
        return {}

    def whole(self, entry: Entry, name: str, where: str, default: int | None = None) -> int:
        """Return a non-negative integer, checked."""
        value = entry.get(name, default)
        if type(value) is not int:
            value = whole_of(value)
        if type(value) is not int or not 0 <= value < 1 << 53:
            raise self.damaged(f"{where}.{name} is {_short(value)}")
        return value

    def numbers(
        self, entry: Entry, name: str, where: str, default: tuple[float, ...]
    ) -> tuple[float, ...]:
        """Return finite numbers, as many as ``default`` has."""
        values = entry.get(name, default)
        is_sound = isinstance(values, (list, tuple)) and len(values) == len(default)
        if not is_sound or not all(_is_number(value) for value in values):
            raise self.damaged(f"{where}.{name} is not {len(default)} numbers")
        return tuple(float(value) for value in values)

    def number(self, entry: Entry, name: str, where: str, default: float) -> float:
        """Return a finite number, checked."""
        value = entry.get(name, default)
        if not _is_number(value):
            raise self.damaged(f"{where}.{name} is {_short(value)}, no finite number")
        return float(value)

    def number_list(self, entry: Entry, name: str, where: str) -> tuple[float, ...] | None:
        """Return a list of finite numbers of any length; None if missing."""
        values = entry.get(name)
        if values is None:
            return None
        if not isinstance(values, list) or not all(map(_is_number, values)):
            raise self.damaged(f"{where}.{name} is no list of numbers")
        return tuple(map(float, values))

    def _first_chunk(self, data: memoryview) -> memoryview:
        """Return the bytes of the JSON; store the binary chunk."""
        if len(data) < _HEADER + _CHUNK_HEADER:
            raise self.damaged("the file ends within its header")
        version, length = struct.unpack_from("<II", data, 4)
        if version != 2:
            raise self.error(f"glTF of version {version} is not read, only 2")
        if length > len(data):
            raise self.damaged(f"{length} bytes are announced, there are {len(data)}")
        size, kind = struct.unpack_from("<II", data, _HEADER)
        first, end = _HEADER + _CHUNK_HEADER, _HEADER + _CHUNK_HEADER + size
        if kind != _JSON or end > length:
            raise self.damaged("the first chunk is no whole JSON chunk")
        if end + _CHUNK_HEADER <= length:
            size, kind = struct.unpack_from("<II", data, end)
            start = end + _CHUNK_HEADER
            if start + size > length:
                raise self.damaged("a chunk goes beyond the end of the file")
            if kind == _BINARY:
                self.binary = data[start : start + size]
            elif self._has_chunk(data[start + size : length], _BINARY):
                raise self.damaged("the binary chunk is not the second one")
        return data[first:end]

    def _has_chunk(self, data: memoryview, wanted: int) -> bool:
        """Return whether the rest of a file contains a chunk of a given type."""
        place = 0
        while place + _CHUNK_HEADER <= len(data):
            size, kind = struct.unpack_from("<II", data, place)
            if kind == wanted:
                return True
            place += _CHUNK_HEADER + size
        return False

    def _parsed(self, text: memoryview) -> Entry:
        try:
            tree = json.loads(bytes(text).decode("utf-8"), parse_constant=_no_number)
        except RecursionError:
            raise self.error(f"not a {self.kind} file: its JSON is nested too deeply") from None
        except ValueError as error:
            raise self.error(f"not a {self.kind} file: no JSON in UTF-8 ({error})") from error
        if not isinstance(tree, dict):
            raise self.error(f"not a {self.kind} file: its JSON is no object")
        return tree

    def _check_version(self) -> None:
        asset = self.part(self.tree, "asset", "")
        version, least = asset.get("version"), asset.get("minVersion", "2.0")
        if not isinstance(version, str) or not isinstance(least, str):
            raise self.error("not a glTF file: it does not tell its version as a text")
        if version.partition(".")[0] != "2":
            raise self.error(f"glTF of version {shown(version)} is not read, only 2.0")
        if _parts_of(least) > (2, 0):
            raise self.error(f"needs glTF of version {shown(least)}, only 2.0 is read")
        if version not in ("2.0", "2"):
            self.warnings.add(f"what glTF {shown(version)} has beyond 2.0 is not read")


def once(kept: dict[_Key, _Value | DamagedError], key: _Key, make: Callable[[], _Value]) -> _Value:
    """Return the cached result for a key, or compute it; errors of damaged parts are cached too."""
    found = kept.get(key)
    if found is None:
        try:
            found = make()
        except DamagedError as error:
            found = error
        kept[key] = found
    if isinstance(found, DamagedError):
        raise found.with_traceback(None)
    return found


def _parts_of(version: str) -> tuple[int, int]:
    """Return major and minor version; a huge pair if invalid."""
    major, _, minor = version.partition(".")
    parts = major, minor or "0"
    are_sound = all(part.isascii() and part.isdigit() and len(part) < 10 for part in parts)
    return (int(parts[0]), int(parts[1])) if are_sound else (10**9, 0)


def whole_of(value: Any) -> Any:
    """Return a number without a fraction as an integer; JSON may write it as 1.0 or 1e0."""
    return int(value) if isinstance(value, float) and value.is_integer() else value


def _no_number(name: str) -> NoReturn:
    raise ValueError(f"{name} is no number")


def _is_number(value: Any) -> bool:
    try:
        return type(value) in (int, float) and math.isfinite(value)
    except OverflowError:
        return False


def _short(value: Any) -> str:
    return shown(repr(value))[1:-1]
