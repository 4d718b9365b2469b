"""Looking through a camera of the scene, until the view is turned.

In: a viewpoint, and a node with a camera. Out: the viewpoint at the camera's place; when looking
through it ends, the viewpoint stays there with its own lens and up direction.
"""

from __future__ import annotations

import numpy as np

from .....model.scene.cameras import Camera
from .....model.scene.nodes import Node
from .....stage.views.viewpoint import Sphere, Viewpoint, look_through


class ThroughCamera:
    """Which camera the view looks through.

    Parameters
    ----------
    view : Viewpoint
    """

    def __init__(self, view: Viewpoint) -> None:
        self._view = view
        self._node: Node | None = None
        self._before: Viewpoint | None = None
        self._bounds: Sphere | None = None

    @property
    def node(self) -> Node | None:
        """The node of the camera; None if the view is its own."""
        node = self._node
        if node is not None and (node.scene is None or not isinstance(node.object, Camera)):
            self.leave()
        return self._node

    def look(self, node: Node, bounds: Sphere) -> None:
        """Look through a node's camera."""
        self.leave()
        self._before, self._node, self._bounds = self._view.copy(), node, bounds
        look_through(self._view, node, bounds)

    def leave(self) -> None:
        """Go on from where the camera stands."""
        view, before = self._view, self._before
        if before is None:
            return
        node, bounds = self._node, self._bounds
        is_there = node is not None and node.scene is not None and isinstance(node.object, Camera)
        if is_there and bounds is not None:
            look_through(view, node, bounds)  # it may have moved meanwhile
        eye, target = view.position(), np.array(view.target)
        view.up, view.yfov, view.lens = before.up, before.yfov, before.lens
        view.orthographic = before.orthographic
        view.look_from(eye, target)
        self._node = self._before = None
