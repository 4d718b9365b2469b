"""The command that repeats nodes in rows, columns and layers.

In: nodes, how many along each axis, and how far apart. Out: copies with their subtrees.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np

from ...base.language import translated
from ...errors import InvalidArgumentError
from ...model.scene.nodes import Node, with_below
from ...model.scene.scene import Scene
from .new_things.free_names import FreeNames
from .node_commands import AddNodes, copy_nodes, counted
from .selection import topmost

#: The most places of an array.
MOST_PLACES = 10_000
#: How far apart copies stand at first, in sizes of what is copied.
_APART = 1.5


class ArrayNodes(AddNodes):
    """Adds copies of nodes in rows along the axes of their parents; the originals begin the rows.

    Copies share meshes and move as their originals, as those of `DuplicateNodes`.

    Parameters
    ----------
    scene : Scene
    nodes : sequence of Node
    counts : sequence of int
        How many along X, Y and Z, the original counted.
    steps : sequence of float
        How far apart along X, Y and Z, in units of the parents.

    Raises
    ------
    InvalidArgumentError
        There is nothing to add, or more than `MOST_PLACES` places.
    """

    def __init__(
        self, scene: Scene, nodes: Sequence[Node], counts: Sequence[int], steps: Sequence[float]
    ) -> None:
        places = math.prod(counts)
        if not 1 < places <= MOST_PLACES or min(counts) < 1:
            raise InvalidArgumentError(
                f"an array needs 2 to {MOST_PLACES} places, not {places}: its counts are {counts}"
            )
        originals = topmost(nodes)

        def add(scene: Scene) -> None:
            names = FreeNames(scene.data.names())
            for place in itertools.islice(itertools.product(*map(range, counts)), 1, None):
                _copy_to(scene, originals, np.multiply(place, steps), names)

        super().__init__(scene, add, counted(translated("Make an array of"), originals))


def _copy_to(scene: Scene, originals: Sequence[Node], offset: np.ndarray, names: FreeNames) -> None:
    for twin in copy_nodes(scene, {node: node.parent for node in originals}, names):
        pose = twin.pose.copy()
        pose[:3, 3] += offset
        twin.pose = pose


def usual_steps(nodes: Sequence[Node]) -> tuple[float, float, float]:
    """Return how far apart copies of nodes stand clear of each other along X, Y and Z."""
    boxes = [box for node in nodes for each in with_below(node) if (box := each.bounds) is not None]
    if not boxes:
        return 1.0, 1.0, 1.0
    size = np.max([box[1] for box in boxes], axis=0) - np.min([box[0] for box in boxes], axis=0)
    largest = float(size.max())
    x, y, z = (float(f"{_APART * (side or largest or 1.0):.3g}") for side in size.tolist())
    return x, y, z
