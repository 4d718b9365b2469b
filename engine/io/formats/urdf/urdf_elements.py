"""The XML elements of a URDF file, with their lines.

In: the bytes of a file. Out: its root element. xacro, which is a program that writes URDF, is
refused; so are document types, which could define entities.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from typing import NoReturn

from ....base.near_words import meant
from ...reading.sources import Source
from ...reading.text import shown
from ...reading.warning_list import WarningList
from ...reading.xml_elements import Element, XmlFile, read_elements
from ...reading.xml_events import XmlFault

_XACRO = "this is xacro, from which URDF is made: xacro IN.urdf.xacro > OUT.urdf"
# A declaration that does not begin the file, as XML demands.
_DECLARATION = re.compile(rb"(\s*)(<\?xml\b[^>]*\?>)")
_END = b"</robot>"
# Words of a list of numbers: some files have commas.
_BETWEEN = re.compile(r"[\s,]+")


class UrdfText(XmlFile):
    """The elements of a file of a robot.

    Attributes
    ----------
    left_out : str
        Why the first shape that is left out was; empty if none was.

    Raises
    ------
    FileFormatError
        The file is no XML, or not of a robot.
    """

    def __init__(self, source: Source, warnings: WarningList) -> None:
        super().__init__(source, warnings)
        self.left_out = ""
        data = self._repaired(source.data)
        self.root = self._parsed(data)
        if self.root.name != "robot":
            raise self.fault(
                f"no URDF file: its root is <{self.root.name}>, not <robot>", self.root
            )

    def _repaired(self, data: bytes) -> bytes:
        """Return the text without what other readers of robots overlook; lines stay."""
        late = _DECLARATION.match(data)
        if late is not None and late[1]:
            data = late[1] + b" " * len(late[2]) + data[late.end() :]
        end = data.rfind(_END) + len(_END)
        if end >= len(_END) and data[end:].strip() and b"<" not in data[end:]:
            self.warnings.add("what follows </robot> is left out", 1 + data.count(b"\n", 0, end))
            data = data[:end]
        return data

    def _parsed(self, data: bytes) -> Element:
        def check(namespace: str) -> None:
            if "xacro" in namespace:
                raise XmlFault(_XACRO)

        return read_elements(data, self.source.path, check)

    def name(self, element: Element, attribute: str = "name") -> str:
        """Return a name that an element must have."""
        name = element.attributes.get(attribute, "")
        if not name:
            raise self.fault(f"<{element.name}> needs {attribute}=", element)
        return name

    def leave_out(self, message: str, element: Element) -> None:
        """Warn of a shape that is left out."""
        self.left_out = self.left_out or message
        self.warn(message, element)

    def unknown(self, what: str, name: str, known: Iterable[str], element: Element) -> NoReturn:
        """Raise that a name is not known, with the nearest that is."""
        hint = meant(name, known)
        raise self.fault(f"there is no {what} {shown(name)}{hint}", element)

    def numbers(
        self, element: Element | None, attribute: str, usual: tuple[float, ...]
    ) -> tuple[float, ...]:
        """Return the numbers of an attribute: the usual ones if it is missing, or unreadable.

        What is unreadable, or too long, gives a warning.

        Raises
        ------
        FileFormatError
            The text is an expression of xacro.
        """
        text = None if element is None else element.attributes.get(attribute)
        if text is None or element is None:
            return usual
        if "${" in text:
            raise self.fault(_XACRO, element)
        numbers = tuple(_number(word) for word in _BETWEEN.split(text) if word)
        if len(numbers) < len(usual) or not all(map(math.isfinite, numbers)):
            taken = " ".join(f"{number:g}" for number in usual)
            self.warn(f"{attribute} {shown(text)} is unreadable: {taken} is taken", element)
            return usual
        if len(numbers) > len(usual):
            self.warn(f"of {attribute} {shown(text)}, the first {len(usual)} count", element)
        return numbers[: len(usual)]


def _number(word: str) -> float:
    """Return the number of a word; NaN if it is none."""
    try:
        return math.nan if "_" in word else float(word)
    except ValueError:
        return math.nan
