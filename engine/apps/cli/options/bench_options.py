"""The options of ``bench``."""

from __future__ import annotations

import argparse

from ...scenes import SCENES, WORKLOAD_NAMES
from .. import values
from .picture_options import BACKENDS


def add(command) -> None:
    """Add the options for workloads and duration."""
    command.epilog = "workloads:"
    command.epilog += "".join(f"\n  {n:<15} {SCENES[n].about}" for n in WORKLOAD_NAMES)
    command.formatter_class = argparse.RawDescriptionHelpFormatter
    command.add_argument(
        "--workloads",
        type=values.some_of(WORKLOAD_NAMES),
        default=list(WORKLOAD_NAMES),
        metavar="NAME,…",
        help="workloads to measure (default: all of those below)",
    )
    command.add_argument(
        "--backends",
        type=values.some_of((*BACKENDS, "all")),
        default=["auto"],
        metavar="NAME,…",
        help="all, or some of " + ", ".join(BACKENDS) + " (default: auto, the fastest)",
    )
    command.add_argument(
        "--threads",
        type=values.thread_counts,
        metavar="N,…",
        help="numbers of threads to measure with; 0 is one per available CPU (default: 1,0)",
    )
    command.add_argument(
        "--size",
        type=values.size,
        default=(1920, 1080),
        metavar="WxH",
        help="size in pixels (default: 1920x1080)",
    )
    command.add_argument(
        "--seconds",
        type=values.positive,
        default=45.0,
        metavar="N",
        help="about how long to measure in all; slow frames may take longer (default: 45)",
    )
    command.add_argument(
        "--json", metavar="FILE", help="write the results as JSON; - for standard output"
    )
