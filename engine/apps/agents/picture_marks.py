"""Names and highlights over an agent's picture.

In: a frame with IDs, and what its nodes are. Out: the same pixels, drawn on.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base.numbers import shown
from ...errors import InvalidArgumentError
from ...rendering.frame import Frame
from ...stage.overlays.lettering import text_font
from ...stage.overlays.selection_outline import OUTLINE, outline_pixels
from ...stage.overlays.theme import LIGHT
from ...stage.visibility import mesh_of
from .shown_scene import Shown
from .things import Things

#: Names of more parts would cover the picture.
MOST_LABELS = 24
#: How much of a highlight's colour is over the surface.
_TINT = 0.45
_GAP = 3
#: Runs of this fraction of the longest one are long enough for a name to stand on.
_LONG = 0.8
_KEYS = ("object", "faces")


def draw_highlights(frame: Frame, shown_: Shown, things: Things, highlights: Any) -> None:
    """Tint and outline objects, or some of their faces.

    Parameters
    ----------
    frame : Frame
    shown_ : Shown
    things : Things
    highlights : list of dict
        ``object``: a name; ``faces``: numbers of triangles, all by default.

    Raises
    ------
    InvalidArgumentError
        There is no such object or face.
    """
    for entry in highlights:
        if not isinstance(entry, dict) or "object" not in entry or not set(entry) <= set(_KEYS):
            raise InvalidArgumentError(
                f'highlight must be like {{"object": "box", "faces": [0]}}, not {shown(entry)}'
            )
        parts = things.find(entry["object"], "highlight")
        inside = np.isin(frame.object_id, [node.id for node in shown_.nodes_of(parts)])
        faces = entry.get("faces") or []
        if faces:
            _check_faces(faces, max(len(mesh_of(part.drawn).faces) for _, part in parts))
            inside &= np.isin(frame.face_id, faces)
        tinted = frame.color[inside, :3] * (1.0 - _TINT) + np.array(OUTLINE[:3]) * _TINT
        frame.color[inside, :3] = (tinted + 0.5).astype(np.uint8)
        outline_pixels(frame, inside)


def _check_faces(faces: Any, count: int) -> None:
    for face in faces:
        if isinstance(face, bool) or not isinstance(face, int) or not 0 <= face < count:
            raise InvalidArgumentError(
                f"highlight: faces are numbers from 0 to {count - 1}, not {shown(face)}"
            )


def draw_names(frame: Frame, shown_: Shown) -> None:
    """Write the names of the largest visible parts on them.

    A name stands where its part is broad, and covers no other; where there is no room, it is left
    out.
    """
    canvas = frame.canvas()
    taken: list[tuple[int, int, int, int]] = []
    font = text_font(2 if frame.height >= 900 else 1)
    for name, counted in shown_.visible(frame)[:MOST_LABELS]:
        x, y, width, height = counted.box
        wide, high = font.text_size(name)
        shows = frame.object_id[y : y + height, x : x + width] == counted.key
        column, middle = _broadest(shows)
        left = x + column - wide // 2
        left = min(max(left, _GAP), max(frame.width - wide - _GAP, _GAP))
        middle += y - high // 2
        rows = range(max(y - high, _GAP), min(y + height, frame.height - high - _GAP) + 1)
        free = [top for top in rows if not _covers((left, top, wide, high), taken)]
        if free:
            top = min(free, key=lambda row: (abs(row - middle), row))
            taken.append((left, top, wide, high))
            canvas.text(left, top, name, LIGHT.text, font=font, background=LIGHT.block)


def _broadest(shows: NDArray[np.bool_]) -> tuple[int, int]:
    """Return the column and the row of the middle of a long run of pixels of a mask (H, W).

    Of runs nearly as long as the longest, that in the row nearest to the middle.
    """
    steps = np.diff(np.pad(shows, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    rows, starts = np.nonzero(steps == 1)
    lengths = np.nonzero(steps == -1)[1] - starts
    long = np.flatnonzero(lengths >= _LONG * lengths.max())
    best = long[np.abs(rows[long] - shows.shape[0] // 2).argmin()]
    return int(starts[best] + lengths[best] // 2), int(rows[best])


def _covers(text: tuple[int, int, int, int], taken: list[tuple[int, int, int, int]]) -> bool:
    """Return whether a text would cover or touch one of others, by x, y, width and height."""
    left, top, wide, high = text
    return any(
        left < x + w + 2 * _GAP
        and x < left + wide + 2 * _GAP
        and top < y + h + 2 * _GAP
        and y < top + high + 2 * _GAP
        for x, y, w, h in taken
    )
