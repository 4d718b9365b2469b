"""Visualises culling: freezes it from one view, and draws its boxes over pictures."""

from __future__ import annotations

import numpy as np

from ...model.scene.cameras import Camera
from ...model.scene.scene import Scene
from .debug_lines import Lines, box_lines, frustum_lines, tree_lines


class CullingStudy:
    """The state of a culling visualisation.

    Attributes
    ----------
    camera : (Camera, (4, 4) float64) or None
        The frozen culling camera; None: each frame's own camera.
    drawing : str or None
        The drawing over frames, one of `debug_lines.DEBUG_DRAWINGS`.
    """

    def __init__(self) -> None:
        self.camera: tuple[Camera, np.ndarray] | None = None
        self.drawing: str | None = None
        self._from: tuple[Camera, np.ndarray] | None = None

    def choose(self, drawing: str | None, camera: tuple[Camera, np.ndarray]) -> None:
        """Choose the debug drawing.

        A frustum drawing shows the given camera's frustum from then on, or that of the frozen
        camera while culling is frozen.
        """
        self.drawing, self._from = drawing, camera

    def lines(self, scene: Scene, size: tuple[int, int]) -> list[Lines]:
        """Return the lines to draw over a frame."""
        seen = self.camera or self._from
        if self.drawing == "frustum" and seen is not None:
            return frustum_lines(*seen, size)
        return box_lines(scene) if self.drawing == "boxes" else tree_lines(scene)
