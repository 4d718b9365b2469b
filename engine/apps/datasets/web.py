"""The WebDataset format: tar files with a number of pictures each, read sequentially.

Out: ``shard-000000.tar`` and so on. Of each picture, ``KEY.png``, the other outputs as
``KEY.depth.npy`` …, and ``KEY.json``, which says what `folders` says. Files in a tar have no date
and no owner, so that its bytes follow from theirs.
Pictures lie in the folder ``unpacked`` until all that can be drawn are there; then they are packed.
Source: the conventions of the library webdataset.
"""

from __future__ import annotations

import contextlib
import functools
import io
import os
import tarfile
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from ...base.calls import checks_types
from ...base.files import json_records as records
from ...base.files.atomic_write import atomic_write, path_below
from ...base.numbers import shown
from ...base.validation import optional_positive
from ...errors import InvalidArgumentError
from .folders import json_line, said_of
from .measured import checked_outputs, described, encoded, frame_outputs
from .readme import write_readme
from .samples import Sample
from .writer import DatasetWriter, Note

UNPACKED = "unpacked"
_SAYS = (
    "shard-*.tar: files of each picture under one key: KEY.png, KEY.OUTPUT.SUFFIX, and KEY.json: "
    "its camera (world_from_camera, which looks along -Z with +Y up; clip_from_camera) and things.",
)


class WebDatasetWriter(DatasetWriter):
    """Writes pictures into tar files.

    Parameters
    ----------
    outputs : sequence of str
        As of `FolderWriter`.
    shard : int
        Pictures in a tar file.
    baseline : float, optional
        As of `FolderWriter`.

    Raises
    ------
    InvalidArgumentError
    """

    kind = "webdataset"
    note_shape = staticmethod(records.one_of(None))

    def __init__(
        self,
        outputs: Sequence[str] = ("color",),
        shard: int = 1000,
        baseline: float | None = None,
    ) -> None:
        self.baseline = optional_positive(baseline, "baseline")
        self.written = checked_outputs(outputs, self.baseline)
        self.outputs = frame_outputs(self.written)
        if isinstance(shard, bool) or not isinstance(shard, int) or shard < 1:
            raise InvalidArgumentError(f"shard must be a whole number above 0, not {shown(shard)}")
        self.shard = shard

    @checks_types
    def describe(self, sample: Sample) -> tuple[dict[str, bytes], Any]:
        key = f"{UNPACKED}/{sample.index:09d}"
        said = json_line({"name": sample.name, **said_of(sample)})  # before the scene moves on
        files = {}
        for output, suffix, data in encoded(sample, self.written, self.baseline):
            files[f"{key}.{suffix if output == 'color' else f'{output}.{suffix}'}"] = data
        return {**files, f"{key}.json": said}, None

    @checks_types
    def finish(self, folder: str, notes: Iterable[Note]) -> Iterator[str]:
        shard: list[Note] = []
        for note in notes:
            if shard and note.index // self.shard != shard[0].index // self.shard:
                yield self._pack(folder, shard)
                shard = []
            shard.append(note)
        if shard:
            yield self._pack(folder, shard)
        with contextlib.suppress(OSError):  # missing, or from newly added pictures
            os.rmdir(os.path.join(folder, UNPACKED))
        yield write_readme(folder, [*_SAYS, *described(self.written)], self.baseline)

    @checks_types
    def beside(self, sample: Sample, end: str) -> str:
        return f"{UNPACKED}/{sample.index:09d}.{end}"

    @checks_types
    def stored(self, folder: str, note: Note, path: str) -> bytes | None:
        data = super().stored(folder, note, path)
        if data is not None:
            return data
        shard = os.path.join(folder, self._shard_of(note))
        try:
            start, size = _members(shard, os.stat(shard).st_mtime_ns)[_packed(path)]
            with open(shard, "rb") as file:
                file.seek(start)
                return file.read(size)
        except (OSError, ValueError, KeyError, tarfile.TarError):
            return None

    def _shard_of(self, note: Note) -> str:
        return f"shard-{note.index // self.shard:06d}.tar"

    def _pack(self, folder: str, notes: list[Note]) -> str:
        """Write the tar file of some pictures, and remove their loose files."""
        path = self._shard_of(notes[0])
        paths = [(note, name) for note in notes for name in sorted(note.files)]
        with atomic_write(os.path.join(folder, path), below=folder) as file:
            with tarfile.open(fileobj=file, mode="w", format=tarfile.USTAR_FORMAT) as tar:
                for note, name in paths:
                    data = self.stored(folder, note, name) or b""
                    entry = tarfile.TarInfo(_packed(name))
                    entry.size = len(data)
                    tar.addfile(entry, io.BytesIO(data))
        for _, name in paths:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(path_below(os.path.join(folder, name), folder))
        return path


def _packed(path: str) -> str:
    """Return the name in a tar file for a loose file in a folder."""
    return path.partition("/")[2]


@functools.lru_cache(4)
def _members(path: str, written: int) -> dict[str, tuple[int, int]]:
    """Return the offset and length of each member of a tar file."""
    with tarfile.open(path) as tar:
        return {entry.name: (entry.offset_data, entry.size) for entry in tar}
