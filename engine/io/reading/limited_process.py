"""Runs readers in a separate process with limited memory and time.

In: a reading function, and a `Source`. Out: its result or exception. Libraries that may crash on a
file crash only that process. Memory is limited on Linux alone, and where the system cannot limit
processes, time by the clock. Pillow is restricted to the formats of `images`, whatever library
calls it.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import signal
import subprocess
import sys
from collections.abc import Callable
from types import ModuleType
from typing import TypeVar

from ...base.files.confined_reading import confined_reading, confinement
from ...errors import FileFormatError
from ..formats.images import PILLOW_FORMATS, images_of_one_model
from .linked_files import found_files, tell_found
from .sources import Source

Answer = TypeVar("Answer")
# Memory limit beyond Python's own: a base, which the reader's library needs (trimesh loads SciPy,
# where that is installed), and a multiple of the file's size.
MAX_MEMORY_BASE = 512 << 20
MAX_MEMORY_RATIO = 40
# Seconds of processor time: a base, and for each megabyte of the file.
MAX_SECONDS_BASE = 10
MAX_SECONDS_PER_MEGABYTE = 4
# The limit of wall time is this many times as long, since other work may run.
_PATIENCE = 10
_START = "import pickle, sys; sys.path[:] = pickle.load(sys.stdin.buffer); {}"
_RUN = "from engine3d.io.reading.limited_process import main; main()"


def in_limited_process(
    read: Callable[[Source, bool], Answer], source: Source, split: bool, *, size: int
) -> Answer:
    """Return ``read(source, split)``, called in another process.

    Parameters
    ----------
    read : callable
        A function of a module.
    source : Source
    split : bool
    size : int
        The size in bytes on which limits depend.

    Raises
    ------
    FileFormatError
        The process exceeded a limit, or crashed.
    Engine3DError
        The exception of ``read``.
    """
    if not sys.executable or getattr(sys, "frozen", False):
        raise FileFormatError("needs a Python interpreter of its own, there is none", source.path)
    seconds = MAX_SECONDS_BASE + MAX_SECONDS_PER_MEGABYTE * (size >> 20)
    memory = MAX_MEMORY_BASE + MAX_MEMORY_RATIO * size
    request = (read, _sent(source), confinement(), split, memory, seconds)
    answer, status = _answer(pickle.dumps(sys.path) + pickle.dumps(request), seconds * _PATIENCE)
    if _is_late(status):
        raise FileFormatError(
            f"takes longer than {seconds} seconds, the limit for its size", source.path
        )
    try:
        paths, result = pickle.loads(answer)
    except (pickle.UnpicklingError, EOFError) as error:
        raise FileFormatError(
            f"damaged: the process that read it ended (status {status})", source.path
        ) from error
    tell_found(paths)
    if isinstance(result, MemoryError):
        raise FileFormatError(
            f"needs more than {memory} bytes of memory, the limit for its size", source.path
        )
    if isinstance(result, BaseException):
        raise result
    return result


def _sent(source: Source) -> Source:
    """Return a source that can be pickled: whole, and without what only the caller can answer."""
    defaults = Source._field_defaults
    answered = {name: defaults[name] for name in ("progress", "companion")}
    return source._replace(content=source.data, joints=dict(source.joints), **answered)


def _is_late(status: int | None) -> bool:
    """Return whether a process ended because of its time; Windows has no signal for that."""
    if status is None:
        return True
    return hasattr(signal, "SIGXCPU") and status == -signal.SIGXCPU


def _answer(request: bytes, seconds: float) -> tuple[bytes, int | None]:
    """Return the process's output and exit status; None if it had to be killed."""
    process = subprocess.Popen(
        # Isolated: it imports nothing from the current folder or the environment.
        [sys.executable, "-I", "-c", _START.format(_RUN)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
    )
    try:
        answer, _ = process.communicate(request, timeout=seconds)
        return answer, process.returncode
    except subprocess.TimeoutExpired:
        return b"", None
    finally:
        process.kill()
        process.wait()


def main() -> None:
    """Answer the request on standard input; the process runs this."""
    answer = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # libraries may print
    read, source, confined, split, memory, seconds = pickle.load(sys.stdin.buffer)
    paths: list[str] = []
    try:
        _limit(memory, seconds)
        _limit_pillow()
        with found_files(paths.append), images_of_one_model(), confined_reading(confined):
            result = read(source, split)
        written = pickle.dumps((paths, result), protocol=5)
    except MemoryError:
        written = pickle.dumps((paths, MemoryError()))
    except FileFormatError as error:
        written = pickle.dumps((paths, error))
    with answer:
        answer.write(written)


def _limit(memory: int, seconds: int) -> None:
    """Limit this process to ``memory`` more bytes than it has now, as far as the system can."""
    try:
        import resource
    except ImportError:
        return
    own = _address_space(resource.getpagesize())
    if own is not None:
        _lower(resource, resource.RLIMIT_AS, own + memory)
    _lower(resource, resource.RLIMIT_CPU, seconds)
    _lower(resource, resource.RLIMIT_CORE, 0)


def _address_space(page: int) -> int | None:
    """Return the bytes of address space that this process has; None except on Linux.

    macOS reserves hundreds of gigabytes of it, and refuses limits below that.
    """
    try:
        with open("/proc/self/statm") as file:
            return int(file.read().split()[0]) * page
    except (OSError, ValueError):
        return None


def _lower(resource: ModuleType, what: int, limit: int) -> None:
    """Set a limit, unless a lower one is set or the system refuses it."""
    _, most = resource.getrlimit(what)
    if most == resource.RLIM_INFINITY or limit < most:
        with contextlib.suppress(OSError, ValueError):
            resource.setrlimit(what, (limit, most))


def _limit_pillow() -> None:
    """Remove forbidden formats from Pillow: one of them starts Ghostscript."""
    try:
        from PIL import Image
    except ImportError:
        return
    Image.init()
    Image.ID[:] = PILLOW_FORMATS
    for name in set(Image.OPEN) - set(PILLOW_FORMATS):
        del Image.OPEN[name]
