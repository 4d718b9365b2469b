"""Compares two pictures, or the pictures of two folders, for ``engine3d diff``.

In:  what was drawn now, what was expected. Out: results, and difference pictures where they are
     asked for. Files of the same bytes are equal; only others are decoded.
"""

from __future__ import annotations

import dataclasses
import os
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...base.files.atomic_write import atomic_write
from ...base.files.making_folders import make_folder_of
from ...base.files.png import encode_pixels
from ...base.side_by_side import side_by_side
from ...errors import Engine3DError, FileAccessError, FileFormatError
from .comparison import Difference, compare
from .difference_picture import difference_picture
from .display import displayed
from .picture_files import SUFFIXES, Picture
from .reading import read_picture
from .results import CHANGED, DELETED, FAILED, NEW, PASSED, Result

_AT_ONCE = 16  # pairs per thread between two progress updates


@dataclass(frozen=True)
class Rules:
    """The tolerances of a comparison; none by default.

    Attributes
    ----------
    matching : float or None
        The distance in YIQ, 0 to 1, up to which colours match, as in reg-cli.
    count_antialiasing : bool
        Whether, with ``matching``, pixels count that look like antialiasing.
    rate, pixels : float, int or None
        The share, or the number, of pixels that may differ. The number takes precedence.
    flip : float or None
        The mean FLIP error up to which pictures pass.
    """

    matching: float | None = None
    count_antialiasing: bool = False
    rate: float = 0.0
    pixels: int | None = None
    flip: float | None = None

    def allowed(self, total: int) -> float:
        """Return how many pixels of a total may differ."""
        return self.rate * total if self.pixels is None else self.pixels


@dataclass(frozen=True)
class Pair:
    """Two files to compare; one of them may be missing.

    Attributes
    ----------
    name : str
    actual, expected, difference : str or None
    folder : str or None
        Of the differences, which ``difference`` does not leave; None where somebody named that.
    """

    name: str
    actual: str | None
    expected: str | None
    difference: str | None
    folder: str | None = None


def pairs(actual: str, expected: str, differences: str | None = None) -> list[Pair]:
    """Return the pairs to compare: two pictures, or all of two folders, by relative path.

    Raises `FileAccessError` where one is not there, or is a folder and the other none.
    """
    for path in (actual, expected):
        if not os.path.exists(path):
            raise FileAccessError("cannot read: No such file or directory", path)
    if os.path.isdir(actual) != os.path.isdir(expected):
        raise FileAccessError(f"one is a folder and the other is none: {expected}", actual)
    if not os.path.isdir(actual):
        return [Pair(os.path.basename(actual), actual, expected, differences)]
    names = [set(_pictures_below(folder)) for folder in (actual, expected)]
    found = []
    for name in sorted(names[0] | names[1]):
        drawn, wanted = (
            os.path.join(folder, name) if name in held else None
            for folder, held in zip((actual, expected), names, strict=True)
        )
        place = None if differences is None else os.path.join(differences, _as_png(name))
        found.append(Pair(name.replace(os.sep, "/"), drawn, wanted, place, differences))
    return found


def _as_png(name: str) -> str:
    return name if name.lower().endswith(".png") else f"{name}.png"


def _pictures_below(folder: str) -> Iterator[str]:
    for path in Path(folder).rglob("*"):
        if path.suffix.lower() in SUFFIXES and path.is_file():
            yield os.fspath(path.relative_to(folder))


def compare_all(
    found: list[Pair], rules: Rules, threads: int, *, keep_going: bool
) -> Iterator[Result]:
    """Yield the result of each pair, in order; see `compare_files`."""
    for start in range(0, len(found), _AT_ONCE * threads):
        some = found[start : start + _AT_ONCE * threads]
        yield from side_by_side(lambda pair: compare_files(pair, rules, keep_going), some, threads)


def compare_files(pair: Pair, rules: Rules, keep_going: bool = False) -> Result:
    """Compare two files, and write the difference picture if it has a path.

    With ``keep_going`` a file that cannot be read has failed: the other pictures are compared.
    Raises `FileAccessError`, or `FileFormatError` where one is no picture.
    """
    result = Result(pair.name, PASSED, actual=pair.actual, expected=pair.expected)
    if pair.actual is None or pair.expected is None:
        result.status = NEW if pair.expected is None else DELETED
        result.message = "nothing was expected" if pair.expected is None else "nothing was drawn"
        return result
    try:
        if _same_bytes(pair.actual, pair.expected):
            return result
        pictures = read_picture(pair.actual), read_picture(pair.expected)
    except (FileAccessError, FileFormatError) as error:
        if not keep_going:
            raise
        result.status, result.message = FAILED, str(error)
        return result
    _judge(result, pair, pictures, rules)
    return result


def _judge(result: Result, pair: Pair, pictures: tuple[Picture, Picture], rules: Rules) -> None:
    """Return the difference of two pictures, if it exceeds the tolerance."""
    frame, difference = _first_difference(*pictures, rules)
    result.frame = frame
    shown = [one.frames[min(frame, len(one.frames) - 1)] for one in pictures]
    result.measure(difference)
    if _passes(result, difference, shown, rules):
        return
    result.status, result.message = CHANGED, _what_differs(*pictures, result, difference)
    if pair.difference is not None:
        result.difference = pair.difference
        make_folder_of(pair.difference, below=pair.folder)
        with atomic_write(pair.difference, below=pair.folder) as file:
            file.write(encode_pixels(difference_picture(displayed(shown[1]), difference)))


def _same_bytes(a: str, b: str) -> bool:
    try:
        return os.path.getsize(a) == os.path.getsize(b) and _bytes(a) == _bytes(b)
    except OSError as error:
        raise FileAccessError(f"cannot read: {error.strerror}", error.filename) from error


def _bytes(path: str) -> bytes:
    with open(path, "rb") as file:
        return file.read()


def _first_difference(actual: Picture, expected: Picture, rules: Rules) -> tuple[int, Difference]:
    """Return the first frame that differs too much, or else the last one."""
    both = list(zip(actual.frames, expected.frames, strict=False))
    for number, (a, b) in enumerate(both):
        difference = _difference(a, b, rules)
        if difference.kinds or difference.different > rules.allowed(difference.total):
            return number, difference
    if len(actual.frames) != len(expected.frames):
        kinds = f"it has {len(actual.frames)} frames, not {len(expected.frames)}"
        difference = dataclasses.replace(difference, kinds=kinds)
    return len(both) - 1, difference


def _difference(actual: np.ndarray, expected: np.ndarray, rules: Rules) -> Difference:
    difference = compare(actual, expected)
    if rules.matching is None or difference.kinds or not difference.different:
        return difference
    from .matching import looks_different

    shown = displayed(actual, expected), displayed(expected)
    mask = looks_different(*shown, rules.matching, rules.count_antialiasing)
    return Difference(mask, difference.amount, difference.largest)


def _passes(result: Result, difference: Difference, shown: list, rules: Rules) -> bool:
    if difference.kinds:
        return False
    if difference.different <= rules.allowed(difference.total):
        return True
    if rules.flip is None:
        return False
    from .flip import mean_flip

    result.flip = mean_flip(displayed(*shown), displayed(shown[1]))
    return result.flip <= rules.flip


def _what_differs(
    actual: Picture, expected: Picture, result: Result, difference: Difference
) -> str:
    text = str(difference)
    if max(len(actual.frames), len(expected.frames)) > 1 and "frames" not in difference.kinds:
        text = f"frame {result.frame} of {len(expected.frames)} (from 0): {text}"
    return text if result.flip is None else f"{text}; mean FLIP error {result.flip:.4g}"


def update(results: list[Result], actual: str, expected: str) -> list[Result]:
    """Make the drawn pictures the expected ones: copy changed or new ones, delete others.

    A damaged picture is replaced by what was drawn, but never the other way round. Returns the
    results of those that were drawn and cannot be read. Raises `FileAccessError`.
    """
    left = [r for r in results if r.status == FAILED and not _is_readable(r.actual)]
    try:
        for result in results:
            if result.status == DELETED and result.expected is not None:
                os.remove(result.expected)
            elif result.status in (CHANGED, NEW, FAILED) and result not in left:
                if os.path.isdir(actual):
                    name = os.path.join(expected, *result.name.split("/"))
                    _copy(result.actual, name, below=expected)
                else:
                    _copy(result.actual, expected)
    except FileAccessError:
        raise
    except OSError as error:
        raise FileAccessError(f"cannot write: {error.strerror}", error.filename) from error
    return left


def _is_readable(path: str) -> bool:
    try:
        read_picture(path)
    except Engine3DError:
        return False
    return True


def _copy(source: str, target: str, below: str | None = None) -> None:
    make_folder_of(target, below=below)
    with open(source, "rb") as data, atomic_write(target, below=below) as file:
        shutil.copyfileobj(data, file)
