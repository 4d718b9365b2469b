"""Parallel work in threads, robust against threads that never start.

In: a function and items. Out: its results, in the items' order. Python's own pools wait forever for
a thread that dies before it starts, as happens when memory is nearly exhausted. Here nobody waits
for a thread that has not started: the caller works too, alone if necessary.
"""

from __future__ import annotations

import _thread
import contextlib
import contextvars
import threading
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from ..errors import OutOfMemoryError

Item = TypeVar("Item")
Outcome = TypeVar("Outcome")

#: Seconds within which a thread starts, however busy the machine is.
PATIENCE = 60.0


def side_by_side(
    function: Callable[[Item], Outcome], items: Sequence[Item], threads: int
) -> list[Outcome]:
    """Return a function's result for each item, computed by several threads.

    Parameters
    ----------
    function : callable
        Runs in the caller's context (`contextvars`).
    items : sequence
    threads : int
        The maximum number, including the caller's.

    Raises
    ------
    Exception
        The function's exception for the first item that fails; no further items are started.
    """
    work = _Work(function, items)
    helpers = [_Helper(work) for _ in range(min(threads, len(items)) - 1)]
    try:
        for helper in helpers:
            helper.start()
        work.do()
    finally:
        work.stop()
        for helper in helpers:
            helper.wait()
    return work.results()


class _Work:
    """The items, taken one by one, and their results."""

    def __init__(self, function: Callable[[Any], Any], items: Sequence[Any]) -> None:
        self._function, self._items = function, items
        self._outcomes: list[Any] = [None] * len(items)
        self._errors: list[BaseException | None] = [None] * len(items)
        self._places = iter(range(len(items)))  # each number goes to one thread only

    def do(self) -> None:
        """Process items until none are left."""
        for place in self._places:
            self._do_one(place)

    def _do_one(self, place: int) -> None:
        try:
            self._outcomes[place] = self._function(self._items[place])
        except BaseException as error:
            self._errors[place] = error
            self.stop()
            if not isinstance(error, Exception):
                raise

    def stop(self) -> None:
        """Prevent any further item from being taken."""
        for _ in self._places:
            pass

    def results(self) -> list[Any]:
        for error in self._errors:
            if error is not None:
                raise error
        return self._outcomes


class _Helper:
    """A thread that processes items, if it starts."""

    def __init__(self, work: _Work) -> None:
        self._work = work
        self._context = contextvars.copy_context()
        self._has_begun = False
        self._ended = threading.Lock()
        self._ended.acquire()

    def start(self) -> None:
        with contextlib.suppress(RuntimeError, MemoryError):  # no more threads are possible
            _thread.start_new_thread(self._run, ())

    def wait(self) -> None:
        """Wait for started work to end; nothing new can start now."""
        if self._has_begun:
            self._ended.acquire()

    def _run(self) -> None:
        try:
            self._has_begun = True
            with contextlib.suppress(BaseException):  # the work records it
                self._context.run(self._work.do)
        finally:
            self._ended.release()


class Thread(threading.Thread):
    """A thread that raises an error if it does not start, instead of waiting forever.

    `start` raises `OutOfMemoryError`.
    """

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self._started = _Begun()

    def start(self) -> None:
        try:
            super().start()
        except RuntimeError as error:
            if self._started.is_set():
                raise
            raise OutOfMemoryError(f"no thread could be started: {error}") from None


class _Begun(threading.Event):
    """The event that a new thread sets when it starts."""

    def wait(self, timeout: float | None = None) -> bool:
        begun = super().wait(PATIENCE if timeout is None else timeout)
        if not begun and timeout is None:
            raise OutOfMemoryError("a thread that was started did not begin")
        return begun
