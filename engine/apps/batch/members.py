"""Names the member of an object that is wrong, so that a manifest can tell its place.

In: what checks a value that has members, such as a task's camera. Out: errors that tell their way
down to the member at fault.
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
    """Let errors be those of the member ``key`` of what is checked."""
    try:
        yield
    except MemberError as error:
        raise MemberError(str(error), (key, *error.keys)) from None
    except (InvalidArgumentError, TypeError) as error:
        raise MemberError(str(error), (key,)) from None
