"""The drawing options that keys and the command line change.

In: option values. Out: the keyword arguments of one `Renderer.render` call.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import fields
from types import SimpleNamespace
from typing import Any, TypeVar, cast

from ..base import linalg
from ..base.calls import refuse_unknown
from ..choices import Color
from ..model.environments.environment import Environment
from ..model.geometry.mesh import Mesh
from ..model.materials.colors import linear_color
from ..model.materials.linear_colors import linear
from ..model.scene.gradients import Gradient
from ..model.scene.instances import InstancedMesh
from ..model.scene.scene import Scene
from ..model.scene.surroundings import Background
from ..rendering.options import MODES, WHITE, RenderOptions, drawn_mode

DARK, LIGHT = (22, 24, 28), (225, 229, 236)
#: Points are this fraction of the distance between points spread evenly over the picture. They are
#: at least one pixel of a picture this high, and at most this many such pixels.
POINT_SHARE = 0.4
USUAL_HEIGHT = 720.0
MOST_PIXELS = 6.0
#: Luminance weights of red, green and blue in linear light.
_LUMINANCE = (0.2126, 0.7152, 0.0722)


#: The picture options of a view, with their defaults.
DEFAULTS = {one.name: one.default for one in fields(RenderOptions) if one.name != "outputs"} | {
    "line_color": None,
    "point_size": None,
}
#: The options of what is drawn as it is, where they have other defaults here.
BARE = {"point_size": 1.0, "line_color": WHITE}
Value = TypeVar("Value")
#: The choices of options with few choices, in the order in which keys cycle.
CHOICES = {
    one.name: tuple(one.metadata["numbers"])
    for one in fields(RenderOptions)
    if one.metadata["numbers"]
} | {"mode": MODES}


class Appearance(SimpleNamespace):
    """The drawing options of one frame as attributes: those of `RenderOptions` except its outputs.

    ``line_color`` is (r, g, b), integers 0 to 255, sRGB; None is dark over faces, and contrasts
    with the background without faces. A ``mode`` may be an output. A ``point_size`` of None depends
    on the picture and the number of points.
    """

    def __init__(self, **given: Any) -> None:
        refuse_unknown(Appearance, given, DEFAULTS)
        super().__init__(**(DEFAULTS | given))

    def arguments(self, background: Background, point_size: float) -> dict[str, Any]:
        """Return the keyword arguments for `Renderer.render`.

        Parameters
        ----------
        background : (3,) sequence, Gradient, Environment or None
            The scene's.
        point_size : float
            The automatic size for the scene and picture.
        """
        arguments = dict(vars(self)) | {"mode": drawn_mode(self.mode)}
        if self.line_color is None:
            alone = self.wireframe == "only"
            arguments["line_color"] = contrasting(background) if alone else DARK
        if self.point_size is None:
            arguments["point_size"] = point_size
        return arguments


def contrasting(background: Background) -> tuple[int, int, int]:
    """Return a dark or a light colour, whichever contrasts more with a background."""
    if background is None or isinstance(background, Environment):
        return LIGHT
    if isinstance(background, Gradient):
        ends = linear_color(background.top) + linear_color(background.bottom)
        background = cast(Color, linear(ends / 2))
    here, dark, light = (
        float(linalg.dot(linear_color(color), _LUMINANCE)) + 0.05
        for color in (background, DARK, LIGHT)
    )
    return DARK if here / dark > light / here else LIGHT


def point_size(count: int, size: tuple[int, int]) -> float:
    """Return the size in pixels for ``count`` points in a picture of some size."""
    side = min(size)
    pixel = max(1.0, side / USUAL_HEIGHT)
    apart = side / math.sqrt(max(count, 1))
    return float(round(max(pixel, min(MOST_PIXELS * pixel, POINT_SHARE * apart))))


def count_points(scene: Scene) -> int:
    """Return the number of visible points in a scene."""
    count = 0
    for node in scene.nodes:
        shape = node.object
        if not node.shown:
            continue
        if isinstance(shape, Mesh):
            count += len(shape.points)
        elif isinstance(shape, InstancedMesh):
            count += len(shape.mesh.points) * len(shape.poses)
    return count


def has_faces(scene: Scene) -> bool:
    """Return whether a scene has more than points and lines."""
    meshes = (getattr(obj, "mesh", obj) for obj in scene.data.objects.objects)
    return any(isinstance(mesh, Mesh) and len(mesh.faces) > 0 for mesh in meshes)


def following(value: Value, choices: Sequence[Value], step: int = 1) -> Value:
    """Return the choice ``step`` places after ``value``, cyclically."""
    index = choices.index(value) if value in choices else -1
    return choices[(index + step) % len(choices)]
