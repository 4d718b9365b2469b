"""``engine3d batch``: draws many pictures in many processes; finished ones stay."""

from __future__ import annotations

import argparse
import contextlib
import sys

from ...batch import Summary, Task, read_manifest, run
from ...batch.drawing import Outcome
from .. import quietness
from ..said import say

_SHOWN = 20  # failures that are listed


def batch(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    manifest = read_manifest(args.manifest)
    # Keep prints of scripts out of the command's own output.
    with _Progress(len(manifest.tasks)) as progress, contextlib.redirect_stdout(sys.stderr):
        summary = run(
            manifest.tasks,
            args.output,
            writer=manifest.writer,
            jobs=args.jobs,
            threads=args.threads or None,
            backend=args.backend,
            scheduler=args.scheduler,
            resume=args.resume,
            timeout=args.timeout,
            progress=progress,
        )
    return _report(summary)


def _report(summary: Summary) -> int:
    """Print the summary of the batch; return the exit status."""
    failed = summary.failures
    for name, error in failed[:_SHOWN]:
        say(f"error: {name}: {error}")
    if len(failed) > _SHOWN:
        say(f"error: and {len(failed) - _SHOWN:,} more")
    if not quietness.is_quiet():
        counts = f"{summary.drawn:,} drawn, {summary.done_before:,} done before, {len(failed):,}"
        print(f"{counts} failed; SHA256SUMS {summary.hash}")
        if summary.plugins:
            print(f"with plug-ins of {', '.join(summary.plugins)}")
    return 1 if failed else 0


class _Progress:
    """A progress bar on a terminal, and a line for each picture that is drawn again."""

    def __init__(self, total: int) -> None:
        self._total = total
        self._bar = self._task = None
        self._failed = 0

    def __enter__(self) -> _Progress:
        if quietness.shows_progress():
            from rich.console import Console
            from rich.progress import MofNCompleteColumn, Progress, TimeRemainingColumn

            columns = (*Progress.get_default_columns()[:2], MofNCompleteColumn())
            console = Console(stderr=True)
            self._bar = Progress(*columns, TimeRemainingColumn(), console=console, transient=True)
            self._task = self._bar.add_task("drawing", total=self._total)
            self._bar.start()
        return self

    def __call__(self, task: Task, outcome: Outcome | None, text: str) -> None:
        if outcome is None:
            quietness.remark(f"warning: {text}")
            return
        self._failed += outcome.error is not None
        if self._bar is not None:
            label = f"drawing, {self._failed:,} failed" if self._failed else "drawing"
            self._bar.update(self._task, advance=1, description=label)

    def __exit__(self, kind: type[BaseException] | None, *error: object) -> None:
        if self._bar is not None:
            with contextlib.suppress(OSError):
                self._bar.stop()
        if kind is KeyboardInterrupt:
            quietness.remark("stopped: with --resume, the batch goes on from here")
