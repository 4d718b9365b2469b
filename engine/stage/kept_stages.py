"""The stages of the things that a renderer drew last, so that the next picture stages none anew.

In: things, and how they are drawn. Out: a `ViewRenderer` and the first view of each, the same ones
until the thing changes. If nodes of a dressed scene only move, its `ViewRenderer` stays, and renews
what depends on where they are.
"""

from __future__ import annotations

import os
from collections import OrderedDict
from collections.abc import Mapping
from typing import Any, NamedTuple, Protocol

import numpy as np

from ..base.files.stamps import FileState
from ..errors import InvalidArgumentError
from ..io.reading.linked_files import found_files
from ..io.resources import versions_of
from ..io.scenes.other_libraries import library_of
from ..model.geometry.mesh import Mesh
from ..model.materials.material import Material
from ..model.scene.instances import InstancedMesh
from ..model.scene.scene import Scene
from ..model.scene.scene_changes import SceneChanges
from ..rendering.renderer import Renderer
from .coloring import show_numbers
from .look import Look
from .overlays.numbers import NO_MARKS, Marks
from .view_renderer import ViewRenderer
from .viewed_scene import ViewedScene
from .viewed_thing import settings_for, viewed_of
from .views.viewpoint import Viewpoint

#: Number of stages that a renderer keeps.
KEPT = 4


class Changes(Protocol):
    """Tells what has happened to a thing, as `SceneChanges` does."""

    @property
    def any(self) -> bool:
        """Whether the thing has changed, or whether changes cannot be noticed."""

    def take_moves(self) -> bool:
        """Return whether nothing more has happened than that nodes moved.

        Then they are where they are, and no longer count as changed.
        """


class Stage(NamedTuple):
    """A staged thing.

    Attributes
    ----------
    thing : object
        It is held, so that no other thing gets its identity.
    changes : Changes
        Those of the thing since.
    view_renderer : ViewRenderer
    first : Viewpoint
        Its first view, as of ``engine3d render``.
    """

    thing: Any
    changes: Changes
    view_renderer: ViewRenderer
    first: Viewpoint


class KeptStages:
    """The last stages of a renderer.

    Parameters
    ----------
    renderer : Renderer
        Draws them.
    look : Look
    material : Material or None
    drawing : Mapping
        Other options of `Renderer`, for small pictures.
    """

    def __init__(
        self,
        renderer: Renderer,
        look: Look,
        material: Material | None,
        drawing: Mapping[str, Any],
    ) -> None:
        self._renderer = renderer
        self._look, self._material, self._drawing = look, material, drawing
        self._kept: OrderedDict[Any, Stage] = OrderedDict()
        #: The stage that was asked for last.
        self.last: Stage | None = None

    def stage_of(self, thing: Any, options: Mapping[str, Any], marks: Marks = NO_MARKS) -> Stage:
        """Return the stage of a thing that is drawn with some options; with marks always a new one.

        Raises
        ------
        FileFormatError, FileAccessError, InvalidArgumentError
        """
        self.last = self._found(thing, options, marks)
        return self.last

    def _found(self, thing: Any, options: Mapping[str, Any], marks: Marks) -> Stage:
        if isinstance(thing, (str, os.PathLike)):
            thing = os.fspath(thing)
        if marks.shows_any:
            return self._staged(thing, options, marks)
        identity = thing if isinstance(thing, (str, bytes)) else id(thing)
        key = identity, tuple(sorted(options.items()))
        known = self._kept.get(key)
        if known is None:
            known = self._kept[key] = self._staged(thing, options, NO_MARKS)
        elif known.changes.any or known.view_renderer.size != self._renderer.size:
            known = self._kept[key] = self._renewed(known) or self._staged(thing, options, NO_MARKS)
        self._kept.move_to_end(key)
        while len(self._kept) > KEPT:
            self._kept.popitem(last=False)
        return known

    @np.errstate(all="ignore")
    def _staged(self, thing: Any, options: Mapping[str, Any], marks: Marks) -> Stage:
        files: dict[str, FileState] = {}
        changes = _changes_of(thing, files)  # from before the thing is read
        if isinstance(thing, str):
            files[thing] = FileState(thing)
        with found_files(lambda path: files.setdefault(path, FileState(path))):
            viewed = viewed_of(thing)
        if viewed is None:
            raise InvalidArgumentError(_refusal(thing))
        show_numbers(viewed, marks)
        settings = settings_for(self._look, options, self._material, marks)
        view_renderer = ViewRenderer(
            viewed,
            settings,
            self._renderer.size,
            samples=self._renderer.samples,
            renderer=self._renderer,
            **self._drawing,
        )
        return Stage(thing, changes, view_renderer, view_renderer.filling_view())

    @np.errstate(all="ignore")
    def _renewed(self, stage: Stage) -> Stage | None:
        """Return a stage for where the nodes of its scene are now, and for the renderer's size.

        None: more has changed.
        """
        view_renderer, changes = stage.view_renderer, stage.changes
        if not view_renderer.staging.can_renew or (changes.any and not changes.take_moves()):
            return None
        view_renderer.resize(self._renderer.size)
        view_renderer.renew()
        return stage._replace(first=view_renderer.filling_view())


def _changes_of(thing: Any, files: Mapping[str, FileState]) -> Changes:
    """Return the changes of a thing from now on.

    Parameters
    ----------
    thing : object
    files : mapping
        The states of the files that a path leads to, found while it is opened.
    """
    if isinstance(thing, str):
        return _FileChanges(files)
    if isinstance(thing, (Scene, ViewedScene)):
        return SceneChanges(thing if isinstance(thing, Scene) else thing.scene)
    return _MeshChanges(thing) if isinstance(thing, (Mesh, InstancedMesh)) else _Unnoticed()


class _Unnoticed:
    """The changes of things that tell nothing of them."""

    @property
    def any(self) -> bool:
        return True

    def take_moves(self) -> bool:
        return False


class _FileChanges(_Unnoticed):
    """The changes of files."""

    def __init__(self, files: Mapping[str, FileState]) -> None:
        self._files = files

    @property
    def any(self) -> bool:
        return any(file.changed() for file in self._files.values())


class _MeshChanges(_Unnoticed):
    """The changes of a mesh, or of its instances."""

    def __init__(self, thing: Mesh | InstancedMesh) -> None:
        self._thing, self._before = thing, _versions(thing)

    @property
    def any(self) -> bool:
        return _versions(self._thing) != self._before


def _versions(thing: Mesh | InstancedMesh) -> tuple[Any, ...]:
    if isinstance(thing, InstancedMesh):
        return (thing.version, *versions_of(thing.mesh))
    return versions_of(thing)


def _refusal(thing: Any) -> str:
    """Return why a thing cannot be drawn."""
    kind, library = type(thing).__name__, library_of(thing)
    if library is not None:
        return f"this {kind} of {library} holds nothing that can be drawn"
    return (
        "a path, a scene, a node, a mesh or points can be drawn, "
        f"not {kind}; to draw several, add them to a Scene"
    )
