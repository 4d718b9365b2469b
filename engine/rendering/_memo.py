"""Remembers the inputs that something was made from, to remake it only when they change."""

from __future__ import annotations


class Memo:
    """The inputs that something was last made from, compared by ``==``."""

    __slots__ = ("_made_of", "_next")

    def __init__(self) -> None:
        self._made_of: tuple[object, ...] | None = None
        self._next: tuple[object, ...] | None = None

    def is_of(self, *made_of: object) -> bool:
        """Return whether the result was made from these inputs."""
        return self._made_of == made_of

    def differs(self, *made_of: object) -> bool:
        """Return whether the result must be remade from these inputs, and note them for `done`."""
        if self._made_of == made_of:
            return False
        self._made_of, self._next = None, made_of
        return True

    def forget(self) -> None:
        """Force a remake in any case."""
        self._made_of = None

    def done(self) -> None:
        """Note that the result was made from the inputs last asked for."""
        self._made_of = self._next
