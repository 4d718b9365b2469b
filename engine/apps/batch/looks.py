"""Draws models as ``engine3d render`` does, in a look.

In: a task with a look. Out: a frame, and why it shows nothing, if that is so; its bytes are those
of the command with the same options.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from ...choices import Backend
from ...errors import warn
from ...rendering.frame import Frame
from ...stage.blank import Reason
from ...stage.look import LookChoice
from ...stage.open_models import open_models
from ...stage.view_renderer import ViewRenderer
from ...stage.viewed_thing import settings_for
from ...stage.views.first_view import FirstView
from .task import Task


def draw_look(
    task: Task, look: LookChoice, threads: int, backend: Backend, companion: Callable[[str], bool]
) -> tuple[Frame, Reason | None]:
    """Draw a task's model in a look; also return why it is blank, or None.

    Parameters
    ----------
    task : Task
    look : str
    threads, backend
        As of `Renderer`.
    companion : callable
        Whether an image beside the model, which has its name, may be its texture.

    Raises
    ------
    FileFormatError, FileAccessError
    """
    viewed = open_models([task.path(task.model)], companion=companion, root=task.root_path)
    for text in viewed.warnings:
        warn(f"{task.model}: {text}")
    with ViewRenderer(
        viewed,
        settings_for(look),
        task.size,
        backend=backend,
        threads=threads,
        samples=task.samples,
        antialiasing=task.antialiasing,
    ) as view_renderer:
        view = _view(task.camera or {}).place(view_renderer, turns=False)
        frame = view_renderer.draw(view)
        return frame, view_renderer.why_blank()


def _view(said: dict[str, Any]) -> FirstView:
    angle = said.get("yfov_degrees")
    return FirstView(
        yfov=None if angle is None else math.radians(angle),
        azimuth=math.radians(said.get("azimuth_degrees", 0.0)),
        elevation=math.radians(said.get("elevation_degrees", 0.0)),
    )
