"""The HTML report: one file with all pictures, to review changes.

In:  results, whose pictures are read from their files. Out: a page that loads nothing from
     elsewhere: side by side, swiped, blinking, and where they differ. Without scripts it shows
     pictures side by side.
"""

from __future__ import annotations

import base64
import os
import re
from collections import Counter
from html import escape
from importlib.resources import files

from ...base.files.atomic_write import atomic_write
from ...base.files.png import encode_pixels
from ...errors import Engine3DError
from ...version import __version__
from .display import displayed
from .reading import read_picture
from .results import CHANGED, DELETED, FAILED, NEW, PASSED, UNUSED, UPDATED, Result

_ORDER = (FAILED, CHANGED, NEW, DELETED, UPDATED, UNUSED, PASSED)
_VIEWS = (
    ("side", "Side by side"),
    ("swipe", "Swipe"),
    ("blink", "Blink"),
    ("difference", "Difference"),
)
_SMALL = 0.02  # share of a picture
# Pictures are enlarged by a whole number until they are about this wide.
_WIDE_BESIDE, _WIDE_ALONE, _LARGEST = 420, 900, 8


class Report:
    """A page of results.

    Parameters
    ----------
    title : str
    expected, actual : str
        What the two pictures are called above them.
    """

    def __init__(self, title: str, expected: str, actual: str) -> None:
        self._title = title
        self._labels = {"expected": expected, "actual": actual, "difference": "difference"}

    def write(self, path: str, results: list[Result]) -> None:
        """Write the page whole or not at all. Raises `FileAccessError`."""
        page = self.page(results).encode("utf-8", "replace")
        with atomic_write(path) as file:
            file.write(page)

    def page(self, results: list[Result]) -> str:
        """Return the text of the page."""
        results = sorted(results, key=lambda result: (_ORDER.index(result.status), result.name))
        others = [result for result in results if result.status != PASSED]
        cards = "\n".join(self._card(result) for result in others)
        parts = {
            "TITLE": escape(self._title),
            "COUNTS": _counts(results),
            "VIEWS": _view_buttons(),
            "CARDS": cards or '<p class="well">Nothing differs.</p>',
            "PASSED": _passed([r for r in results if r.status == PASSED]),
            "VERSION": escape(__version__),
        }
        template = (files(__package__) / "report.html").read_text("utf-8")
        return re.sub("@([A-Z]+)@", lambda name: parts[name[1]], template)

    def _card(self, result: Result) -> str:
        pictures = {
            kind: picture
            for kind in ("expected", "actual", "difference")
            if (picture := _read(getattr(result, kind), result.frame)) is not None
        }
        folder, _, name = result.name.rpartition("/")
        folder = f"<span>{escape(folder)}/</span>" if folder else ""
        views = ""
        if len(pictures) > 1:
            views = f'<div class="switch views">{_view_buttons()}</div>'
        test = "" if not result.test else f'<p class="test">{escape(result.test)}</p>'
        return (
            f'<article class="card {result.status}{_sharp(pictures)}" data-view="side"'
            f' tabindex="-1" style="{_scales(pictures)}">'
            f'<div class="head"><div class="what"><h2>{folder}{escape(name)}</h2>'
            f'<span class="chip {result.status}">{result.status}</span>'
            f'<p class="message">{escape(result.message)}</p>{test}</div>{views}</div>'
            f"{self._stage(pictures, result)}</article>"
        )

    def _stage(self, pictures: dict, result: Result) -> str:
        if not pictures:
            return ""
        figures = "".join(self._figure(kind, shown, result) for kind, shown in pictures.items())
        knob = '<div class="handle"></div><input class="knob" type="range" max="1000" value="500"'
        knob += ' aria-label="where the one picture ends and the other begins">'
        return f'<div class="stage"><div class="frame">{figures}{knob}</div></div>'

    def _figure(self, kind: str, shown, result: Result) -> str:
        height, width = shown.shape[:2]
        data = base64.b64encode(encode_pixels(shown)).decode("ascii")
        label = escape(self._labels[kind])
        return (
            f'<figure class="{kind}"><figcaption>{label}</figcaption><div class="picture">'
            f'<img alt="{label}" width="{width}" height="{height}" style="--w:{width}"'
            f' src="data:image/png;base64,{data}">'
            f"{_marker(result, width, height) if kind == 'difference' else ''}</div></figure>"
        )


def _read(path: str | None, frame: int):
    """Return a picture for display; None if it cannot be read."""
    if path is None or not os.path.isfile(path):  # a FIFO would block
        return None
    try:
        frames = read_picture(path).frames
    except Engine3DError:
        return None
    return displayed(frames[min(frame, len(frames) - 1)])


def _marker(result: Result, width: int, height: int) -> str:
    """Return the marker around a small difference, which would vanish in a reduced picture."""
    if result.box is None:
        return ""
    left, top, right, bottom = result.box
    if (right - left) * (bottom - top) > _SMALL * width * height:
        return ""
    place = {"left": left / width, "top": top / height}
    place |= {"width": (right - left) / width, "height": (bottom - top) / height}
    style = ";".join(f"{key}:{100 * share:.3f}%" for key, share in place.items())
    return f'<div class="marker" style="{style}"></div>'


def _widest(pictures: dict) -> int:
    return max((shown.shape[1] for shown in pictures.values()), default=1)


def _scale(width: int, wanted: int) -> int:
    return max(1, min(_LARGEST, wanted // width))


def _scales(pictures: dict) -> str:
    width = _widest(pictures)
    return f"--auto:{_scale(width, _WIDE_BESIDE)};--alone:{_scale(width, _WIDE_ALONE)}"


def _sharp(pictures: dict) -> str:
    """Return the CSS for small pictures, which keep sharp pixels; large ones are smoothed."""
    return " sharp" if _scale(_widest(pictures), _WIDE_BESIDE) > 1 else ""


def _view_buttons() -> str:
    return "".join(
        f'<button data-view="{view}" aria-pressed="{str(view == "side").lower()}">{text}</button>'
        for view, text in _VIEWS
    )


def _counts(results: list[Result]) -> str:
    counts = Counter(result.status for result in results)
    return "".join(
        f'<button class="chip {one}" data-status="{one}" aria-pressed="true">'
        f"{counts[one]} {one}</button>"
        for one in _ORDER
        if counts[one]
    )


def _passed(results: list[Result]) -> str:
    if not results:
        return ""
    names = sorted({result.name for result in results})
    items = "".join(f"<li>{escape(name)}</li>" for name in names)
    summary = f"<summary>{len(results)} passed</summary>"
    return f'<details class="passing passed">{summary}<ul>{items}</ul></details>'
