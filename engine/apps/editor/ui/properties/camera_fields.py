"""The fields of cameras, and what one does with them: look through them, place them."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .....base import linalg
from .....model.scene.cameras import Camera, OrthographicCamera, PerspectiveCamera
from .....model.scene.nodes import Node
from ..workspace import Workspace
from .fields import Fields


def draw_cameras(workspace: Workspace, fields: Fields, nodes: Sequence[Node]) -> None:
    """Lay out what all cameras of some nodes have."""
    if not fields.folder("Camera"):
        return
    if len(nodes) == 1:
        _draw_buttons(workspace, fields, nodes[0])
    cameras: list[Camera] = [node.object for node in nodes]
    if all(isinstance(camera, PerspectiveCamera) for camera in cameras):
        degrees = math.degrees(1.0)
        fields.number(cameras, "yfov", "Field of view, °", 0.5, 1.0, 179.0, degrees)
    elif all(isinstance(camera, OrthographicCamera) for camera in cameras):
        fields.number(cameras, "ymag", "Half height", 0.05, 1e-3)
    if all(camera.znear is not None for camera in cameras):
        fields.number(cameras, "znear", "Near", 0.01, 1e-4)
        fields.number(cameras, "zfar", "Far", 1.0, 1e-3)


def _draw_buttons(workspace: Workspace, fields: Fields, node: Node) -> None:
    if workspace.through.node is node:
        if fields.button("Leave it"):
            workspace.through.leave()
    elif fields.button("Look through it"):
        workspace.through.look(node, workspace.bounds)
    if fields.button("Place it where the view is"):
        pose = workspace.view.pose()
        if node.parent is not None:
            pose = linalg.multiply(linalg.inverse(node.parent.world_pose), pose)
        fields.set([node], {"pose": pose}, "Place the camera")
