"""Lengths of lines beside those of Open CASCADE's hidden-line removal of the same triangles."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d._native import drawing as native

pytest.importorskip("OCP", exc_type=ImportError)

from drawings import occt_parts as occt

#: Lines nearer to each other than this, in millimetres, are one stroke for both.
NEAR = 0.1
#: Whose lines Open CASCADE finds by interpolation within triangles, hidden ones above all.
ROUND = ("shaft", "pipe", "ball")


def length(shown, hidden):
    """Return the lengths of visible and of hidden strokes, each counted once."""
    segments = np.concatenate([shown, hidden]).reshape(-1, 4)
    pieces = native.hide_repeated(np.ascontiguousarray(segments), NEAR, 1)
    pieces = pieces[pieces["is_hidden"] == 0]
    ends = segments[pieces["line"]]
    sizes = np.hypot(ends[:, 2] - ends[:, 0], ends[:, 3] - ends[:, 1])
    sizes *= pieces["to"] - pieces["from"]
    is_shown = pieces["line"] < len(shown)
    return sizes[is_shown].sum(), sizes[~is_shown].sum()


def own_lines(mesh, view):
    drawing = e3d.drawings.line_drawing(
        mesh, occt.camera(view), size=(1000, 1000), scale=1.0, intersections=False, threads=1
    )
    return drawing.pieces.of(hidden=False).ends, drawing.pieces.of(hidden=True).ends


@pytest.mark.slow
@pytest.mark.parametrize("part", occt.PARTS, ids=lambda part: part.__name__)
def test_lengths_are_those_of_open_cascade(part):
    shape = part()
    mesh = e3d.Mesh(*occt.tessellate(shape, 0.05))
    for view in occt.VIEWS:
        shown, hidden, _ = occt.poly_lines(shape, view)
        wanted, wanted_hidden = length(shown, hidden)
        found, found_hidden = length(*own_lines(mesh, view))
        assert found == pytest.approx(wanted, rel=0.008), view
        rel = 0.1 if part.__name__ in ROUND else 0.015
        assert found_hidden == pytest.approx(wanted_hidden, rel=rel, abs=5.0), view
