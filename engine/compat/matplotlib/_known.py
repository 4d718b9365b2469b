"""Which artists are drawn through the depth buffer, and why others are not.

In: the children of axes. Out: for each its kind, or the reason why mplot3d draws it on top.
"""

from __future__ import annotations

import numpy as np
from matplotlib import artist as martist
from matplotlib.collections import LineCollection
from mpl_toolkits.mplot3d import art3d

from ._polygons import is_plain

#: By kind: the class, and the methods that decide what it looks like.
KINDS = {
    "polygons": (art3d.Poly3DCollection, ("draw", "do_3d_projection")),
    "segments": (art3d.Line3DCollection, ("draw", "do_3d_projection")),
    "scatter": (art3d.Path3DCollection, ("draw", "do_3d_projection", "get_facecolor", "get_edgecolor")),
    "contours": (art3d.Collection3D, ("do_3d_projection",)),
    "line": (art3d.Line3D, ("draw",)),
    "patch": (art3d.Patch3D, ("draw",)),
    "text": (art3d.Text3D, ("draw",)),
}
#: These fill areas; the others may lie on them.
SURFACES = ("polygons", "patch", "contours")


def kind_of(artist) -> str | None:
    """Return the kind of an artist, or None if it is flat: a legend, a text on the page."""
    return next((kind for kind, (cls, _) in KINDS.items() if isinstance(artist, cls)), None)


def reason_against(artist, kind: str, axes) -> str | None:
    """Return why an artist cannot be drawn through the depth buffer; None if it can."""
    cls, methods = KINDS[kind]
    own = type(artist)
    for name in methods:
        if not _is_theirs(getattr(own, name)):
            return f"its class has a method {name} of its own"
    if artist.get_path_effects() and kind != "text":
        return "it has path effects"
    if artist.get_sketch_params() is not None and kind != "text":
        return "it is sketched"
    if artist.get_agg_filter() is not None:
        return "it has a filter"
    if artist._clippath is not None or not _clips_as(artist, axes):
        return "it has a clip path of its own"
    return _REASONS.get(kind, _nothing)(artist)


def _is_theirs(method) -> bool:
    """Return whether a method is matplotlib's own."""
    return str(getattr(method, "__module__", "")).partition(".")[0] in ("matplotlib", "mpl_toolkits")


def _clips_as(artist, axes) -> bool:
    box = artist.get_clip_box()
    return box is None or not artist.get_clip_on() or np.allclose(box.extents, axes.bbox.extents)


def is_clipped(artist) -> bool:
    """Return whether what lies outside the axes' box is not drawn."""
    return bool(artist.get_clip_on()) and artist.get_clip_box() is not None


def _nothing(artist) -> None:
    return None


def _against_polygons(artist) -> str | None:
    if artist.get_hatch():
        return "it is hatched"
    codes = artist._codes3d
    if codes is not None and not all(is_plain(one) for one in codes):
        return "its polygons have curves or holes"
    return None


def _against_segments(artist) -> str | None:
    if len(artist.get_facecolor()) and np.any(artist.get_facecolor()[:, 3]):
        return "its lines are filled"
    if getattr(artist, "_gapcolor", None) is not None:
        return "its gaps have a colour"
    return None


def _against_contours(artist) -> str | None:
    if isinstance(artist, LineCollection) or len(artist.get_offsets()) > 1:
        return "its paths are moved"
    return "it is hatched" if artist.get_hatch() or any(getattr(artist, "hatches", ())) else None


def _against_line(artist) -> str | None:
    return "it has steps" if artist.get_drawstyle() != "default" else None


def _against_scatter(artist) -> str | None:
    return "it is hatched" if artist.get_hatch() else None


_REASONS = {
    "polygons": _against_polygons,
    "segments": _against_segments,
    "contours": _against_contours,
    "line": _against_line,
    "scatter": _against_scatter,
}


def looks_solid(artist) -> bool:
    """Return whether a program's own artist means to stand in space, or was never matplotlib's."""
    if hasattr(artist, "do_3d_projection"):
        return True
    return not _is_theirs(type(artist).draw) and isinstance(artist, martist.Artist)
