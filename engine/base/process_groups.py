"""Processes that end together with what they have started.

In: a command. Out: its process, at the head of a group of its own, which Ctrl-C in the terminal
spares. On Windows the group is a job object, which outlives the process.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Mapping
from typing import Any

from ..errors import warn


class LeadingProcess(subprocess.Popen[bytes]):
    """A process that leads a group.

    Parameters
    ----------
    command : list of str
    **options
        As of `subprocess.Popen`.
    """

    def __init__(self, command: list[str], **options: Any) -> None:
        if sys.platform == "win32":
            options["creationflags"] = subprocess.CREATE_NEW_PROCESS_GROUP
            command, options["env"] = without_launcher(command, options.get("env"))
        else:
            options["start_new_session"] = True
        super().__init__(command, **options)
        if sys.platform == "win32":
            self._job = _Job(int(self._handle))
            if not self._job.is_led and self.poll() is None:
                warn("Windows puts a process into no job: what it starts may outlive it")

    def kill_group(self) -> None:
        """End the process, and what it has started."""
        with contextlib.suppress(OSError):
            if sys.platform == "win32":
                self._job.end()
                self.kill()  # where it could not be put into the job
            else:
                os.killpg(self.pid, signal.SIGKILL)


def without_launcher(
    command: list[str], environment: Mapping[str, str] | None
) -> tuple[list[str], Mapping[str, str] | None]:
    """Return a command, and its environment, that starts Python itself on Windows.

    In a virtual environment, ``sys.executable`` is a launcher: Python is its child, which it may
    start before it is put into a job, and whose own children leave the launcher's job. The variable
    tells Python where the virtual environment is, as it does for `multiprocessing`.
    """
    python = getattr(sys, "_base_executable", sys.executable)
    if command[0] != sys.executable or python == sys.executable:
        return command, environment
    known = os.environ if environment is None else environment
    return [python, *command[1:]], {**known, "__PYVENV_LAUNCHER__": sys.executable}


class _Job:
    """A job object of Windows with a process in it, whose children will belong to it, too.

    What the process starts before it is put into the job stays outside: Python has hardly begun
    then. `subprocess` can start no process that waits for this.

    Attributes
    ----------
    is_led : bool
        Whether Windows put the process into the job.
    """

    def __init__(self, process: int) -> None:
        import ctypes
        from ctypes import wintypes

        self._kernel = ctypes.WinDLL("kernel32", use_last_error=True)  # type: ignore[attr-defined]
        self._kernel.CreateJobObjectW.restype = wintypes.HANDLE
        for function in ("AssignProcessToJobObject", "TerminateJobObject", "CloseHandle"):
            getattr(self._kernel, function).restype = wintypes.BOOL
        self._handle = wintypes.HANDLE(self._kernel.CreateJobObjectW(None, None))
        self.is_led = bool(
            self._handle.value
            and self._kernel.AssignProcessToJobObject(self._handle, wintypes.HANDLE(process))
        )

    def end(self) -> None:
        """End what is in the job."""
        import ctypes

        if self.is_led:
            self._kernel.TerminateJobObject(self._handle, ctypes.c_uint(signal.SIGTERM))

    def __del__(self) -> None:
        if self._handle.value:
            self._kernel.CloseHandle(self._handle)
