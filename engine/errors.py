"""The exceptions and the warning of engine3d.

Every exception that the project raises on purpose is an `Engine3DError` and also inherits the
matching built-in, so that both ``except Engine3DError`` and ``except ValueError`` work. The text of
a file error starts with ``FILE:LINE:`` and is one line, ready for the command line.
"""

from __future__ import annotations

import os
import sys
import warnings
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from types import FrameType

__all__ = [
    "BackendError",
    "DisplayError",
    "Engine3DError",
    "Engine3DWarning",
    "FileAccessError",
    "FileFormatError",
    "InvalidArgumentError",
    "MissingOutputError",
    "OutOfMemoryError",
    "PluginError",
    "RendererBusyError",
    "SceneChangedError",
]


class Engine3DError(Exception):
    """Base of all exceptions of engine3d."""


class FileFormatError(Engine3DError, ValueError):
    """The content of a file violates its format.

    Parameters
    ----------
    message : str
        The fault, in one line.
    path : str or path-like, optional
        The file.
    line : int, optional
        Line number, counted from 1, for text formats.

    Attributes
    ----------
    message : str
    path : str or None
    line : int or None
    """

    def __init__(
        self, message: str, path: str | os.PathLike[str] | None = None, line: int | None = None
    ) -> None:
        super().__init__(message)
        self.message = message
        self.path = _name_of(path)
        self.line = line

    def __str__(self) -> str:
        return located(self.message, self.path, self.line)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.message, self.path, self.line)


class FileAccessError(Engine3DError, OSError):
    """A file cannot be opened, read or written.

    Parameters
    ----------
    message : str
        The fault, in one line.
    path : str or path-like, optional
        The file.

    Attributes
    ----------
    message : str
    path : str or None
    """

    def __init__(self, message: str, path: str | os.PathLike[str] | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.path = _name_of(path)

    def __str__(self) -> str:
        return located(self.message, self.path)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.message, self.path)


class InvalidArgumentError(Engine3DError, ValueError):
    """An argument has a wrong type, shape or value."""


class BackendError(Engine3DError, RuntimeError):
    """A backend is unknown, or this machine cannot run it."""


class OutOfMemoryError(Engine3DError, MemoryError):
    """The core could not allocate the memory for a call."""


class DisplayError(Engine3DError, RuntimeError):
    """A window cannot be opened or used."""


class MissingOutputError(Engine3DError, AttributeError):
    """An output was read that the frame was not rendered with."""


class PluginError(Engine3DError, RuntimeError):
    """A package that extends engine3d cannot be imported, or breaks the contract of its group."""


class SceneChangedError(Engine3DError, RuntimeError):
    """Another thread changed a scene's nodes while a frame was drawn."""


class RendererBusyError(Engine3DError, RuntimeError):
    """A renderer was called from within its own frame, or after a fork from within one."""


class Engine3DWarning(UserWarning):
    """Something was omitted or replaced; the rest of the work continued."""


def _name_of(path: Any) -> str | None:
    """Return any path as text; building an error must not raise another."""
    if path is None or isinstance(path, str):
        return path
    return os.fsdecode(path) if isinstance(path, (bytes, os.PathLike)) else str(path)


# Decorators of these packages stand between functions of engine3d; those of matplotlib call it.
_PASSED = ("numpy", "contextlib", "matplotlib", "mpl_toolkits")


def warn(message: str) -> None:
    """Issue an `Engine3DWarning` that points to the calling line outside engine3d."""
    passed, level = {__name__.partition(".")[0], *_PASSED}, 1
    frame: FrameType | None = sys._getframe()
    while frame is not None and frame.f_globals.get("__name__", "").partition(".")[0] in passed:
        level, frame = level + 1, frame.f_back
    warnings.warn(message, Engine3DWarning, stacklevel=level)


def located(message: str, path: str | None, line: int | None = None) -> str:
    """Return ``message`` with its place in front: ``FILE:LINE: message``."""
    if path is None:
        return printable(message)
    path = path or "''"
    place = path if line is None else f"{path}:{line}"
    return printable(f"{place}: {message}")


def printable(text: str) -> str:
    """Return an external name on one line, with control characters escaped."""
    if text.isprintable():
        return text
    # The no-break space steers nothing, though Python counts it with what is not printed.
    shown = (c.isprintable() or c == "\u00a0" for c in text)
    return "".join(
        c if is_shown else c.encode("unicode_escape").decode()
        for c, is_shown in zip(text, shown, strict=True)
    )
