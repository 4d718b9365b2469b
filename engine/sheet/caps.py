"""The faces of a cut: the pixels of a section at which its plane goes through something.

In: a panel whose camera's near plane cuts the scene. Out: which node each pixel goes through, and
the areas. Of nodes whose outlines do not close, as in open meshes, a pixel counts as cut where what
is nearest turns its back.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from .. import linalg
from ..materials.material import Material
from ..rendering.frame import Frame
from ..scene.cameras import Camera
from ..scene.scene import Scene
from ..scene.usage import uses_in
from .cutting import Outline, Plane, area_of, cut_nodes, inside, is_closed
from .layout import Rectangle
from .studio import Studio

#: Cut material and its hatching.
_CUT, _HATCH = (232, 164, 124), (150, 78, 44)
#: Pixels from one line of the hatching to the next.
_PITCH = 9


class CutNode(NamedTuple):
    """What is cut of a node: pixels that show it, and square units, None where it is open."""

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
    studio: Studio,
    plane: Plane,
    camera: Camera,
    pose: np.ndarray,
    rectangle: Rectangle,
    shown: Frame,
) -> Caps:
    """Return the cut faces of a panel.

    Parameters
    ----------
    studio, plane, camera, pose, rectangle
        Of the panel.
    shown : Frame
        Drawn with both sides of all faces.
    """
    wanted = set(studio.own_ids.tolist())
    nodes = [node for node in studio.scene.nodes if node.id in wanted]
    outlines = cut_nodes(nodes, plane)
    closed = [is_closed(outline.segments) for outline in outlines]
    areas = [area_of(outline.segments, plane) for outline in outlines]
    backs = None if all(closed) else _backs(studio, camera, pose, rectangle, shown)
    ids = np.full(shown.depth.shape, -1, np.int64)
    # What lies within something else is painted over it.
    for number in sorted(range(len(outlines)), key=lambda k: -areas[k]):
        outline = outlines[number]
        if closed[number]:
            ends = _on_panel(outline, camera, pose, rectangle)
            mask = inside(ends, rectangle.width, rectangle.height)
        else:
            mask = backs & (shown.object_id == outline.node)
        ids[mask] = outline.node
    nodes = [
        CutNode(outline.node, int((ids == outline.node).sum()), area if is_whole else None)
        for outline, area, is_whole in zip(outlines, areas, closed, strict=True)
    ]
    return Caps(ids, nodes)


def _on_panel(
    outline: Outline, camera: Camera, pose: np.ndarray, rectangle: Rectangle
) -> np.ndarray:
    """The ends of segments in the panel's pixels, (N, 2, 2)."""
    projection = np.array(camera.projection(rectangle.width, rectangle.height), np.float64)
    clip = linalg.multiply(projection, linalg.inverse(pose))
    x, y = (linalg.dot(outline.segments, row[:3]) + row[3] for row in clip[:2])
    return np.stack(
        [(x + 1.0) * (0.5 * rectangle.width), (1.0 - y) * (0.5 * rectangle.height)], axis=-1
    )


def _backs(
    studio: Studio, camera: Camera, pose: np.ndarray, rectangle: Rectangle, shown: Frame
) -> np.ndarray:
    """Where what is nearest turns its back, (H, W) bool."""
    with _one_sided(studio.scene):
        fronts = studio.render(camera, pose, rectangle, outputs=("depth",), cull="back").depth
    return (shown.depth > 0) & ((fronts > shown.depth) | (fronts == 0))


@contextlib.contextmanager
def _one_sided(scene: Scene) -> Iterator[None]:
    """Let no material of a scene show its back, for a while."""
    materials = [
        thing for thing in uses_in([scene]) if isinstance(thing, Material) and thing.two_sided
    ]
    try:
        for material in materials:
            material.two_sided = False
        yield
    finally:
        for material in materials:
            material.two_sided = True


def paint_caps(color: np.ndarray, ids: np.ndarray) -> None:
    """Paint cut material, hatched: in two directions, by the ids of nodes.

    Parameters
    ----------
    color : (H, W, 4) uint8
    ids : (H, W) int64
        As of `Caps`.
    """
    rows, columns = np.nonzero(ids >= 0)
    flipped = ids[rows, columns] % 2 == 1
    stripes = np.where(flipped, columns - rows, columns + rows) % _PITCH == 0
    color[rows, columns, :3] = np.where(stripes[:, np.newaxis], _HATCH, _CUT)
