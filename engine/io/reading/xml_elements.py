"""XML as a tree of elements, with their lines.

In: the bytes of a file. Out: its root element. Namespaces are dropped, but for a check of the
caller's. Document types are refused, and so is excessive nesting.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...errors import FileFormatError
from .sources import Source
from .warning_list import WarningList
from .xml_events import SEPARATOR, Attributes, read_xml

_LINE_END = ord("\n")


class Element:
    """An element, with those within it.

    Attributes
    ----------
    name : str
        Without a namespace.
    attributes : dict of str to str
    line : int
    children : list of Element
    text : str
        The text directly in it, if texts were asked for.
    """

    __slots__ = ("attributes", "children", "line", "name", "text")

    def __init__(self, name: str, attributes: Attributes, line: int) -> None:
        self.name, self.attributes, self.line, self.text = name, attributes, line, ""
        self.children: list[Element] = []

    def all(self, name: str) -> list[Element]:
        """Return the elements of a name within this one."""
        return [child for child in self.children if child.name == name]

    def first(self, *path: str) -> Element | None:
        """Return the first element of a name within this one, or along a path of names."""
        here: Element | None = self
        for name in path:
            if here is not None:
                here = next((child for child in here.children if child.name == name), None)
        return here


class XmlFile:
    """The elements of a file, and the place of every fault: what formats of XML begin with.

    Attributes
    ----------
    source : Source
    warnings : WarningList
    root : Element
        Set by the format.
    """

    root: Element

    def __init__(self, source: Source, warnings: WarningList) -> None:
        self.source, self.warnings = source, warnings

    def fault(self, message: str, element: Element) -> FileFormatError:
        """Return an error about an element."""
        return FileFormatError(message, self.source.path, element.line)

    def warn(self, message: str, element: Element) -> None:
        """Add a warning about an element."""
        self.warnings.add(message, element.line)


def read_elements(
    data: bytes, path: str, check: Callable[[str], object] | None = None, *, texts: bool = False
) -> Element:
    """Return the root element of XML.

    Parameters
    ----------
    data : bytes
    path : str
        The file for messages.
    check : callable, optional
        Called with the namespace of each element; may raise `XmlFault`.
    texts : bool
        Whether to keep texts.

    Raises
    ------
    FileFormatError
        As `read_xml`.
    """
    top = Element("", {}, 0)
    open_elements, parts = [top], [[""]]
    ends = np.flatnonzero(np.frombuffer(data, np.uint8) == _LINE_END)

    def begin(name: str, attributes: Attributes, place: int) -> None:
        space, _, local = name.rpartition(SEPARATOR)
        if check is not None:
            check(space)
        element = Element(local, attributes, int(np.searchsorted(ends, place)) + 1)
        open_elements[-1].children.append(element)
        open_elements.append(element)
        parts.append([])

    def end(name: str) -> None:
        open_elements.pop().text = "".join(parts.pop())

    def write(text: str) -> None:
        parts[-1].append(text)

    read_xml([data], begin, end, path, text=write if texts else None)
    return top.children[0]
