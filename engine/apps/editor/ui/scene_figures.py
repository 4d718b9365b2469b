"""The figures of the view: pictures a second, how long one takes, and what it draws.

In: the scene's pictures as they are drawn. Out: a line of text.
"""

from __future__ import annotations

import time
from collections import deque
from typing import Any

import numpy as np

from ...._native.scene_graph import ALIVE
from ....model.geometry.mesh import Mesh
from ....model.motion.posed_mesh import PosedMesh
from ....model.scene.instances import InstancedMesh
from ....model.scene.scene import Scene
from ....rendering.frame import Frame
from .workspace import Workspace

#: Seconds over which pictures are counted, and after which the view is at rest.
_PERIOD = 1.0


class SceneFigures:
    """Counts the pictures of a view.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    shows_rate : bool
        Whether the line tells of pictures a second, and is out of date a second later.
    """

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._drawn: deque[float] = deque()
        self._seconds = 0.0
        self.shows_rate = False

    def note(self, seconds: float) -> None:
        """Note a picture that was just drawn in some seconds."""
        self._seconds = seconds
        self._drawn.append(time.perf_counter())

    def text(self, frame: Frame) -> str:
        """Return the line for the shown picture."""
        stats, now = frame.stats, time.perf_counter()
        while self._drawn and self._drawn[0] < now - _PERIOD:
            self._drawn.popleft()
        count = len(self._drawn)
        self.shows_rate = count > 1
        rate = f"{count / _PERIOD:.0f} fps" if self.shows_rate else "at rest"
        held = objects_of(self._workspace.scene)
        beside = max(stats["instances"] - held, 0)  # the grid, and the ground of a look
        objects = f"{stats['instances_drawn'] - beside:,} of {held:,} objects drawn"
        draws = f"{stats['draws']:,} draw{'' if stats['draws'] == 1 else 's'}"
        triangles = f"{stats['triangles_drawn']:,} of {stats['triangles']:,} triangles"
        text = f"{rate}, {1e3 * self._seconds:.1f} ms, {objects}, {draws}, {triangles}"
        if self._workspace.document.moves:
            animator = self._workspace.document.animator
            text += f", {animator.time:.2f} s, frame {self._workspace.moments}"
        return text


def objects_of(scene: Scene) -> int:
    """Return how many objects a scene has to draw: meshes, once for each place of one."""
    arrays, held = scene.data.arrays, scene.data.objects.objects
    columns = {name: arrays.columns[name][: arrays.count] for name in ("object", "flags")}
    drawn = columns["object"][(columns["flags"] & ALIVE != 0) & (columns["object"] >= 0)]
    counts = np.bincount(drawn, minlength=len(held)).tolist()
    return sum(count * _places_of(obj) for obj, count in zip(held, counts, strict=False) if count)


def _places_of(obj: Any) -> int:
    if isinstance(obj, InstancedMesh):
        return len(obj)
    return int(isinstance(obj, (Mesh, PosedMesh)))
