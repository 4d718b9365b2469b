"""A pool of processes that outlives the death of each of them.

In: calls of functions that can be imported. Out: futures, as executors of `concurrent.futures` give
them. A process that dies fails the call that it worked on, by an error that names it, and another
takes its place. No process runs the program that made the pool, so that it needs no guard; none is
in the terminal's group, so that Ctrl-C reaches the pool alone, which ends them.
"""

from __future__ import annotations

import contextlib
import pickle
import queue
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

from .worker import receive, send

_PROGRAM = "import sys; sys.path[:] = {path!r}; from engine3d.batch.worker import main; main()"
_PATIENCE = 5.0  # seconds, for a process to end that was asked to


class WorkerDiedError(RuntimeError):
    """A process ended while it worked on a call."""


class ProcessPool:
    """Processes that do calls, each one at a time.

    Parameters
    ----------
    count : int
    """

    def __init__(self, count: int) -> None:
        self._calls: queue.SimpleQueue = queue.SimpleQueue()
        self._workers = [_Worker(number, self._calls) for number in range(1, count + 1)]

    def submit(self, function: Callable[..., Any], /, *arguments: Any) -> Future:
        """Have a call done; its future fails with `WorkerDiedError` where the process dies."""
        future: Future = Future()
        self._calls.put((future, function, arguments))
        return future

    def process_ids(self) -> list[int]:
        """Return the ids of the processes that there are now."""
        return [worker.process.pid for worker in self._workers if worker.process is not None]

    def stop(self) -> None:
        """End all processes, whatever they work on; what is half written is removed."""
        for _ in self._workers:
            self._calls.put(None)
        for worker in self._workers:
            worker.hang_up()
        for worker in self._workers:
            worker.join()

    def __enter__(self) -> ProcessPool:
        return self

    def __exit__(self, *error: object) -> None:
        self.stop()


class _Worker:
    """A process, and the thread that talks with it."""

    def __init__(self, number: int, calls: queue.SimpleQueue) -> None:
        self._number, self._calls = number, calls
        self._stopped = False
        self.process: subprocess.Popen | None = None
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def hang_up(self) -> None:
        """Let the process know that nobody asks any more."""
        self._stopped = True
        if self.process is not None:
            with contextlib.suppress(OSError, ValueError):
                self.process.stdin.close()

    def join(self) -> None:
        """Wait for the end of the process."""
        process = self.process
        if process is not None:
            try:
                process.wait(_PATIENCE)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self._thread.join(_PATIENCE)

    def _serve(self) -> None:
        while not self._stopped and (call := self._calls.get()) is not None:
            future, function, arguments = call
            if future.set_running_or_notify_cancel():
                self._do(future, (function, arguments))

    def _do(self, future: Future, call: tuple) -> None:
        try:
            if self.process is None or self.process.poll() is not None:
                self.process = _started()
                if self._stopped:
                    self.hang_up()
            send(self.process.stdin, call)
            returned, result = receive(self.process.stdout)
        except (EOFError, OSError, ValueError, pickle.UnpicklingError) as error:
            future.set_exception(WorkerDiedError(self._end(error)))
            return
        except Exception as error:  # what cannot be pickled
            future.set_exception(error)
            return
        if returned:
            future.set_result(result)
        else:
            future.set_exception(result)

    def _end(self, error: Exception) -> str:
        """Say how the process ended."""
        process, self.process = self.process, None
        if process is None:
            return f"worker {self._number} did not start: {error}"
        with contextlib.suppress(OSError):
            process.stdin.close()
        process.stdout.close()
        try:
            status = process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            status = process.wait()
        how = f"ended with status {status}"
        if status < 0:
            with contextlib.suppress(ValueError):
                how = f"was ended by {signal.Signals(-status).name}"
        return f"worker {self._number} (process {process.pid}) {how}"


def _started() -> subprocess.Popen:
    program = _PROGRAM.format(path=sys.path)
    return subprocess.Popen(
        [sys.executable, "-c", program],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        start_new_session=True,
    )
