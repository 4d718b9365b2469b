"""The kinds of artists that stand in space: how each is drawn, or why one cannot be.

In: the children of axes. Out: for each its `Kind`, or the reason why mplot3d draws it on top.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from mpl_toolkits.mplot3d import art3d

from ._lines import draw_line, draw_line_collection, points_of
from ._paths import draw_contours, draw_patch, draw_scatter
from ._polygons import draw_edges, is_plain


class Kind(NamedTuple):
    """A kind of artists.

    Attributes
    ----------
    cls : type
    methods : tuple of str
        What decides on the look: a class with one of its own is not drawn.
    points : function of artist
        Its points, (..., 3), in data coordinates; those that do not count are not a number.
    draw : function of pile, view, artist, painter
        Adds it to a pile; of polygons the edges, of texts nothing: they come last.
    against : function of artist
        Why this one cannot be drawn, or None.
    """

    cls: type
    methods: tuple[str, ...]
    points: Callable
    draw: Callable
    against: Callable


def kind_of(artist) -> Kind | None:
    """Return the kind of an artist, or None if it is flat: a legend, a text on the page."""
    return next((kind for kind in KINDS if isinstance(artist, kind.cls)), None)


def reason_against(artist, kind: Kind, axes) -> str | None:
    """Return why an artist cannot be drawn through the depth buffer; None if it can."""
    for name in kind.methods:
        if not _is_theirs(getattr(type(artist), name)):
            return f"its class has a method {name} of its own"
    if artist.get_path_effects() and kind is not TEXT:
        return "it has path effects"
    if artist.get_sketch_params() is not None and kind is not TEXT:
        return "it is sketched"
    if artist.get_agg_filter() is not None:
        return "it has a filter"
    if artist._clippath is not None or not _clips_as(artist, axes):
        return "it has a clip path of its own"
    return kind.against(artist)


def is_clipped(artist) -> bool:
    """Return whether what lies outside the axes' box is not drawn."""
    return bool(artist.get_clip_on()) and artist.get_clip_box() is not None


def stands_in_space(artist) -> bool:
    """Return whether an artist of no known kind is more than flat, or a program's own."""
    return hasattr(artist, "do_3d_projection") or not _is_theirs(type(artist).draw)


def _is_theirs(method) -> bool:
    """Return whether a method is matplotlib's own."""
    module = str(getattr(method, "__module__", ""))
    return module.partition(".")[0] in ("matplotlib", "mpl_toolkits")


def _clips_as(artist, axes) -> bool:
    box = artist.get_clip_box()
    return box is None or not artist.get_clip_on() or np.allclose(box.extents, axes.bbox.extents)


# ---- points ----


def _rows(parts) -> np.ndarray:
    """Return the points of several arrays, of which some may be masked."""
    rows = [np.ma.filled(np.ma.asarray(one, float), np.nan).reshape(-1, 3) for one in parts]
    return np.concatenate(rows) if rows else np.empty((0, 3))


def _points_of_polygons(artist) -> np.ndarray:
    faces = artist._faces
    invalid = np.broadcast_to(artist._invalid_vertices, faces.shape[:2])
    return faces[~invalid] if invalid.any() else faces


def _points_of_scatter(artist) -> np.ndarray:
    xyz = artist._offsets3d
    return np.stack([np.ma.filled(np.ma.asarray(one, float), np.nan) for one in xyz], -1)


# ---- reasons ----


def _against_polygons(artist) -> str | None:
    if artist.get_hatch():
        return "it is hatched"
    codes = artist._codes3d
    if codes is not None and not all(is_plain(one) for one in codes):
        return "its polygons have curves or holes"
    return None


def _against_segments(artist) -> str | None:
    faces = artist.get_facecolor()
    if len(faces) and np.any(faces[:, 3]):
        return "its lines are filled"
    return "its gaps have a colour" if getattr(artist, "_gapcolor", None) is not None else None


def _against_contours(artist) -> str | None:
    if len(artist.get_offsets()) > 1:
        return "its paths are moved"
    return "it is hatched" if artist.get_hatch() or any(getattr(artist, "hatches", ())) else None


def _against_line(artist) -> str | None:
    return "it has steps" if artist.get_drawstyle() != "default" else None


def _against_scatter(artist) -> str | None:
    return "it is hatched" if artist.get_hatch() else None


def _nothing(*_) -> None:
    return None


_PROJECTED = ("draw", "do_3d_projection")
POLYGONS = Kind(
    *(art3d.Poly3DCollection, _PROJECTED, _points_of_polygons),
    *(lambda pile, view, artist, _: draw_edges(pile, view, artist), _against_polygons),
)
SCATTER = Kind(
    *(art3d.Path3DCollection, (*_PROJECTED, "get_facecolor", "get_edgecolor")),
    *(_points_of_scatter, lambda pile, view, artist, _: draw_scatter(pile, view, artist)),
    _against_scatter,
)
LINE = Kind(
    *(art3d.Line3D, ("draw",), points_of),
    *(lambda pile, view, artist, _: draw_line(pile, view, artist), _against_line),
)
TEXT = Kind(
    *(art3d.Text3D, ("draw",), lambda artist: artist.get_position_3d(), _nothing, _nothing),
)
KINDS = (
    POLYGONS,
    Kind(
        *(art3d.Line3DCollection, _PROJECTED, lambda artist: _rows(artist._segments3d)),
        lambda pile, view, artist, _: draw_line_collection(pile, view, artist),
        _against_segments,
    ),
    SCATTER,
    Kind(
        *(art3d.Collection3D, ("do_3d_projection",)),
        lambda artist: _rows(vertices for vertices, _ in artist._3dverts_codes),
        *(draw_contours, _against_contours),
    ),
    LINE,
    Kind(art3d.Patch3D, ("draw",), lambda artist: artist._segment3d, draw_patch, _nothing),
    TEXT,
)
