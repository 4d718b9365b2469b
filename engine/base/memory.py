"""Tells a lack of memory from other errors."""

from __future__ import annotations

import errno

#: What is said of a file that memory does not suffice for.
NEEDS_MORE = "needs more memory than there is"


def is_lack_of_memory(error: BaseException) -> bool:
    """Return whether an error means that memory ran out; Python and systems have several."""
    if isinstance(error, ImportError):  # the dynamic loader has no error type of its own for this
        return "failed to map" in str(error)
    return isinstance(error, MemoryError) or getattr(error, "errno", None) == errno.ENOMEM
