"""Warnings of what pictures leave out, each once for a scene or a material.

In: what it is about, and words. Out: a warning, unless one of its kind was given before. The
pictures of one frame share it, as those in mirrors, so that they do not say the same again.
"""

from __future__ import annotations

from weakref import WeakKeyDictionary

from ..errors import warn


class Told:
    """What was told of each scene and material."""

    def __init__(self) -> None:
        self._kinds: WeakKeyDictionary[object, set[str]] = WeakKeyDictionary()

    def warn(self, about: object, words: str, kind: str = "") -> None:
        """Warn of something, unless the same, or anything of this kind, was told of it."""
        known = self._kinds.setdefault(about, set())
        if (kind or words) not in known:
            known.add(kind or words)
            warn(words)
