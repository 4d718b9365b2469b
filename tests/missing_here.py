"""What some systems lack: tests that use it skip, and say so."""

import contextlib
import os
import signal
import subprocess
import sys
import tempfile

import pytest

# What ends a process at once, and how a pool tells that. Windows has no signals between processes.
KILL = getattr(signal, "SIGKILL", signal.SIGTERM)
KILLED = "was ended by SIGKILL" if hasattr(signal, "SIGKILL") else f"ended with status {KILL:d}"

# How a program is started that another process may stop as Ctrl-C does, and with what status that
# ends it: Windows has Ctrl-Break for that, which reaches a group.
STOPPABLE = {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP} if os.name == "nt" else {}
STOPPED = 128 + (signal.SIGBREAK if os.name == "nt" else signal.SIGINT)

needs_full_device = pytest.mark.skipif(
    os.name == "nt" or not os.path.exists("/dev/full"), reason="there is no /dev/full"
)

# Elsewhere SDL itself asks for one.
needs_no_screen = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="only Linux tells of a screen before a window"
)
needs_compiler = pytest.mark.skipif(
    os.name == "nt", reason="no compiler of Windows has built it: its wheels are built on Linux"
)


def skip_where_files_cannot_be_made():
    """Let `os.symlink` and `os.mkfifo` skip the test where there are no such files.

    Windows has no FIFOs, and makes links for those with the right to it; wine makes none.
    """
    if not _makes_links():
        os.symlink = _skipping("symbolic links")
    if not hasattr(os, "mkfifo"):
        os.mkfifo = _skipping("FIFOs")


def _makes_links():
    with tempfile.TemporaryDirectory() as folder:
        link = os.path.join(folder, "link")
        with contextlib.suppress(OSError):
            os.symlink(folder, link)
        return os.path.islink(link)


class _NoSuchFile(pytest.skip.Exception, OSError):
    """Skips a test; what is caught as an error by pytest, which makes links for convenience."""


def _skipping(what):
    def skip(*_arguments, **_options):
        raise _NoSuchFile(f"{what} cannot be made here")

    return skip


def interrupt():
    """Press Ctrl-C, as far as this process can tell; `os.kill` would end it on Windows."""
    if os.name == "nt":
        signal.raise_signal(signal.SIGINT)
    else:
        os.kill(os.getpid(), signal.SIGINT)


def stop(process):
    """Stop a process that is `STOPPABLE`; without a console of Windows, skip the test."""
    if os.name != "nt":
        process.send_signal(signal.SIGINT)
    elif _has_console():
        process.send_signal(signal.CTRL_BREAK_EVENT)
    else:
        process.kill()
        process.wait()
        pytest.skip("Ctrl-Break needs a console")


def _has_console():
    import ctypes

    return ctypes.WinDLL("kernel32").GetConsoleProcessList((ctypes.c_uint32 * 1)(), 1) > 0


def open_files():
    """Return the handles that this process has open; none where the system does not tell.

    Wine shows those of the system below, which come and go as it likes.
    """
    if os.name == "nt" or not os.path.isdir("/proc/self/fd"):
        return []
    return os.listdir("/proc/self/fd")


def is_superuser():
    """Return whether nothing is forbidden to this process; Windows asks for each file instead."""
    return hasattr(os, "geteuid") and os.geteuid() == 0


def peak_memory():
    """Return the most bytes that this process has used, 0 on Windows, where none of it is asked."""
    try:
        import resource
    except ImportError:
        return 0
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss << 10


def is_running(process):
    """Return whether there is such a process; what is dead, and nobody has asked for, is none."""
    if os.name == "nt":
        return _is_running_on_windows(process)
    with contextlib.suppress(OSError), open(f"/proc/{process}/stat") as file:
        return file.read().rpartition(")")[2].split()[0] not in "ZX"
    return False


def _is_running_on_windows(process):
    import ctypes

    synchronize, timed_out = 0x100000, 0x102
    kernel = ctypes.WinDLL("kernel32")
    handle = kernel.OpenProcess(synchronize, False, process)
    if not handle:
        return False
    state = kernel.WaitForSingleObject(handle, 0)
    kernel.CloseHandle(handle)
    return state == timed_out
