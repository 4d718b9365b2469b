"""Properties that convert or refuse assigned values; names."""

from __future__ import annotations

from collections.abc import Callable


def held(name: str, made: Callable, doc: str, then: Callable | None = None) -> property:
    """Return a property that stores values converted by `made`; `then` is called after that."""
    hidden = f"_{name}"

    def put(self, value) -> None:
        setattr(self, hidden, made(value))
        if then is not None:
            then(self)

    return property(lambda self: getattr(self, hidden), put, doc=doc)


def optional(made: Callable) -> Callable:
    """Return a converter that passes None through."""
    return lambda value: None if value is None else made(value)


def number_unless(wrong: Callable[[float], bool], complaint: str) -> Callable[[object], float]:
    """Return a converter to float with a custom error."""

    def made(value) -> float:
        number = float(value)
        if wrong(number):
            raise ValueError(complaint)
        return number

    return made


class Named:
    """Base of objects with a name: text, or None."""

    _name: str | None = None

    name = held("name", optional(str), "Text or None.")
