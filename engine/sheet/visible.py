"""What shows in a panel: pixels and boxes of nodes, materials and parts, and what hides them.

In: the IDs of the panel's pixels. Out: plain records. All of it is counting, the same everywhere.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..geometry.mesh import Mesh
from ..motion.shown import source_of
from ..rendering.frame import Frame
from ..scene.instances import InstancedMesh
from ..scene.nodes import Node
from ..scene.scene import Scene


class Shown(NamedTuple):
    """Pixels of one kind.

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


def covered(frame: Frame, own_ids: np.ndarray) -> np.ndarray:
    """Return which pixels show nodes of the scene's own, (H, W) bool."""
    ids = frame.object_id
    known = np.zeros(max(int(ids.max()), int(own_ids.max(initial=-1))) + 2, bool)
    known[own_ids] = True  # the last one is of the background's -1
    return known[ids]


def box_of(mask: np.ndarray) -> tuple[int, int, int, int] | None:
    """Return x, y, width and height of what is marked, or None."""
    columns, rows = np.flatnonzero(mask.any(axis=0)), np.flatnonzero(mask.any(axis=1))
    if not len(columns):
        return None
    left, top = int(columns[0]), int(rows[0])
    return left, top, int(columns[-1]) - left + 1, int(rows[-1]) - top + 1


def count_by_key(keys: np.ndarray, mask: np.ndarray) -> list[Shown]:
    """Return the pixels of each key, in the order of keys.

    Parameters
    ----------
    keys : (H, W) int
    mask : (H, W) bool
        The pixels that count.
    """
    box = box_of(mask)
    if box is None:
        return []
    left, top, width, height = box
    window = slice(top, top + height), slice(left, left + width)
    mask = mask[window]
    given = keys[window][mask]
    first = int(given[0])
    if (given == first).all():
        return [Shown(first, len(given), box)]
    rows, columns = np.nonzero(mask)
    order = np.argsort(given, kind="stable")
    given, rows, columns = given[order], rows[order] + top, columns[order] + left
    starts = np.flatnonzero(np.concatenate([[True], given[1:] != given[:-1]]))
    counts = np.diff(np.append(starts, len(given)))
    lefts, rights = (f.reduceat(columns, starts) for f in (np.minimum, np.maximum))
    tops, bottoms = (f.reduceat(rows, starts) for f in (np.minimum, np.maximum))
    sizes = rights - lefts + 1, bottoms - tops + 1
    table = np.stack([given[starts], counts, lefts, tops, *sizes], axis=1).tolist()
    return [Shown(key, pixels, (x, y, w, h)) for key, pixels, x, y, w, h in table]


def joined(shown: list[Shown], key: int) -> Shown | None:
    """Return what several kinds are together, or None without any."""
    if not shown:
        return None
    boxes = [one.box for one in shown]
    left, top = min(box[0] for box in boxes), min(box[1] for box in boxes)
    right = max(box[0] + box[2] for box in boxes)
    bottom = max(box[1] + box[3] for box in boxes)
    size = right - left, bottom - top
    return Shown(key, sum(one.pixels for one in shown), (left, top, *size))


def mesh_of_node(node: Node) -> Mesh | None:
    """Return the mesh that a node draws, of which frames show IDs."""
    thing = source_of(node._drawn)
    if isinstance(thing, InstancedMesh):
        thing = thing.mesh
    return thing if isinstance(thing, Mesh) else None


class PartShown(NamedTuple):
    """Pixels of a named group of a node's faces."""

    node: int
    name: str
    pixels: int
    box: tuple[int, int, int, int]


def count_parts(frame: Frame, mask: np.ndarray, scene: Scene) -> Iterator[PartShown]:
    """Yield the named groups of faces that show, node by node."""
    for node in scene.nodes:
        mesh = mesh_of_node(node)
        if mesh is None or not mesh.groups:
            continue
        own = mask & (frame.object_id == node.id) & (frame.triangle_id >= 0)
        faces = count_by_key(frame.triangle_id, own)
        if not faces:
            continue
        place = np.full(len(mesh.faces), -1)
        place[[face.key for face in faces]] = np.arange(len(faces))
        for name, group in mesh.groups.items():
            found = np.unique(place[group])
            part = joined([faces[number] for number in found[found >= 0].tolist()], 0)
            if part is not None:
                yield PartShown(node.id, name, part.pixels, part.box)
