"""The selected nodes, in the order of selection.

In: nodes. Out: the selected nodes still in the scene. The last one is the active one, whose
properties panels show.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...model.scene.nodes import Node


class Selection:
    """The nodes that commands apply to.

    Attributes
    ----------
    version : int
        Grows whenever other nodes are selected.
    """

    def __init__(self) -> None:
        self._nodes: dict[Node, None] = {}
        self.version = 0

    @property
    def nodes(self) -> tuple[Node, ...]:
        """The selected nodes, the active one last."""
        gone = [node for node in self._nodes if node.scene is None]
        for node in gone:
            del self._nodes[node]
        self.version += bool(gone)
        return tuple(self._nodes)

    @property
    def active(self) -> Node | None:
        """The node that was selected last."""
        nodes = self.nodes
        return nodes[-1] if nodes else None

    def set(self, nodes: Iterable[Node] = ()) -> None:
        """Select exactly these nodes."""
        chosen = dict.fromkeys(nodes)
        if list(chosen) != list(self._nodes):
            self._nodes = chosen
            self.version += 1

    def add(self, nodes: Iterable[Node]) -> None:
        """Add nodes to the selection; the last one becomes active."""
        more = dict.fromkeys(nodes)
        self.set([*(node for node in self._nodes if node not in more), *more])

    def toggle(self, node: Node) -> None:
        """Add a node to the selection, or remove it."""
        if node in self._nodes:
            self.set([other for other in self._nodes if other is not node])
        else:
            self.add([node])

    def __contains__(self, node: object) -> bool:
        return node in self._nodes

    def __len__(self) -> int:
        return len(self.nodes)

    def topmost(self) -> tuple[Node, ...]:
        """Return the selected nodes without selected ancestors."""
        return topmost(self.nodes)


def topmost(nodes: Iterable[Node]) -> tuple[Node, ...]:
    """Return the given nodes without ancestors among them, in order."""
    chosen = dict.fromkeys(nodes)
    return tuple(node for node in chosen if not _is_below_any(node, chosen))


def _is_below_any(node: Node, others: dict[Node, None]) -> bool:
    above = node.parent
    while above is not None:
        if above in others:
            return True
        above = above.parent
    return False
