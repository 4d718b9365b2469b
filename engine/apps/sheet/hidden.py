"""Measures how much of each node others hide, by drawing it alone.

In: a panel's camera and the scene. Out: how many pixels each node would have alone. Nodes that are
apart on the screen are drawn together, and what no other's box meets is not drawn at all.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...base import linalg
from ...model.scene.cameras import Camera
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...model.scene.shown import placing_pose, shown_object
from ...rendering.renderer import Renderer
from ...stage.visibility import DRAWABLE
from .layout import Rectangle

#: Maximum number of pictures per panel; further results stay unknown.
MOST_PICTURES = 64
_MOST_NODES = 2048
_ROOM = 2.0  # pixels by which boxes are enlarged, for wide lines and points


class AloneScene:
    """A scene with the same meshes at the same places, any of which may be hidden.

    Parameters
    ----------
    scene : Scene
    """

    def __init__(self, scene: Scene) -> None:
        scene.data.update()
        nodes = [node for node in scene.nodes if node.shown and isinstance(node.object, DRAWABLE)]
        self.ids = [node.id for node in nodes]
        self._scene = Scene(background=None)
        self._nodes = [self._copy(node) for node in nodes] if 1 < len(nodes) <= _MOST_NODES else []

    def _copy(self, node: Node) -> Node:
        return self._scene.add(shown_object(node), pose=placing_pose(node))

    def count(
        self, camera: Camera, pose: np.ndarray, rectangle: Rectangle, options: Mapping
    ) -> dict[int, int | None]:
        """Return how many pixels each possibly hidden node has alone.

        Parameters
        ----------
        camera, pose, rectangle
            Of the panel.
        options : Mapping
            ``cull``, ``backend`` and ``threads``.

        Returns
        -------
        dict
            By node id; None where it took too many pictures. Other nodes are hidden by none.
        """
        if not self._nodes:
            return {} if len(self.ids) <= 1 else dict.fromkeys(self.ids)
        boxes = self._boxes(camera, pose, rectangle)
        pictures = _apart(boxes)
        if len(pictures) > MOST_PICTURES:
            return dict.fromkeys(self.ids)
        found: dict[int, int | None] = {}
        selection = self._scene.select(self._nodes)
        drawing = {name: options[name] for name in ("backend", "threads") if name in options}
        with Renderer((rectangle.width, rectangle.height), **drawing) as renderer:
            for numbers in pictures:
                visible = np.zeros(len(self._nodes), bool)
                visible[numbers] = True
                selection.visible = visible
                ids = renderer.render(
                    self._scene,
                    (camera, pose),
                    cull=options["cull"],
                    point_size=options["point_size"],
                    outputs=("object_id",),
                    transparent_outputs=True,
                ).object_id
                counts = np.bincount(ids[ids >= 0], minlength=len(self._nodes))
                found |= {self.ids[n]: int(counts[self._nodes[n].id]) for n in numbers}
        return found

    def _boxes(self, camera: Camera, pose: np.ndarray, rectangle: Rectangle) -> np.ndarray:
        """Return boxes in the panel, (N, 4): left, top, right, bottom; the whole if unsure."""
        selection = self._scene.select(self._nodes)
        selection.visible = True
        corners = selection.bounds[:, [[i & 1, i >> 1 & 1, i >> 2] for i in range(8)], [0, 1, 2]]
        projection = np.array(camera.projection((rectangle.width, rectangle.height)), np.float64)
        clip = linalg.multiply(projection, linalg.inverse(pose))
        x, y, _, w = (linalg.dot(corners, row[:3]) + row[3] for row in clip)
        with np.errstate(all="ignore"):
            x = (x / w + 1.0) * (0.5 * rectangle.width)
            y = (1.0 - y / w) * (0.5 * rectangle.height)
        boxes = np.stack([x.min(1), y.min(1), x.max(1), y.max(1)], axis=1)
        boxes += (-_ROOM, -_ROOM, _ROOM, _ROOM)
        unsure = ~((w > 0.0).all(axis=1) & np.isfinite(boxes).all(axis=1))
        boxes[unsure] = (-np.inf, -np.inf, np.inf, np.inf)
        return boxes


def _apart(boxes: np.ndarray) -> list[list[int]]:
    """Distribute boxes to pictures without overlaps; leave out boxes that overlap no other."""
    meets = np.ones((len(boxes), len(boxes)), bool)
    for low, high in ((0, 2), (1, 3)):
        meets &= boxes[:, np.newaxis, low] < boxes[np.newaxis, :, high]
        meets &= boxes[np.newaxis, :, low] < boxes[:, np.newaxis, high]
    pictures: list[list[int]] = []
    taken: list[np.ndarray] = []
    for number in np.flatnonzero(meets.sum(axis=1) > 1).tolist():
        for picture, mask in zip(pictures, taken, strict=True):
            if not mask[number]:
                picture.append(number)
                mask |= meets[number]
                break
        else:
            pictures.append([number])
            taken.append(meets[number].copy())
        if len(pictures) > MOST_PICTURES:
            break
    return pictures
