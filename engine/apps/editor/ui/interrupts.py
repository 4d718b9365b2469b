"""Signals that ask the editor to end, and code that goes on too long and can be stopped.

In: signals, a function that tells whether to stop, another that keeps what is not saved. Out:
`KeyboardInterrupt` in the code, or the number of the signal. The system's alarm (setitimer) makes
Python ask between two of its instructions: what runs in one call of C is stopped once that is over.
"""

from __future__ import annotations

import contextlib
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator

from ....base.system import ending_signals, has_alarm

#: Seconds before it is asked for the first time, and from then on between two times.
FIRST, PERIOD = 0.2, 0.1
#: How long the editor may take to end by itself once a signal asked it to, in seconds.
GRACE = 0.6
_ENDING = ending_signals()
_HAS_ALARM = has_alarm()
_BASE = 128  # plus the signal's number is the exit status, as shells count


def _set_alarm(seconds: float) -> None:
    """Let the alarm come after so long, and then again and again; 0: no more.

    Where the system has none, as Windows, what goes on too long is not stopped.
    """
    if _HAS_ALARM:
        signal.setitimer(signal.ITIMER_REAL, seconds, PERIOD if seconds else 0.0)


class Interrupts:
    """Follows signals while it is open.

    Parameters
    ----------
    keep : callable
        Keeps what is not saved, where the editor does not end in time: called between any two
        instructions of what it is doing.

    Attributes
    ----------
    number : int
        Of the signal that asked the editor to end; 0 if none did.
    """

    def __init__(self, keep: Callable[[], object]) -> None:
        self.number = 0
        self._keep = keep
        self._deadline = 0.0
        self._stops: Callable[[], bool] | None = None
        self._before: dict[int, object] = {}

    @property
    def status(self) -> int:
        """The exit status: 0 if no signal came."""
        return _BASE + self.number if self.number else 0

    def __enter__(self) -> Interrupts:
        if threading.current_thread() is threading.main_thread():
            handlers = dict.fromkeys(_ENDING, self._note)
            if _HAS_ALARM:
                handlers[signal.SIGALRM] = self._look
            self._before = {each: signal.signal(each, handlers[each]) for each in handlers}
        return self

    def __exit__(self, *exception: object) -> None:
        if self._before:
            _set_alarm(0.0)
        for number, handler in self._before.items():
            signal.signal(number, handler)
        self._before = {}

    @contextlib.contextmanager
    def stoppable(self, stops: Callable[[], bool]) -> Iterator[None]:
        """Raise `KeyboardInterrupt` in the code within, once ``stops()`` is true."""
        if not self._before:  # nobody listens to signals
            yield
            return
        self._stops = stops
        _set_alarm(FIRST)
        try:
            yield
        finally:
            self._stops = None
            if not self.number:
                _set_alarm(0.0)

    def _note(self, number: int, frame: object) -> None:
        if not self.number:
            self.number, self._deadline = number, time.monotonic() + GRACE
            _set_alarm(PERIOD)

    def _look(self, number: int, frame: object) -> None:
        if self.number and time.monotonic() > self._deadline:
            try:
                self._keep()
            finally:
                os._exit(self.status)
        stops = self._stops
        if stops is not None and (self.number or stops()):
            raise KeyboardInterrupt
