"""Output without a data set: the files of each picture side by side, under its name.

Out: ``NAME.png``, or another format, and ``NAME.OUTPUT.npy``, or another format of numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ...base.files import json_records as records
from ...rendering.frame import Frame
from ..datasets.measured import encoded_output
from ..datasets.samples import Sample
from ..datasets.writer import DatasetWriter


class PlainWriter(DatasetWriter):
    """Writes a task's ``outputs`` as files.

    Parameters
    ----------
    names : sequence of str
        Checked by `Task`.
    """

    kind = "plain"
    note_shape = staticmethod(records.one_of(None))

    def __init__(self, names: Sequence[str]) -> None:
        self.formats = {name.partition(".")[0]: name.partition(".")[2] for name in names}
        self.outputs = tuple(self.formats)

    def describe(self, sample: Sample) -> tuple[dict[str, bytes], Any]:
        return self.files(sample.name, sample.frame), None

    def files(self, name: str, frame: Frame) -> dict[str, bytes]:
        """Return the files of a picture, by path."""
        files = {}
        for output, suffix in self.formats.items():
            if output == "color" and suffix:
                files[f"{name}.{suffix}"] = frame.encode(suffix)
                continue
            suffix, data = encoded_output(frame, f"{output}.{suffix}" if suffix else output)
            own = name if output == "color" else f"{name}.{output}"
            files[f"{own}.{suffix}"] = data
        return files

    def beside(self, sample: Sample, end: str) -> str:
        return f"{sample.name}.{end}"
