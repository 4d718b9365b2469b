"""A file of XML whose faults and warnings name their lines: what COLLADA and URDF begin with."""

from __future__ import annotations

from ...errors import FileFormatError
from .sources import Source
from .warning_list import WarningList
from .xml_elements import Element


class XmlFile:
    """The elements of a file, and the place of every fault.

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
