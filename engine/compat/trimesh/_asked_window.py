"""The window of trimesh's viewer: the engine's own, with what trimesh's was asked for.

In: a ``trimesh.Scene``, and the arguments of trimesh's viewer. Out: what `show_viewed` takes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base.validation import positive
from ...errors import warn
from ...model.geometry.mesh import Mesh
from ...rendering.options import MAX_LINE
from ...stage.stage_settings import Settings
from ...stage.viewed_scene import ViewedScene
from ...stage.viewed_thing import settings_for, viewed_of
from ._scene_pictures import background_of

_LEAST = 1.0  # pixels: OpenGL draws no thinner lines


@dataclass(frozen=True)
class Asked:
    """What the window was asked for.

    Attributes
    ----------
    caption : str or None
    smooth : bool
    flags, line_settings : mapping
        Those that were given.
    background : color or None
    callback : callable or None
    """

    caption: str | None
    smooth: bool
    flags: Mapping[str, Any]
    line_settings: Mapping[str, Any]
    background: Any
    callback: Callable[[Any], None] | None

    def settings(self) -> Settings:
        """Return the settings of the window."""
        options: dict[str, Any] = {}
        if "cull" in self.flags:
            options["cull"] = "back" if self.flags["cull"] else "none"
        if self.flags.get("wireframe"):
            options["wireframe"] = "only"
        for name, value in self.line_settings.items():
            size = positive(value, f"line_settings[{name!r}]")
            options[name] = min(max(size, _LEAST), MAX_LINE)
        settings = settings_for("studio", options)
        settings.grid = bool(self.flags.get("grid"))
        settings.axes = bool(self.flags.get("axis"))
        if self.background is not None:
            red, green, blue = background_of(self.background)[:3].tolist()
            settings.background = red, green, blue
        return settings

    def viewed(self, scene: Any) -> ViewedScene:
        """Return a scene as the window shows it."""
        viewed = viewed_of(scene)
        assert viewed is not None  # of a scene there is one
        viewed.title = self.caption or viewed.title
        if not self.smooth:
            for node in viewed.scene.nodes:
                for material in node.object.materials if isinstance(node.object, Mesh) else ():
                    material.flat_shading = True
        if self.callback is not None:
            viewed.update, viewed.plays = _following(scene, viewed, self.callback), True
        return viewed


def _following(
    scene: Any, viewed: ViewedScene, callback: Callable[[Any], None]
) -> Callable[[float], None]:
    """Return a function that calls the callback, and moves what it has moved."""
    nodes = {node.name: node for node in viewed.scene.nodes if isinstance(node.object, Mesh)}
    shapes = {name: hash(geometry) for name, geometry in scene.geometry.items()}
    view, has_warned = np.array(scene.camera_transform), False

    def update(time: float) -> None:
        nonlocal has_warned
        callback(scene)
        here = {str(name): name for name in scene.graph.nodes_geometry}
        for name, node in nodes.items():
            node.visible = name in here
            if node.visible:
                node.pose = np.array(scene.graph[here[name]][0], np.float64)
        is_shown = here.keys() <= nodes.keys() and np.array_equal(scene.camera_transform, view)
        for name, geometry in scene.geometry.items():
            is_shown = is_shown and hash(geometry) == shapes.get(name)
        if not (is_shown or has_warned):
            has_warned = True
            warn("the window takes no new shapes and views of a callback, which may move and hide")

    return update


def warn_of_missing(asked: Mapping[str, bool]) -> None:
    """Name the arguments that the window does not take, of those that ask for something."""
    if missed := [name for name, is_asked in asked.items() if is_asked]:
        warn(f"the window does not support {', '.join(missed)}")
