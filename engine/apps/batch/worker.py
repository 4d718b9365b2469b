"""A process that does what another one asks: the far end of `processes`.

In: pickled calls on standard input, each behind its length. Out: pickled results on what was
standard output; what a script prints goes to standard error. When the asking process is gone,
whatever happens to it, standard input ends: the process stops at once, and half-written files with
it. It is started as a program of its own: nothing of the asking program is imported or run again.
Before each result it says that it begins, so that whoever waits can tell how long a call takes.
"""

from __future__ import annotations

import _thread
import contextlib
import os
import pickle
import queue
import signal
import struct
import sys
from typing import Any, BinaryIO

from ...base.side_by_side import Thread

LENGTH = struct.Struct("<Q")
BEGUN = "begun"


def send(stream: BinaryIO, thing: Any) -> None:
    """Write a thing and its length."""
    data = pickle.dumps(thing, pickle.HIGHEST_PROTOCOL)
    stream.write(LENGTH.pack(len(data)) + data)
    stream.flush()


def receive(stream: BinaryIO) -> Any:
    """Read what `send` wrote.

    Raises
    ------
    EOFError
        The stream ends.
    """
    header = stream.read(LENGTH.size)
    if len(header) < LENGTH.size:
        raise EOFError
    (length,) = LENGTH.unpack(header)
    data = stream.read(length)
    if len(data) < length:
        raise EOFError
    return pickle.loads(data)


def main(idle: float | None = None) -> None:
    """Do what is asked until nobody asks any more, or for ``idle`` seconds nobody did."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    # Whoever ends this process means what Ctrl-C means: nothing half written stays behind.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    results = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    calls: queue.SimpleQueue = queue.SimpleQueue()
    try:
        # Whoever asks may be gone already: what listens stops this thread at once then.
        Thread(target=_listen, args=(sys.stdin.buffer, calls), daemon=True).start()
        patience = None  # the first call is on its way
        while (call := calls.get(timeout=patience)) is not None:
            patience = idle
            send(results, BEGUN)
            send(results, _answer(*call))
    except (KeyboardInterrupt, BrokenPipeError, queue.Empty):
        pass
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def _listen(stream: BinaryIO, calls: queue.SimpleQueue) -> None:
    """Take in calls; when there will be no more, stop whatever is being done."""
    with contextlib.suppress(EOFError, OSError):
        while True:
            calls.put(receive(stream))
    calls.put(None)
    _thread.interrupt_main()


def _answer(function: Any, arguments: tuple) -> tuple[bool, Any]:
    """Whether a call returned, and what it returned or raised."""
    try:
        return True, function(*arguments)
    except Exception as error:
        return False, error
