"""What a server for agents allows: a folder, sizes, a time."""

from __future__ import annotations

import contextlib
import os
import signal
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from types import FrameType

from ...base.files.atomic_write import path_below
from ...base.files.confined_reading import Confinement, confined_reading
from ...base.numbers import shown
from ...errors import Engine3DError, FileAccessError, InvalidArgumentError, printable
from .usual_limits import MEGABYTE, MEGABYTES, SECONDS, SIDE, TRIANGLES


class TimeLimitError(Engine3DError):
    """A call took longer than it may."""


@dataclass(frozen=True)
class Limits:
    """What a server allows.

    Attributes
    ----------
    root : str
        The folder that holds all files that are read and written.
    allow_scripts : bool
    seconds : float
        How long a call may take.
    most_bytes : int
        Of each file that is read, those that models name, too.
    most_triangles : int
        Of a scene.
    most_side : int
        Of pictures, in pixels.
    """

    root: str = os.curdir
    allow_scripts: bool = False
    seconds: float = SECONDS
    most_bytes: int = MEGABYTES * MEGABYTE
    most_triangles: int = TRIANGLES
    most_side: int = SIDE

    def __post_init__(self) -> None:
        root = os.path.realpath(self.root)
        if not os.path.isdir(root):
            raise FileAccessError("no such folder", self.root)
        if os.path.dirname(root) == root:
            raise InvalidArgumentError(
                f"the root is {printable(root)}, which holds all files: name a folder with --root"
            )
        object.__setattr__(self, "root", root)

    def path_to_read(self, path: str) -> str:
        """Return the real path of a file in the root that is not too large.

        Raises
        ------
        FileAccessError
            There is none, it is outside, also by a symbolic link, or it is too large.
        """
        real = os.path.realpath(self._joined(path))
        self._refuse_outside(real, path)
        if not os.path.isfile(real):
            raise FileAccessError("no such file in the root folder", path)
        if reason := self._confinement.why_not_of_size(os.path.getsize(real)):
            raise FileAccessError(reason, path)
        return real

    def reading(self) -> contextlib.AbstractContextManager[None]:
        """Let readers open only what is allowed within the block: files that models name, too."""
        return confined_reading(self._confinement)

    @property
    def _confinement(self) -> Confinement:
        return Confinement(self.root, self.most_bytes, "--max-megabytes")

    def path_to_write(self, path: str, overwrite: bool) -> str:
        """Return the path of a file to write in the root, in a folder that exists.

        Raises
        ------
        FileAccessError
            It is outside, also by a symbolic link; there is no such folder; or the file exists
            and must not be overwritten.
        """
        joined = self._joined(path)
        folder = os.path.realpath(os.path.dirname(joined))
        self._refuse_outside(folder, path)
        if not os.path.isdir(folder):
            raise FileAccessError("no such folder in the root folder", path)
        whole = path_below(joined, self.root)
        if os.path.islink(whole) or (os.path.lexists(whole) and not os.path.isfile(whole)):
            raise FileAccessError("cannot write: a link, or no regular file", path)
        if os.path.exists(whole) and not overwrite:
            raise FileAccessError("exists: give overwrite=true to replace it", path)
        return whole

    def shown(self, path: str) -> str:
        """Return a path as agents name it: below the root."""
        return printable(os.path.relpath(path, self.root).replace(os.sep, "/"))

    def with_short_names(self, message: str) -> str:
        """Return a message in which files are named as agents name them: below the root."""
        return message.replace(printable(os.path.join(self.root, "")), "")

    def _joined(self, path: str) -> str:
        if not isinstance(path, str) or not path or "\0" in path:
            raise InvalidArgumentError(f"path must be the name of a file, not {shown(path)}")
        if "://" in path:
            raise FileAccessError("an address: only files in the root folder are read", path)
        return os.path.join(self.root, path)

    def _refuse_outside(self, real: str, path: str) -> None:
        if reason := self._confinement.why_not_at(real):
            raise FileAccessError(reason, path)

    def check_triangles(self, count: int) -> None:
        """Raise an error if a scene would have more triangles than allowed."""
        if count > self.most_triangles:
            raise InvalidArgumentError(
                f"the scene would have {count:,} triangles; the limit is "
                f"{self.most_triangles:,} (--max-triangles)"
            )

    @contextlib.contextmanager
    def in_time(self) -> Iterator[None]:
        """End the block by a `TimeLimitError` when its time is over.

        An alarm of the system does it, which also ends frames between their tiles. Where there is
        none, on Windows and in threads, the block takes its time.
        """
        if not hasattr(signal, "setitimer") or (
            threading.current_thread() is not threading.main_thread()
        ):
            yield
            return
        running = [True]

        def stop(number: int, frame: FrameType | None) -> None:
            if running[0]:
                raise TimeLimitError(f"took longer than {self.seconds:g} s, the limit (--timeout)")

        before = signal.signal(signal.SIGALRM, stop)
        signal.setitimer(signal.ITIMER_REAL, self.seconds, 1.0)  # again, if one is swallowed
        try:
            yield
        finally:
            running[0] = False
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, before)
