"""The editor's document: a scene with its resources, file, history and selection.

In: commands. Out: the changed scene, and log entries. Panels show this state and keep no essential
state themselves.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Hashable
from typing import Any

import numpy as np

from ...base.files.stamps import FileState
from ...base.language import translated
from ...errors import Engine3DError, FileAccessError, InvalidArgumentError, printable
from ...io.loaders import load_document
from ...io.reading.loading import document_of
from ...io.reading.sources import Source
from ...io.scenes.scene_loading import scene_from_document
from ...io.writing.scene_saving import save_scene
from ...model.scene.animation import Animator, motions_of
from ...model.scene.scene import Scene
from .console import Console
from .history import Command, History
from .prompt import Prompt
from .recovery import Recovery, content_of
from .resource_list import ResourceList
from .selection import Selection

#: Extension of scene files, which are saved as they were opened.
SCENE_EXTENSION = ".e3d.json"


class SceneDocument:
    """A scene being edited.

    Parameters
    ----------
    scene : Scene, optional
        An empty one if left out.
    console : Console, optional
        One that goes on from document to document.

    Attributes
    ----------
    path : str or None
        Absolute; None until the scene is saved for the first time.
    scene : Scene
        Change it by `do` only, so that it can be undone.
    up : str
        As of the `Document` that it was made of.
    resources : ResourceList
        What it is made of, and what waits to be used.
    history : History
    selection : Selection
    console : Console
    prompt : Prompt
        With the names ``scene``, ``selection`` (a tuple of nodes), ``node`` (the active one),
        ``animator``, ``document``, ``e3d`` and ``np``.
    """

    def __init__(self, scene: Scene | None = None, *, console: Console | None = None) -> None:
        self.scene = Scene() if scene is None else scene
        self.path: str | None = None
        self.up = "+Y"
        self._state: FileState | None = None  # of the file, when it was opened or saved
        self.resources = ResourceList(self.scene)
        self.history = History()
        self.selection = Selection()
        self.console = Console() if console is None else console
        self.prompt = Prompt(self.scene, self.history, self.console, self._names)

    def do(self, command: Command, *, drag: Hashable = None) -> bool:
        """Run a command as an undoable step, and select its result.

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
        try:
            with self.console.warnings_noted():
                self.history.do(command, drag)
        except Engine3DError as error:
            self.console.write(
                "error", translated("{what}: {detail}", what=command.label, detail=error)
            )
            return False
        if command is self.history.last:  # the drag continues in the same step
            self.console.write("action", command.label)
        if command.makes_nodes:
            self.selection.set(command.nodes)
        return True

    def undo(self) -> bool:
        """Undo the last step; return whether there was one."""
        return self._step(translated("Undo"), self.history.undo)

    def redo(self) -> bool:
        """Redo the last undone step; return whether there was one."""
        return self._step(translated("Redo"), self.history.redo)

    @classmethod
    def open(cls, path: str | os.PathLike[str], *, console: Console | None = None) -> SceneDocument:
        """Open a scene, or any model as a new scene.

        Raises
        ------
        FileFormatError, FileAccessError
        """
        name = os.path.abspath(os.fspath(path))
        console = Console() if console is None else console
        state = FileState(name)  # before it is read
        with console.warnings_noted():
            loaded = load_document(name)
            document = cls(scene_from_document(loaded), console=console)
        document.up = loaded.up
        if loaded.scene is not None:
            document.path, document._state = name, state
        console.write("action", translated("Open {name}", name=name))
        return document

    @classmethod
    def begin(
        cls, path: str | os.PathLike[str], *, console: Console | None = None
    ) -> SceneDocument:
        """Open a file as `open` does; a missing scene file starts an empty scene.

        Raises
        ------
        FileFormatError, FileAccessError
        """
        name = os.path.abspath(os.fspath(path))
        if not name.lower().endswith(SCENE_EXTENSION) or os.path.lexists(name):
            return cls.open(path, console=console)
        if not os.path.isdir(os.path.dirname(name)):
            raise FileAccessError("cannot begin a scene: its folder is not there", path)
        document = cls(console=console)
        document.path, document._state = name, FileState(name)
        document.console.write("action", translated("Begin {name}", name=name))
        return document

    @classmethod
    def recover(cls, copy: Recovery, *, console: Console | None = None) -> SceneDocument:
        """Open a crashed editor's copy, as an unsaved later state of its file.

        Raises
        ------
        FileFormatError, FileAccessError
        """
        console = Console() if console is None else console
        name, data = content_of(copy)
        with console.warnings_noted(), Source(name, data) as source:
            loaded = document_of(source, "e3d", split=True)
            document = cls(scene_from_document(loaded), console=console)
        document.path = copy.document
        document.history.mark_unsaved()
        name = copy.document or translated("a scene without a name")
        console.write("action", translated("Recover {name}", name=name))
        return document

    @property
    def animator(self) -> Animator:
        """The animator of the scene; created, without motions, if the scene has none."""
        if self.scene.animator is None:
            self.scene.animator = Animator(self.scene)
        return self.scene.animator

    @property
    def moves(self) -> bool:
        """Whether the animator moves any nodes."""
        animator = self.scene.animator
        return animator is not None and any(motions_of(animator))

    @property
    def title(self) -> str:
        """The file's name, with a star if there are unsaved changes."""
        name = (
            translated("untitled") if self.path is None else printable(os.path.basename(self.path))
        )
        return f"{name}*" if self.is_modified else name

    def save_would_overwrite(self, path: str | os.PathLike[str] | None = None) -> str | None:
        """Return what saving to a path would overwrite, to ask the user.

        Parameters
        ----------
        path : path-like, optional
            The document's own if left out.

        Returns
        -------
        reason : str or None
            None if nothing would: the file is not there, or is as it was opened or saved last.
        """
        name = self._target(path)
        if not os.path.lexists(name):
            return None
        if self.path is None or os.path.realpath(name) != os.path.realpath(self.path):
            return translated("{name} is there already", name=printable(name))
        if self._state is None:
            return translated("{name} may have changed since", name=printable(name))
        if self._state.changed():
            return translated("{name} was changed by another program", name=printable(name))
        return None

    def save(self, path: str | os.PathLike[str] | None = None, *, overwrite: bool = False) -> bool:
        """Save the scene.

        Parameters
        ----------
        path : path-like, optional
            The document's own if left out, and from now on its own.
        overwrite : bool
            Replace also what `save_would_overwrite` tells of.

        Returns
        -------
        saved : bool
            False if it was not; the console tells why.
        """
        name = self._target(path)
        reason = None if overwrite else self.save_would_overwrite(name)
        if reason is not None:
            self.console.write("error", translated("Save: {reason}", reason=reason))
            return False
        try:
            with self.console.warnings_noted():
                save_scene(self.scene, name)
        except Engine3DError as error:
            self.console.write("error", translated("Save: {reason}", reason=error))
            return False
        self.path, self._state = name, FileState(name)
        self.history.mark_saved()
        self.console.write("action", translated("Save {name}", name=name))
        return True

    def _target(self, path: str | os.PathLike[str] | None) -> str:
        if path is None and self.path is None:
            raise InvalidArgumentError("the scene has no file yet: give a path")
        return os.path.abspath(os.fspath(self.path if path is None else path))

    @property
    def is_modified(self) -> bool:
        """Whether there are unsaved changes."""
        return not self.history.is_saved

    def _step(self, what: str, step: Callable[[], Command | None]) -> bool:
        try:
            command = step()
        except Engine3DError as error:  # the scene was changed without the history
            self.history.clear()
            self.console.write(
                "error",
                translated("{what}: {detail}; the history was cleared", what=what, detail=error),
            )
            return False
        if command is None:
            return False
        self.console.write(
            "action", translated("{what}: {detail}", what=what, detail=command.label)
        )
        self.selection.set([node for node in command.nodes if node.scene is self.scene])
        return True

    def _names(self) -> dict[str, Any]:
        import engine3d

        selection = self.selection
        return {
            "scene": self.scene,
            "selection": selection.nodes,
            "node": selection.active,
            "animator": self.animator,
            "document": self,
            "e3d": engine3d,
            "np": np,
        }
