"""Warnings of what pictures leave out, each once for a scene.

In: a scene's data and words. Out: a warning, unless one of its kind was given before. The pictures
of one frame share it, as those in mirrors, so that they do not say the same again.
"""

from __future__ import annotations

from weakref import WeakKeyDictionary

from ..errors import warn
from ..model.scene.staged_data import AnyData


class Told:
    """What was told of each scene."""

    def __init__(self) -> None:
        self._kinds: WeakKeyDictionary[AnyData, set[str]] = WeakKeyDictionary()

    def warn(self, data: AnyData, words: str, kind: str = "") -> None:
        """Warn of a scene, unless the same, or anything of this kind, was told of it."""
        known = self._kinds.setdefault(data, set())
        if (kind or words) not in known:
            known.add(kind or words)
            warn(words)
