"""How a frame is drawn: the options of `Renderer.render` and the scene's colours, checked.

In: options as callers write them. Out: `FrameOptions`, whose `native` the core takes as it is. They
are made when an option or a colour changes, and kept from frame to frame meanwhile.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Iterable
from typing import TYPE_CHECKING, TypedDict

from ._native import rasterizer as _native
from .attributes import choose
from .choices import (
    ColorLike,
    Cull,
    Culling,
    HiddenSurfaces,
    Mode,
    Normals,
    Output,
    Shading,
    Wireframe,
)
from .colors import check_color
from .display_colors import display_color, shading_color
from .errors import InvalidArgumentError
from .native_handles import MeshNeeds
from .number_checks import real, shown
from .scene import Scene

if TYPE_CHECKING:
    from .frame import Frame
    from .view import CameraChoice

_MAX_LINE = 256.0
_NO_CLAMP = (0.0, math.inf)
# Modes whose colours go through the sRGB encoder; the others give display values.
_ENCODED_MODES = ("lit", "unlit")


class RenderOptions(TypedDict, total=False):
    """The keyword arguments of `Renderer.render`, for functions that pass them on."""

    mode: Mode
    wireframe: Wireframe | None
    cull: Cull
    shading: Shading
    outputs: Iterable[Output]
    out: Frame | None
    normals: Normals
    hidden_surfaces: HiddenSurfaces
    line_width: float
    line_color: ColorLike
    hidden_lines: bool
    point_size: float
    culling: Culling
    culling_camera: CameraChoice
    batching: bool


class FrameOptions:
    """The options of a frame.

    Parameters
    ----------
    scene : Scene
        Its background, ambient light and limits of light count as options.
    color_space : {"srgb", "linear"}
    line_color, mode, wireframe, cull, shading, normals, hidden_surfaces, hidden_lines, line_width,
    point_size, culling
        As for `Renderer.render`.

    Attributes
    ----------
    native : NativeOptions
    headlight_color : tuple of 3 float
        Of the light of scenes without lights; with the ambient it adds up to white.
    mark_size : float
        Pixels; lines and points reach less than half of this beyond where they are.

    Raises
    ------
    InvalidArgumentError
    """

    def __init__(
        self,
        scene: Scene,
        color_space: str,
        line_color,
        mode,
        wireframe,
        cull,
        shading,
        normals,
        hidden_surfaces,
        hidden_lines: bool,
        line_width,
        point_size,
        culling,
    ) -> None:
        self.mode = choose(mode, _native.MODES, "mode")
        self.normals = choose(normals, _native.NORMALS, "normals")
        self._has_edges = choose(wireframe, _native.WIREFRAMES, "wireframe") is not None
        self._needs: dict[tuple[str, ...], MeshNeeds] = {}
        encoded = mode in _ENCODED_MODES and color_space == "srgb"
        convert = shading_color if encoded else display_color
        if scene.background is None:
            background = (0.0, 0.0, 0.0, 0.0)
        else:
            background = (*convert(scene.background, color_space), 1.0)
        ambient = shading_color(scene.ambient, color_space)
        self.headlight_color = tuple(max(0.0, 1.0 - component) for component in ambient)
        hidden = choose(hidden_surfaces, _native.HIDDEN_SURFACES, "hidden_surfaces")
        self.native = _native.NativeOptions(
            mode=_native.MODES[mode],
            cull=_native.CULLS[choose(cull, _native.CULLS, "cull")],
            wireframe=_native.WIREFRAMES[wireframe],
            hidden=_native.HIDDEN_SURFACES[hidden],
            shading=_native.SHADINGS[choose(shading, _native.SHADINGS, "shading")],
            normals=_native.NORMALS[normals],
            culling=_native.CULLINGS[choose(culling, _native.CULLINGS, "culling")],
            remove_hidden_lines=not hidden_lines,
            line_width=_line_size(line_width, "line_width"),
            point_size=_line_size(point_size, "point_size"),
            line_color=convert(check_color(line_color, "line_color"), color_space),
            background=background,
            encode_srgb=encoded,
            decode_srgb=color_space == "srgb",
            ambient=ambient,
            light_clamp=scene.light_clamp or _NO_CLAMP,
        )
        # Twice as far from its middle as the widest line or point reaches, and for rounding.
        self.mark_size = 2.0 * (max(line_width, point_size) + 2.0)

    def needs(self, outputs: tuple[str, ...]) -> MeshNeeds:
        """Return which derived arrays of meshes a frame with these outputs reads."""
        known = self._needs.get(outputs)
        if known is None:
            shaded = "color" in outputs
            reads_normals = "normal" in outputs or "world_normal" in outputs
            reads_normals = reads_normals or (shaded and self.mode in ("lit", "normal"))
            known = self._needs[outputs] = MeshNeeds(
                vertex_normals=reads_normals and self.normals != "flat",
                face_normals=reads_normals and self.normals != "smooth",
                edges=shaded and self._has_edges,
            )
        return known


class OptionsCache:
    """The options of the last frame, for as long as none changes.

    Identity decides, because (255, 255, 255) and (255.0, 255.0, 255.0) are equal, but not the same
    colour. What is compared cannot change in place: a colour that could is not kept.
    """

    def __init__(self, color_space: str) -> None:
        self._color_space = color_space
        self._compared: tuple = ()
        self._options: FrameOptions | None = None

    def get(self, scene: Scene, line_color, *others) -> FrameOptions:
        """Return the options of a frame; ``others`` are the rest, in `FrameOptions`'s order."""
        given = (line_color, *others, scene.background, scene.ambient, scene.light_clamp)
        if not self._compared or not all(map(operator.is_, given, self._compared)):
            self._compared = ()
            self._options = FrameOptions(scene, self._color_space, line_color, *others)
            if type(line_color) is tuple:
                self._compared = given
        return self._options


def _line_size(value, what: str) -> float:
    number = real(value)
    if not 0 < number <= _MAX_LINE:
        raise InvalidArgumentError(
            f"{what} must be more than 0 and at most 256, not {shown(value)}"
        )
    return number
