"""Names, which most objects of pyrender have."""

from __future__ import annotations


class Named:
    """Something with a name: text, or None."""

    _name: str | None = None

    @property
    def name(self) -> str | None:
        """The name, text or None."""
        return self._name

    @name.setter
    def name(self, value) -> None:
        self._name = None if value is None else str(value)
