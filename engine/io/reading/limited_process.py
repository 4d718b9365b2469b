"""Reading in a process of its own, which may take so much memory and time and no more.

In: a function that reads, and a `Source`. Out: what it returns or raises. Libraries that cannot be
trusted with a file end with it there. Where the system knows no limits of processes, time alone is
limited. Pillow is allowed the formats of `images` only, whoever calls it.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from types import ModuleType
from typing import TypeVar

from ...errors import FileFormatError
from ..formats.images import PILLOW_FORMATS, images_of_one_model
from .linked_files import found_files, tell_found
from .sources import Source

Answer = TypeVar("Answer")
# A process may take so many bytes besides what Python takes, and so many times the file's.
MAX_MEMORY_BASE = 256 << 20
MAX_MEMORY_RATIO = 40
# Seconds of processor time: for any file, and for each megabyte of it.
MAX_SECONDS_BASE = 10
MAX_SECONDS_PER_MEGABYTE = 4
# By the clock it may take so many times as long, since other work may go on.
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
        The bytes that limits go by.

    Raises
    ------
    FileFormatError
        It took more than it may, or the process ended.
    Engine3DError
        What ``read`` raised.
    """
    if not sys.executable or getattr(sys, "frozen", False):
        raise FileFormatError("needs a Python interpreter of its own, there is none", source.path)
    seconds = MAX_SECONDS_BASE + MAX_SECONDS_PER_MEGABYTE * (size >> 20)
    memory = MAX_MEMORY_BASE + MAX_MEMORY_RATIO * size
    request = (read, source.path, source.data, split, memory, seconds)
    answer, status = _answer(pickle.dumps(sys.path) + pickle.dumps(request), seconds * _PATIENCE)
    if status is None or status == -_signal("SIGXCPU"):
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


def _answer(request: bytes, seconds: float) -> tuple[bytes, int | None]:
    """Return the output of the process, and its exit status; None if it had to be ended."""
    process = subprocess.Popen(
        # Isolated: nothing in the current folder or the environment is imported.
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
    """Answer the request at standard input; what this process runs."""
    answer = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # libraries may print
    read, path, data, split, memory, seconds = pickle.load(sys.stdin.buffer)
    paths: list[str] = []
    try:
        _limit(memory, seconds)
        _limit_pillow()
        with found_files(paths.append), images_of_one_model():
            result = read(Source(path, data), split)
        written = pickle.dumps((paths, result), protocol=5)
    except MemoryError:
        written = pickle.dumps((paths, MemoryError()))
    except FileFormatError as error:
        written = pickle.dumps((paths, error))
    with answer:
        answer.write(written)


def _limit(memory: int, seconds: int) -> None:
    """Limit this process; ``memory`` is what it may take besides what it has now."""
    try:
        import resource
    except ImportError:
        return
    with contextlib.suppress(OSError, ValueError):
        with open("/proc/self/statm") as file:
            memory += int(file.read().split()[0]) * resource.getpagesize()
        _lower(resource, resource.RLIMIT_AS, memory)
    _lower(resource, resource.RLIMIT_CPU, seconds)
    _lower(resource, resource.RLIMIT_CORE, 0)


def _lower(resource: ModuleType, what: int, limit: int) -> None:
    """Set a limit, unless a lower one is set."""
    _, most = resource.getrlimit(what)
    if most == resource.RLIM_INFINITY or limit < most:
        resource.setrlimit(what, (limit, most))


def _limit_pillow() -> None:
    """Forget the formats of Pillow's that may not be opened: one of them starts Ghostscript."""
    try:
        from PIL import Image
    except ImportError:
        return
    Image.init()
    Image.ID[:] = PILLOW_FORMATS
    for name in set(Image.OPEN) - set(PILLOW_FORMATS):
        del Image.OPEN[name]


def _signal(name: str) -> int:
    import signal

    return getattr(signal, name, 0)
