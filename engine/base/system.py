"""Functions that systems provide differently: opening, locking, processors, signals, forks.

What a system lacks does nothing here: on Windows a file cannot be opened without waiting, from an
open folder or without following links, no process is forked, and no signal tells that a terminal
was closed.
"""

from __future__ import annotations

import contextlib
import errno
import os
from collections.abc import Callable
from typing import Any

_BINARY = getattr(os, "O_BINARY", 0)  # or else Windows changes the ends of lines
_OWN = getattr(os, "O_CLOEXEC", getattr(os, "O_NOINHERIT", 0))
_TAKEN = (errno.EAGAIN, errno.EACCES, errno.EDEADLK)  # what says that another has locked a file
_NO_SYNC = (errno.EINVAL, errno.ENOSYS, errno.EBADF, errno.EACCES)  # of file systems without it

#: Flags of `os.open`: read bytes, in this process alone.
READ = os.O_RDONLY | _BINARY | _OWN
#: The same to write, and for both.
WRITE = os.O_WRONLY | _BINARY | _OWN
READ_WRITE = os.O_RDWR | _BINARY | _OWN
#: In addition: a FIFO that nobody writes to is not waited for; a link is not followed.
AT_ONCE = getattr(os, "O_NONBLOCK", 0)
NO_LINK = getattr(os, "O_NOFOLLOW", 0)
#: Opens a folder, which need not be readable where the system can do without; 0 where it cannot.
FOLDER = getattr(os, "O_DIRECTORY", 0) and (
    getattr(os, "O_PATH", os.O_RDONLY) | os.O_DIRECTORY | _OWN
)


def usable_processors() -> int:
    """The processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def machine_memory() -> int | None:
    """The bytes of memory that the machine has; None where the system does not tell."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, OSError, ValueError):
        return None


def ending_signals() -> tuple[Any, ...]:
    """The signals by which a system asks a program to end."""
    import signal

    names = ("SIGTERM", "SIGHUP")
    return tuple(getattr(signal, name) for name in names if hasattr(signal, name))


def has_alarm() -> bool:
    """Whether the system can interrupt this process after a while."""
    import signal

    return hasattr(signal, "setitimer") and hasattr(signal, "SIGALRM")


def kill_group(process: int) -> None:
    """End a process that leads a group, and where the system has groups, all of its group."""
    import signal

    with contextlib.suppress(OSError):
        if hasattr(os, "killpg"):
            os.killpg(process, signal.SIGKILL)
        else:
            os.kill(process, signal.SIGTERM)  # which Windows knows as the end at once


def after_fork(function: Callable[[], object]) -> None:
    """Call a function in every process that is forked from this one."""
    if hasattr(os, "register_at_fork"):
        os.register_at_fork(after_in_child=function)


def locked(handle: int) -> bool:
    """Lock an open file until it is closed; tell whether no other process has locked it.

    Where a file system has no locks, as some on networks, nobody has.
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


def sync_folder(path: str | None) -> None:
    """See that the names in a folder are on the disk, where the system can say so."""
    if path is None or not hasattr(os, "O_DIRECTORY"):
        return
    try:
        handle = os.open(path or os.curdir, os.O_RDONLY | os.O_DIRECTORY | _OWN)
    except OSError:
        return  # a folder that may be written to, but not read
    try:
        os.fsync(handle)
    except OSError as error:
        if error.errno not in _NO_SYNC:
            raise
    finally:
        os.close(handle)


def set_mode(handle: int, path: str, mode: int) -> None:
    """Set who may read and write an open file, whose path this is."""
    if hasattr(os, "fchmod"):
        os.fchmod(handle, mode)
    else:
        os.chmod(path, mode)
