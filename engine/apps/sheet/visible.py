"""Counts the visible pixels of nodes, materials and parts in a panel, with boxes and occluders.

In: the IDs of the panel's pixels. Out: plain records. All of it is counting, the same everywhere.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ...model.geometry.mesh import Mesh
from ...model.scene.instances import InstancedMesh
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...rendering.frame import Frame

#: Colours within this difference cannot be told from the background.
SAME_COLOUR = 6


class Shown(NamedTuple):
    """The visible pixels of one key.

    Attributes
    ----------
    key : int
    pixels : int
    box : (int, int, int, int)
        x, y, width, height in the panel.
    """

    key: int
    pixels: int
    box: tuple[int, int, int, int]


def contrast(frame: Frame, shown: np.ndarray, ground: tuple[int, int, int]) -> int:
    """Return the largest difference in codes between visible pixels and the background."""
    most = 0
    for channel, code in enumerate(ground):
        codes = frame.color[..., channel][shown]
        if len(codes):
            most = max(most, int(codes.max()) - code, code - int(codes.min()))
    return most


def box_of(mask: np.ndarray) -> tuple[int, int, int, int] | None:
    """Return x, y, width and height of a mask's bounding box, or None."""
    columns, rows = np.flatnonzero(mask.any(axis=0)), np.flatnonzero(mask.any(axis=1))
    if not len(columns):
        return None
    left, top = int(columns[0]), int(rows[0])
    return left, top, int(columns[-1]) - left + 1, int(rows[-1]) - top + 1


def count_by_key(keys: np.ndarray, mask: np.ndarray) -> list[Shown]:
    """Return the pixels of each key, in key order.

    Parameters
    ----------
    keys : (H, W) int
    mask : (H, W) bool
        The pixels that count.
    """
    table = _count(keys, mask).tolist()
    return [Shown(key, pixels, (x, y, r - x, b - y)) for key, pixels, x, y, r, b in table]


def _count(keys: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """Return rows of keys, pixel counts, and box edges left, top, right and bottom, (K, 6)."""
    box = box_of(mask)
    if box is None:
        return np.zeros((0, 6), np.int64)
    left, top, width, height = box
    window = slice(top, top + height), slice(left, left + width)
    mask = mask[window]
    given = keys[window][mask]
    first = int(given[0])
    if (given == first).all():
        return np.array([[first, len(given), left, top, left + width, top + height]])
    rows, columns = np.nonzero(mask)
    order = np.argsort(given, kind="stable")
    given, rows, columns = given[order], rows[order] + top, columns[order] + left
    starts = np.flatnonzero(np.concatenate([[True], given[1:] != given[:-1]]))
    counts = np.diff(np.append(starts, len(given)))
    lows = [np.minimum.reduceat(places, starts) for places in (columns, rows)]
    highs = [np.maximum.reduceat(places, starts) + 1 for places in (columns, rows)]
    return np.stack([given[starts], counts, *lows, *highs], axis=1)


def joined(shown: list[Shown], key: int) -> Shown | None:
    """Return several counts merged, or None if there are none."""
    if not shown:
        return None
    boxes = [one.box for one in shown]
    left, top = min(box[0] for box in boxes), min(box[1] for box in boxes)
    right = max(box[0] + box[2] for box in boxes)
    bottom = max(box[1] + box[3] for box in boxes)
    size = right - left, bottom - top
    return Shown(key, sum(one.pixels for one in shown), (left, top, *size))


def mesh_of_node(node: Node) -> Mesh | None:
    """Return the mesh that a node draws, to which the IDs in frames refer."""
    thing = node.object
    if isinstance(thing, InstancedMesh):
        thing = thing.mesh
    return thing if isinstance(thing, Mesh) else None


class PartShown(NamedTuple):
    """The visible pixels of a named group of a node's faces."""

    node: int
    name: str
    pixels: int
    box: tuple[int, int, int, int]


def count_parts(frame: Frame, mask: np.ndarray, scene: Scene) -> Iterator[PartShown]:
    """Yield the visible named groups of faces, node by node."""
    nodes = {node.id: node for node in scene.nodes}
    for shown in count_by_key(frame.object_id, mask & (frame.face_id >= 0)):
        mesh = mesh_of_node(nodes[shown.key])
        if mesh is not None and mesh.groups:
            for name, pixels, box in _groups(frame, mask, shown, mesh):
                yield PartShown(shown.key, name, pixels, box)


def _groups(frame: Frame, mask: np.ndarray, shown: Shown, mesh: Mesh):
    """Yield name, pixels and box of each group of a mesh, within its node's pixels."""
    x, y, width, height = shown.box
    window = slice(y, y + height), slice(x, x + width)
    faces = frame.face_id[window]
    table = _count(faces, mask[window] & (frame.object_id[window] == shown.key) & (faces >= 0))
    place = np.full(len(mesh.faces), -1)
    place[table[:, 0]] = np.arange(len(table))
    for name, group in mesh.groups.items():
        found = np.zeros(len(table) + 1, bool)
        found[place[group]] = True  # the last entry is for invisible faces
        rows = table[found[:-1]]
        if len(rows):
            left, top = (int(low) for low in rows[:, 2:4].min(axis=0))
            right, bottom = (int(high) for high in rows[:, 4:].max(axis=0))
            yield name, int(rows[:, 1].sum()), (x + left, y + top, right - left, bottom - top)
