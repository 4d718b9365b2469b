"""``engine3d bench``: how fast this machine draws, stage by stage."""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Iterator

from ....base.files.atomic_write import atomic_write
from ....base.files.making_folders import make_folder_of
from ....base.system import usable_processors
from ....rendering.backend_selection import backends, resolve_backend
from ...bench import figures, measuring
from ...scenes import workloads
from ..outputs import STANDARD_OUTPUT, check_folder

#: Maximum seconds per row: more would not improve the figures.
LONGEST = 2.0


def bench(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    if args.json not in (None, STANDARD_OUTPUT):
        check_folder(args.json)
    cases = [(name, backend) for name in args.workloads for backend in _backends(args.backends)]
    quiet = args.json == STANDARD_OUTPUT
    if not quiet:
        print("\n".join(figures.heading(args.size)), end="\n\n")
        print(figures.columns(), flush=True)
    rows = []
    for row in _measure(args, cases):
        rows.append(row)
        if not quiet:
            print(figures.line(row), flush=True)
    if args.json:
        _write_json(args, rows)
    return 0


def _backends(names: list[str]) -> list[str]:
    """Return the chosen backends, checked before anything is drawn."""
    if "all" in names:
        return backends()[::-1]
    for name in names:
        resolve_backend(name)
    return names


def _thread_counts(args) -> list[int]:
    """Return the thread counts to measure: by default one and all."""
    return args.threads or ([0] if usable_processors() == 1 else [1, 0])


def _measure(args, cases) -> Iterator[dict]:
    """Yield the rows; each takes at most its share of the remaining time."""
    cases = [(*case, threads) for case in cases for threads in _thread_counts(args)]
    end = time.perf_counter() + args.seconds
    made = None
    for number, (name, backend, threads) in enumerate(cases):
        if made is None or made.name != name:
            made = workloads.make(name)
        share = max(0.0, end - time.perf_counter()) / (len(cases) - number)
        share = min(share, LONGEST)
        yield measuring.measure(made, args.size, backend, threads, share)


def _write_json(args, rows) -> None:
    result = {
        **figures.machine(),
        "size": list(args.size),
        "picture": "default",
        "rows": rows,
    }
    text = json.dumps(result, indent=2)
    if args.json == STANDARD_OUTPUT:
        print(text)
    else:
        make_folder_of(args.json)
        with atomic_write(args.json) as file:
            file.write(text.encode() + b"\n")
