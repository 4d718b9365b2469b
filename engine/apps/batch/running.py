"""Runs a batch: distributes chunks, collects outcomes, and writes the final files.

In: tasks, a folder, an executor. Out: files, and a `Summary`. A chunk holds as many pictures as
take 50 ms (250 ms with Dask), to keep overhead low. Only a few chunks are queued, to bound memory.
If a process dies, its chunk is drawn again, picture by picture; a picture fails when it has killed
its process three times, or takes too long.
"""

from __future__ import annotations

import contextlib
import hashlib
import math
import os
import queue
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any

from ...base.calls import checks_types
from ...base.files.atomic_write import LEFT_BEHIND, checked_path
from ...base.files.hashing import hash_of_file
from ...base.files.making_folders import make_folder_of
from ...base.files.portable_names import common_name, folded
from ...base.numbers import real, shown
from ...base.plugins.discovery import are_on
from ...base.system import next_in
from ...base.thread_count import MAX_THREADS
from ...base.validation import whole_number
from ...choices import Backend
from ...errors import FileAccessError, InvalidArgumentError, warn
from ...rendering.backend_selection import resolve_backend
from ...version import __version__
from ..datasets.kinds import named_in_errors
from ..datasets.writer import DatasetWriter, Note
from .drawing import How, Outcome, draw_chunk, writer_of
from .executors import Engine, engine_for
from .limits import draw_limited
from .locking import locked_folder
from .processes import TimeLimitError
from .records import FOLDER, note_of, read_record
from .summary import Failure, Summary, write_sums
from .task import Task

_MOST_IN_CHUNK = 256
_TRIES = 3
_NAMED = 4  # pictures that a dead process may have been drawing


@checks_types
def run(
    tasks: Iterable[Task],
    out: str | os.PathLike[str],
    *,
    writer: DatasetWriter | None = None,
    jobs: int | None = None,
    threads: int | None = None,
    backend: Backend = "auto",
    executor: Any = None,
    scheduler: str | None = None,
    resume: bool = False,
    timeout: float | None = None,
    progress: Callable[[Task, Outcome | None, str], object] | None = None,
) -> Summary:
    """Draw a batch of pictures.

    Parameters
    ----------
    tasks : iterable of Task
        Their order is that of the data set.
    out : path-like
        The output folder; created if missing.
    writer : DatasetWriter, optional
        Decides the files of pictures; by default each task's ``outputs`` do.
    jobs : int, optional
        Number of processes; by default one per processor. 1: this process.
    threads : int, optional
        Threads of each renderer; by default the processors divided among the processes.
    backend : str
        As in `Renderer`; all give the same bytes.
    executor : object, optional
        Instead of ``jobs``: an executor as those of `concurrent.futures`, or a client of Dask.
    scheduler : str, optional
        Instead of ``jobs``: the address of Dask's scheduler, ``tcp://HOST:PORT``. All workers must
        see the same files, at the same paths.
    resume : bool
        Skip pictures whose inputs have not changed.
    timeout : float, optional
        Seconds that a picture may take, including loading. After that its process is killed, and
        the picture has failed; ``resume`` tries it again. With a timeout, a separate process draws
        even with ``jobs=1``, and beside each worker of executors and Dask.
    progress : callable, optional
        Called with a task, its outcome, and ``""``; or with a task, None, and a line that says why
        it is drawn again.

    Returns
    -------
    summary : Summary

    Raises
    ------
    InvalidArgumentError
        Arguments conflict, or two tasks have the same name.
    FileAccessError
        The folder cannot be written to, or another batch writes to it.
    """
    numbered = _numbered(tasks)
    for number, what in ((jobs, "jobs"), (threads, "threads")):
        if number is not None:
            whole_number(number, what, 1, MAX_THREADS)
    if timeout is not None and not 0 < real(timeout) <= threading.TIMEOUT_MAX:
        raise InvalidArgumentError(f"timeout must be a number of seconds, not {shown(timeout)}")
    resolve_backend(backend)
    folder = os.path.abspath(checked_path(out))
    _make(folder)
    with locked_folder(os.path.join(folder, FOLDER)):
        _remove_left_behind(folder)
        try:
            with engine_for(jobs, threads, executor, scheduler, timeout) as engine:
                limit = None if engine.ends_calls else timeout
                how = How(
                    folder,
                    writer,
                    engine.threads,
                    backend,
                    resume,
                    __version__,
                    limit,
                    are_on(),
                )
                summary = _Run(numbered, how, engine, progress).run()
        finally:
            _remove_left_behind(folder)
        summary.hash, summary.plugins = _finish(numbered, how)
    return summary


def _numbered(tasks: Iterable[Task]) -> list[Task]:
    """Yield the tasks with their positions as indices."""
    numbered: list[Task] = []
    names: dict[str, str] = {}
    for index, task in enumerate(tasks):
        if not isinstance(task, Task):
            raise InvalidArgumentError(f"tasks must be Tasks, not {type(task).__name__}")
        other = names.get(key := folded(task.name))
        if other is not None:
            raise InvalidArgumentError(f"two tasks have {common_name(task.name, other)}")
        names[key] = task.name
        numbered.append(task if task.index == index else replace(task, index=index))
    return numbered


def _make(folder: str) -> None:
    lock = os.path.join(folder, FOLDER, "lock")
    make_folder_of(folder)
    make_folder_of(lock, below=folder)


class _Run:
    """Distributes the tasks of a batch."""

    def __init__(self, tasks: Sequence[Task], how: How, engine: Engine, progress: Any) -> None:
        self._tasks, self._how, self._engine = tasks, how, engine
        self._draw = draw_chunk if how.timeout is None else draw_limited
        self._progress = progress or (lambda task, outcome, text: None)
        self._fresh = iter(tasks)
        self._again: deque[Task] = deque()  # tasks whose process died
        self._tries: dict[int, int] = {}
        self._finished: queue.SimpleQueue = queue.SimpleQueue()
        self._running: dict[Any, list[Task]] = {}
        self._counted, self._seconds = 0, 0.0  # of outcomes, to estimate the time of a picture
        self._warned: set[str] = set()
        self._failed: dict[int, str] = {}
        self.summary = Summary()

    def run(self) -> Summary:
        """Distribute all tasks and collect their outcomes."""
        try:
            self._hand_out()
            while self._running:
                future = next_in(self._finished)
                self._take_in(future, self._running.pop(future))
                self._hand_out()
        finally:
            for future in self._running:
                future.cancel()
        names = {task.index: task.name for task in self._tasks if task.index in self._failed}
        self.summary.failures = [Failure(names[k], self._failed[k]) for k in sorted(names)]
        return self.summary

    def _hand_out(self) -> None:
        most = self._engine.at_once + (self._engine.at_once > 1) * self._engine.at_once
        while len(self._running) < most and (chunk := self._next_chunk()):
            again = any(self._tries.get(task.index) for task in chunk)
            how = self._how._replace(resume=True) if again else self._how
            try:
                future = self._engine.executor.submit(self._draw, chunk, how)
            except RuntimeError as error:  # it is broken, or was shut down
                self._fail(chunk, f"the executor takes no more calls: {error}")
                continue
            self._running[future] = chunk
            future.add_done_callback(self._finished.put)

    def _next_chunk(self) -> list[Task]:
        if self._again:
            return [self._again.popleft()]
        chunk = []
        for _ in range(self._chunk_size()):
            with contextlib.suppress(StopIteration):
                chunk.append(next(self._fresh))
        return chunk

    def _chunk_size(self) -> int:
        """Return how many pictures take as long as a chunk should."""
        if not self._counted:
            return 1
        mean = max(self._seconds / self._counted, 1e-6)
        return min(math.ceil(self._engine.chunk_seconds / mean) or 1, _MOST_IN_CHUNK)

    def _take_in(self, future: Any, chunk: list[Task]) -> None:
        try:
            outcomes = future.result()
        except Exception as error:
            self._died(chunk, error)
            return
        for task, outcome in zip(chunk, outcomes, strict=True):
            self._count(task, outcome)

    def _died(self, chunk: list[Task], error: BaseException) -> None:
        """Requeue tasks whose process died, or that could not be submitted."""
        text = " ".join(str(error).split()) or type(error).__name__
        lasting = isinstance(error, (InvalidArgumentError, TimeLimitError))
        again = []
        for task in chunk:
            tries = self._tries[task.index] = self._tries.get(task.index, 0) + 1
            if lasting or tries >= _TRIES:
                self._fail([task], text)
            else:
                again.append(task)
        self._again.extend(again)
        if again:
            names = " or ".join(task.name for task in again[:_NAMED])
            more = " or others" if len(again) > _NAMED else ""
            self._progress(again[0], None, f"{text} while it drew {names}{more}: drawn again")

    def _fail(self, chunk: list[Task], text: str) -> None:
        for task in chunk:
            self._count(task, Outcome(task.index, " ".join(text.split()), False, 0.0, ()))

    def _count(self, task: Task, outcome: Outcome) -> None:
        if outcome.error is not None:
            self._failed[task.index] = outcome.error
        elif outcome.drawn:
            self.summary.drawn += 1
        else:
            self.summary.done_before += 1
        self._counted += 1
        self._seconds += outcome.seconds
        self.summary.seconds += outcome.seconds
        for text in outcome.warnings:
            if text not in self._warned:
                self._warned.add(text)
                warn(text)
        self._progress(task, outcome, "")


class _Notes:
    """Notes on the finished pictures, in order; can be iterated repeatedly."""

    def __init__(self, tasks: Sequence[Task], how: How) -> None:
        self._tasks, self._how = tasks, how

    def __iter__(self) -> Iterator[Note]:
        for task, record in self.records():
            yield note_of(task, record)

    def records(self) -> Iterator[tuple[Task, dict[str, Any]]]:
        """Yield the finished pictures, each with its record."""
        for task in self._tasks:
            writer = writer_of(task, self._how.writer)
            record = read_record(self._how.out, task, writer)
            if record is not None and record["key"] == task.key(writer):
                yield task, record


def _finish(tasks: Sequence[Task], how: How) -> tuple[str, list[str]]:
    """Write the files of the whole set; return the hash of everything, and who took part."""
    notes, whole = _Notes(tasks, how), []
    if how.writer is not None:
        with named_in_errors(how.writer):
            whole = list(how.writer.finish(how.out, notes))
    hashes = {p: _digest(f"{how.out}/{p}") for p in whole}
    plugins: set[str] = set()
    for _, record in notes.records():
        plugins.update(f"{name} {version}" for _, _, name, version in record.get("plugins", ()))
        files = record["files"].items()
        # A missing file is inside one of the listed files.
        hashes.update((p, digest) for p, digest in files if os.path.exists(f"{how.out}/{p}"))
    return write_sums(how.out, hashes.items()), sorted(plugins)


def _digest(path: str) -> str:
    try:
        return hash_of_file(path, hashlib.sha256())
    except OSError as error:
        raise FileAccessError(f"cannot read: {error.strerror}", path) from error


def _remove_left_behind(folder: str) -> None:
    """Remove partial files of killed processes."""
    for place, _, names in os.walk(folder):
        for name in filter(LEFT_BEHIND.fullmatch, names):
            with contextlib.suppress(OSError):
                os.unlink(os.path.join(place, name))
