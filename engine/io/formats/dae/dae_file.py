"""The elements of a COLLADA file, by their IDs.

In: the bytes of a file. Out: elements, the numbers in them, and what their URLs refer to. Source:
Khronos, "COLLADA - Digital Asset Schema Release 1.5.0", 2008.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...._native import loaders as native
from ....errors import FileFormatError
from ...reading.number_arrays import NotANumberError, read_numbers
from ...reading.sources import Source
from ...reading.text import shown
from ...reading.warning_list import WarningList
from ...reading.xml_elements import Element, XmlFile, read_elements

# The indices of a file are below this.
_MOST_INDEX = 2**31


class DaeFile(XmlFile):
    """A COLLADA file.

    Raises
    ------
    FileFormatError
        The file is no XML, or not of COLLADA.
    """

    def __init__(self, source: Source, warnings: WarningList) -> None:
        super().__init__(source, warnings)
        self.root = read_elements(source.data, source.path, texts=True)
        if self.root.name != "COLLADA":
            raise FileFormatError("not a dae file", source.path)
        self._by_id: dict[str, Element] = {}
        waiting = [self.root]
        while waiting:
            element = waiting.pop()
            if "id" in element.attributes:
                self._by_id.setdefault(element.attributes["id"], element)
            waiting += element.children

    def find(self, url: str, *names: str) -> Element | None:
        """Return the element of a URL within the file, if it has one of the names."""
        found = self._by_id.get(url.rpartition("#")[2]) if url else None
        return found if found is not None and found.name in names else None

    def named(self, url: str, element: Element, *names: str) -> Element:
        """Return the element that another one must refer to."""
        found = self.find(url, *names)
        if found is None:
            raise self.fault(f"<{element.name}> names {shown(url)}, which is not there", element)
        return found

    def numbers(self, element: Element | None, count: int | None = None) -> NDArray[np.float64]:
        """Return the numbers of an element's text: as many as must be, if that is known."""
        if element is None:
            return np.zeros(0)
        text = element.text.replace(",", ".") if "," in element.text else element.text
        try:
            values = read_numbers(text.encode() + b"\n", native.NO_COMMENTS).values
        except NotANumberError as error:
            raise self.fault(f"not a number: {shown(error.word)}", element) from None
        if count is not None and len(values) != count:
            raise self.fault(
                f"<{element.name}> has {len(values)} numbers instead of {count}", element
            )
        return values

    def whole_numbers(self, element: Element | None) -> NDArray[np.int64]:
        """Return the indices or counts of an element's text, at least 0."""
        values = self.numbers(element)
        if element is not None and not ((values >= 0) & (values < _MOST_INDEX)).all():
            raise self.fault(f"a number of <{element.name}> is no index", element)
        return values.astype(np.int64)
