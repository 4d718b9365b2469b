"""The rows of a scene's tree in a panel, with open nodes and search results.

In: a scene, its open nodes, a search text. Out: the rows from top to bottom. They are recomputed
only when the tree, a searched name, or the open nodes change; for nodes that merely move, only two
numbers and the links are compared.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple
from weakref import WeakSet

import numpy as np

from ..._native.scene_graph import ALIVE
from ...model.scene.nodes import Node, with_below
from ...model.scene.scene import Scene


class Row(NamedTuple):
    """A row of the tree.

    Attributes
    ----------
    node : Node
    depth : int
        0 at the top.
    has_children : bool
        Whether there is something to open.
    is_open : bool
        Whether the children, those that the search lets through, stand below.
    is_match : bool
        Whether the search found the node itself; False also without a search.
    """

    node: Node
    depth: int
    has_children: bool
    is_open: bool
    is_match: bool


class Rows(Sequence[Row]):
    """The rows of a tree, from top to bottom, created on demand.

    Parameters
    ----------
    nodes : list of Node or None
        By slot, as all of these but the depths:
    first_child : list of int
    is_open, is_match : bytes-like
    slots, depths : list of int
        Of the rows.
    """

    def __init__(self, nodes: list, first_child, is_open, is_match, slots, depths) -> None:
        self._nodes, self._first_child = nodes, first_child
        self._is_open, self._is_match = is_open, is_match
        self._slots, self._depths = slots, depths
        self._places: dict[Node, int] | None = None

    def __len__(self) -> int:
        return len(self._slots)

    def __getitem__(self, index):
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        slot = self._slots[index]
        has_children = self._first_child[slot] >= 0
        is_open = has_children and self._is_open[slot] > 0
        node, depth = self._nodes[slot], self._depths[index]
        return Row(node, depth, has_children, is_open, self._is_match[slot] > 0)

    def place(self, node: Node) -> int | None:
        """Return the index of a node's row; None if it has none."""
        if self._places is None:
            self._places = {self._nodes[slot]: k for k, slot in enumerate(self._slots)}
        return self._places.get(node)

    def between(self, first: Node, last: Node) -> tuple[Node, ...]:
        """Return the nodes from one row to another, inclusive, in row order."""
        places = [place for place in map(self.place, (first, last)) if place is not None]
        slots = self._slots[min(places) : max(places) + 1] if places else ()
        return tuple(self._nodes[slot] for slot in slots)


class Hierarchy:
    """The tree of a scene, shown in rows.

    Parameters
    ----------
    scene : Scene
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._open: WeakSet[Node] = WeakSet()
        self._search = ""
        self._openings = 0
        self._rows = Rows([], [], b"", b"", [], [])
        self._made_of: tuple = ()
        self._looked: tuple = ()
        self._links: list[np.ndarray] = []
        self._names: tuple[tuple[int, int], list[str]] | None = None

    @property
    def search(self) -> str:
        """The text that names must contain, ignoring case; "" shows all open nodes.

        What is found is shown with all that is above it, whether that is open or not.
        """
        return self._search

    @search.setter
    def search(self, text: str) -> None:
        self._search = str(text).strip().casefold()

    def is_open(self, node: Node) -> bool:
        """Return whether a node's children are shown."""
        return node in self._open

    def set_open(self, node: Node, is_open: bool, *, below: bool = False) -> None:
        """Show or hide a node's children; with ``below``, also those of its whole subtree."""
        self._set_open(with_below(node) if below else [node], is_open)

    def reveal(self, node: Node) -> None:
        """Open all ancestors of a node."""
        self._set_open(_above(node), True)

    def _set_open(self, nodes: Iterable[Node], is_open: bool) -> None:
        (self._open.update if is_open else self._open.difference_update)(nodes)
        self._openings += 1

    def rows(self) -> Rows:
        """Return the rows of the current tree: the same object until one of them changes."""
        names = self._tree(), self._scene.data.renames
        key = names if self._search else names[:1], self._openings, self._search
        if key != self._made_of:
            self._rows, self._made_of = self._found(names), key
        return self._rows

    def _tree(self) -> int:
        """Return a number that grows with every change of the tree."""
        arrays = self._scene.data.arrays
        looked = arrays, arrays.changes
        if self._looked[:2] != looked:
            count = arrays.count
            links = [arrays.columns[name][:count] for name in ("flags", "parent", "next", "id")]
            links[0] = links[0] & ALIVE
            same = len(links) == len(self._links) and all(map(np.array_equal, links, self._links))
            version = self._looked[2] + (not same) if self._looked else 0
            if not same:
                self._links = [link.copy() for link in links]
            self._looked = (*looked, version)
        return self._looked[2]

    def _found(self, names: tuple[int, int]) -> Rows:
        arrays = self._scene.data.arrays
        count = arrays.count
        links = (arrays.columns[name][:count] for name in ("parent", "first_child", "next"))
        parent, first, following = (link.tolist() for link in links)
        tops = np.flatnonzero((arrays.columns["parent"][:count] < 0) & self._links[0]).tolist()
        matches = self._matches(names)
        shown = bytearray(b"\1" * count) if matches is None else _with_above(matches, parent)
        is_open = shown if matches is not None else self._open_slots(count)
        slots, depths = _walk(tops, parent, first, following, shown, is_open)
        return Rows(list(arrays.nodes), first, is_open, matches or bytes(count), slots, depths)

    def _open_slots(self, count: int) -> bytearray:
        is_open = bytearray(count)
        slots = self._scene.data.slots_of(self._open)
        for slot in slots[slots >= 0].tolist():
            is_open[slot] = 1
        return is_open

    def _matches(self, key: tuple[int, int]) -> bytes | None:
        """Return the slots that the search finds; None without a search."""
        text = self._search
        if not text:
            return None
        if self._names is None or self._names[0] != key:
            self._names = key, [name.casefold() for name in self._scene.data.names()]
        return bytes([text in name for name in self._names[1]])


def _with_above(matches: bytes, parent: list[int]) -> bytearray:
    """Mark search results and all their ancestors."""
    shown = bytearray(len(matches))
    at = matches.find(1)
    while at >= 0:
        above = at
        while above >= 0 and not shown[above]:
            shown[above] = 1
            above = parent[above]
        at = matches.find(1, at + 1)
    return shown


def _walk(tops, parent, first, following, shown, is_open) -> tuple[list[int], list[int]]:
    """Return the slots of visible rows, and their depths: parents first."""
    slots, depths = [], []
    for top in tops:
        at, depth = top, 0
        while True:
            if shown[at]:
                slots.append(at)
                depths.append(depth)
            if is_open[at] and shown[at] and first[at] >= 0:
                at, depth = first[at], depth + 1
                continue
            while at != top and following[at] < 0:
                at, depth = parent[at], depth - 1
            if at == top:
                break
            at = following[at]
    return slots, depths


def _above(node: Node) -> Iterator[Node]:
    above = node.parent
    while above is not None:
        yield above
        above = above.parent
