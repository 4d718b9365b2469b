"""A process pool that survives the death of its processes.

In: calls of importable functions. Out: futures, as from executors of `concurrent.futures`. If a
process dies, its call fails with an error that names it, and a new process replaces it; a process
that exceeds the time limit is killed. Processes do not run the caller's main program, so it needs
no guard; they are outside the terminal's group, so Ctrl-C reaches only the pool, which ends them.
"""

from __future__ import annotations

import contextlib
import pickle
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

from ...base.process_groups import LeadingProcess
from ...base.side_by_side import Thread
from ...errors import OutOfMemoryError
from .worker import BEGUN, receive, send

_PROGRAM = (
    "import sys; sys.path[:] = {path!r}; from engine3d.apps.batch.worker import main; main({idle})"
)
_PATIENCE = 5.0  # seconds that processes get to end when asked to, together


class WorkerDiedError(RuntimeError):
    """A process died during a call."""


class TimeLimitError(RuntimeError):
    """A process was killed because its call took too long.

    Parameters
    ----------
    seconds : float
        The limit.
    """

    def __init__(self, seconds: float) -> None:
        super().__init__(seconds)
        self.seconds = seconds

    def __str__(self) -> str:
        return f"it took more than {self.seconds:g} s, and was ended"


class ProcessPool:
    """Processes that run calls, one at a time each.

    Parameters
    ----------
    count : int
    limit : float, optional
        Seconds that a call may take, from when its process has begun with it.
    idle : float, optional
        Seconds after which a process ends that nobody asks anything; the next call starts another.
    """

    def __init__(self, count: int, limit: float | None = None, idle: float | None = None) -> None:
        self._calls: queue.SimpleQueue = queue.SimpleQueue()
        numbers = range(1, count + 1)
        self._workers = [_Worker(number, self._calls, limit, idle) for number in numbers]

    def submit(self, function: Callable[..., Any], /, *arguments: Any) -> Future:
        """Submit a call.

        Its future fails with `WorkerDiedError` if the process dies, and with `TimeLimitError` if it
        was killed.
        """
        future: Future = Future()
        self._calls.put((future, function, arguments))
        return future

    def process_ids(self) -> list[int]:
        """Return the IDs of the current processes."""
        return [worker.process.pid for worker in self._workers if worker.process is not None]

    def stop(self) -> None:
        """Kill all processes at any point of their work; partial files are removed."""
        for _ in self._workers:
            self._calls.put(None)
        for worker in self._workers:
            worker.hang_up()
        deadline = time.monotonic() + _PATIENCE
        for worker in self._workers:
            worker.join(deadline)

    def __enter__(self) -> ProcessPool:
        return self

    def __exit__(self, *error: object) -> None:
        self.stop()


class _Worker:
    """A process, and the thread that communicates with it."""

    def __init__(
        self, number: int, calls: queue.SimpleQueue, limit: float | None, idle: float | None
    ) -> None:
        self._number, self._calls = number, calls
        self._limit, self._idle = limit, idle
        self._stopped = False
        self.process: LeadingProcess | None = None
        self._thread = Thread(target=self._serve, daemon=True)
        self._thread.start()

    def hang_up(self) -> None:
        """Signal the process that no more calls come."""
        self._stopped = True
        if self.process is not None:
            with contextlib.suppress(OSError, ValueError):
                self.process.stdin.close()

    def join(self, deadline: float) -> None:
        """Wait for the process to end, until a time of the monotonic clock, and kill it then."""
        process = self.process
        if process is not None:
            try:
                process.wait(max(deadline - time.monotonic(), 0.0))
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
            returned, result = self._result(self._asked(call))
        except TimeLimitError as error:
            self._end(error)
            future.set_exception(error)
            return
        except (EOFError, OSError, ValueError, pickle.UnpicklingError, OutOfMemoryError) as error:
            future.set_exception(WorkerDiedError(self._end(error)))
            return
        except Exception as error:  # the result cannot be pickled
            future.set_exception(error)
            return
        if returned:
            future.set_result(result)
        else:
            future.set_exception(result)

    def _asked(self, call: tuple, again: bool = True) -> LeadingProcess:
        """Return the process after it has started a call."""
        if self.process is None or self.process.poll() is not None:
            self.process = _started(self._idle)
            if self._stopped:
                self.hang_up()
        try:
            send(self.process.stdin, call)
            begun = receive(self.process.stdout)
        except (EOFError, OSError) as error:
            if self._idle is None or not again:
                raise
            self._end(error)  # its idle time was over, and it was about to end
            return self._asked(call, again=False)
        assert begun == BEGUN
        return self.process

    def _result(self, process: LeadingProcess) -> tuple[bool, Any]:
        """Return the process's result; kill the process if that takes too long."""
        if self._limit is None:
            return receive(process.stdout)
        has_answered, is_over = threading.Event(), threading.Event()

        def end() -> None:
            if not has_answered.wait(self._limit):
                is_over.set()
                process.kill_group()

        timer = Thread(target=end, daemon=True)
        timer.start()
        try:
            return receive(process.stdout)
        finally:
            has_answered.set()
            timer.join()
            if is_over.is_set():
                raise TimeLimitError(self._limit)

    def _end(self, error: Exception) -> str:
        """Return the error for how the process ended."""
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


def _started(idle: float | None) -> LeadingProcess:
    program = _PROGRAM.format(path=sys.path, idle=idle)
    command = [sys.executable, "-c", program]
    return LeadingProcess(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
