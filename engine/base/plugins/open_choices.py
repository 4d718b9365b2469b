"""Choices of an option that packages can add to."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from .registry import plugin_names


class OpenChoices(Collection[str]):
    """The names that ship, and those that plug-ins add, which are looked for when needed.

    An option with such choices needs a ``metavar``: argparse would list them at once.

    Parameters
    ----------
    group : str
        Of plug-ins.
    shipped : collection of str
    """

    def __init__(self, group: str, shipped: Collection[str]) -> None:
        self._group, self._shipped = group, shipped

    def __contains__(self, name: object) -> bool:
        return name in self._shipped or name in plugin_names(self._group)

    def __iter__(self) -> Iterator[str]:
        yield from self._shipped
        yield from plugin_names(self._group)

    def __len__(self) -> int:
        return sum(1 for _ in self)
