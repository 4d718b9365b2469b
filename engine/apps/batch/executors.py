"""Executors for the calls of a batch: this process, our own processes, Dask, or the caller's.

In: the arguments of `run`. Out: an object with ``submit(function, *arguments)`` that returns a
future with ``add_done_callback`` and ``result``, and its number of parallel calls.
"""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from typing import Any, NamedTuple

from ...base.numbers import shown
from ...base.system import usable_processors
from ...errors import InvalidArgumentError
from .processes import ProcessPool

#: Each Dask call passes through a scheduler, a client and a worker.
DASK_SECONDS = 0.25


class Engine(NamedTuple):
    """An executor, with its properties.

    Attributes
    ----------
    executor : object
        With ``submit``.
    at_once : int
        Calls that it does at the same time.
    threads : int
        Of each renderer, so that they do not fight for processors.
    chunk_seconds : float
        How long a call should take at least, so that asking for it costs little beside it.
    ends_calls : bool
        Whether it ends calls that take too long.
    """

    executor: Any
    at_once: int
    threads: int
    chunk_seconds: float = 0.05
    ends_calls: bool = False


class InThisProcess:
    """Runs each call immediately when it is submitted."""

    def submit(self, function, /, *arguments: Any) -> Future:
        """Run a call; return a finished future."""
        future: Future = Future()
        try:
            future.set_result(function(*arguments))
        except Exception as error:
            future.set_exception(error)
        return future


@contextmanager
def engine_for(
    jobs: int | None,
    threads: int | None,
    executor: Any,
    scheduler: str | None,
    timeout: float | None = None,
) -> Iterator[Engine]:
    """Create the executor within the block, and shut it down afterwards.

    Raises
    ------
    InvalidArgumentError
        Two are asked for at once, or Dask is asked for and is not installed or does not answer.
    """
    if sum(x is not None for x in (jobs, executor, scheduler)) > 1:
        raise InvalidArgumentError("give one of jobs, executor and scheduler")
    if scheduler is not None:
        from .dask_engine import connected

        with connected(scheduler) as (client, count):
            yield Engine(client, count, threads or 1, DASK_SECONDS)
    elif executor is not None:
        if isinstance(executor, type) or not callable(getattr(executor, "submit", None)):
            raise InvalidArgumentError(f"executor must have a method submit: {shown(executor)}")
        yield _given(executor, threads or 1)
    else:
        yield from _own(usable_processors() if jobs is None else jobs, threads, timeout)


def _own(jobs: int, threads: int | None, timeout: float | None) -> Iterator[Engine]:
    each = threads or max(1, usable_processors() // jobs)
    if timeout is not None:
        # one picture per call: the timeout ends only that one
        with ProcessPool(jobs, timeout) as pool:
            yield Engine(pool, jobs, each, chunk_seconds=0.0, ends_calls=True)
    elif jobs == 1:
        yield Engine(InThisProcess(), 1, each)
    else:
        with ProcessPool(jobs) as pool:
            yield Engine(pool, jobs, each)


def _given(executor: Any, threads: int) -> Engine:
    """Return the caller's own executor, which the caller shuts down."""
    if hasattr(executor, "scheduler_info"):
        from .dask_engine import DaskExecutor, count_of

        return Engine(DaskExecutor(executor), count_of(executor), threads, DASK_SECONDS)
    return Engine(executor, getattr(executor, "_max_workers", None) or usable_processors(), threads)
