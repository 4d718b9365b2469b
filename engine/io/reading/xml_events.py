"""Parses XML element by element, without entity expansion.

In: bytes, in pieces. Out: a call for each start and end of an element. A document type, which could
define entities, is refused, and so is excessive nesting.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from xml.parsers import expat

from ...errors import FileFormatError

_MOST_DEPTH = 64
#: Separates namespace and local name.
SEPARATOR = " "

Attributes = dict[str, str]


class XmlFault(ValueError):
    """An error in an element; `read_xml` adds its place."""


def read_xml(
    pieces: Iterable[bytes],
    begin: Callable[[str, Attributes, int], object],
    end: Callable[[str], object],
    path: str,
    part: str = "",
    text: Callable[[str], object] | None = None,
) -> None:
    """Call ``begin(name, attributes, place)`` and ``end(name)`` for each element, in order.

    Parameters
    ----------
    pieces : iterable of bytes
    begin, end : callable
        Names of elements and attributes are ``"namespace local"``, or only local without a
        namespace; ``place`` is the offset in the text. They may raise `XmlFault`.
    path, part : str
        The file for messages, and the part of it that the text is.
    text : callable, optional
        Called with each piece of text, in order.

    Raises
    ------
    FileFormatError
        The XML is not well-formed, has a document type, or is too deep.
    """
    parser = expat.ParserCreate(namespace_separator=SEPARATOR)
    depth = 0

    def enter(name: str, attributes: Attributes) -> None:
        nonlocal depth
        depth += 1
        if depth > _MOST_DEPTH:
            raise XmlFault(f"elements are nested more than {_MOST_DEPTH} deep")
        begin(name, attributes, parser.CurrentByteIndex)

    def leave(name: str) -> None:
        nonlocal depth
        depth -= 1
        end(name)

    def refuse(*_: object) -> None:
        raise XmlFault("a document type is not allowed")

    parser.StartElementHandler, parser.EndElementHandler = enter, leave
    parser.StartDoctypeDeclHandler = refuse
    if text is not None:
        parser.buffer_text = True
        parser.CharacterDataHandler = text
    try:
        for piece in pieces:
            parser.Parse(piece, False)
        parser.Parse(b"", True)
    except FileFormatError:  # from the pieces
        raise
    except XmlFault as fault:
        raise _located(str(fault), path, part, parser.CurrentLineNumber) from None
    except expat.ExpatError as error:
        message = f"no well-formed XML: {expat.ErrorString(error.code)}"
        raise _located(message, path, part, error.lineno) from error
    except (LookupError, ValueError) as error:
        raise _located("no readable XML: its encoding is not known", path, part, 1) from error


def _located(message: str, path: str, part: str, line: int) -> FileFormatError:
    if part:
        return FileFormatError(f"{part}:{line}: {message}", path)
    return FileFormatError(message, path, line)
