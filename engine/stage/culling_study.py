"""Shows how culling works: frozen from one view, with its boxes drawn over pictures."""

from __future__ import annotations

import numpy as np

from ..model.scene.cameras import Camera
from ..model.scene.scene import Scene
from .overlays.debug_lines import Lines, box_lines, frustum_lines, tree_lines


class CullingStudy:
    """A study of a renderer's culling.

    Attributes
    ----------
    camera : (Camera, (4, 4) float64) or None
        What culls, wherever the scene is seen from; None: what each frame is seen from.
    drawing : str or None
        What is drawn over frames: one of `debug_lines.DEBUG_DRAWINGS`.
    """

    def __init__(self) -> None:
        self.camera: tuple[Camera, np.ndarray] | None = None
        self.drawing: str | None = None
        self._from: tuple[Camera, np.ndarray] | None = None

    def choose(self, drawing: str | None, camera: tuple[Camera, np.ndarray]) -> None:
        """Draw what culling works with.

        A frustum is that of this camera, wherever the scene is seen from; but while culling is
        frozen it is the one that culls.
        """
        self.drawing, self._from = drawing, camera

    def lines(self, scene: Scene, size: tuple[int, int]) -> list[Lines]:
        """Return the lines to draw over a frame."""
        seen = self.camera or self._from
        if self.drawing == "frustum" and seen is not None:
            return frustum_lines(*seen, size)
        return box_lines(scene) if self.drawing == "boxes" else tree_lines(scene)
