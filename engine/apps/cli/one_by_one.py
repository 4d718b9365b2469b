"""Draws several pictures one after the other; if one fails, the others are still drawn.

In: jobs, and what draws one. Out: lines on standard error: what went wrong, and how many there are.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence

from ...errors import Engine3DError
from .quietness import remark
from .said import say

Draw = Callable[[argparse.Namespace], int]


def tried(draw: Draw, job: argparse.Namespace) -> int:
    """Draw what a job says; return the exit status, and tell what is wrong."""
    try:
        return draw(job)
    except (Engine3DError, OSError) as error:
        say(f"error: {error}")
        return 1


def draw_each(draw: Draw, jobs: Sequence[argparse.Namespace]) -> int:
    """Draw them all; return 1 if one failed, else 0."""
    failed = sum(tried(draw, job) != 0 for job in jobs)
    if len(jobs) > 1:
        remark(f"{len(jobs) - failed} drawn" + (f", {failed} failed" if failed else ""))
    return 1 if failed else 0
