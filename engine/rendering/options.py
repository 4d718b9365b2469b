"""The options of a picture, checked once and used for any number of frames.

In: options as callers write them. Out: `RenderOptions`, which cannot change; what depends on the
scene as well is found for each frame (_frame_options.py).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypedDict

from .._native import rasterizer as _native
from .._support.numbers import real, shown
from .._support.validation import choose, optional_positive
from ..choices import (
    ColorLike,
    Cull,
    Culling,
    HiddenSurfaces,
    Mode,
    Normals,
    Shading,
    Wireframe,
)
from ..errors import InvalidArgumentError
from ..materials.colors import check_color
from .frame import OUTPUTS, Output

if TYPE_CHECKING:
    from ._view import CameraChoice
    from .frame import Frame

WHITE = (1.0, 1.0, 1.0)
MAX_LINE = 256.0  # pixels: the widest line, the largest point


def check_outputs(outputs: Iterable[str]) -> tuple[str, ...]:
    """Return the names of outputs, checked."""
    if isinstance(outputs, str) or not isinstance(outputs, Iterable):
        raise InvalidArgumentError(f"outputs must be a tuple of names, not {outputs!r}")
    names = tuple(choose(name, OUTPUTS, "outputs") for name in outputs)
    if not names:
        raise InvalidArgumentError('outputs must name at least one output, such as "color"')
    return names


def _line_size(value, what: str) -> float:
    number = real(value)
    if not 0 < number <= MAX_LINE:
        raise InvalidArgumentError(
            f"{what} must be more than 0 and at most 256, not {shown(value)}"
        )
    return number


class RenderKeywords(TypedDict, total=False):
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
    transparent_outputs: bool
    ambient_occlusion: bool
    ambient_occlusion_radius: float | None
    options: RenderOptions | None


@dataclass(frozen=True, kw_only=True)
class RenderOptions:
    """How pictures are drawn: made once, checked, and given to any number of frames.

    Options cannot change; ``dataclasses.replace(options, mode="depth")`` makes others. They can be
    compared, hashed, copied and pickled.

    Parameters
    ----------
    mode, wireframe, cull, shading, outputs, normals, hidden_surfaces, line_width, line_color,
    hidden_lines, point_size, culling, batching, transparent_outputs, ambient_occlusion,
    ambient_occlusion_radius
        As for `Renderer.render`, and read under the same names.

    Raises
    ------
    InvalidArgumentError
    """

    mode: Mode = "lit"
    wireframe: Wireframe | None = None
    cull: Cull = "back"
    shading: Shading = "deferred"
    outputs: Iterable[Output] = ("color",)
    normals: Normals = "auto"
    hidden_surfaces: HiddenSurfaces = "zbuffer"
    line_width: float = 1.0
    line_color: ColorLike = WHITE
    hidden_lines: bool = False
    point_size: float = 1.0
    culling: Culling = "all"
    batching: bool = True
    transparent_outputs: bool = False
    ambient_occlusion: bool = False
    ambient_occlusion_radius: float | None = None

    def __post_init__(self) -> None:
        choose(self.mode, _native.MODES, "mode")
        choose(self.wireframe, _native.WIREFRAMES, "wireframe")
        choose(self.cull, _native.CULLS, "cull")
        choose(self.shading, _native.SHADINGS, "shading")
        choose(self.normals, _native.NORMALS, "normals")
        choose(self.hidden_surfaces, _native.HIDDEN_SURFACES, "hidden_surfaces")
        choose(self.culling, _native.CULLINGS, "culling")
        self.__dict__.update(  # past __setattr__, which refuses
            outputs=check_outputs(self.outputs),
            line_width=_line_size(self.line_width, "line_width"),
            line_color=check_color(self.line_color, "line_color"),
            hidden_lines=bool(self.hidden_lines),
            point_size=_line_size(self.point_size, "point_size"),
            batching=bool(self.batching),
            transparent_outputs=bool(self.transparent_outputs),
            ambient_occlusion=bool(self.ambient_occlusion),
            ambient_occlusion_radius=optional_positive(
                self.ambient_occlusion_radius, "ambient_occlusion_radius"
            ),
        )


_DEFAULTS = RenderOptions()


def either(options: RenderOptions | None, keywords: RenderOptions) -> RenderOptions:
    """Return the options that were given as such, or those that keyword arguments named.

    Raises
    ------
    InvalidArgumentError
        Both were given.
    """
    if options is None:
        return keywords
    if not isinstance(options, RenderOptions):
        raise InvalidArgumentError(f"options must be RenderOptions, not {type(options).__name__}")
    if keywords != _DEFAULTS:
        raise InvalidArgumentError(
            "give options or keyword arguments, not both: dataclasses.replace makes other options"
        )
    return options
