"""Handles signals that end the editor, and interrupts long-running code.

In: signals, a function that says whether to stop, another that keeps unsaved work. Out:
`KeyboardInterrupt` in the code, or the signal's number. The system's alarm (setitimer) makes Python
check between two instructions: a running C call is stopped only after it returns.
"""

from __future__ import annotations

import contextlib
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator

from ....base.system import ending_signals, has_alarm

#: Seconds before the first check, and between checks.
FIRST, PERIOD = 0.2, 0.1
#: Seconds the editor gets to end by itself after a signal.
GRACE = 0.6
_ENDING = ending_signals()
_HAS_ALARM = has_alarm()
_BASE = 128  # added to the signal's number for the exit status, as in shells


def _set_alarm(seconds: float) -> None:
    """Start the alarm after a delay, then repeatedly; 0 stops it.

    On systems without alarms, such as Windows, long-running code is not stopped.
    """
    if _HAS_ALARM:
        signal.setitimer(signal.ITIMER_REAL, seconds, PERIOD if seconds else 0.0)


class Interrupts:
    """Handles signals while it is open.

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
        """Raise `KeyboardInterrupt` in the block once ``stops()`` is true."""
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
