"""Opening and saving, with questions about unsaved changes and existing files.

In: the user's requests. Out: the workspace's document, opened or saved.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence

from ....base.language import translated
from ....errors import printable
from ....io.loaders import formats
from ....model.materials.material import Material
from ....model.scene.nodes import Node
from ...imgui_painter.imgui_painter import ImguiPainter
from ..autosave import forget, left_behind
from ..document import SCENE_EXTENSION
from ..gltf_export import GLTF_EXTENSIONS
from ..recovery import Recovery
from .file_chooser import FileDialog
from .middle import begin_dialog
from .translated_imgui import imgui
from .workspace import Workspace

_SCENES = (SCENE_EXTENSION,)


def _kinds() -> dict[str, tuple[str, ...]]:
    """Return the kinds of files that can be opened: extensions by name."""
    meshes = tuple(end for item in formats("mesh") for end in item.extensions)
    return {"Scenes and models": (*_SCENES, *meshes), "Scenes": _SCENES, "All files": ()}


class Files:
    """Asks for files, and before anything is lost.

    Parameters
    ----------
    workspace : Workspace
    painter : ImguiPainter
        Shows pictures of files.
    """

    def __init__(self, workspace: Workspace, painter: ImguiPainter) -> None:
        self._workspace = workspace
        self._dialog = FileDialog(workspace.recent, painter)
        self._question = ""
        self._answers: dict[str, Callable[[], object]] = {}
        self._opens = False

    @property
    def is_waiting(self) -> bool:
        """Whether a file's thumbnail is being made."""
        return self._dialog.is_waiting

    # User requests

    def new(self) -> None:
        """Start an empty scene, after saving or discarding the old one."""
        self._unless_lost(self._workspace.new)

    def open(self) -> None:
        """Ask for a file, and open it."""
        self._unless_lost(lambda: self._dialog.ask("Open a file", _kinds(), self._workspace.open))

    def add(self) -> None:
        """Ask for a file, and add its content to the scene."""
        self._dialog.ask("Add a file", _kinds(), self._workspace.add_file)

    def load_texture(self, materials: Sequence[Material], slot: str) -> None:
        """Ask for an image, and use it as a texture of materials."""
        kinds = {"Images": tuple(end for item in formats("image") for end in item.extensions)}
        self._dialog.ask(
            "Load an image", kinds, lambda path: self._workspace.load_texture(path, materials, slot)
        )

    def load_mesh(self, node: Node) -> None:
        """Ask for a model, and give it to a node as one mesh."""
        kinds = {"Models": tuple(end for item in formats("mesh") for end in item.extensions)}
        self._dialog.ask("Load a mesh", kinds, lambda path: self._workspace.load_mesh(path, node))

    def save(self, then: Callable[[], object] = lambda: None) -> None:
        """Save the scene, or ask where to; then run a follow-up action."""
        if self._workspace.document.path is None:
            self.save_as(then)
        else:
            self._save_to(None, then)

    def save_as(self, then: Callable[[], object] = lambda: None) -> None:
        """Ask where to save the scene; a name of glTF is asked about."""
        path = self._workspace.document.path
        name = "scene.e3d.json" if path is None else os.path.basename(path)
        self._dialog.ask(
            "Save the scene",
            {"Scenes": _SCENES},
            lambda chosen: self._save_or_export(chosen, then),
            name=name,
            others=GLTF_EXTENSIONS,
            beside=path,
        )

    def export(self) -> None:
        """Ask where to write the scene as glTF."""
        path = self._workspace.document.path
        stem = "scene" if path is None else os.path.basename(path).removesuffix(SCENE_EXTENSION)
        kinds = {"glTF": GLTF_EXTENSIONS}
        document = self._workspace.document
        self.ask_for_new("Export as glTF", kinds, f"{stem}.glb", document.export)

    def ask_for_new(
        self,
        title: str,
        kinds: dict[str, tuple[str, ...]],
        name: str,
        answer: Callable[[str], object],
    ) -> None:
        """Ask for a file to write, and before one that is there already is overwritten.

        Parameters
        ----------
        title : str
        kinds : dict of str to tuple of str
            Extensions by what the dialog calls them.
        name : str
            What it may be called.
        answer : callable
            Given the path.
        """
        self._dialog.ask(
            title,
            kinds,
            lambda path: self._unless_there(path, answer),
            name=name,
            beside=self._workspace.document.path,
        )

    def open_recent(self, path: str) -> None:
        """Open a file, after saving or discarding the old scene."""
        self._unless_lost(lambda: self._workspace.open(path))

    def exit(self) -> None:
        """Close the editor, after saving or discarding the scene."""
        self._unless_lost(lambda: setattr(self._workspace, "wants_exit", True))

    def offer_recovery(self) -> None:
        """Offer the latest recovery copy, if there is one."""
        with self._workspace.console.warnings_noted():
            copies = left_behind()
        if copies:
            self._offer(copies[0])

    # Questions

    def _offer(self, copy: Recovery) -> None:
        name = (
            translated("a scene without a name")
            if copy.document is None
            else printable(copy.document)
        )
        made = time.strftime("%Y-%m-%d %H:%M", time.localtime(copy.time))

        def recover():
            self._workspace.recover(copy)
            forget(copy)

        self._ask(
            translated(
                "An editor ended without saving {name}, as it was on {time}.", name=name, time=made
            ),
            {"Recover": recover, "Discard": lambda: forget(copy), "Later": lambda: None},
        )

    def _unless_lost(self, act: Callable[[], object]) -> None:
        document = self._workspace.document
        if not document.is_modified:
            act()
            return
        self._ask(
            translated("{name} is not saved.", name=document.title.rstrip("*")),
            {"Save": lambda: self.save(act), "Discard": act, "Cancel": lambda: None},
        )

    def _unless_there(self, path: str, answer: Callable[[str], object]) -> None:
        if not os.path.lexists(path):
            answer(path)
            return
        question = translated("{name} is there already.", name=printable(path))
        self._ask(question, {"Overwrite": lambda: answer(path), "Cancel": lambda: None})

    def _save_or_export(self, path: str, then: Callable[[], object]) -> None:
        """Save to a path; ask what is meant by a name of glTF."""
        if not path.lower().endswith(GLTF_EXTENSIONS):
            self._save_to(path, then)
            return
        stem = os.path.splitext(path)[0]
        scene = stem + SCENE_EXTENSION
        export = translated("Export as {name}", name=printable(os.path.basename(path)))
        save = translated("Save as {name}", name=printable(os.path.basename(scene)))
        document = self._workspace.document
        self._ask(
            translated(
                "The editor saves scenes with all that they hold as .e3d.json. glTF holds less."
            ),
            {
                save: lambda: self._save_to(scene, then),
                export: lambda: self._unless_there(path, document.export),
                "Cancel": lambda: None,
            },
        )

    def _save_to(self, path: str | None, then: Callable[[], object]) -> None:
        reason = self._workspace.document.save_would_overwrite(path)

        def save():
            if self._workspace.save(path, overwrite=True):
                then()

        if reason is None:
            save()
        else:
            self._ask(f"{reason}.", {"Overwrite": save, "Cancel": lambda: None})

    def _ask(self, question: str, answers: dict[str, Callable[[], object]]) -> None:
        self._question, self._answers, self._opens = question, answers, True

    # Laying out

    def draw(self) -> None:
        """Lay out the current question."""
        self._dialog.draw()
        if self._opens:
            imgui.open_popup("Question")
            self._opens = False
        if not begin_dialog("Question", imgui.Cond_.always):
            return
        imgui.text_unformatted(self._question)
        imgui.spacing()
        chosen = self._chosen_answer()
        if chosen is not None:
            imgui.close_current_popup()
            self._answers[chosen]()
        imgui.end_popup()

    def _chosen_answer(self) -> str | None:
        """Lay out the answers; return the chosen one.

        Enter and Space give the one that has the focus, at first the first one. Esc gives the last
        one, which changes nothing.
        """
        first, *_, last = self._answers
        chosen = last if imgui.is_key_pressed(imgui.Key.escape, False) else None
        if imgui.is_window_appearing():
            imgui.set_nav_cursor_visible(True)  # otherwise Enter works only after an arrow key
        for name in self._answers:
            if imgui.button(name):
                chosen = name
            if name == first:
                imgui.set_item_default_focus()
            imgui.same_line()
        return chosen
