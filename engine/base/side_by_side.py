"""Work shared out among threads, and threads that begin or are given up.

In: a function and items. Out: its results, in the items' order. Python's own pools wait for ever
for a thread that ends before it has begun, as threads do when memory is nearly gone. Here nobody
waits for a thread that has not begun: whoever asks works, too, and alone if need be.
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

#: Seconds in which a thread begins, however busy the machine is.
PATIENCE = 60.0


def side_by_side(
    function: Callable[[Item], Outcome], items: Sequence[Item], threads: int
) -> list[Outcome]:
    """Return what a function makes of each item; several threads may call it.

    Parameters
    ----------
    function : callable
        Finds the variables of the caller's context (`contextvars`).
    items : sequence
    threads : int
        At most, the caller's included.

    Raises
    ------
    Exception
        What the function raised for the first item for which it did; no more items are begun then.
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
    """Items that are taken one by one, and what became of them."""

    def __init__(self, function: Callable[[Any], Any], items: Sequence[Any]) -> None:
        self._function, self._items = function, items
        self._outcomes: list[Any] = [None] * len(items)
        self._errors: list[BaseException | None] = [None] * len(items)
        self._places = iter(range(len(items)))  # of which each number is given to one thread alone

    def do(self) -> None:
        """Take items until there are none left."""
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
        """Let nobody take another item."""
        for _ in self._places:
            pass

    def results(self) -> list[Any]:
        for error in self._errors:
            if error is not None:
                raise error
        return self._outcomes


class _Helper:
    """A thread that takes items, if it begins."""

    def __init__(self, work: _Work) -> None:
        self._work = work
        self._context = contextvars.copy_context()
        self._has_begun = False
        self._ended = threading.Lock()
        self._ended.acquire()

    def start(self) -> None:
        with contextlib.suppress(RuntimeError, MemoryError):  # there can be no more threads
            _thread.start_new_thread(self._run, ())

    def wait(self) -> None:
        """Wait for the end of what was begun; there is nothing to begin any more."""
        if self._has_begun:
            self._ended.acquire()

    def _run(self) -> None:
        try:
            self._has_begun = True
            with contextlib.suppress(BaseException):  # which the work keeps
                self._context.run(self._work.do)
        finally:
            self._ended.release()


class Thread(threading.Thread):
    """A thread whose start is an error where it does not begin, and no wait for ever.

    Raises `OutOfMemoryError` when it is started.
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
    """What a new thread sets when it begins."""

    def wait(self, timeout: float | None = None) -> bool:
        begun = super().wait(PATIENCE if timeout is None else timeout)
        if not begun and timeout is None:
            raise OutOfMemoryError("a thread that was started did not begin")
        return begun
