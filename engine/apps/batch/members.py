"""Errors that name the faulty member of an object, for messages about manifests.

In: checks of a value with members, such as a task's camera. Out: errors with the path to the faulty
member.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from ...errors import InvalidArgumentError


class MemberError(InvalidArgumentError):
    """A member of a value is wrong.

    Parameters
    ----------
    text : str
    keys : tuple of str or int
        The way from the value to the member.
    """

    def __init__(self, text: str, keys: tuple[str | int, ...]) -> None:
        super().__init__(text)
        self.keys = keys


@contextmanager
def member(key: str | int) -> Iterator[None]:
    """Attribute errors within the block to the member ``key``."""
    try:
        yield
    except MemberError as error:
        raise MemberError(str(error), (key, *error.keys)) from None
    except (InvalidArgumentError, TypeError) as error:
        raise MemberError(str(error), (key,)) from None
