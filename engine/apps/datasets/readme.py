"""The README.txt of a data set: what its files hold, in which units and conventions."""

from __future__ import annotations

import os
from collections.abc import Iterable

from ...base.files.atomic_write import atomic_write
from ...base.files.making_folders import make_folder_of

README = "README.txt"
_GENERAL = (
    "A data set drawn by engine3d. All values of a picture are of the same pixels.",
    "Lengths are in units of the scene, unless said otherwise. x is to the right and y down from "
    "the top left corner; the centre of the top left pixel is (0.5, 0.5), unless said otherwise.",
)


def write_readme(folder: str, lines: Iterable[str], baseline: float | None = None) -> str:
    """Write the README of a data set; return its path there."""
    stereo = []
    if baseline is not None:
        stereo = [f"The right camera is {baseline!r} to the right of the left one: rectified."]
    target = os.path.join(folder, README)
    make_folder_of(target, below=folder)
    with atomic_write(target, below=folder) as file:
        file.write("".join(f"{line}\n" for line in (*_GENERAL, *stereo, *lines)).encode())
    return README
