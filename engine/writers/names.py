"""Text with names in it, as model files hold it.

In: text; a name may come from a path that is no UTF-8, or from JSON, with halves of surrogate
pairs that no encoding has. Out: UTF-8, those halves as Python escapes them.
"""

from __future__ import annotations


def encoded(text: str) -> bytes:
    """Return text as UTF-8, whatever is in it."""
    return text.encode("utf-8", "backslashreplace")
