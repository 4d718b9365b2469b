"""Several views in one picture: drawings with dimensions, and turns around the scene.

In: the objects, and which views. Out: a `Sheet`, or cells in a grid with captions.
"""

from __future__ import annotations

import math
import os
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ...base.numbers import shown as shown_value
from ...errors import InvalidArgumentError
from ...io.output.animation_saving import save_animation
from ...rendering.canvas import Canvas
from ...stage.overlays.lettering import text_font
from ...stage.overlays.theme import LIGHT
from ..sheet.contact_sheet import Sheet, contact_sheet
from .pictures import Drawn, Picture, Request, Studio, check_pixel, visible_parts
from .things import Things
from .view_cameras import rounded

MOST_FRAMES = 36
_SMALLEST = 32
_GAP, _CAPTION = 6, 8
_FPS = 12.0


@dataclass(frozen=True)
class GridPicture(Drawn):
    """A picture of several views; its record has ``size`` and ``cells``.

    Attributes
    ----------
    sheet : Sheet or None
        Which knows the pixels of its views.
    """

    sheet: Sheet | None = None

    def at(self, x: int, y: int) -> dict[str, Any]:
        """Return what a pixel shows, as `Picture.at` does.

        Raises
        ------
        InvalidArgumentError
            The pixel is outside of the picture, or that of a turntable.
        """
        height, width, _ = self.pixels.shape
        check_pixel(x, y, (width, height))
        if self.sheet is None:
            raise InvalidArgumentError("pick: the last picture is a turntable: give a view")
        found = self.sheet.at(x, y)
        if found is None or "object_id" not in found:
            return {"object": None, "view": None if found is None else found["view"]}
        face = found["face_id"]
        return {
            "object": found["name"],
            "triangle": face if face >= 0 else None,
            "view": found["view"],
            "position": rounded(found["position"]),
        }


def draw_views(
    studio: Studio, things: Things, names: Any, size: Any, objects: Any, sections: Any
) -> GridPicture:
    """Draw views in a grid, as ``engine3d sheet`` does; see the tool ``views``.

    Raises
    ------
    InvalidArgumentError
    """
    shown = studio.scene_of(visible_parts(things, objects, ()), things.lamps(objects))
    sheet = contact_sheet(
        shown.viewed,
        views=names,
        sections=sections,
        size=studio.checked_size(size),
    )
    record = {"size": sheet.report["size"], "cells": _cells(sheet)}
    return GridPicture(sheet.picture.pixels, record, sheet)


def _cells(sheet: Sheet) -> list[dict[str, Any]]:
    """Return what the cells of a sheet show."""
    return [
        {
            "name": view["name"],
            "box": view["rectangle"],
            "pixels": view["pixels"],
            "blank": view["blank"],
            "reason": view["why"],
            "scale": view["camera"].get("scale"),
            "visible": [{"name": n["name"], "pixels": n["pixels"]} for n in view["nodes"][:12]],
        }
        for view in sheet.report["models"][0]["views"]
    ]


def draw_turntable(
    studio: Studio, things: Things, frames: int, elevation: float, size: Any, objects: Any
) -> GridPicture:
    """Draw a turn around the scene as cells of a grid, with the azimuths as captions.

    Raises
    ------
    InvalidArgumentError
    """
    width, height = studio.checked_size(size)
    columns = _columns(_checked(frames), width, height)
    rows = -(-frames // columns)
    cell = (width - _GAP * (columns - 1)) // columns, (height - _GAP * (rows - 1)) // rows
    if min(cell) < _SMALLEST:
        raise InvalidArgumentError(f"size: too small for {frames} frames")
    canvas = Canvas((width, height))
    canvas.clear((255, 255, 255, 255))
    cells, font = [], text_font(1)
    turn = _turn(studio, things, frames, elevation, cell, objects)
    for number, (azimuth, drawn) in enumerate(turn):
        x, y = (number % columns) * (cell[0] + _GAP), number // columns * (cell[1] + _GAP)
        canvas.pixels[y : y + cell[1], x : x + cell[0]] = drawn.pixels
        caption = f"{azimuth:g}°"
        place = x + _CAPTION, y + cell[1] - font.line_height - _CAPTION
        canvas.text(*place, caption, LIGHT.text, font=font, background=LIGHT.block)
        cells.append(_cell(azimuth, [x, y, *cell], drawn))
    return GridPicture(canvas.pixels, {"size": [width, height], "cells": cells})


def animate_turntable(
    studio: Studio, things: Things, frames: int, elevation: float, size: Any, objects: Any
) -> tuple[bytes, dict[str, Any]]:
    """Return a turn around the scene as an animated WebP, and its record; see `draw_turntable`."""
    size = studio.checked_size(size)
    turn = list(_turn(studio, things, _checked(frames), elevation, size, objects))
    cells = [_cell(azimuth, [0, 0, *size], drawn) for azimuth, drawn in turn]
    with tempfile.TemporaryDirectory(prefix="engine3d-") as folder:
        path = os.path.join(folder, "turn.webp")
        save_animation([drawn.pixels for _, drawn in turn], path, fps=_FPS)
        with open(path, "rb") as file:
            return file.read(), {"size": list(size), "cells": cells}


def _checked(frames: int) -> int:
    if isinstance(frames, bool) or not isinstance(frames, int) or not 2 <= frames <= MOST_FRAMES:
        raise InvalidArgumentError(
            f"frames must be a whole number from 2 to {MOST_FRAMES}, not {shown_value(frames)}"
        )
    return frames


def _turn(
    studio: Studio, things: Things, frames: int, elevation: float, size: Any, objects: Any
) -> Iterator[tuple[float, Picture]]:
    """Yield the azimuths of a turn in degrees, and the pictures from there."""
    for number in range(frames):
        azimuth = 360.0 * number / frames
        view = {"azimuth": azimuth, "elevation": elevation}
        yield azimuth, studio.draw(things, Request(view=view, size=list(size), objects=objects))


def _cell(azimuth: float, box: list[int], drawn: Picture) -> dict[str, Any]:
    return {
        "name": f"{azimuth:g}",
        "box": box,
        "pixels": sum(one["pixels"] for one in drawn.record["visible"]),
        "blank": drawn.record["blank"],
        "reason": drawn.record["reason"],
    }


def _columns(count: int, width: int, height: int) -> int:
    """Return how many columns make cells nearest to the shape of three by two."""
    shapes = {
        n: abs(math.log((width / n) / (height / -(-count // n)) / 1.5)) for n in range(1, count + 1)
    }
    full = {n: shape for n, shape in shapes.items() if count % n == 0}
    best = min(shapes, key=lambda n: shapes[n])
    whole = min(full, key=lambda n: full[n])
    return whole if full[whole] < shapes[best] + math.log(1.5) else best
