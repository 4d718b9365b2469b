"""Saves copies of unsaved work, in case of a crash.

In: a document, from time to time. Out: a copy of its scene in the user's cache folder, at most a
minute old, which the next editor finds after a crash. A copy belongs to the process that locks it;
the system releases the lock when the process ends.
"""

from __future__ import annotations

import contextlib
import json
import os
import time
from pathlib import Path

from ...base.files import json_records
from ...base.files.atomic_write import LEFT_BEHIND, atomic_write
from ...base.language import translated
from ...base.system import NO_LINK, READ_WRITE, locked
from ...errors import FileAccessError, FileFormatError, warn
from ...io.writing.scene_saving import scene_text
from ..desktop.user_folders import user_path
from .document import SceneDocument
from .recovery import ROOT, Recovery

#: Seconds between copies of a scene that keeps changing.
PERIOD = 30.0
_HEAD = json_records.members(
    {
        "autosave": json_records.members(
            {
                "document": json_records.anything,  # without it the scene is still complete
                "time": json_records.time_of_day,
            }
        )
    }
)
_LONGEST_LINE = 1 << 16  # bytes


class Autosave:
    """Copies of one document; the first at once if it is unsaved, as after a recovery.

    Parameters
    ----------
    document : SceneDocument
    folder : path-like, optional
        The user's own if left out.
    """

    def __init__(self, document: SceneDocument, folder: str | os.PathLike | None = None) -> None:
        self._document = document
        self._folder = _folder() if folder is None else Path(folder)
        self._lock: int | None = None
        self._path: Path | None = None
        self._version = document.history.version
        self._changed_since: float | None = None
        if not document.history.is_saved:
            self.save()

    def tick(self, now: float | None = None) -> bool:
        """Make a copy if one is due; return whether one was made. Call this often.

        Parameters
        ----------
        now : float, optional
            Seconds of ``time.monotonic()``.
        """
        now = time.monotonic() if now is None else now
        history = self._document.history
        if history.is_saved:
            self.discard()
            return False
        if history.version == self._version:
            return False
        if self._changed_since is None:
            self._changed_since = now
        if now - self._changed_since < PERIOD:
            return False
        return self.save()

    def save(self) -> bool:
        """Make a copy now; warn on the console if that fails."""
        document = self._document
        self._version, self._changed_since = document.history.version, None
        try:
            path = self._owned_path()
            content, _ = scene_text(document.scene, ROOT, document.resources.kept_materials)
            saying = {"document": document.path, "time": time.time()}
            with atomic_write(path, below=self._folder) as file:
                file.write(b'{"autosave": ' + json.dumps(saying).encode("ascii") + b",\n")
                file.write(content.removeprefix(b"{\n"))
        except (OSError, FileAccessError) as error:
            said = translated("no copy was made in case of a crash: {reason}", reason=error)
            document.console.write("warning", said)
            return False
        return True

    def discard(self) -> None:
        """Remove the copy, once its content is saved or not wanted."""
        self._version, self._changed_since = self._document.history.version, None
        if self._path is not None:
            _remove(self._path)
        if self._lock is not None:
            os.close(self._lock)
        if self._path is not None:
            _remove(self._path)  # Windows keeps a lock that is open
        self._path = self._lock = None

    def _owned_path(self) -> Path:
        """Return the path of the copy, which this process owns from now on."""
        if self._path is None:
            self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            path = self._folder / f"{os.urandom(8).hex()}.e3d.json"
            flags = READ_WRITE | os.O_CREAT | NO_LINK
            self._lock = os.open(_lock_of(path), flags, 0o600)
            if not locked(self._lock):
                raise OSError("another process has locked a name drawn at random")
            os.close(os.open(path, flags, 0o600))  # private from the start
            self._path = path
        return self._path


def left_behind(folder: str | os.PathLike | None = None) -> tuple[Recovery, ...]:
    """Return the copies of editors that crashed, latest first.

    Partial files of such editors are removed.
    """
    place = _folder() if folder is None else Path(folder)
    _remove_half_written(place)
    found = []
    for path in sorted(place.glob("*.e3d.json")):
        saying = None if _is_locked(path) else _saying(path)
        if saying is not None:
            found.append(Recovery(str(path), *saying))
    return tuple(sorted(found, key=lambda copy: -copy.time))


def _remove_half_written(place: Path) -> None:
    """Remove partial files of editors that are gone, as their locks show."""
    for path in place.glob(".*.part"):
        match = LEFT_BEHIND.fullmatch(path.name)
        if match is not None and not _is_locked(place / match["name"]):
            with contextlib.suppress(OSError):
                path.unlink()


def forget(copy: Recovery) -> None:
    """Remove a copy left behind by a crash."""
    _remove(Path(copy.path))


def _folder() -> Path:
    return user_path("cache", "unsaved")


def _lock_of(path: Path) -> Path:
    return path.with_suffix(".lock")


def _is_locked(path: Path) -> bool:
    """Return whether a live process owns a copy."""
    try:
        handle = os.open(_lock_of(path), READ_WRITE)
    except OSError:
        return False
    try:
        return not locked(handle)
    finally:
        os.close(handle)


def _saying(path: Path) -> tuple[str | None, float] | None:
    """Return a copy's first line: its document, and its time.

    Return None, with a warning, for an unreadable copy.
    """
    try:
        line = json_records.start_of(path, _LONGEST_LINE).partition(b"\n")[0]
        head = json_records.parsed(line.removesuffix(b",") + b"}", str(path), _HEAD)["autosave"]
    except (FileAccessError, FileFormatError) as error:
        warn(f"{error}: this copy of what was not saved is passed over")
        return None
    document = head["document"]
    return document if json_records.path_text(document) is None else None, float(head["time"])


def _remove(path: Path) -> None:
    for each in (path, _lock_of(path)):
        with contextlib.suppress(OSError):
            each.unlink()
