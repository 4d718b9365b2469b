"""Finds places that are free: on the ground, in view, beside what stands there.

In: a scene, a view, the size of what is to be placed. Out: a point on the ground. Places are the
cells of a grid around the point that one looks at; boxes of nodes take cells, and so do the icons
of lights, cameras and empties.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ...._native.scene_graph import SHOWN
from ....base import linalg
from ....model.scene.orbiting import home_axes
from ....model.scene.scene import Scene
from ....stage.views.viewpoint import Viewpoint

#: Cells from the middle to each side of the grid.
REACH = 24
#: How far apart cells are, in the size of what is placed.
APART = 1.25
#: Lines of sight less steep than this do not count as looking at the ground.
_LEVEL = 0.05
#: Looking farther than this many distances of the view is looking at the horizon.
_FAR = 3.0
_NEARLY = 1e-6
#: Half the side of an icon, in the size of what is placed.
_ICON = 0.25
#: What is flat and wider than this, in the size of what is placed, is a floor to stand on.
_FLOOR = 8.0


def free_place(scene: Scene, view: Viewpoint, size: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a point on the ground, (3,), where a box has room.

    Parameters
    ----------
    scene : Scene
    view : Viewpoint
    size : (3,) float64
        Of the box, in axes whose Y is up; the point is the middle of its underside. What is flat
        (0 high) finds room beneath boxes, but not where something flat lies.

    Returns
    -------
    place : (3,) float64
        Where one looks, if there is no room anywhere near.
    """
    axes = home_axes(view.up)
    width = max(float(size[0]), float(size[2]), _NEARLY)
    step = APART * width
    middle = _rounded(_looked_at(view, axes), step)
    boxes = np.concatenate([_boxes(scene, axes), _icons(scene, axes, width)])
    taken = _taken_cells(boxes, middle, size, step)
    row, column = _nearest_free(taken)
    across, back = middle[0] + column * step, middle[2] + row * step
    return axes[0] * across + axes[2] * back


def _looked_at(view: Viewpoint, axes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the point of the ground in the middle of the view, in the axes of the ground."""
    eye, ahead = (linalg.dot(axes, each) for each in (view.position(), -view.rotation()[:, 2]))
    if abs(float(ahead[1])) > _LEVEL:
        far = -float(eye[1]) / float(ahead[1])
        if 0.0 < far < _FAR * view.distance:
            return eye + ahead * far
    return linalg.dot(axes, view.target)


def _rounded(point: NDArray[np.float64], step: float) -> NDArray[np.float64]:
    """Return a point with short decimals, moved by less than half a step."""
    unit = 10.0 ** math.floor(math.log10(step)) / 2.0
    return np.round(point / unit) * unit + 0.0


def _boxes(scene: Scene, axes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the boxes of shown nodes in the axes of the ground, (N, 2, 3)."""
    scene.data.update()
    arrays = scene.data.arrays
    shown = arrays.columns["flags"][: arrays.count] & SHOWN != 0
    boxes = arrays.columns["bounds"][: arrays.count][shown, :6].reshape(-1, 2, 3)
    boxes = boxes[(boxes[:, 0] <= boxes[:, 1]).all(axis=1) & np.isfinite(boxes).all(axis=(1, 2))]
    middles = _along(axes, (boxes[:, 0] + boxes[:, 1]) / 2)
    halves = _along(np.abs(axes), (boxes[:, 1] - boxes[:, 0]) / 2)
    return np.stack([middles - halves, middles + halves], axis=1)


def places_without_surface(scene: Scene) -> NDArray[np.float64]:
    """Return where shown nodes stand that have no surface, none below them, (N, 3)."""
    scene.data.update()
    arrays = scene.data.arrays
    columns = {name: arrays.columns[name][: arrays.count] for name in ("flags", "bounds", "world")}
    ends = arrays.columns["first_child"][: arrays.count] < 0
    bare = columns["bounds"][:, 0] > columns["bounds"][:, 3]
    return columns["world"][(columns["flags"] & SHOWN != 0) & ends & bare][:, 3::4]


def _icons(scene: Scene, axes: NDArray[np.float64], width: float) -> NDArray[np.float64]:
    """Return the boxes of icons in the axes of the ground, (N, 2, 3)."""
    middles = _along(axes, places_without_surface(scene))
    return np.stack([middles - _ICON * width, middles + _ICON * width], axis=1)


def _along(axes: NDArray[np.float64], vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the parts of vectors, (N, 3), along axes, (3, 3): a row each."""
    return (vectors[:, np.newaxis] * axes).sum(axis=-1)


def _taken_cells(
    boxes: NDArray[np.float64], middle: NDArray[np.float64], size: NDArray[np.float64], step: float
) -> NDArray[np.bool_]:
    """Return which cells have no room for a box on the ground, by row and column."""
    taken = np.zeros((2 * REACH + 1, 2 * REACH + 1), bool)
    slack = _NEARLY * step
    upright = (boxes[:, 0, 1] < size[1] - slack) & (boxes[:, 1, 1] > slack)
    if size[1] < slack:
        wide = (boxes[:, 1] - boxes[:, 0])[:, ::2].max(axis=1) > _FLOOR * step
        upright |= (np.abs(boxes[:, :, 1]) < slack).all(axis=1) & ~wide
    low = (boxes[upright, 0][:, ::2] - size[::2] / 2 - middle[::2] + slack) / step
    high = (boxes[upright, 1][:, ::2] + size[::2] / 2 - middle[::2] - slack) / step
    first = np.clip(np.ceil(low) + REACH, 0, taken.shape[0]).astype(int)
    last = np.clip(np.floor(high) + REACH + 1, 0, taken.shape[0]).astype(int)
    for (left, top), (right, bottom) in zip(first.tolist(), last.tolist(), strict=True):
        if right - left < taken.shape[1] or bottom - top < taken.shape[0]:  # no sky around all
            taken[top:bottom, left:right] = True
    return taken


def _nearest_free(taken: NDArray[np.bool_]) -> tuple[int, int]:
    """Return row and column of the free cell nearest the middle, counted from there."""
    rows, columns = np.nonzero(~taken)
    if not len(rows):
        return 0, 0
    rows, columns = rows - REACH, columns - REACH
    # Of equally near ones the one to the right, then that in front.
    order = np.lexsort((-rows, -columns, rows * rows + columns * columns))
    return int(rows[order[0]]), int(columns[order[0]])
