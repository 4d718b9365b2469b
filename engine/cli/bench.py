"""``engine3d bench``: how fast this machine draws, stage by stage, or beside Mesa's llvmpipe."""

from __future__ import annotations

import argparse
import json
import os
import time
from collections.abc import Iterator

from ..benchmarking import bar_chart, measuring, report, workloads
from ..files.atomic_write import atomic_write
from ..rendering.backend_selection import backends, resolve_backend
from .outputs import STANDARD_OUTPUT, check_folder, check_output

PLOTS = (".svg", ".png", ".jpg", ".webp")
#: Seconds that a row takes at most: more would tell nothing new.
LONGEST = 2.0


def bench(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    if args.plot:
        check_output(args.plot, PLOTS, "--plot")
    if args.json not in (None, STANDARD_OUTPUT):
        check_folder(args.json)
    cases = [(name, backend) for name in args.workloads for backend in _backends(args.backends)]
    quiet = args.json == STANDARD_OUTPUT
    if args.against:
        _check_peer(args)
    if not quiet:
        print("\n".join(report.heading(args.resolution, args.against)), end="\n\n")
        print(report.columns(bool(args.against)), flush=True)
    rows = []
    for row in _measure(args, cases):
        rows.append(row)
        if not quiet:
            print(report.line(row), flush=True)
    if args.plot:
        bar_chart.save(args.plot, *report.chart(rows))
    if args.json:
        _write_json(args, rows)
    return 0


def _backends(names: list[str]) -> list[str]:
    """The backends asked for, checked before anything is drawn."""
    if "all" in names:
        return backends()[::-1]
    for name in names:
        resolve_backend(name)
    return names


def _thread_counts(args) -> list[int]:
    """One thread and all, unless asked otherwise; a peer takes all."""
    one_cpu = len(os.sched_getaffinity(0)) == 1
    return args.threads or ([0] if args.against or one_cpu else [1, 0])


def _measure(args, cases) -> Iterator[dict]:
    """Yield the rows, none of which takes more than its share of the time that is left."""
    cases = [(*case, threads) for case in cases for threads in _thread_counts(args)]
    end = time.perf_counter() + args.seconds
    made = None
    for number, (name, backend, threads) in enumerate(cases):
        if made is None or made.name != name:
            made = workloads.make(name, plain=bool(args.against))
        share = max(0.0, end - time.perf_counter()) / (len(cases) - number)
        share = min(share, LONGEST)
        if args.against:
            yield _beside_peer(args, made, backend, threads, share)
        else:
            yield measuring.measure(made, args.resolution, backend, threads, share)


def _beside_peer(args, workload, backend, threads, seconds) -> dict:
    from ..benchmarking import llvmpipe

    peer = llvmpipe.Peer(workload, args.resolution)
    try:
        return measuring.compare(workload, args.resolution, peer, backend, threads, seconds)
    finally:
        peer.close()


def _check_peer(args) -> None:
    """Raise, before anything is drawn, if the peer is not there."""
    from ..benchmarking import llvmpipe

    threads = _thread_counts(args)
    llvmpipe.open_context(threads[0] if len(threads) == 1 else 0).release()


def _write_json(args, rows) -> None:
    result = {
        **report.machine(),
        "resolution": list(args.resolution),
        "picture": "plain" if args.against else "default",
        "rows": rows,
    }
    text = json.dumps(result, indent=2)
    if args.json == STANDARD_OUTPUT:
        print(text)
    else:
        with atomic_write(args.json) as file:
            file.write(text.encode() + b"\n")
