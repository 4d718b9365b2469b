"""How much of a text fits a width.

In: a text that grows with what is kept of it, and the measure of texts. Out: how much to keep.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable


def most_kept(
    shortened: Callable[[int], str], count: int, most: int, width: Callable[[str], int]
) -> int:
    """Return the largest number below ``count`` whose text is at most so wide; -1 for none.

    Parameters
    ----------
    shortened : callable
        Returns the text for a number of kept characters, never narrower for more of them.
    count, most : int
    width : callable
        Returns the width of a text: pixels or characters.
    """
    return bisect_right(range(count), most, key=lambda kept: width(shortened(kept))) - 1
