"""Tracks which of many objects changed, without visiting all of them.

Meshes, instances, materials, textures, cameras and lights get a new ``version`` with every
assignment, and report it here. In: such objects. Out: those of a `Watch` whose version changed
since its last look. Only the latest changes are remembered: a watch that looks too rarely visits
all objects.

Nothing here takes a lock, because a signal handler may assign at any point. Each step that others
could see half done is one atomic operation of the interpreter.
"""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Iterable
from typing import Any

from .system import after_fork

_REMEMBERED = 2048

_versions = itertools.count(1)  # unique even if two threads count at once
_changed: deque[list[int]] = deque([[0]], _REMEMBERED)  # IDs of the latest changes, in order


def renew(thing: Any) -> None:
    """Give an object a new version and report it; call this after the assignment is complete."""
    thing.__dict__["version"] = next(_versions)
    _changed.append([id(thing)])


def _since(moment: list[int]) -> tuple[set[int] | None, list[int]]:
    """Return the IDs changed since a moment, or None if forgotten; and the current moment.

    A moment is the last entry at that time, compared by identity.
    """
    entries = list(_changed)
    ids: set[int] = set()
    for entry in reversed(entries):
        if entry is moment:
            return ids, entries[-1]
        ids.add(entry[0])
    return None, entries[-1]


def _forget() -> None:
    """Invalidate all moments in a forked process, since the fork may have interrupted a change."""
    _changed.extend([[0] for _ in range(_REMEMBERED)])


after_fork(_forget)


class Watch:
    """A set of objects, with the version of each that was last seen.

    Several threads may look at once: each finds a change until one of them confirms it with `saw`.
    """

    def __init__(self, things: Iterable[Any] = ()) -> None:
        self._seen: dict[int, tuple[Any, int]] = {}
        self._moment = _changed[-1]
        self._found: dict[int, None] = {}  # IDs of possible changes not yet confirmed
        for thing in things:
            self.add(thing)

    def add(self, thing: Any) -> None:
        """Watch an object from now on; call this before reading it."""
        self._seen.setdefault(id(thing), (thing, thing.version))

    def remove(self, thing: Any) -> None:
        """Stop watching an object, if it is watched."""
        self._seen.pop(id(thing), None)

    def found(self) -> list[tuple[Any, int]]:
        """Return the unconfirmed changes: pairs of an object and its version."""
        if self._moment is not _changed[-1]:
            ids, moment = _since(self._moment)
            seen = list(self._seen) if ids is None else ids & self._seen.keys()
            self._found.update(dict.fromkeys(seen))
            self._moment = moment
        pairs = []
        for key in list(self._found):
            thing, version = self._seen.get(key, (None, 0))
            if thing is None:
                self._found.pop(key, None)
            elif thing.version == version:
                self._take_in(key, thing, version)
            else:
                pairs.append((thing, thing.version))
        return pairs

    def saw(self, thing: Any, version: int) -> None:
        """Confirm that an object was read at this version, or a later one."""
        if id(thing) in self._seen:
            self._seen[id(thing)] = thing, version
            self._take_in(id(thing), thing, version)

    def _take_in(self, key: int, thing: Any, version: int) -> None:
        self._found.pop(key, None)
        if thing.version != version:  # changed meanwhile: it will be found again
            self._found[key] = None

    def changed(self) -> list[Any]:
        """Return the objects changed since the last look, and confirm them."""
        pairs = self.found()
        for thing, version in pairs:
            self.saw(thing, version)
        return [thing for thing, _ in pairs]
