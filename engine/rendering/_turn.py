"""Whose turn it is to draw with a renderer.

In: whoever wants to draw. Out: the turn, one after the other; threads wait for theirs. What comes
from within a frame, such as a signal handler, cannot wait for it to end and is told so. So is a
process that was forked from the middle of a frame: the rest of that frame is elsewhere.
"""

from __future__ import annotations

import threading
import weakref
from collections.abc import Iterator
from contextlib import contextmanager

from .._native.rasterizer import NativeRenderer
from ..base.system import after_fork
from ..errors import RendererBusyError

_WITHIN = (
    "the renderer is drawing already, and this comes from within that frame (a signal handler, or "
    "what a frame calls): leave a note and draw after the frame, or draw with another Renderer"
)
_FORKED = (
    "this process was forked while the renderer drew, and has no more than half of that frame: "
    "make another Renderer here"
)


class RendererTurn:
    """The turns of one renderer.

    Parameters
    ----------
    native : NativeRenderer
        Of which a forked process must let go.
    """

    def __init__(self, native: NativeRenderer) -> None:
        self._native: NativeRenderer | None = native
        self._lock = threading.RLock()  # who comes from within gets past it, and is told
        self._drawing = self._forked = False
        _turns.add(self)

    @contextmanager
    def taken(self, *, closing: bool = False) -> Iterator[None]:
        """Wait for the turn, and have it within the block; a renderer can be closed after a fork.

        Raises
        ------
        RendererBusyError
        """
        with self._lock:
            if self._drawing and not self._forked:
                raise RendererBusyError(_WITHIN)
            if not closing:
                self.check()
            try:
                self._drawing = True
                yield
            finally:
                self._drawing = False

    def check(self) -> None:
        """Raise if the process was forked from within a frame."""
        if self._forked:
            raise RendererBusyError(_FORKED)

    def let_go(self) -> None:
        """Free the native renderer, which the caller has had too."""
        self._native = None

    def _fork(self) -> None:
        """In a forked process: the threads that had or awaited the turn are not here."""
        self._lock = threading.RLock()
        if self._drawing and self._native is not None:
            self._forked = True
            self._native.abandon()


_turns: weakref.WeakSet[RendererTurn] = weakref.WeakSet()


def _fork_all() -> None:
    for turn in list(_turns):
        turn._fork()


after_fork(_fork_all)
