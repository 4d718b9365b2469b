"""The command line: ``engine3d run``, ``render``, ``info``, ``convert``, ``learn`` …

In: arguments. Out: an exit status: 0, 1 after an error (one line on standard error that names the
file and the line), 2 after wrong usage. One file per command; a command's module, and with it NumPy
and the core, loads only when it runs.
"""

from __future__ import annotations

import argparse
import contextlib
import gc
import os
import sys
from collections.abc import Callable

from .said import say
from .usage import UsageError

INTERRUPTED = 130
#: Exit status of an interrupted program: this plus the signal's number, as in shells.
ENDED_BY_SIGNAL = 128
#: What Python's streams do by default about letters that they cannot encode: they raise.
_RAISING = ("strict", "surrogateescape")


def main(argv: list[str] | None = None, begin: Callable[[], None] | None = None) -> int:
    """Run one command.

    Parameters
    ----------
    argv : list of str, optional
        The arguments without the program's name; those of the process by default.
    begin : callable, optional
        Called when everything that the command needs is imported, before it runs.

    Returns
    -------
    int
        The exit status.
    """
    # NumPy's linear algebra, which is not used here, would start a thread for each CPU.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    _replace_closed_streams()
    _escape_missing_letters()
    return _run(sys.argv[1:] if argv is None else argv, begin)


def _replace_closed_streams() -> None:
    """Redirect closed streams (``>&-``) to nowhere; otherwise the next file would replace them."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w"))  # noqa: SIM115


def _escape_missing_letters() -> None:
    """Print letters that a stream's encoding lacks as ``\\xb2``, as Python's standard error does.

    Redirected output has the code page of Windows, which may lack letters of the help. A handler
    that the user names, as in ``PYTHONIOENCODING=:replace``, stands.
    """
    for stream in (sys.stdout, sys.stderr):
        if getattr(stream, "errors", None) in _RAISING and hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")


def _run(arguments: list[str], begin: Callable[[], None] | None) -> int:
    """Run a command, and print every foreseen exception as one line."""
    from ...base.system import is_unread
    from ...errors import Engine3DError
    from .plugin_switch import plugins_as_asked

    try:
        with _short_warnings(), _ended_politely(), plugins_as_asked(arguments):
            status = _obey(arguments, begin)
            sys.stdout.flush()
        return status
    except KeyboardInterrupt:
        return INTERRUPTED
    except _Ended as ended:
        return ENDED_BY_SIGNAL + ended.number
    except (Engine3DError, OSError) as error:
        if isinstance(error, OSError) and is_unread(error):
            # The reader of our output has closed it.
            _leave_standard_output()
            return 1
        if not _can_flush():
            _leave_standard_output()
        return _fail(_one_line(error))
    except MemoryError:
        return _fail("out of memory")
    except ImportError as error:
        # the system's message about a library that does not fit into memory
        if "failed to map" not in str(error):
            raise
        return _fail("out of memory")


def _obey(arguments: list[str], begin: Callable[[], None] | None) -> int:
    """Parse the arguments, run the command, and return its exit status."""
    from ...errors import InvalidArgumentError
    from .parser import parse
    from .quietness import set_quiet

    try:
        args = parse(arguments)
        if getattr(args, "verbose", False) and args.quiet:
            raise UsageError("--verbose does not go with --quiet")
        set_quiet(getattr(args, "quiet", False))
        command = _load(args)
        if begin is not None:
            begin()
        return command(args)
    except UsageError as error:
        return _usage(str(error))
    except InvalidArgumentError as error:
        from ...stage.viewed_scene import NotInModelError

        if isinstance(error, NotInModelError):
            return _usage(str(error))
        raise
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else 1


class _Ended(BaseException):
    """Raised when a signal asks the program to end."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


@contextlib.contextmanager
def _ended_politely():
    """Turn SIGTERM and SIGHUP into exceptions, so that partial files are removed."""
    import signal
    import threading

    from ...base.system import ending_signals

    def end(number, frame):
        raise _Ended(number)

    numbers = ending_signals()
    if threading.current_thread() is not threading.main_thread():
        numbers = ()
    changed = [number for number in numbers if signal.getsignal(number) is signal.SIG_DFL]
    try:
        for number in changed:
            signal.signal(number, end)
        yield
    finally:
        for number in changed:
            signal.signal(number, signal.SIG_DFL)


def _can_flush() -> bool:
    try:
        sys.stdout.flush()
    except OSError:
        return False
    return True


def _leave_standard_output() -> None:
    """Prevent Python's error when it flushes unwritable output at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _load(args: argparse.Namespace):
    """Import the command without garbage collection, since imported objects stay."""
    if "numpy" in sys.modules:
        return args.load_command()
    gc.disable()
    try:
        return args.load_command()
    finally:
        gc.freeze()
        gc.enable()


def _one_line(error: Exception) -> str:
    text = str(error)
    if isinstance(error, OSError) and error.strerror:
        place = "" if error.filename is None else f"{os.fsdecode(error.filename)}: "
        text = place + error.strerror
    return text or type(error).__name__


def _fail(message: str) -> int:
    say(f"error: {message}")
    return 1


def _usage(message: str) -> int:
    say(f"error: {message}")
    return 2


class _short_warnings:
    """Print warnings of engine3d as one line on standard error within the block."""

    def __enter__(self):
        import warnings

        from ...errors import Engine3DWarning

        self._catcher = warnings.catch_warnings()
        self._catcher.__enter__()
        warnings.simplefilter("always", Engine3DWarning)
        # A Python without the lock takes it back for engine3d: the user has nothing to do.
        warnings.filterwarnings("ignore", "The global interpreter lock", RuntimeWarning)
        warnings.showwarning = _show_warning

    def __exit__(self, *exception):
        self._catcher.__exit__(*exception)


def _show_warning(message, category, filename, lineno, file=None, line=None) -> None:
    from .quietness import remark

    remark(f"warning: {message}")
