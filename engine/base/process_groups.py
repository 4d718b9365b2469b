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
from typing import Any


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
        else:
            options["start_new_session"] = True
        super().__init__(command, **options)
        if sys.platform == "win32":
            self._job = _Job(int(self._handle))

    def kill_group(self) -> None:
        """End the process, and what it has started."""
        with contextlib.suppress(OSError):
            if sys.platform == "win32":
                self._job.end()
                self.kill()  # where it could not be put into the job
            else:
                os.killpg(self.pid, signal.SIGKILL)


if sys.platform == "win32":
    import ctypes
    from ctypes import wintypes

    class _Job:
        """A job object of Windows with a process in it, whose children will belong to it, too."""

        def __init__(self, process: int) -> None:
            self._kernel = ctypes.WinDLL("kernel32", use_last_error=True)
            self._kernel.CreateJobObjectW.restype = wintypes.HANDLE
            self._handle = wintypes.HANDLE(self._kernel.CreateJobObjectW(None, None))
            self._kernel.AssignProcessToJobObject(self._handle, wintypes.HANDLE(process))

        def end(self) -> None:
            self._kernel.TerminateJobObject(self._handle, wintypes.UINT(signal.SIGTERM))

        def __del__(self) -> None:
            self._kernel.CloseHandle(self._handle)
