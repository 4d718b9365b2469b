"""The fixture ``golden``, which compares a picture with its golden one.

In:  what the test drew. Out: nothing, or an `AssertionError` that says what differs and where both
     pictures are; a `Result` in any case. The hash is compared first; only where it differs is the
     golden picture decoded.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base.files.portable_names import folded
from ...errors import FileFormatError, InvalidArgumentError
from ...version import PICTURES, __version__
from . import names
from .comparison import Difference, compare
from .display import displayed
from .failure_files import write_failure
from .given_pixels import as_pixels
from .golden_files import read_golden, write_golden
from .pixel_hash import describe, pixel_hash
from .results import CHANGED, NEW, PASSED, TWO_PICTURES, UPDATED, Result


@dataclass
class Place:
    """The location of a test's golden pictures.

    Attributes
    ----------
    folder : str
        The folder of the pictures of the test's module.
    module, classes, test : str, list of str, str
        The module's name, the classes around the test, what pytest calls it.
    node : str
        All of it in one.
    """

    folder: str
    module: str
    classes: list[str]
    test: str
    node: str


class Golden:
    """Compares the pictures of one test with golden ones.

    Parameters
    ----------
    place : Place
    update : str
        ``""``, ``"failed"``, ``"missing"`` or ``"all"``: which golden files are written.
    failures : callable
        Returns the folder for pictures of what failed; it is asked and made when something does.
    written : dict of str to str
        The hashes of the golden files that the run has written, by folded path; it is added to.
    """

    def __init__(
        self, place: Place, update: str, failures: Callable[[], str], written: dict[str, str]
    ) -> None:
        self._results: list[Result] = []
        self._place, self._update = place, update
        self._failures, self._written = failures, written
        self._unnamed = 0

    def __call__(
        self,
        picture: Any,
        name: str | None = None,
        max_different: int = 0,
        tolerance: float = 0,
        *,
        max_flip: float | None = None,
    ) -> None:
        """Fail unless a picture equals its golden one.

        Parameters
        ----------
        picture : Frame, Canvas, PIL.Image.Image, array, or path of an image file
            Arrays are (H, W) or (H, W, 1 to 4) of any type of numbers, such as ``frame.depth``.
        name : str, optional
            What to call the file; the test's name if left out. Tests of a module may share one.
        max_different : int, optional
            How many pixels may differ. 0: none.
        tolerance : float, optional
            What a channel may differ by, in the numbers of the picture, before its pixel counts.
        max_flip : float, optional
            Or the mean FLIP error, 0 to 1, up to which a picture passes whatever differs. Needs
            ``pip install 'engine3d[flip]'``.

        Raises
        ------
        AssertionError
            It differs, or there is no golden picture yet.
        InvalidArgumentError
            The picture is none, or the name leads out of the folder.
        FileAccessError
            A golden file cannot be read or written.
        """
        __tracebackhide__ = True
        _check_allowances(max_different, tolerance, max_flip)
        case = self._begin(name, as_pixels(picture))
        self._compare(case, (max_different, tolerance, max_flip))
        if case.result.status == PASSED:
            return
        if self._may_write(case.result.status):
            self._write(case)
            return
        raise AssertionError(self._explain(case))

    def take_results(self) -> list[Result]:
        """Return the results of calls since the last request."""
        taken, self._results = self._results, []
        return taken

    def _begin(self, name: str | None, pixels: np.ndarray) -> _Case:
        """Return a case with the name and the path of its golden file."""
        place = self._place
        if name is None:
            self._unnamed += 1
            relative = names.test_name(place.classes, place.test, self._unnamed)
        else:
            relative = names.given_name(name)
        path = os.path.join(place.folder, *relative.split("/")) + names.SUFFIX
        result = Result(
            name=f"{place.module}/{relative}",
            status=PASSED,
            test=place.node,
            expected=path,
            digest=pixel_hash(pixels),
        )
        self._results.append(result)
        return _Case(result, path, pixels)

    def _compare(self, case: _Case, allowances: tuple) -> None:
        """Determine the status of a case, and the fault."""
        result = case.result
        try:
            golden = read_golden(case.path)
            if golden is None:
                result.status, result.expected = NEW, None
                result.message = "there is no golden picture yet"
                return
            if golden.digest == result.digest:
                return
            case.pictures = golden.pictures
            case.expected = golden.pixels()
        except FileFormatError as error:
            result.status, result.message = CHANGED, str(error)
            return
        case.difference = compare(case.pixels, case.expected, allowances[1])
        result.measure(case.difference)
        if not _passes(case, golden.digest is None, allowances):
            result.status, result.message = CHANGED, _what_differs(case)

    def _explain(self, case: _Case) -> str:
        """Write the pictures of a failure; return the lines of advice."""
        result = case.result
        write_failure(result, self._failures(), case.pixels, case.expected, case.difference)
        which = "missing" if result.status == NEW else "failed"
        lines = [
            f"{result.name}: {result.message}",
            f"  golden:     {case.path}",
            f"  drawn now:  {result.actual}",
        ]
        if result.difference is not None:
            lines.append(f"  difference: {result.difference}")
        lines += _other_version(case.pictures)
        lines.append(f"If it is meant, look at it, then: pytest --golden-update={which}")
        return "\n".join(lines)

    def _may_write(self, status: str) -> bool:
        wanted = {CHANGED: "failed", NEW: "missing"}[status]
        return self._update in (wanted, "all")

    def _write(self, case: _Case) -> None:
        __tracebackhide__ = True
        result = case.result
        if self._written.setdefault(folded(case.path), result.digest) != result.digest:
            raise AssertionError(f"{result.name}: {TWO_PICTURES}: {case.path}")
        write_golden(case.path, case.pixels, below=self._place.folder)
        result.status, result.expected = UPDATED, case.path


@dataclass
class _Case:
    """One call: the drawn picture, the expected one, and the result."""

    result: Result
    path: str
    pixels: np.ndarray
    expected: np.ndarray | None = None
    pictures: int | None = None
    difference: Difference | None = None


def _check_allowances(max_different: Any, tolerance: Any, max_flip: Any) -> None:
    for name, value in (
        ("max_different", max_different),
        ("tolerance", tolerance),
        ("max_flip", max_flip),
    ):
        if value is not None and not (isinstance(value, int | float) and value >= 0):
            raise InvalidArgumentError(f"{name} is a number of at least 0, not {value!r}")


def _passes(case: _Case, foreign: bool, allowances: tuple) -> bool:
    """Return whether a difference is within the test's tolerance.

    ``foreign``: the golden file was made by other means, and may be RGB where RGBA is drawn.
    """
    max_different, tolerance, max_flip = allowances
    result, difference = case.result, case.difference
    if difference is None or case.expected is None or difference.kinds:
        return False
    if difference.different <= max_different:
        return foreign or bool(max_different or tolerance)
    if max_flip is None:
        return False
    from .flip import mean_flip

    shown = displayed(case.pixels, case.expected), displayed(case.expected)
    result.flip = mean_flip(*shown)
    return result.flip <= max_flip


def _other_version(pictures: int | None) -> list[str]:
    """Return a line if an engine3d that draws other pictures wrote the golden file."""
    if pictures is None or pictures == PICTURES:
        return []
    return [
        f"The golden picture is one of engine3d.PICTURES {pictures}. This is engine3d "
        f"{__version__} with PICTURES {PICTURES}: docs/versions.md lists what each number changed."
    ]


def _what_differs(case: _Case) -> str:
    if case.difference is None or case.expected is None:
        return ""
    text = str(case.difference)
    if case.difference.box is None:
        text = f"it is {describe(case.pixels)}, not {describe(case.expected)}"
    return text if case.result.flip is None else f"{text}; mean FLIP error {case.result.flip:.4g}"
