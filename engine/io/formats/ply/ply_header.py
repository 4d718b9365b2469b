"""The header of a PLY file, which describes its body.

In: the bytes of a file. Out: a `PlyHeader`: the encoding, the elements with their properties, the
images that comments name, and where the body begins. The reader of the body checks that the
announced content exists. Source: G. Turk, "The PLY Polygon File Format", 1994.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import NoReturn

from ....errors import FileFormatError
from ...reading.sources import Source
from ...reading.text import decoded, shown
from ...reading.warning_list import WarningList

#: Type names -> NumPy codes, without byte order.
TYPES = {
    "char": "i1",
    "int8": "i1",
    "uchar": "u1",
    "uint8": "u1",
    "short": "i2",
    "int16": "i2",
    "ushort": "u2",
    "uint16": "u2",
    "int": "i4",
    "int32": "i4",
    "uint": "u4",
    "uint32": "u4",
    "int64": "i8",
    "uint64": "u8",
    "float": "f4",
    "float32": "f4",
    "double": "f8",
    "float64": "f8",
}
#: Encoding names -> byte order of numbers, "" for text.
ENCODINGS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}

#: The comment of our own writer.
OWN_COMMENT = b"comment written by engine3d"
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_MAGIC = re.compile(rb"ply[ \t]*(\r\n|\n|\r)")
_END = re.compile(rb"(?:^|(?<=[\r\n]))[ \t]*end_header[ \t]*(?:\r\n|\n|\r|$)")
_MAX_DIGITS = 18
# More bytes than most headers have.
_USUAL_SIZE = 1 << 16


@dataclass(frozen=True)
class PlyProperty:
    """One property of an element.

    Attributes
    ----------
    name : str
    type : str
        NumPy code without byte order, such as ``"f4"``; for a list, that of its items.
    count_type : str or None
        The code of a list's length; None for a single number.
    """

    name: str
    type: str
    count_type: str | None = None


@dataclass
class PlyElement:
    """One kind of row in the body.

    Attributes
    ----------
    name : str
    count : int
        The announced number of rows.
    properties : dict of str to PlyProperty
    """

    name: str
    count: int
    properties: dict[str, PlyProperty] = field(default_factory=dict)


@dataclass
class PlyHeader:
    """The header of a PLY file.

    Attributes
    ----------
    byte_order : {"", "<", ">"}
        Empty for a text body.
    elements : dict of str to PlyElement
        In body order.
    textures : list of str
        The names in ``comment TextureFile``.
    body_start : int
        Offset of the body's first byte.
    body_line : int
        The number of its first line, from 1.
    is_own : bool
        Whether our own writer made the file.
    """

    byte_order: str
    elements: dict[str, PlyElement]
    textures: list[str]
    body_start: int
    body_line: int
    is_own: bool = False


def is_ply(head: bytes) -> bool:
    """Return whether a file that begins with ``head`` is a PLY file."""
    return _MAGIC.match(head.removeprefix(_BYTE_ORDER_MARK)) is not None


def read_header(source: Source, warnings: WarningList) -> PlyHeader:
    """Read the header.

    Raises
    ------
    FileFormatError
        It is not a PLY header, or its content is impossible.
    """
    data = source.head(_USUAL_SIZE)
    end = _END.search(data)
    if len(data) < source.size and (end is None or end.end() == len(data)):
        data = source.data
    start = len(_BYTE_ORDER_MARK) if data.startswith(_BYTE_ORDER_MARK) else 0
    magic = _MAGIC.match(data, start)
    if magic is None:
        raise FileFormatError("not a PLY file: the first line is not 'ply'", source.path, 1)
    end = _END.search(data, magic.end())
    if end is None:
        raise FileFormatError("the header has no end_header", source.path)
    line_end = magic[1]
    body_start = end.end()
    if line_end != b"\r\n" and data[body_start - 2 : body_start] == b"\r\n":
        # The header's lines end in CR alone; the line feed is the body's first byte.
        body_start -= line_end == b"\r"
    lines = data[magic.end() : end.start()].split(line_end)
    parser = _HeaderParser(source.path, warnings)
    for number, line in enumerate(lines, 2):
        parser.read(line, number)
    return parser.header(body_start, 2 + len(lines))


class _HeaderParser:
    """Parses the lines between ``ply`` and ``end_header``."""

    def __init__(self, path: str, warnings: WarningList) -> None:
        self._path = path
        self._warnings = warnings
        self._byte_order: str | None = None
        self._elements: dict[str, PlyElement] = {}
        self._current: PlyElement | None = None
        self._textures: list[str] = []
        self._number = 1
        self._is_own = False

    def read(self, line: bytes, number: int) -> None:
        self._number = number
        words = line.split(None, 5)
        if not words or words[0] == b"obj_info":
            return
        if words[0] == b"comment":
            self._comment(line)
            return
        read = {
            b"format": self._format,
            b"element": self._element,
            b"property": self._property,
        }.get(words[0])
        if read is None:
            self._warnings.add(f"not a header line, left out: {shown(line)}", number)
            return
        read(words)

    def header(self, body_start: int, body_line: int) -> PlyHeader:
        if self._byte_order is None:
            raise FileFormatError("the header has no format line", self._path)
        found = self._elements, self._textures
        return PlyHeader(self._byte_order, *found, body_start, body_line, self._is_own)

    def _comment(self, line: bytes) -> None:
        self._is_own |= line.strip() == OWN_COMMENT
        words = line.split(None, 2)
        if len(words) == 3 and words[1].lower() == b"texturefile":
            self._textures.append(decoded(words[2].strip()))

    def _format(self, words: list[bytes]) -> None:
        if self._byte_order is not None:
            self._fail("a second format line")
        name = decoded(words[1]) if len(words) > 1 else ""
        if name not in ENCODINGS:
            self._fail(f"unknown format {shown(name)}")
        self._byte_order = ENCODINGS[name]
        if words[2:3] != [b"1.0"]:
            self._warnings.add("not version 1.0; read as if it were", self._number)

    def _element(self, words: list[bytes]) -> None:
        if len(words) != 3:
            self._fail("an element line needs a name and a number")
        if not words[2].isdigit() or len(words[2]) > _MAX_DIGITS:
            self._fail(f"not a number of elements: {shown(words[2])}")
        name = decoded(words[1])
        if name in self._elements:
            self._fail(f"element {shown(name)} twice")
        self._current = self._elements[name] = PlyElement(name, int(words[2]))

    def _property(self, words: list[bytes]) -> None:
        count_type = None
        if self._current is None:
            self._fail("a property before any element")
        if words[1:2] == [b"list"]:
            if len(words) != 5:
                self._fail("a list property needs two types and a name")
            count_type, item_type = self._type(words[2]), self._type(words[3])
            if count_type.startswith("f"):
                self._fail("the length of a list must be an integer type")
        else:
            if len(words) != 3:
                self._fail("a property needs a type and a name")
            item_type = self._type(words[1])
        name = decoded(words[-1])
        if name in self._current.properties:
            self._fail(f"property {shown(name)} twice")
        self._current.properties[name] = PlyProperty(name, item_type, count_type)

    def _type(self, word: bytes) -> str:
        code = TYPES.get(decoded(word))
        if code is None:
            self._fail(f"unknown type {shown(word)}")
        return code

    def _fail(self, message: str) -> NoReturn:
        raise FileFormatError(message, self._path, self._number)
