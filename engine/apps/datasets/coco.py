"""The COCO data set format: pictures, and one file of boxes, categories and masks.

Out: ``images/NAME.png`` and ``annotations.json``, and other outputs that are asked for as
``depth/NAME.npy`` …, and README.txt, which COCO's tools pass over. Each thing of which at least one
pixel shows is an annotation: its mask as run lengths, its area in pixels, its box. A pixel belongs
to what its sample near the centre shows: masks never overlap.
Source: the format of COCO's object detection, cocodataset.org.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from ...base.calls import checks_types
from ...base.files import json_records as records
from ...base.files.png import encode_pixels
from ...base.validation import optional_positive
from ...rendering.frame import Output
from .measured import checked_outputs, described, encoded, frame_outputs
from .readme import write_readme
from .rle import encode_rle
from .samples import Sample, box_of
from .writer import (
    DatasetWriter,
    JsonParts,
    Note,
    category_numbers,
    check_category,
    checked_categories,
)

ANNOTATIONS = "annotations.json"
_NEEDED: tuple[Output, ...] = ("color", "object_id")
_SAYS = (
    "images: the pictures.",
    f"{ANNOTATIONS}: boxes (pixels, from the top left), areas and masks of COCO's format. A pixel "
    "belongs to one thing. The format has no place for models: those of BOP have one.",
)
_SIZE = records.row(records.count, records.count)
_MASK = records.members({"size": _SIZE, "counts": records.sound_text})
_BOX = records.listed(records.count, 4)
_THING = records.row(records.sound_text, _MASK, records.count, _BOX)


class CocoWriter(DatasetWriter):
    """Writes pictures and COCO's annotations of them.

    Parameters
    ----------
    categories : sequence of str, optional
        The categories, numbered from 1 on in this order; others are errors. Left out, they are
        those that the pictures show, sorted by name.
    outputs : sequence of str
        As of `FolderWriter`: those besides color get a folder each.
    baseline : float, optional
        As of `FolderWriter`.

    Raises
    ------
    InvalidArgumentError
    """

    kind = "coco"
    note_shape = staticmethod(
        records.members({"size": _SIZE, "things": records.listed(_THING)}),
    )

    def __init__(
        self,
        categories: Sequence[str] | None = None,
        outputs: Sequence[str] = ("color",),
        baseline: float | None = None,
    ) -> None:
        self.categories = checked_categories(categories)
        self.baseline = optional_positive(baseline, "baseline")
        self.written = checked_outputs(outputs, self.baseline)
        # Annotations need these outputs in any case.
        self.outputs = tuple(dict.fromkeys((*_NEEDED, *frame_outputs(self.written))))

    @checks_types
    def describe(self, sample: Sample) -> tuple[dict[str, bytes], Any]:
        files = {f"images/{sample.name}.png": encode_pixels(sample.frame.color[..., :3])}
        found = []
        for thing in sample.things():
            check_category(self.categories, thing.category)
            mask = thing.mask(sample.frame.object_id)
            area = int(mask.sum())
            if area:
                run_lengths = encode_rle(mask)
                box = list(box_of(mask))
                found.append([thing.category, run_lengths, area, box])
        size = [sample.frame.width, sample.frame.height]
        for output, suffix, data in encoded(sample, self._beside, self.baseline):
            files[f"{output}/{sample.name}.{suffix}"] = data
        return files, {"size": size, "things": found}

    @property
    def _beside(self) -> list[str]:
        """What is written beside COCO's own files."""
        return [one for one in self.written if one != "color.png"]

    @checks_types
    def finish(self, folder: str, notes: Iterable[Note]) -> Iterator[str]:
        shown = (thing[0] for note in notes for thing in note.said["things"])
        numbers = category_numbers(self.categories, shown)
        with JsonParts(folder, ANNOTATIONS) as parts:
            parts.text('{"info": {"description": "drawn by engine3d"},\n"licenses": [],\n')
            parts.text('"categories": ')
            parts.all({"id": number, "name": name} for name, number in numbers.items())
            parts.text(',\n"images": ')
            parts.all(map(_image, notes))
            parts.text(',\n"annotations": ')
            parts.all(_annotations(notes, numbers))
            parts.text("}\n")
        yield ANNOTATIONS
        yield write_readme(folder, [*_SAYS, *described(self._beside)], self.baseline)


def _image(note: Note) -> dict[str, Any]:
    width, height = note.said["size"]
    path = f"{note.name}.png"
    return {"id": note.index + 1, "file_name": path, "width": width, "height": height}


def _annotations(notes: Iterable[Note], numbers: dict[str, int]) -> Iterator[dict[str, Any]]:
    number = 0
    for note in notes:
        for category, run_lengths, area, box in note.said["things"]:
            number += 1
            yield {
                "id": number,
                "image_id": note.index + 1,
                "category_id": numbers[category],
                "segmentation": run_lengths,
                "area": area,
                "bbox": box,
                "iscrowd": 0,
            }
