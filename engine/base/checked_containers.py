"""Lists and dicts that a thing shows, and that may be changed in place: each change is checked.

In: changes, by whatever method. Out: the list or dict as it is then; where the check raises, as it
was. So a thing never holds what could not have been assigned to it.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, SupportsIndex
from weakref import ref


class CheckedList(list[Any]):
    """A list that belongs to a thing.

    Parameters
    ----------
    owner : object
        Held weakly: without it, the list is as any other.
    take : callable
        ``take(owner, content, put)`` raises, or calls ``put(content)`` with what is to be held.
    content : list
    """

    def __init__(self, owner: Any, take: Callable[..., None], content: list[Any]) -> None:
        super().__init__(content)
        self._owner, self._take = ref(owner), take

    def __reduce_ex__(self, protocol: SupportsIndex) -> tuple[Any, ...]:
        return list, (list(self),)  # a copy belongs to nobody

    def _put(self, content: list[Any]) -> None:
        list.__setitem__(self, slice(None), content)


class CheckedDict(dict[Any, Any]):
    """A dict that belongs to a thing; as `CheckedList`."""

    def __init__(self, owner: Any, take: Callable[..., None], content: dict[Any, Any]) -> None:
        super().__init__(content)
        self._owner, self._take = ref(owner), take

    def __reduce_ex__(self, protocol: SupportsIndex) -> tuple[Any, ...]:
        return dict, (dict(self),)

    def _put(self, content: dict[Any, Any]) -> None:
        dict.clear(self)
        dict.update(self, content)


def _checked(kind: type, change: Callable[..., Any]) -> Callable[..., Any]:
    """A method that makes a change of a copy, and has that taken over."""

    @functools.wraps(change)
    def method(self: Any, *args: Any, **options: Any) -> Any:
        content = kind(self)
        result = change(content, *args, **options)
        owner = self._owner()
        if owner is None:
            self._put(content)
        else:
            self._take(owner, content, self._put)
        return self if result is content else result

    return method


LIST_CHANGES = (
    *("append", "extend", "insert", "pop", "remove", "clear", "sort", "reverse"),
    *("__setitem__", "__delitem__", "__iadd__", "__imul__"),
)
DICT_CHANGES = (
    *("update", "setdefault", "pop", "popitem", "clear"),
    *("__setitem__", "__delitem__", "__ior__"),
)
for _name in LIST_CHANGES:
    setattr(CheckedList, _name, _checked(list, getattr(list, _name)))
for _name in DICT_CHANGES:
    setattr(CheckedDict, _name, _checked(dict, getattr(dict, _name)))
