"""The file that a reader of another package gets.

In: a `Source`. Out: a binary file object, which also opens the files that the model names: those
that engine3d's own readers may open, and no others.
"""

from __future__ import annotations

import io

from ...base.calls import checks_types
from ...base.validation import fraction as checked_fraction
from ...errors import FileAccessError
from ..addresses.linked_urls import linked_files
from ..reading.linked_files import LinkedFileError, LinkedFiles
from ..reading.sources import Source
from ..reading.warning_list import WarningList


class PluginFile(io.BytesIO):
    """A model file, open for a reader of another package; it is in memory as a whole.

    Attributes
    ----------
    name : str
        The file as messages show it; in angle brackets if it has no path.
    path : str or None
        Where the same bytes are on the disk, for libraries that only take paths; None for bytes,
        streams, and files that were compressed.
    """

    def __init__(
        self, source: Source, files: LinkedFiles | None = None, warnings: WarningList | None = None
    ) -> None:
        super().__init__(source.data)
        self.name = source.path
        self.path = source.path if source.is_on_disk else None
        self._progress = source.progress
        self._warnings = WarningList(source.path) if warnings is None else warnings
        self._files = linked_files(source, self._warnings) if files is None else files

    @checks_types
    def open(self, name: str) -> PluginFile:
        """Open a file that this one names, such as a texture or a list of points.

        Parameters
        ----------
        name : str
            As it stands in the file. It is searched in the model's folder and in the caller's
            ``root``; names that lead out of both are refused.

        Raises
        ------
        FileAccessError
            There is no such file, or it is outside.
        """
        try:
            source = self._files.read(self._files.find_uri(name))
        except LinkedFileError as error:
            raise FileAccessError(str(error), name) from None
        with source:
            return PluginFile(source, self._files, self._warnings)

    @checks_types
    def warn(self, message: str) -> None:
        """Add a line to the model's warnings: what is left out or replaced."""
        self._warnings.add(message)

    @checks_types
    def progress(self, fraction: float) -> None:
        """Tell how much of the file is read, 0 to 1, for progress bars."""
        self._progress(checked_fraction(fraction, "fraction"))
