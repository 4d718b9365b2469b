"""System functions that differ between platforms: opening, locking, processors, signals, forks.

Features that a system lacks do nothing here: Windows cannot open a file without waiting, relative
to an open folder or without following links; it does not fork, and no signal reports a closed
terminal.
"""

from __future__ import annotations

import contextlib
import errno
import os
import sys
import time
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import queue

_BINARY = getattr(os, "O_BINARY", 0)  # prevents Windows from changing line ends
_OWN = getattr(os, "O_CLOEXEC", getattr(os, "O_NOINHERIT", 0))
# errors that mean the file is already locked; 0 is that of wine
_TAKEN = (errno.EAGAIN, errno.EACCES, errno.EDEADLK, 0)
# errors of file systems that cannot sync
_NO_SYNC = (errno.EINVAL, errno.ENOSYS, errno.EBADF, errno.EACCES)
# errors of a pipe that nobody reads; Windows tells the second one
_UNREAD = (errno.EPIPE, errno.EINVAL) if os.name == "nt" else (errno.EPIPE,)
_SHORT = 0.5  # seconds
_LONGEST_ANSWER = 5.0  # seconds
# Seconds to try again where Windows refuses to replace a file: another program, such as a scanner
# of viruses, may have it open for a moment.
_MOMENT = 1.0 if os.name == "nt" else 0.0

#: Flags of `os.open`: read bytes, and do not pass the handle to child processes.
READ = os.O_RDONLY | _BINARY | _OWN
#: The same for writing, and for both.
WRITE = os.O_WRONLY | _BINARY | _OWN
READ_WRITE = os.O_RDWR | _BINARY | _OWN
#: Additional flags: do not wait for a FIFO's writer; do not follow a link.
AT_ONCE = getattr(os, "O_NONBLOCK", 0)
NO_LINK = getattr(os, "O_NOFOLLOW", 0)
#: Opens a folder, without the right to read it if the system allows that; 0 if unsupported.
FOLDER = getattr(os, "O_DIRECTORY", 0) and (
    getattr(os, "O_PATH", os.O_RDONLY) | os.O_DIRECTORY | _OWN
)


def decoded_name(name: bytes) -> str:
    """Return a file name of any bytes; `os.fsdecode` of Windows fails where they are no UTF-8."""
    try:
        return os.fsdecode(name)
    except UnicodeDecodeError:
        return name.decode("utf-8", "surrogateescape")


def usable_processors() -> int:
    """Return the processors that this process may use: the threads that the core takes for 0.

    Its affinity and a container's quota may leave it fewer than the machine has.
    """
    from .._native.rasterizer import thread_count

    return thread_count()


def machine_memory() -> int | None:
    """Return the machine's memory in bytes; None if the system does not tell."""
    if sys.platform == "win32":
        return _memory_of_windows()
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, OSError, ValueError):
        return None


def _memory_of_windows() -> int | None:
    import ctypes

    class Status(ctypes.Structure):  # MEMORYSTATUSEX
        _fields_ = (
            ("size", ctypes.c_uint32),
            ("percent_used", ctypes.c_uint32),
            ("memory", ctypes.c_uint64),
            ("others", ctypes.c_uint64 * 6),
        )

    status = Status(size=ctypes.sizeof(Status))
    kernel = ctypes.WinDLL("kernel32")  # type: ignore[attr-defined]
    return status.memory if kernel.GlobalMemoryStatusEx(ctypes.byref(status)) else None


def answer_of(*command: str) -> str:
    """Return what a short program of the system prints; nothing if it fails or is not there."""
    import subprocess

    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=_LONGEST_ANSWER)
    except (OSError, subprocess.SubprocessError, UnicodeDecodeError):
        return ""
    return done.stdout.strip() if done.returncode == 0 else ""


def ending_signals() -> tuple[Any, ...]:
    """Return the signals by which the system asks a program to end."""
    import signal

    # The last one is that of Ctrl-Break. When a console closes Windows sends it too, but ends the
    # process as soon as Python has noted it, before a handler runs.
    names = ("SIGTERM", "SIGHUP", "SIGBREAK")
    return tuple(getattr(signal, name) for name in names if hasattr(signal, name))


def has_alarm() -> bool:
    """Return whether the system can interrupt this process after a time."""
    import signal

    return hasattr(signal, "setitimer") and hasattr(signal, "SIGALRM")


def can_forbid_files() -> bool:
    """Return whether `opening_no_files` has an effect on this system."""
    return os.name == "posix"


@contextlib.contextmanager
def opening_no_files() -> Iterator[None]:
    """Let no library open a file within the block; files that are open stay so."""
    if not can_forbid_files():
        yield
        return
    import resource

    fewest, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (0, most))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, (fewest, most))


def next_in(waiting: queue.SimpleQueue[Any]) -> Any:
    """Wait for the next item of a queue; on Windows, Ctrl-C interrupts only short waits."""
    import queue

    while True:
        with contextlib.suppress(queue.Empty):
            return waiting.get(timeout=_SHORT)


def after_fork(function: Callable[[], object]) -> None:
    """Call a function in every process forked from this one."""
    if hasattr(os, "register_at_fork"):
        os.register_at_fork(after_in_child=function)


def is_unread(error: OSError) -> bool:
    """Return whether an error of writing means that nobody reads the other end of the pipe."""
    # One that a program raises may have no number.
    is_one = isinstance(error, BrokenPipeError) or error.errno in _UNREAD
    # Errors of files name them, such as one of a path that is invalid.
    return is_one and error.filename is None


def locked(handle: int) -> bool:
    """Lock an open file until it is closed; return whether the lock was obtained.

    On file systems without locks, such as some on networks, it always succeeds.
    """
    try:
        _lock(handle)
    except OSError as error:
        return error.errno not in _TAKEN
    return True


def _lock(handle: int) -> None:
    try:
        import fcntl
    except ImportError:
        import msvcrt

        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined]
    else:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)


def sync_file(handle: int) -> None:
    """Sync an open file to the disk, through the cache of the disk itself.

    `os.fsync` of macOS leaves the bytes in that cache, which a power cut empties.
    """
    try:
        import fcntl

        fcntl.fcntl(handle, fcntl.F_FULLFSYNC)  # type: ignore[attr-defined]
    except (ImportError, AttributeError, OSError):  # no such call, or a disk without it
        os.fsync(handle)


def sync_folder(path: str | None) -> None:
    """Sync the names in a folder to the disk, if the system supports it."""
    if path is None or not hasattr(os, "O_DIRECTORY"):
        return
    try:
        handle = os.open(path or os.curdir, os.O_RDONLY | os.O_DIRECTORY | _OWN)
    except OSError:
        return  # a folder that is writable but not readable
    try:
        sync_file(handle)
    except OSError as error:
        if error.errno not in _NO_SYNC:
            raise
    finally:
        os.close(handle)


def replace_file(path: str, target: str) -> None:
    """Rename a file to another's name; on Windows, wait a moment for those that read the other."""
    deadline = time.monotonic() + _MOMENT
    while True:
        try:
            return os.replace(path, target)
        except PermissionError:
            if time.monotonic() >= deadline:
                raise
        time.sleep(0.01)


def set_mode(handle: int, path: str, mode: int) -> None:
    """Set the permissions of an open file, whose path this is."""
    if hasattr(os, "fchmod"):
        os.fchmod(handle, mode)
    else:
        os.chmod(path, mode)
