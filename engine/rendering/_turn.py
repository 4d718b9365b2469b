"""Serialises the use of a renderer.

In: callers that want to draw. Out: turns, one after the other; threads wait for theirs. A call from
within a frame, such as from a signal handler, cannot wait and raises an error. So does a process
forked in the middle of a frame: the threads that draw the rest of it do not exist there.
"""

from __future__ import annotations

import weakref
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from threading import RLock

from .._native.rasterizer import FORKED, WITHIN, NativeRenderer, Turn
from ..base.system import after_fork
from ..errors import RendererBusyError


class RendererTurn(Turn):
    """The turns of one renderer: ``with turn:`` holds one to draw."""

    lock: AbstractContextManager[object]

    def __init__(self) -> None:
        self._natives: list[NativeRenderer] = []
        self._staging = False
        _turns.add(self)

    @contextmanager
    def taken(self, *, closing: bool = False, staging: bool = False) -> Iterator[None]:
        """Hold the turn within the block, for anything but drawing.

        Parameters
        ----------
        closing : bool
            Allow it after a fork.
        staging : bool
            The block stages a thing, and takes the turn again to draw it; nothing else is staged.

        Raises
        ------
        RendererBusyError
        """
        with self.lock:
            if (self.is_drawing or self._staging and staging) and not self.is_forked:
                raise RendererBusyError(WITHIN)
            if not closing:
                self.check()
            held = "_staging" if staging else "is_drawing"
            try:
                setattr(self, held, True)
                yield
            finally:
                setattr(self, held, False)

    def check(self) -> None:
        """Raise if the process was forked from within a frame."""
        if self.is_forked:
            raise RendererBusyError(FORKED)

    def hold(self, native: NativeRenderer) -> None:
        """Note a native renderer that draws in these turns: a forked process must abandon it."""
        self._natives.append(native)

    def let_go(self) -> None:
        """Free the native renderers, once the caller has dropped them too."""
        self._natives.clear()

    def _fork(self) -> None:
        """Reset the turn in a forked process: the threads that held or awaited it are gone."""
        self.lock = RLock()
        if (self.is_drawing or self._staging) and self._natives:
            self.is_forked = True
            for native in self._natives:
                native.abandon()


_turns: weakref.WeakSet[RendererTurn] = weakref.WeakSet()


def _fork_all() -> None:
    for turn in list(_turns):
        turn._fork()


after_fork(_fork_all)
