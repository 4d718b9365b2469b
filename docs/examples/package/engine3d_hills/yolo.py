"""Data sets in the layout of YOLO, a detector of objects: a picture, and a line for each box."""

import numpy as np

from engine3d.datasets import DatasetWriter


class YoloWriter(DatasetWriter):
    """Writes ``images/NAME.png`` and ``labels/NAME.txt``."""

    kind = "yolo"  # the name of the entry point
    outputs = ("color", "object_id")

    def describe(self, sample):
        """Return the files of a picture by path, and a note for `finish`."""
        lines = []
        ids = sample.frame.object_id
        height, width = ids.shape
        for number, thing in enumerate(sample.things()):
            rows, columns = np.nonzero(thing.mask(ids))
            if len(rows):
                low = np.array([columns.min() / width, rows.min() / height])
                high = np.array([(columns.max() + 1) / width, (rows.max() + 1) / height])
                box = [*(low + high) / 2, *(high - low)]
                lines.append(" ".join([str(number), *(f"{value:.6f}" for value in box)]))
        files = {
            f"images/{sample.name}.png": sample.frame.encode("png"),
            f"labels/{sample.name}.txt": "\n".join(lines).encode(),
        }
        return files, len(lines)
