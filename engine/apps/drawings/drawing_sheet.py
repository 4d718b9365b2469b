"""`drawing_sheet` draws a model from several sides on a page, `DrawingSheet` holds it.

In: a model, views, a page. Out: SVG or PDF, to scale.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ...base.angles import limited_angle
from ...base.calls import checks_types, hints_keywords
from ...base.thread_count import resolve_threads
from ...base.validation import choose, positive
from ...choices import LengthUnit, PageSize, ShapesOf
from ...errors import InvalidArgumentError, printable
from ...model.geometry.creases import CREASE_ANGLE
from ...stage.views.viewpoint import UP_DIRECTIONS
from ..sheet.opening import open_sources
from ..sheet.views import DEFAULT_VIEWS, check_views
from .line_drawing import write_page
from .paper import Page
from .pdf import pdf_of
from .sheet_pages import Look, SheetPage
from .svg import svg_of
from .units import PAGES, millimetres, parse_scale, scale_text


@hints_keywords
class DrawingSheet:
    """A page with line drawings of a model; made by `drawing_sheet`.

    Attributes
    ----------
    size : (float, float)
        Width and height of the page in millimetres.
    scale : float
        That of the views, such as 0.5 for 1:2.
    """

    def __init__(self, page: Page, scale: float) -> None:
        self._page, self.scale = page, scale
        self.size = page.width, page.height

    def svg(self) -> str:
        """Return the page as SVG."""
        return svg_of(self._page)

    def pdf(self) -> bytes:
        """Return the page as PDF."""
        return pdf_of(self._page)

    @checks_types
    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the page as .svg or .pdf, whole or not at all.

        Raises
        ------
        InvalidArgumentError
            The suffix is another one.
        FileAccessError
        """
        write_page(path, self._page)

    def _repr_svg_(self) -> str:
        return self.svg()

    def __repr__(self) -> str:
        return f"<DrawingSheet {self._page.title}: {scale_text(self.scale)}>"


@checks_types
def drawing_sheet(
    model: Any,
    *,
    views: str | Iterable[str] = DEFAULT_VIEWS,
    sections: str | Iterable[str] = (),
    page: PageSize = "A3",
    scale: float | str | None = None,
    title: str | None = None,
    hidden: bool = False,
    up: str | None = None,
    unit: LengthUnit | None = None,
    root: str | os.PathLike[str] | None = None,
    joints: Mapping[str, Any] | None = None,
    shapes: ShapesOf = "visual",
    crease_angle: float = CREASE_ANGLE,
    intersections: bool = True,
    line_width: float = 1.0,
    threads: int = 0,
) -> DrawingSheet:
    """Draw the lines of a model from several sides on one page, to scale.

    Parameters
    ----------
    model : what `render` takes
        One model.
    views, sections, up, unit, root, joints, shapes
        As for `sheets.contact_sheet`. The unit is one of mm, cm, m, µm, in and ft; without one,
        coordinates are millimetres.
    page : {"A4", "A3", "A2", "A1"}
        Its long side is level.
    scale : float or str, optional
        Such as ``0.5`` or ``"1:2"``; by default the largest recommended one at which all views fit.
        The isometric view and those of cameras fill their places.
    title : str, optional
        In the title block; by default the model's name.
    hidden : bool
        Whether hidden lines are drawn, dashed.
    crease_angle, intersections, threads
        As for `line_drawing`.
    line_width : float
        As for `LineDrawing.svg`.

    Returns
    -------
    DrawingSheet

    Raises
    ------
    InvalidArgumentError, FileFormatError, FileAccessError, OutOfMemoryError

    Examples
    --------
    >>> drawing_sheet("part.stl", sections="x=50%", unit="mm").save("part.pdf")
    """
    specs = check_views(views, sections)
    choose(page, PAGES, "page")
    if up is not None:
        choose(up, UP_DIRECTIONS, "up")
    opened = open_sources(model, root=root, joints=joints, shapes=shapes)
    if len(opened) != 1:
        raise InvalidArgumentError(f"a page shows one model, not {len(opened)}")
    length = unit or opened[0].unit or None
    millimetres(length)
    chosen = parse_scale(scale) if isinstance(scale, str) else scale
    look = Look(
        hidden,
        limited_angle(crease_angle, "crease_angle", np.pi, "from 0 to pi radians"),
        intersections,
        positive(line_width, "line_width"),
        resolve_threads(threads),
    )
    opened[0].title = opened[0].title if title is None else printable(title)
    made = SheetPage(opened[0], up or opened[0].up, length, look)
    given = None if chosen is None else positive(chosen, "scale")
    return DrawingSheet(made.draw(specs, page, given), made.scale)
