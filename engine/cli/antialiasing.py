"""``--samples`` and ``--antialiasing``: how many samples a pixel has, and what happens at each."""

from __future__ import annotations

import argparse
from typing import get_args

from ..choices import Samples
from .usage import UsageError

#: By look, the method and the samples of pictures and turntables of which neither is asked for.
PICTURES = {"studio": ("msaa", 4), "plain": ("ssaa", 1)}
#: The method of a window, whose samples follow the time (viewer/sampling.py).
WINDOW = "msaa"
#: The samples of a method that is asked for without a number.
USUAL = 4
_NONE = "none"
_SUPERSAMPLES = (1, 4, 16)


def add(group: argparse._ArgumentGroup) -> None:
    """Add the options to a group."""
    group.add_argument(
        "--samples",
        type=int,
        choices=get_args(Samples),
        help="samples per pixel: more give smoother edges. In a window 4 while nothing moves, and "
        "fewer in motion where it would be slow, if this is not given",
    )
    group.add_argument(
        "--antialiasing",
        choices=(_NONE, "ssaa", "msaa"),
        help="what happens at each sample: everything (ssaa), or only what decides which surface "
        "it shows, while each surface is coloured once a pixel (msaa, faster); none is one sample. "
        "msaa where 2 or 8 samples are asked for, and in windows",
    )


def antialiasing(
    asked: str | None, number: int | None, method: str, samples: int
) -> tuple[str, int]:
    """Return the method, as `Renderer` takes it, and the samples.

    Parameters
    ----------
    asked : str or None
        The method that was asked for.
    number : int or None
        Likewise of the samples.
    method, samples
        Where neither is asked for.

    Raises
    ------
    UsageError
        What is asked for does not go together.
    """
    if asked == _NONE:
        if number not in (None, 1):
            raise UsageError(f"--antialiasing none is one sample a pixel, not {number}")
        return "ssaa", 1
    if asked is not None:
        method, samples = asked, USUAL
    samples = samples if number is None else number
    if method == "ssaa" and samples not in _SUPERSAMPLES:
        if asked is not None:
            raise UsageError(f"--antialiasing ssaa takes 1, 4 or 16 samples, not {samples}")
        method = "msaa"
    return method, samples
