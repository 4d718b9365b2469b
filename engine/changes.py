"""Which of many things changed, without looking at all of them.

Meshes, sets of instances, materials, textures, cameras and lights count what is assigned to them in
``version``, and then tell here that they did. In: such things. Out: those of a `Watch` whose
version is another than when it last looked. Only the latest changes are remembered: whoever looks
less often looks at everything.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Iterable

_REMEMBERED = 1024

_lock = threading.Lock()
_changed: list[int] = []  # ids of what changed last, in order
_told = 0  # how often anything changed


def tell(thing) -> None:
    """Say that the version of a thing has grown."""
    global _told
    with _lock:
        _changed.append(id(thing))
        _told += 1
        if len(_changed) > 2 * _REMEMBERED:
            del _changed[:_REMEMBERED]


def _since(moment: int) -> tuple[set[int] | None, int]:
    """Ids of what changed since a moment, None if that is forgotten; and the moment now."""
    with _lock:
        first = _told - len(_changed)
        return None if moment < first else set(_changed[moment - first :]), _told


def _forget() -> None:
    """In a process that was forked, perhaps from the middle of a change."""
    global _lock, _told
    _lock = threading.Lock()
    _told += 2 * _REMEMBERED
    _changed.clear()


os.register_at_fork(after_in_child=_forget)


class Watch:
    """Things, and which version of each was seen."""

    def __init__(self, things: Iterable = ()) -> None:
        self._seen: dict[int, tuple[object, int]] = {}
        self._moment = _since(0)[1]
        for thing in things:
            self.add(thing)

    def add(self, thing) -> None:
        """Look at a thing from now on."""
        self._seen[id(thing)] = thing, thing.version

    def remove(self, thing) -> None:
        """Look at a thing no longer, if it was looked at."""
        self._seen.pop(id(thing), None)

    def changed(self) -> list:
        """Return the things whose version is another than when they were last looked at."""
        if self._moment == _told:
            return []
        ids, self._moment = _since(self._moment)
        found = []
        for key in list(self._seen) if ids is None else ids & self._seen.keys():
            thing, version = self._seen[key]
            if thing.version != version:
                self._seen[key] = thing, thing.version
                found.append(thing)
        return found
