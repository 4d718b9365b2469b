"""Draws several pictures in turn; if one fails, the others are still drawn.

In: jobs, and a function that draws one. Out: lines on standard error: the faults, and their number.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence

from ...errors import Engine3DError
from .quietness import remark
from .said import say

Draw = Callable[[argparse.Namespace], int]


def tried(draw: Draw, job: argparse.Namespace) -> int:
    """Draw a job; print its error, if any, and return the exit status."""
    try:
        return draw(job)
    except (Engine3DError, OSError) as error:
        say(f"error: {error}")
        return 1


def draw_each(draw: Draw, jobs: Sequence[argparse.Namespace]) -> int:
    """Draw all jobs; return 1 if one failed, else 0."""
    failed = sum(tried(draw, job) != 0 for job in jobs)
    if len(jobs) > 1:
        remark(f"{len(jobs) - failed} drawn" + (f", {failed} failed" if failed else ""))
    return 1 if failed else 0
