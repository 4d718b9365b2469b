"""Lists and dicts of an object that check every change in place.

In: changes, by any method. Out: the changed list or dict; unchanged if the check raises. So an
object never holds a value that could not have been assigned to it.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, SupportsIndex
from weakref import ref


class CheckedList(list[Any]):
    """A list that belongs to an object.

    Parameters
    ----------
    owner : object
        Held weakly; once it is gone, the list is an ordinary one.
    take : callable
        ``take(owner, content, put)`` raises, or calls ``put(content)`` with the content to keep.
    content : list
    """

    def __init__(self, owner: Any, take: Callable[..., None], content: list[Any]) -> None:
        super().__init__(content)
        self._owner, self._take = ref(owner), take

    def __reduce_ex__(self, protocol: SupportsIndex) -> tuple[Any, ...]:
        return list, (list(self),)  # a copy has no owner

    def _put(self, content: list[Any]) -> None:
        list.__setitem__(self, slice(None), content)


class CheckedDict(dict[Any, Any]):
    """A dict that belongs to an object; as `CheckedList`."""

    def __init__(self, owner: Any, take: Callable[..., None], content: dict[Any, Any]) -> None:
        super().__init__(content)
        self._owner, self._take = ref(owner), take

    def __reduce_ex__(self, protocol: SupportsIndex) -> tuple[Any, ...]:
        return dict, (dict(self),)

    def _put(self, content: dict[Any, Any]) -> None:
        dict.clear(self)
        dict.update(self, content)


def _checked(kind: type, change: Callable[..., Any]) -> Callable[..., Any]:
    """Return a method that changes a copy and then submits it to the owner's check."""

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
