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
from ...io.reading.documents import Document
from ...io.reading.loading import document_of
from ...io.reading.sources import Source
from ...io.scenes.scene_loading import scene_from_document
from ...io.writing.scene_saving import save_scene, save_with_materials
from ...model.motion.periods import common_period
from ...model.scene.animation import Animator, motions_of
from ...model.scene.scene import Scene
from .console import Console
from .gltf_export import export_gltf
from .history import Command, History
from .motion_copies import motions_in
from .prompt import Prompt
from .recovery import Recovery, content_of
from .resource_list import ResourceList
from .selection import Selection

#: Extension of scene files, which are saved as they were opened.
SCENE_EXTENSION = ".e3d.json"
#: Characters of a step that menus show.
LONGEST_LABEL = 48


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
        document._keep_materials(loaded)
        if loaded.scene is not None:
            document.path, document._state = name, state
        console.write("action", translated("Open {name}", name=name))
        return document

    @classmethod
    def begin(
        cls,
        path: str | os.PathLike[str],
        *,
        console: Console | None = None,
        new: Callable[[], Scene] = Scene,
    ) -> SceneDocument:
        """Open a file as `open` does; a missing scene file starts a new scene.

        Parameters
        ----------
        path : path-like
        console : Console, optional
        new : callable
            Returns the new scene; by default an empty one.

        Raises
        ------
        FileFormatError, FileAccessError
        """
        name = os.path.abspath(os.fspath(path))
        if not name.lower().endswith(SCENE_EXTENSION) or os.path.lexists(name):
            return cls.open(path, console=console)
        if not os.path.isdir(os.path.dirname(name)):
            raise FileAccessError("cannot begin a scene: its folder is not there", path)
        document = cls(new(), console=console)
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
        document._keep_materials(loaded)
        document.path = copy.document
        document.history.mark_unsaved()
        name = copy.document or translated("a scene without a name")
        console.write("action", translated("Recover {name}", name=name))
        return document

    def _keep_materials(self, loaded: Document) -> None:
        """List also those materials of a scene's file that no node uses."""
        materials = [] if loaded.scene is None else loaded.scene.materials
        used = {entry.thing for entry in self.resources.entries()}
        for material in materials:
            if material not in used:
                self.resources.keep(material)

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
    def length(self) -> float:
        """Seconds after which the motion repeats or rests; 0 if nothing moves."""
        motions = motions_in(self.scene)
        last = max((float(track.times[-1]) for track in motions.tracks), default=0.0)
        return max(common_period(motions) or 0.0, last)

    def settle(self) -> None:
        """Take the time back to its first repetition, so that a key set now is in it."""
        motions, length = motions_in(self.scene), self.length
        if not 0.0 < length < self.animator.time:
            return
        rests = any(path.end == "stop" for path in motions.paths)
        rests = rests or not all(track.repeat for track in motions.tracks)
        self.animator.seek(length if rests else self.animator.time % length)

    @property
    def title(self) -> str:
        """The file's name, with a star if there are unsaved changes."""
        name = (
            translated("untitled") if self.path is None else printable(os.path.basename(self.path))
        )
        return f"{name}*" if self.is_modified else name

    @property
    def undo_label(self) -> str:
        """What undoing does, such as "Undo move 'box'"; "Undo" if there is nothing."""
        last = self.history.last
        if last is None:
            return translated("Undo")
        return translated("Undo {label}", label=_short(last))

    @property
    def redo_label(self) -> str:
        """What redoing does, as `undo_label`."""
        then = self.history.next
        if then is None:
            return translated("Redo")
        return translated("Redo {label}", label=_short(then))

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
                if name.lower().endswith(SCENE_EXTENSION):
                    save_with_materials(self.scene, name, self.resources.kept_materials)
                else:
                    save_scene(self.scene, name)
        except Engine3DError as error:
            self.console.write("error", translated("Save: {reason}", reason=error))
            return False
        self.path, self._state = name, FileState(name)
        self.history.mark_saved()
        self.console.write("action", translated("Save {name}", name=name))
        return True

    def export(self, path: str | os.PathLike[str]) -> bool:
        """Write the scene as glTF (``.glb``, ``.gltf``); the document stays that of its own file.

        Returns
        -------
        written : bool
            False if it was not; the console tells why, and what glTF does not hold.
        """
        name = os.path.abspath(os.fspath(path))
        try:
            with self.console.warnings_noted():
                export_gltf(self.scene, name)
        except Engine3DError as error:
            self.console.write("error", translated("Export: {reason}", reason=error))
            return False
        self.console.write("action", translated("Export {name}", name=name))
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


def _short(command: Command) -> str:
    """Return the label of a step to be undone or redone, shortened."""
    label = command.label
    if not label.startswith("Python"):
        label = label[:1].lower() + label[1:]
    return label if len(label) <= LONGEST_LABEL else label[: LONGEST_LABEL - 1] + "…"
