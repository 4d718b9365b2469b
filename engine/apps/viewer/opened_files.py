"""Opens files while the viewer runs: dropped, stepped to, chosen, or reloaded.

In: paths, and changes of the shown files. Out: another scene in the viewer; if a file cannot be
read, the current scene stays, with a message.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ...base.language import translated
from ...errors import Engine3DError, printable
from ...stage.views.viewpoint import Sphere
from ..desktop.recent_files import RecentFiles
from .model_files import ModelFiles

if TYPE_CHECKING:
    from ...stage.viewed_scene import ViewedScene
    from .state import ViewerState

#: A model that changes its size by more than this factor is framed again.
ALIKE = 8.0


class Opening:
    """Opens files in a viewer.

    Parameters
    ----------
    viewer : ViewerState
    files : ModelFiles
        Those that it shows first.
    """

    def __init__(self, viewer: ViewerState, files: ModelFiles):
        self._viewer = viewer
        self.files = files

    def open(self, paths: Sequence, *, keep_appearance: bool = False) -> None:
        """Show other files.

        Parameters
        ----------
        paths : sequence of path-like
        keep_appearance : bool
            Draw them as the last ones were drawn.
        """
        viewer = self._viewer
        try:
            viewed = self.files.replace(paths)
        except (Engine3DError, MemoryError) as error:
            viewer.say(_reason(error))
            return
        if self.files.remembered:
            RecentFiles().add(*paths)
        viewer.view_renderer.turned_up = None
        self._show(viewed, keep_appearance=keep_appearance)
        viewer.time = 0.0
        viewer.playing = viewed.plays
        viewer.first_view = viewer.view_renderer.view()
        viewer.reset_view()
        if viewed.warnings:
            viewer.say(viewed.warnings[0])
        else:
            viewer.say("opened {name}", name=viewed.title)

    def step(self, step: int) -> None:
        """Show the next or previous model of the folder, cyclically."""
        path = self.files.beside(step)
        if path is None:
            self._viewer.say("there is no other model in the folder; Shift+arrows turn this one")
        else:
            self.open([path], keep_appearance=True)

    def load_again(self) -> None:
        """Reload the files."""
        if self.files.paths:
            self._reload()
        else:
            self._viewer.say("there is no file to load again")

    def look_for_changes(self) -> None:
        """Reload the files if they are watched and have changed."""
        if self.files.changed():
            self._reload()

    def _reload(self) -> None:
        viewer = self._viewer
        viewer.redraw()
        if missing := self.files.missing():
            gone = translated("{names} is not there: this is what it was", names=", ".join(missing))
            viewer.messages.trouble = printable(gone)
            return
        try:
            viewed = self.files.reload()
        except (Engine3DError, MemoryError) as error:
            viewer.messages.trouble = printable(_reason(error))
            return
        before = viewer.view_renderer.bounds
        self._show(viewed, keep_appearance=True)
        said = translated("loaded {name} again", name=viewed.title)
        if viewed.warnings:
            said = viewed.warnings[0]
        if self._in_view(before):
            viewer.say(said)
        else:
            viewer.say("{event}; it was out of view", event=said)
            self._frame_again()

    def _show(self, viewed: ViewedScene, *, keep_appearance: bool) -> None:
        self._viewer.view_renderer.show(viewed, keep_appearance=keep_appearance)
        self._viewer.forget_scene()

    def _frame_again(self) -> None:
        """Frame the whole scene from the same direction; a reset does so from now on."""
        viewer = self._viewer
        if viewer.walker is not None:
            viewer.toggle_walking()
        for view in (viewer.view, viewer.first_view):
            viewer.view_renderer.frame(view)

    def _in_view(self, before: Sphere) -> bool:
        """Return whether the scene, which had other bounds before, is still well framed."""
        view_renderer = self._viewer.view_renderer
        now = view_renderer.bounds
        alike = 1 / ALIKE < now.radius / before.radius < ALIKE
        return alike and self._viewer.view.sees(now, view_renderer.aspect)


def _reason(error: Exception) -> str:
    return translated("out of memory") if isinstance(error, MemoryError) else str(error)
