"""Records a turn around the scene, or its own animation, to a file.

In: a `Viewer` and a path. Out: the file, whole or not at all; the window shows each picture, and
Escape or closing the window cancels.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...base.language import translated
from ...errors import Engine3DError
from ...io.output.animation_files import save_animation
from ...io.output.frame_names import literal_name
from ...stage import headless
from .. import events

if TYPE_CHECKING:
    from .state import ViewerState

FRAMES = 48
#: Maximum side of the pictures: larger files would take too much time and space.
LONGEST_SIDE = 640


class _GivenUp(Exception):
    """The user cancelled the recording."""


def record(viewer: ViewerState, path: Path) -> str:
    """Write the file; return a message about it."""
    view_renderer = viewer.view_renderer
    size, seconds = view_renderer.size, headless.seconds_a_frame(view_renderer, FRAMES)
    shrunk = min(1.0, LONGEST_SIDE / max(size))
    view_renderer.resize(tuple(max(1, round(side * shrunk)) for side in size))
    view_renderer.samples = viewer.sampling.at_rest()
    try:
        save_animation(_pictures(viewer, path.name), literal_name(path), seconds)
    except _GivenUp:
        return translated("given up")
    except (Engine3DError, OSError) as error:
        return str(error)
    finally:
        view_renderer.resize(size)
    return translated("saved {name}", name=path.name)


def _pictures(viewer: ViewerState, name: str) -> Iterator[np.ndarray]:
    """Yield the pictures, and show them; raise `_GivenUp` if the user cancels."""
    pictures = headless.animation(viewer.view_renderer, viewer.view, FRAMES)
    for number, picture in enumerate(pictures, 1):
        viewer.window.title = translated(
            "{name}: {number} of {count} - Escape gives it up",
            name=name,
            number=number,
            count=FRAMES,
        )
        viewer.window.present(picture)
        for event in viewer.window.events():
            if isinstance(event, events.CloseRequested):
                viewer.running = False
            if isinstance(event, events.CloseRequested) or getattr(event, "key", "") == "Escape":
                raise _GivenUp
        yield picture
