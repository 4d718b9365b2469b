"""A worker process: the counterpart of `processes`.

In: pickled calls on the original standard input, each after its length. Out: pickled results on the
original standard output. Scripts read nothing, and their output goes to standard error. When the
parent process is gone, the input ends: the worker stops at once and removes partial files. It is a
separate program that does not import the parent's main module. It reports the start of each call,
so that the parent can measure the time.
"""

from __future__ import annotations

import _thread
import contextlib
import os
import pickle
import queue
import signal
import struct
from typing import Any, BinaryIO

from ...base.side_by_side import Thread
from ...base.system import is_unread

LENGTH = struct.Struct("<Q")
BEGUN = "begun"


def send(stream: BinaryIO, thing: Any) -> None:
    """Write an object with its length."""
    data = pickle.dumps(thing, pickle.HIGHEST_PROTOCOL)
    stream.write(LENGTH.pack(len(data)) + data)
    stream.flush()


def receive(stream: BinaryIO) -> Any:
    """Read an object written by `send`.

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
    """Run calls until the input ends, or for ``idle`` seconds none arrives."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    # Ending this process must act like Ctrl-C: no partial file remains.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    asked, results = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    # Besides, a library that Windows loads may ask what standard input is, which waits while
    # another thread reads from it.
    with open(os.devnull, "rb") as nothing:
        os.dup2(nothing.fileno(), 0)
    os.dup2(2, 1)
    calls: queue.SimpleQueue = queue.SimpleQueue()
    try:
        # The parent may be gone already: the listener then stops this thread at once.
        Thread(target=_listen, args=(asked, calls), daemon=True).start()
        _serve(calls, results, idle)
    except (KeyboardInterrupt, queue.Empty):
        pass
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def _serve(calls: queue.SimpleQueue, results: BinaryIO, idle: float | None) -> None:
    """Answer calls until no more come, or nobody reads the answers."""
    patience = None  # the first call is on its way
    try:
        while (call := calls.get(timeout=patience)) is not None:
            patience = idle
            send(results, BEGUN)
            send(results, _answer(*call))
    except OSError as error:
        if not is_unread(error):
            raise


def _listen(stream: BinaryIO, calls: queue.SimpleQueue) -> None:
    """Queue incoming calls; when the input ends, interrupt the current one."""
    with contextlib.suppress(EOFError, OSError):
        while True:
            calls.put(receive(stream))
    calls.put(None)
    _thread.interrupt_main()


def _answer(function: Any, arguments: tuple) -> tuple[bool, Any]:
    """Return whether a call succeeded, and its result or exception."""
    try:
        return True, function(*arguments)
    except Exception as error:
        return False, error
