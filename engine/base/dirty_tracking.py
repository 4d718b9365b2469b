"""Tracks which of many things changed, without looking at all of them.

Meshes, sets of instances, materials, textures, cameras and lights get another ``version`` whenever
something is assigned to them, which is told here. In: such things. Out: those of a `Watch` whose
version is another than when it last looked. Only the latest changes are remembered: whoever looks
less often looks at everything.

Nothing here takes a lock: a signal handler, which runs in the middle of anything, may assign as
well. Each step that others could see half done is one operation of the interpreter's.
"""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Iterable
from typing import Any

from .system import after_fork

_REMEMBERED = 2048

_versions = itertools.count(1)  # no number twice, even where two count at once
_changed: deque[list[int]] = deque([[0]], _REMEMBERED)  # ids of what changed last, in order


def renew(thing: Any) -> None:
    """Give a thing another version, and say so: once what was assigned is in its place."""
    thing.__dict__["version"] = next(_versions)
    _changed.append([id(thing)])


def _since(moment: list[int]) -> tuple[set[int] | None, list[int]]:
    """Ids of what changed since a moment, None if that is forgotten; and the moment now.

    A moment is the last entry that there was, the very object.
    """
    entries = list(_changed)
    ids: set[int] = set()
    for entry in reversed(entries):
        if entry is moment:
            return ids, entries[-1]
        ids.add(entry[0])
    return None, entries[-1]


def _forget() -> None:
    """In a process that was forked, perhaps from the middle of a change."""
    _changed.extend([[0] for _ in range(_REMEMBERED)])


after_fork(_forget)


class Watch:
    """Things, and which version of each was seen.

    Several threads may look at once: what changed is found by each of them until one has said, by
    `saw`, that it took it in.
    """

    def __init__(self, things: Iterable[Any] = ()) -> None:
        self._seen: dict[int, tuple[Any, int]] = {}
        self._moment = _changed[-1]
        self._found: dict[int, None] = {}  # ids of what may have changed and was not taken in
        for thing in things:
            self.add(thing)

    def add(self, thing: Any) -> None:
        """Look at a thing from now on: before anything is read of it."""
        self._seen.setdefault(id(thing), (thing, thing.version))

    def remove(self, thing: Any) -> None:
        """Look at a thing no longer, if it was looked at."""
        self._seen.pop(id(thing), None)

    def found(self) -> list[tuple[Any, int]]:
        """Return what changed and was not taken in: pairs of a thing and its version."""
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
        """Say that a thing was taken in as it was at a version, or later."""
        if id(thing) in self._seen:
            self._seen[id(thing)] = thing, version
            self._take_in(id(thing), thing, version)

    def _take_in(self, key: int, thing: Any, version: int) -> None:
        self._found.pop(key, None)
        if thing.version != version:  # since: found again by the next who looks
            self._found[key] = None

    def changed(self) -> list[Any]:
        """Return the things that changed since they were last looked at; each is told once."""
        pairs = self.found()
        for thing, version in pairs:
            self.saw(thing, version)
        return [thing for thing, _ in pairs]
