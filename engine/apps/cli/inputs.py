"""The input of a command: a file, or standard input.

In: what was given as MODEL. Out: a path, or a binary file object, as `engine3d.loaders` take them.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import BinaryIO

from .usage import UsageError

STANDARD_INPUT = "-"


def model_file(name: str) -> str | BinaryIO:
    """Return the path, or the bytes of standard input for ``-``."""
    if name != STANDARD_INPUT:
        return name
    if sys.stdin is None:
        raise UsageError("- reads a model from standard input, which is closed")
    if sys.stdin.isatty():
        raise UsageError("- would read a model from the terminal; redirect standard input")
    return sys.stdin.buffer


def model_files(names: Sequence[str]) -> list[str | BinaryIO]:
    """Return the inputs for several names; standard input can be read once."""
    if names.count(STANDARD_INPUT) > 1:
        raise UsageError("- stands for standard input, which can be read only once")
    return [model_file(name) for name in names]
