"""The figures of the view: pictures a second, how long one takes, and what it draws.

In: the scene's pictures as they are drawn. Out: a line of text.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ...._native.scene_graph import ALIVE, SHOWN
from ....base.language import translated, translated_count, translated_number
from ....model.geometry.mesh import Mesh
from ....model.motion.posed_mesh import PosedMesh
from ....model.scene.instances import InstancedMesh
from ....model.scene.scene import Scene
from ....rendering.frame import Frame
from ....stage.overlays.frame_times import FrameRate
from .workspace import Workspace

_NEARLY = 1e-6  # of a frame, which rounding may cost


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
        self._rate = FrameRate()
        self._seconds = 0.0
        self.shows_rate = False

    def note(self, seconds: float) -> None:
        """Note a picture that was just drawn in some seconds."""
        self._seconds = seconds
        self._rate.add()

    def text(self, frame: Frame) -> str:
        """Return the line for the shown picture."""
        stats, rate = frame.stats, self._rate.value
        self.shows_rate = rate > 0.0
        held = objects_of(self._workspace.scene)
        # The grid, and the ground of a look: each is an instance, and a draw.
        beside = max(stats["instances"] - objects_of(self._workspace.scene, SHOWN), 0)
        parts = [
            translated("{rate:.0f} fps", rate=rate) if rate else translated("at rest"),
            f"{translated_number(1e3 * self._seconds, '.1f')} ms",
            translated(
                "{drawn:,} of {count:,} objects drawn",
                drawn=max(stats["instances_drawn"] - beside, 0),
                count=held,
            ),
            translated_count("{count:,} draw", "{count:,} draws", max(stats["draws"] - beside, 0)),
            translated(
                "{drawn:,} of {total:,} triangles",
                drawn=stats["triangles_drawn"],
                total=stats["triangles"],
            ),
        ]
        text = ", ".join(parts)
        if self._workspace.document.moves:
            shown = self._workspace.document.animator.time
            frame_number = int(shown * self._workspace.display.fps + _NEARLY)
            text += translated(", {time:.2f} s, frame {count}", time=shown, count=frame_number)
        return text


def objects_of(scene: Scene, which: int = ALIVE) -> int:
    """Return how many objects a scene has to draw: meshes, once for each place of one.

    Nodes count that have a flag: all of them by default, or those that show.
    """
    arrays, held = scene.data.arrays, scene.data.objects.objects
    columns = {name: arrays.columns[name][: arrays.count] for name in ("object", "flags")}
    drawn = columns["object"][(columns["flags"] & which != 0) & (columns["object"] >= 0)]
    counts = np.bincount(drawn, minlength=len(held)).tolist()
    return sum(count * _places_of(obj) for obj, count in zip(held, counts, strict=False) if count)


def _places_of(obj: Any) -> int:
    if isinstance(obj, InstancedMesh):
        return len(obj)
    return int(isinstance(obj, (Mesh, PosedMesh)))
