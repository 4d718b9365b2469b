"""The cut faces of a section: the pixels where its plane passes through objects.

In: nodes, and a camera whose near plane cuts them. Out: the cut node of each pixel, and the areas.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from ...base import linalg
from ...model.measuring.cutting import Plane, area_of, cut_nodes, gaps_of, inside
from ...model.scene.cameras import Camera
from ...model.scene.nodes import Node
from ...stage.inspection.cut_faces import CUT, HATCH
from .layout import Rectangle

#: Pixels between lines of the hatching.
_PITCH = 9


class CutNode(NamedTuple):
    """The cut of a node: its pixel count and its area, None if it is open."""

    node: int
    pixels: int
    area: float | None


class Caps(NamedTuple):
    """The cut faces of a panel.

    Attributes
    ----------
    ids : (H, W) ndarray of int64
        The node that is cut, -1 for none.
    nodes : list of CutNode
    """

    ids: np.ndarray
    nodes: list[CutNode]


def find_caps(
    nodes: Iterable[Node], plane: Plane, camera: Camera, pose: np.ndarray, rectangle: Rectangle
) -> Caps:
    """Return the cut faces of a panel.

    Parameters
    ----------
    nodes : iterable of Node
        Those of the scene.
    plane, camera, pose, rectangle
        Of the panel.
    """
    outlines = cut_nodes(nodes, plane)
    areas = [area_of(outline.segments, plane) for outline in outlines]
    gaps = [gaps_of(outline.segments) for outline in outlines]
    ids = np.full((rectangle.height, rectangle.width), -1, np.int64)
    # An outline inside another is painted over it.
    for number in sorted(range(len(outlines)), key=lambda k: -areas[k]):
        if gaps[number] is not None:
            closed = np.concatenate([outlines[number].segments, gaps[number]])
            ends = _on_panel(closed, camera, pose, rectangle)
            ids[inside(ends, rectangle.width, rectangle.height)] = outlines[number].node
    cuts = []
    for outline, area, gap in zip(outlines, areas, gaps, strict=True):
        is_closed = gap is not None and not len(gap)
        pixels = int(np.count_nonzero(ids == outline.node))
        cuts.append(CutNode(outline.node, pixels, area if is_closed else None))
    return Caps(ids, cuts)


def _on_panel(
    segments: np.ndarray, camera: Camera, pose: np.ndarray, rectangle: Rectangle
) -> np.ndarray:
    """Return the ends of segments in the panel's pixels, (N, 2, 2)."""
    projection = np.array(camera.projection((rectangle.width, rectangle.height)), np.float64)
    clip = linalg.multiply(projection, linalg.inverse(pose))
    x, y = (linalg.dot(segments, row[:3]) + row[3] for row in clip[:2])
    return np.stack(
        [(x + 1.0) * (0.5 * rectangle.width), (1.0 - y) * (0.5 * rectangle.height)], axis=-1
    )


def paint_caps(color: np.ndarray, ids: np.ndarray) -> None:
    """Paint hatched cut material, in two directions depending on node IDs.

    Parameters
    ----------
    color : (H, W, 4) uint8
    ids : (H, W) int64
        As of `Caps`.
    """
    rows, columns = np.nonzero(ids >= 0)
    flipped = ids[rows, columns] % 2 == 1
    stripes = np.where(flipped, columns - rows, columns + rows) % _PITCH == 0
    color[rows, columns, :3] = np.where(stripes[:, np.newaxis], HATCH, CUT)
