"""Properties that make something of what they are given, or raise, and hold that; names."""

from __future__ import annotations

from collections.abc import Callable


def held(name: str, made: Callable, doc: str) -> property:
    """A property of a name that holds what `made` makes of a value."""
    hidden = f"_{name}"

    def put(self, value) -> None:
        setattr(self, hidden, made(value))

    return property(lambda self: getattr(self, hidden), put, doc=doc)


def optional(made: Callable) -> Callable:
    """What makes something of all but None."""
    return lambda value: None if value is None else made(value)


def number_unless(wrong: Callable[[float], bool], complaint: str) -> Callable[[object], float]:
    """What makes a float of a value, and raises where that is wrong."""

    def made(value) -> float:
        number = float(value)
        if wrong(number):
            raise ValueError(complaint)
        return number

    return made


class Named:
    """Something with a name: text, or None."""

    _name: str | None = None

    name = held("name", optional(str), "Text or None.")
