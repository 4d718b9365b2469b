"""The result of comparing one picture, sent between processes and written as JSON."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Any

PASSED, CHANGED, NEW, UPDATED = "passed", "changed", "new", "updated"
UNUSED, DELETED, FAILED = "unused", "deleted", "failed"
TWO_PICTURES = "two calls gave different pictures for this name in one run"


@dataclass
class Result:
    """The result for one picture.

    Attributes
    ----------
    name : str
        What people call it: the path below the folder of golden pictures, or of the folders that
        are compared.
    status : str
        ``"passed"``, ``"changed"``, ``"new"`` (nothing was expected), ``"updated"`` (what was
        expected has been written anew), ``"unused"`` (no test asked for it), ``"deleted"``
        (nothing was drawn) or ``"failed"`` (one of the files cannot be read).
    message : str
        A line about what differs; empty where nothing does.
    test : str
        The test that asked for it, as pytest calls it; else empty.
    expected, actual, difference : str or None
        The paths of the pictures.
    different, total : int
        How many pixels differ, and of how many.
    largest : float or None
        The largest difference of a channel, in the numbers of the pictures; None if they cannot be
        compared.
    box : list of int or None
        Around what differs: left, top, right, bottom, ends excluded.
    flip : float or None
        The mean FLIP error, where it was asked for.
    digest : str
        The hash of what was drawn; else empty.
    frame : int
        Of animations, which frame the numbers and pictures are of, from 0.
    """

    name: str
    status: str
    message: str = ""
    test: str = ""
    expected: str | None = None
    actual: str | None = None
    difference: str | None = None
    different: int = 0
    total: int = 0
    largest: float | None = None
    box: list[int] | None = None
    flip: float | None = None
    digest: str = ""
    frame: int = 0

    def measure(self, difference) -> None:
        """Copy the numbers of a `Difference`."""
        self.different, self.total = difference.different, difference.total
        self.largest = difference.largest if math.isfinite(difference.largest) else None
        self.box = None if difference.box is None else list(difference.box)

    def as_dict(self) -> dict[str, Any]:
        return dataclasses.asdict(self)
