"""Who does the calls of a batch: this process, processes of ours, Dask, or what callers give.

In: what `run` was given. Out: something with ``submit(function, *arguments)`` that returns a future
with ``add_done_callback`` and ``result``, and how many calls it does at once.
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

#: A scheduler, a client and a worker have a hand in each call of Dask's.
DASK_SECONDS = 0.25


class Engine(NamedTuple):
    """Who does the calls.

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
    """Does each call at once, as it is submitted."""

    def submit(self, function, /, *arguments: Any) -> Future:
        """Do a call; the future is done."""
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
    """Make what does the calls, and end what was made.

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
        with ProcessPool(jobs, timeout) as pool:  # a call is a picture: it alone is ended
            yield Engine(pool, jobs, each, chunk_seconds=0.0, ends_calls=True)
    elif jobs == 1:
        yield Engine(InThisProcess(), 1, each)
    else:
        with ProcessPool(jobs) as pool:
            yield Engine(pool, jobs, each)


def _given(executor: Any, threads: int) -> Engine:
    """An executor of the caller's, who ends it."""
    if hasattr(executor, "scheduler_info"):
        from .dask_engine import DaskExecutor, count_of

        return Engine(DaskExecutor(executor), count_of(executor), threads, DASK_SECONDS)
    return Engine(executor, getattr(executor, "_max_workers", None) or usable_processors(), threads)
