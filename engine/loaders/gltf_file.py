"""A glTF file taken apart: its JSON and, of a .glb, its binary chunk.

In: the bytes of a file. Out: the JSON as objects, each checked when it is asked for, and an error
that names the place of what is wrong in it. Source: Khronos, "glTF 2.0 Specification", 2021.
"""

from __future__ import annotations

import json
import math
import struct

from ..errors import FileFormatError
from .sources import Source
from .text import shown

GLB = b"glTF"
LIGHTS = "KHR_lights_punctual"
_HEADER, _CHUNK_HEADER = 12, 8
_LISTS = ("accessors", "animations", "bufferViews", "buffers", "cameras", "images", "materials")
_LISTS += ("meshes", "nodes", "samplers", "scenes", "skins", "textures")
_JSON, _BINARY = 0x4E4F534A, 0x004E4942


class GltfFile:
    """A glTF file.

    Parameters
    ----------
    source : Source

    Attributes
    ----------
    path : str
        What messages call it.
    kind : {"glb", "gltf"}
    tree : dict
        The JSON.
    binary : memoryview or None
        The binary chunk of a .glb, if it has one.
    newer : str or None
        A version beyond 2.0 that it says it needs.

    Raises
    ------
    FileFormatError
        It is no glTF file, or of another version than 2.
    """

    def __init__(self, source: Source) -> None:
        self.path = source.path
        data = memoryview(source.data)
        is_binary = source.data.startswith(GLB)
        if source.extension == ".glb" and not is_binary:
            raise self.error("not a glb file")
        self.kind = "glb" if is_binary else "gltf"
        self.binary: memoryview | None = None
        self._checked: dict[str, list[dict]] = {}
        if is_binary:
            data = self._first_chunk(data)
        self.tree = self._parsed(data)
        self._check_version()
        for name in _LISTS:
            self.entries(name)
        for name in self.part(self.tree, "extensions", ""):
            self.part(self.tree["extensions"], name, "extensions")

    def error(self, message: str) -> FileFormatError:
        """Return an error that names the file."""
        return FileFormatError(message, self.path)

    def entries(self, name: str, parent: dict | None = None, where: str = "") -> list[dict]:
        """Return a list of objects of the JSON, or of an object in it; empty if it is left out."""
        if parent is None and name in self._checked:
            return self._checked[name]
        entries = (self.tree if parent is None else parent).get(name, [])
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            raise self.error(f"damaged: {where}{name} is no list of objects")
        if parent is None:
            self._checked[name] = entries
        return entries

    def entry(self, name: str, index, where: str) -> dict:
        """Return the object that an index means; ``where`` is the place that names it."""
        entries = self.entries(name)
        return entries[self.index(index, len(entries), name, where)]

    def index(self, value, count: int, name: str, where: str) -> int:
        """Return the number of one of ``count`` things."""
        if type(value) is not int or not 0 <= value < count:
            raise self.error(f"damaged: {where} names {name}[{_short(value)}], there are {count}")
        return value

    def lights(self) -> list[dict]:
        """Return the lights of KHR_lights_punctual."""
        extensions = self.part(self.tree, "extensions", "")
        lights = self.part(extensions, LIGHTS, "extensions")
        if LIGHTS in extensions and "lights" not in lights:
            raise self.error(f"damaged: extensions.{LIGHTS} has no lights")
        return self.entries("lights", lights, f"extensions.{LIGHTS}.")

    def text(self, entry: dict, name: str, where: str) -> str:
        """Return a text; empty if it is left out."""
        value = entry.get(name, "")
        if not isinstance(value, str):
            raise self.error(f"damaged: {where}.{name} is {_short(value)}, no text")
        return value

    def part(self, parent: dict, name: str, where: str) -> dict:
        """Return an object in an object; empty if it is left out."""
        part = parent.get(name, {})
        if not isinstance(part, dict):
            raise self.error(f"damaged: {where}{'.' * bool(where)}{name} is no object")
        return part

    def whole(self, entry: dict, name: str, where: str, default: int | None = None) -> int:
        """Return a whole number that is not negative."""
        value = entry.get(name, default)
        if isinstance(value, float) and value.is_integer():
            value = int(value)
        if type(value) is not int or not 0 <= value < 1 << 53:
            raise self.error(f"damaged: {where}.{name} is {_short(value)}")
        return value

    def numbers(self, entry: dict, name: str, where: str, default: tuple) -> tuple[float, ...]:
        """Return as many finite numbers as ``default`` has."""
        values = entry.get(name, default)
        is_sound = isinstance(values, (list, tuple)) and len(values) == len(default)
        if not is_sound or not all(_is_number(value) for value in values):
            raise self.error(f"damaged: {where}.{name} is not {len(default)} numbers")
        return tuple(float(value) for value in values)

    def number(self, entry: dict, name: str, where: str, default: float) -> float:
        """Return a finite number."""
        value = entry.get(name, default)
        if not _is_number(value):
            raise self.error(f"damaged: {where}.{name} is {_short(value)}, no finite number")
        return float(value)

    def number_list(self, entry: dict, name: str, where: str) -> tuple[float, ...] | None:
        """Return any number of finite numbers; None if they are left out."""
        values = entry.get(name)
        if values is None:
            return None
        if not isinstance(values, list) or not all(map(_is_number, values)):
            raise self.error(f"damaged: {where}.{name} is no list of numbers")
        return tuple(map(float, values))

    def _first_chunk(self, data: memoryview) -> memoryview:
        """The bytes of the JSON; takes note of the binary chunk."""
        if len(data) < _HEADER + _CHUNK_HEADER:
            raise self.error("damaged: the file ends within its header")
        version, length = struct.unpack_from("<II", data, 4)
        if version != 2:
            raise self.error(f"glTF of version {version} is not read, only 2")
        if length > len(data):
            raise self.error(f"damaged: {length} bytes are announced, there are {len(data)}")
        size, kind = struct.unpack_from("<II", data, _HEADER)
        first, end = _HEADER + _CHUNK_HEADER, _HEADER + _CHUNK_HEADER + size
        if kind != _JSON or end > length:
            raise self.error("damaged: the first chunk is no whole JSON chunk")
        if end + _CHUNK_HEADER <= length:
            size, kind = struct.unpack_from("<II", data, end)
            start = end + _CHUNK_HEADER
            if start + size > length:
                raise self.error("damaged: a chunk goes beyond the end of the file")
            if kind == _BINARY:
                self.binary = data[start : start + size]
            elif self._has_chunk(data[start + size : length], _BINARY):
                raise self.error("damaged: the binary chunk is not the second one")
        return data[first:end]

    def _has_chunk(self, data: memoryview, wanted: int) -> bool:
        """Whether a chunk of a kind stands in the rest of a file."""
        place = 0
        while place + _CHUNK_HEADER <= len(data):
            size, kind = struct.unpack_from("<II", data, place)
            if kind == wanted:
                return True
            place += _CHUNK_HEADER + size
        return False

    def _parsed(self, text: memoryview) -> dict:
        try:
            tree = json.loads(bytes(text).decode("utf-8"))
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
        for wanted in (version, least):
            if wanted.partition(".")[0] != "2":
                raise self.error(f"glTF of version {shown(wanted)} is not read, only 2.0")
        self.newer = least if least not in ("2.0", "2") else None


def _is_number(value) -> bool:
    try:
        return type(value) in (int, float) and math.isfinite(value)
    except OverflowError:
        return False


def _short(value) -> str:
    return shown(repr(value))[1:-1]
