"""Which plug-ins took part in a piece of work.

In: a block of work. Out: each plug-in whose value was used within it: results that depend on
plug-ins can be told from those that do not.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .plugin import Plugin

_listeners: ContextVar[tuple[Callable[[Plugin], object], ...]] = ContextVar(
    "_listeners", default=()
)


@contextmanager
def participants(note: Callable[[Plugin], object]) -> Iterator[None]:
    """Call ``note`` with each plug-in that is used within the block, each time."""
    token = _listeners.set((*_listeners.get(), note))
    try:
        yield
    finally:
        _listeners.reset(token)


def took_part(plugin: Plugin) -> None:
    """Tell all listeners that a plug-in is used."""
    for note in _listeners.get():
        note(plugin)
