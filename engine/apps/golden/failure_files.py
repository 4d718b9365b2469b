"""Files of a failure: the drawn picture, and its differences, as PNG.

In:  a `Result` and its pixels. Out: two files in a folder outside of the tree; their paths are in
     the result.
"""

from __future__ import annotations

import os

import numpy as np

from ...base.files.atomic_write import atomic_write
from ...base.files.png import encode_pixels
from .comparison import Difference
from .difference_picture import difference_picture
from .display import displayed
from .golden_files import write_golden
from .results import Result


def write_failure(
    result: Result,
    folder: str,
    pixels: np.ndarray,
    expected: np.ndarray | None,
    difference: Difference | None,
) -> None:
    """Write the drawn picture and, if one was expected, the difference picture."""
    stem = os.path.join(folder, *result.name.split("/"))
    result.actual = f"{stem}.png"
    write_golden(result.actual, pixels, below=folder)
    if expected is not None and difference is not None:
        result.difference = f"{stem}.difference.png"
        with atomic_write(result.difference, below=folder) as file:
            file.write(encode_pixels(difference_picture(displayed(expected), difference)))
