"""Remembers from what a thing was made, so that it is made again only when that changes."""

from __future__ import annotations


class Memo:
    """The values that a thing was last made from; ``==`` compares them."""

    __slots__ = ("_made_of", "_next")

    def __init__(self) -> None:
        self._made_of: tuple[object, ...] | None = None
        self._next: tuple[object, ...] | None = None

    def is_of(self, *made_of: object) -> bool:
        """Return whether the thing was made of these values."""
        return self._made_of == made_of

    def differs(self, *made_of: object) -> bool:
        """Return whether the thing has to be made of these values; it is not, until `done`."""
        if self._made_of == made_of:
            return False
        self._made_of, self._next = None, made_of
        return True

    def forget(self) -> None:
        """Have the thing made again in any case."""
        self._made_of = None

    def done(self) -> None:
        """Say that the thing was made of the values that were last asked for."""
        self._made_of = self._next
