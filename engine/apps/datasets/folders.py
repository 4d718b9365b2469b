"""The plain data set format: one folder for each output, and one list of contents.

Out: ``color/NAME.png``, ``depth/NAME.npy`` and so on, and ``pictures.jsonl``: a line of JSON for
each picture, with its camera, and of each thing its category, its id in ``object_id``, its place;
``README.txt``, which says what all this is.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from ...base.calls import checks_types
from ...base.files import json_records as records
from ...base.files.atomic_write import atomic_write
from ...base.files.making_folders import make_folder_of
from ...base.validation import optional_positive
from ...io.scenes.object_kinds import kind_of, values_of
from ...model.scene.lenses.lens_camera import LensCamera
from .measured import checked_outputs, described, encoded, frame_outputs
from .readme import write_readme
from .samples import Sample
from .writer import DatasetWriter, Note, compact

PICTURES = "pictures.jsonl"
_SAYS = (
    f"{PICTURES}: a line of JSON for each picture: its files, its camera (world_from_camera, which "
    "looks along -Z with +Y up; clip_from_camera) and its things, with their IDs in object_id.",
)
_MATRIX = records.listed(records.listed(records.number, 4), 4)
_THING = {
    "category": records.sound_text,
    "ids": records.listed(records.count),
    "world_from_object": _MATRIX,
}
_NOTE = {
    "size": records.row(records.count, records.count),
    "seed": records.anything,
    "camera": records.members(
        {"world_from_camera": _MATRIX}, {"clip_from_camera": _MATRIX, "lens": records.anything}
    ),
    "things": records.listed(records.members(_THING)),
}


class FolderWriter(DatasetWriter):
    """Writes each output into its own folder.

    Parameters
    ----------
    outputs : sequence of str
        As of `Renderer.render`, and what is measured between two pictures, such as
        ``"disparity"`` and ``"forward_flow"``: see docs/batches.md. A suffix names another format
        than .npy: ``"depth.pfm"``.
    baseline : float, optional
        The distance of the right camera of a stereo pair, in world units.

    Raises
    ------
    InvalidArgumentError
    """

    kind = "folders"
    note_shape = staticmethod(records.members(_NOTE))

    def __init__(
        self,
        outputs: Sequence[str] = ("color", "depth", "object_id"),
        baseline: float | None = None,
    ) -> None:
        self.baseline = optional_positive(baseline, "baseline")
        self.written = checked_outputs(outputs, self.baseline)
        self.outputs = frame_outputs(self.written)

    @checks_types
    def describe(self, sample: Sample) -> tuple[dict[str, bytes], Any]:
        said = said_of(sample)  # before the scene moves on
        return {
            f"{name}/{sample.name}.{suffix}": data
            for name, suffix, data in encoded(sample, self.written, self.baseline)
        }, said

    @checks_types
    def finish(self, folder: str, notes: Iterable[Note]) -> Iterator[str]:
        target = os.path.join(folder, PICTURES)
        make_folder_of(target)
        with atomic_write(target, below=folder) as file:
            for note in notes:
                said = {"name": note.name, "files": note.files, **note.said}
                file.write(f"{compact(said)}\n".encode())
        yield PICTURES
        yield write_readme(folder, [*_SAYS, *described(self.written)], self.baseline)


def said_of(sample: Sample) -> dict[str, Any]:
    """Return the contents of a picture, in JSON types."""
    return {
        "size": [sample.frame.width, sample.frame.height],
        "seed": sample.seed,
        "camera": {
            "world_from_camera": np.asarray(sample.pose).tolist(),
            **_lens_of(sample),
        },
        "things": [
            {
                "category": thing.category,
                "ids": [part.id for part in thing.parts],
                "world_from_object": thing.node.world_pose.tolist(),
            }
            for thing in sample.things()
        ],
    }


def _lens_of(sample: Sample) -> dict[str, Any]:
    """Return the projection of a picture, or the record of its lens as scene files have it."""
    camera = sample.camera
    if isinstance(camera, LensCamera):
        return {"lens": {"kind": kind_of(camera), **values_of(camera)}}
    return {"clip_from_camera": np.asarray(camera.projection(sample.frame.size)).tolist()}


def json_line(value: Any) -> bytes:
    """Return a value as a JSON file."""
    return (json.dumps(value, ensure_ascii=False, allow_nan=False) + "\n").encode("utf-8")
