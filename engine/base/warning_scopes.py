"""Changes of Python's warnings for one thread, or for as long as any of several wants them.

Python's filters, and the function that shows a warning, belong to the process:
`warnings.catch_warnings` in two threads at once may leave the filters of one to all, for good. Here
the first thread saves them, and the last one restores them.
"""

from __future__ import annotations

import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

from ..errors import Engine3DWarning
from .system import after_fork

_texts: ContextVar[list[str] | None] = ContextVar("texts", default=None)


@contextmanager
def gathered() -> Iterator[list[str]]:
    """Gather the texts of engine3d's warnings in this context, and drop all others.

    Threads of `side_by_side` belong to their caller's context.
    """
    texts: list[str] = []
    token = _texts.set(texts)
    try:
        with _held(_show_here):
            yield texts
    finally:
        _texts.reset(token)


@contextmanager
def ignored_of(module: str) -> Iterator[None]:
    """Ignore the warnings of the modules whose names match a regular expression."""
    with _held(lambda: warnings.filterwarnings("ignore", module=module)):
        yield


class _Process:
    """What the process had before the first thread changed it, and how many hold the change."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.holders = 0
        self.before: Any = None
        self.show: Callable[..., None] = warnings.showwarning


_process = _Process()


@contextmanager
def _held(change: Callable[[], None]) -> Iterator[None]:
    """Make a change, which may have been made before, and hold it within the block."""
    with _process.lock:
        if not _process.holders:
            _process.before = warnings.catch_warnings()
            _process.before.__enter__()
        _process.holders += 1
        change()
    try:
        yield
    finally:
        with _process.lock:
            _process.holders -= 1
            if not _process.holders:
                _process.before.__exit__(None, None, None)


def _show_here() -> None:
    warnings.simplefilter("always", Engine3DWarning)
    if warnings.showwarning is not _show:
        _process.show, warnings.showwarning = warnings.showwarning, _show


def _show(message: Warning | str, category: type[Warning], *place: Any, **more: Any) -> None:
    """Take the place of `warnings.showwarning`."""
    texts = _texts.get()
    if texts is None:
        _process.show(message, category, *place, **more)
    elif issubclass(category, Engine3DWarning):
        texts.append(str(message))


def _renew_lock() -> None:
    _process.lock = threading.Lock()  # the thread that held it is not in this process


after_fork(_renew_lock)
