"""The fields of the scene itself: background, ambient light, environment, fog."""

from __future__ import annotations

import math

from .....base.language import translated, translated_count
from .....model.environments.environment import BUILT_IN, named_environment
from .....model.scene.gradients import Gradient
from .....model.scene.scene import Scene
from .....model.scene.surroundings import MAX_EXPOSURE
from ..workspace import Workspace
from .fields import Fields
from .fog_fields import draw_fog


def draw_scene(workspace: Workspace, fields: Fields) -> None:
    """Lay out the scene."""
    scene = workspace.scene
    count = len(scene.nodes)
    fields.note(
        translated_count(
            "{count:,} node; select one to edit it",
            "{count:,} nodes; select one to edit it",
            count,
        )
    )
    if fields.folder("Background and light"):
        _draw_background(fields, scene)
        fields.color([scene], "ambient", "Ambient light")
        fields.number([scene], "exposure", "Exposure", 0.02, -MAX_EXPOSURE, MAX_EXPOSURE)
    if fields.folder("Environment"):
        _draw_environment(fields, scene)
    if fields.folder("Fog", is_open=scene.fog is not None):
        draw_fog(fields, scene, workspace.bounds.radius)


def _draw_background(fields: Fields, scene: Scene) -> None:
    now = scene.background
    if isinstance(now, tuple):
        fields.color([scene], "background", "Background")
    else:
        kind = translated("a gradient" if isinstance(now, Gradient) else "the environment")
        fields.value("Background", translated("none") if now is None else kind)
        if fields.button("Make it one colour"):
            fields.set([scene], {"background": (60, 64, 72)}, "Set the background")


def _draw_environment(fields: Fields, scene: Scene) -> None:
    """Lay out the environment: a built-in one, or from a file."""
    now = scene.environment
    name = "none" if now is None else now.built_in or now.name or translated("from a file")
    options = [(each, each) for each in ("none", *BUILT_IN)]
    chosen = fields.choice("Lit by", name, options, "environment")
    if chosen is not None and chosen != name:
        environment = None if chosen == "none" else named_environment(chosen)
        fields.set([scene], {"environment": environment})
    if now is None:
        return
    fields.number([scene], "environment_intensity", "Intensity", 0.01, 0.0)
    degrees = math.degrees(1.0)
    fields.number([scene], "environment_rotation", "Rotation, °", 0.5, factor=degrees)
    shown = scene.background is now
    changed, shows = fields.checkbox("Shown as the background", [shown])
    if changed:
        background = now if shows else (60, 64, 72)
        fields.set([scene], {"background": background}, "Set the background")
    if shown:
        fields.share([scene], "background_blur", "Blur")
