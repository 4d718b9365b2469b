"""The stages of the things that a renderer drew last, so that the next picture stages none anew.

In: things, and how they are drawn. Out: a `ViewRenderer` and the first view of each, the same ones
until the thing changes. If nodes of a dressed scene only move, its `ViewRenderer` stays, and renews
what depends on where they are.
"""

from __future__ import annotations

import os
from collections import OrderedDict
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

from ..base.files.stamps import FileState
from ..errors import InvalidArgumentError
from ..io.reading.linked_files import found_files
from ..io.resources import versions_of
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
from .viewed_thing import settings_for, viewed_of
from .views.viewpoint import Viewpoint

#: Number of stages that a renderer keeps.
KEPT = 4


class Stage(NamedTuple):
    """A staged thing.

    Attributes
    ----------
    thing : object
        It is held, so that no other thing gets its identity.
    has_changed : callable
        Returns whether the thing has changed since, or whether changes cannot be noticed.
    take_moves : callable
        Returns whether nothing more has happened than that nodes moved; then they are where they
        are, and no longer count as changed.
    view_renderer : ViewRenderer
    first : Viewpoint
        Its first view, as of ``engine3d render``.
    """

    thing: Any
    has_changed: Callable[[], bool]
    take_moves: Callable[[], bool]
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

    def stage_of(self, thing: Any, options: Mapping[str, Any], marks: Marks = NO_MARKS) -> Stage:
        """Return the stage of a thing that is drawn with some options; with marks always a new one.

        Raises
        ------
        FileFormatError, FileAccessError, InvalidArgumentError
        """
        if isinstance(thing, (str, os.PathLike)):
            thing = os.fspath(thing)
        if marks.shows_any:
            return self._staged(thing, options, marks)
        identity = thing if isinstance(thing, (str, bytes)) else id(thing)
        key = identity, tuple(sorted(options.items()))
        known = self._kept.get(key)
        if known is None:
            known = self._kept[key] = self._staged(thing, options, NO_MARKS)
        elif known.has_changed():
            known = self._kept[key] = _moved(known) or self._staged(thing, options, NO_MARKS)
        self._kept.move_to_end(key)
        while len(self._kept) > KEPT:
            self._kept.popitem(last=False)
        return known

    @np.errstate(all="ignore")
    def _staged(self, thing: Any, options: Mapping[str, Any], marks: Marks) -> Stage:
        files: dict[str, FileState] = {}
        noticing = _noticing(thing, files)  # from before the thing is read
        if isinstance(thing, str):
            files[thing] = FileState(thing)
        with found_files(lambda path: files.setdefault(path, FileState(path))):
            viewed = viewed_of(thing)
        if viewed is None:
            raise InvalidArgumentError(
                "a path, a scene, a node, a mesh or points can be drawn, "
                f"not {type(thing).__name__}; to draw several, add them to a Scene"
            )
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
        return Stage(thing, *noticing, view_renderer, view_renderer.filling_view())


@np.errstate(all="ignore")
def _moved(stage: Stage) -> Stage | None:
    """Return a stage for where the nodes of its scene are now; None if more has changed."""
    view_renderer = stage.view_renderer
    if not view_renderer.staging.can_renew or not stage.take_moves():
        return None
    view_renderer.renew()
    return stage._replace(first=view_renderer.filling_view())


def _noticing(
    thing: Any, files: Mapping[str, FileState]
) -> tuple[Callable[[], bool], Callable[[], bool]]:
    """Return the `has_changed` and `take_moves` of a stage.

    Parameters
    ----------
    thing : object
    files : mapping
        The states of the files that a path leads to, found while it is opened.
    """
    if isinstance(thing, str):
        return lambda: any(file.changed() for file in files.values()), _never
    if isinstance(thing, Scene):
        changes = SceneChanges(thing)
        return lambda: changes.any, changes.take_moves
    if not isinstance(thing, (Mesh, InstancedMesh)):
        return lambda: True, _never
    before = _versions(thing)
    return lambda: _versions(thing) != before, _never


def _never() -> bool:
    return False


def _versions(thing: Mesh | InstancedMesh) -> tuple[Any, ...]:
    if isinstance(thing, InstancedMesh):
        return (thing.version, *versions_of(thing.mesh))
    return versions_of(thing)
