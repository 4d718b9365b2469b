"""What is edited: a scene with its resources, its file, what was done to it, and what is selected.

In: commands. Out: a scene that they changed, a console that tells so. Panels show what is here and
keep nothing of their own that matters.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any

import numpy as np

from ..errors import Engine3DError
from ..files.resources import Resources
from ..scene.scene import Scene
from .console import Console
from .history import Command, History
from .prompt import Prompt
from .selection import Selection


class SceneDocument:
    """A scene that is edited.

    Parameters
    ----------
    scene : Scene, optional
        An empty one if left out.
    console : Console, optional
        One that goes on from document to document.

    Attributes
    ----------
    scene : Scene
        Change it by `do` only, so that it can be undone.
    resources : Resources
        What its files were loaded through.
    history : History
    selection : Selection
    console : Console
    prompt : Prompt
        With the names ``scene``, ``selection`` (a tuple of nodes), ``node`` (the active one),
        ``document``, ``e3d`` and ``np``.
    """

    def __init__(self, scene: Scene | None = None, *, console: Console | None = None) -> None:
        self.scene = Scene() if scene is None else scene
        self.resources = Resources()
        self.history = History()
        self.selection = Selection()
        self.console = Console() if console is None else console
        self.prompt = Prompt(self.scene, self.history, self.console, self._names)

    def do(self, command: Command, *, drag: Hashable = None) -> bool:
        """Do a command as a step that can be undone, and select what it made.

        Parameters
        ----------
        command : Command
        drag : hashable, optional
            As in `History.do`.

        Returns
        -------
        done : bool
            False if it failed: the scene is as it was, and the console tells why.
        """
        count = len(self.scene.nodes)
        try:
            with self.console.warnings_noted():
                self.history.do(command, drag)
        except Engine3DError as error:
            self.console.write("error", f"{command.label}: {error}")
            return False
        if command is self.history.last:  # not a part of a drag that goes on
            self.console.write("action", command.label)
        if len(self.scene.nodes) > count:
            self.selection.set(command.nodes)
        return True

    def undo(self) -> bool:
        """Undo the last step, if there is one; return whether there was."""
        return self._step("Undo", self.history.undo)

    def redo(self) -> bool:
        """Do the step again that was undone last; return whether there was one."""
        return self._step("Redo", self.history.redo)

    @property
    def is_modified(self) -> bool:
        """Whether something changed since it was saved."""
        return not self.history.is_saved

    def _step(self, what: str, step: Callable[[], Command | None]) -> bool:
        try:
            command = step()
        except Engine3DError as error:  # somebody changed the scene past the history
            self.history.clear()
            self.console.write("error", f"{what}: {error}; the history was cleared")
            return False
        if command is None:
            return False
        self.console.write("action", f"{what}: {command.label}")
        self.selection.set([node for node in command.nodes if node._scene is self.scene])
        return True

    def _names(self) -> dict[str, Any]:
        import engine3d

        selection = self.selection
        return {
            "scene": self.scene,
            "selection": selection.nodes,
            "node": selection.active,
            "document": self,
            "e3d": engine3d,
            "np": np,
        }
