"""The options of a picture, checked once and used for any number of frames.

In: options as callers write them. Out: `RenderOptions`, which cannot change; what depends on the
scene as well is found for each frame (_frame_options.py).
"""

from __future__ import annotations

import functools
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypedDict, get_args

from .._native import rasterizer as _native
from .._support.calls import checks_types, hints_keywords
from .._support.numbers import real, shown
from .._support.validation import choose, flag, optional_positive
from ..choices import (
    ColorLike,
    Culling,
    FrameCull,
    HiddenSurfaces,
    LineShape,
    Mode,
    Normals,
    PointShape,
    Shading,
    SizeUnit,
    ToneMapping,
    Wireframe,
)
from ..errors import InvalidArgumentError
from ..materials.colors import check_color
from .frame import OUTPUTS, Output

if TYPE_CHECKING:
    from ._view import CameraChoice
    from .frame import Frame

#: Bytes that a frame may take beside its outputs, and a few for each pixel: docs/reliability.md.
MAX_FRAME_BYTES = 1 << 30
_CULLS = (*_native.CULLS, "auto")
WHITE = (1.0, 1.0, 1.0)
MAX_LINE = 256.0  # pixels: the widest line, the largest point
_MAX_BLOOM = 100.0
SIZE_UNITS: tuple[SizeUnit, ...] = get_args(SizeUnit)
_ROWS = 1000  # of a picture on which sizes in "picture" are pixels


def check_outputs(outputs: Iterable[str]) -> tuple[str, ...]:
    """Return the names of outputs, checked."""
    if isinstance(outputs, str) or not isinstance(outputs, Iterable):
        raise InvalidArgumentError(f"outputs must be a tuple of names, not {outputs!r}")
    names = tuple(choose(name, OUTPUTS, "outputs") for name in outputs)
    if not names:
        raise InvalidArgumentError('outputs must name at least one output, such as "color"')
    return names


def shows_light(outputs: Iterable[str]) -> bool:
    """Whether outputs show light: shadows and all that falls on surfaces are found for them."""
    return "color" in outputs or "radiance" in outputs


def size_in_picture(pixels: float, height: int) -> float:
    """Return a size of pixels as ``size_unit="picture"`` counts it in a picture of some height."""
    return pixels * _ROWS / height


def _line_size(value, what: str) -> float:
    number = real(value)
    if not 0 < number <= MAX_LINE:
        raise InvalidArgumentError(
            f"{what} must be more than 0 and at most 256, not {shown(value)}"
        )
    return number


def _strength(value) -> float:
    number = real(value)
    if not 0 <= number <= _MAX_BLOOM:
        raise InvalidArgumentError(f"bloom must be in 0..{_MAX_BLOOM:g}, not {shown(value)}")
    return number


class RenderKeywords(TypedDict, total=False):
    """The keyword arguments of `Renderer.render`, for functions that pass them on."""

    mode: Mode
    wireframe: Wireframe | None
    cull: FrameCull
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
    tone_mapping: ToneMapping
    bloom: float
    line_shape: LineShape
    point_shape: PointShape
    size_unit: SizeUnit
    alpha_to_coverage: bool
    ambient_occlusion: bool
    ambient_occlusion_radius: float | None
    options: RenderOptions | None


@hints_keywords
@dataclass(frozen=True, kw_only=True)
class RenderOptions:
    """How pictures are drawn: made once, checked, and given to any number of frames.

    Options cannot change; ``dataclasses.replace(options, mode="depth")`` makes others. They can be
    compared, hashed, copied and pickled.

    Parameters
    ----------
    mode, wireframe, cull, ...
        All keywords of `Renderer.render` but the camera's, read under the same names.

    Raises
    ------
    InvalidArgumentError
    """

    mode: Mode = "lit"
    wireframe: Wireframe | None = None
    cull: FrameCull = "back"
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
    tone_mapping: ToneMapping = "none"
    bloom: float = 0.0
    line_shape: LineShape = "plain"
    point_shape: PointShape = "square"
    size_unit: SizeUnit = "pixels"
    alpha_to_coverage: bool = False
    ambient_occlusion: bool = False
    ambient_occlusion_radius: float | None = None

    def __post_init__(self) -> None:
        choose(self.mode, _native.MODES, "mode")
        choose(self.wireframe, _native.WIREFRAMES, "wireframe")
        choose(self.cull, _CULLS, "cull")
        choose(self.shading, _native.SHADINGS, "shading")
        choose(self.normals, _native.NORMALS, "normals")
        choose(self.hidden_surfaces, _native.HIDDEN_SURFACES, "hidden_surfaces")
        choose(self.culling, _native.CULLINGS, "culling")
        choose(self.tone_mapping, _native.TONE_MAPPINGS, "tone_mapping")
        choose(self.line_shape, _native.LINE_SHAPES, "line_shape")
        choose(self.point_shape, _native.POINT_SHAPES, "point_shape")
        choose(self.size_unit, SIZE_UNITS, "size_unit")
        self.__dict__.update(  # past __setattr__, which refuses
            outputs=check_outputs(self.outputs),
            line_width=_line_size(self.line_width, "line_width"),
            line_color=check_color(self.line_color, "line_color"),
            hidden_lines=flag(self.hidden_lines, "hidden_lines"),
            point_size=_line_size(self.point_size, "point_size"),
            batching=flag(self.batching, "batching"),
            transparent_outputs=flag(self.transparent_outputs, "transparent_outputs"),
            bloom=_strength(self.bloom),
            alpha_to_coverage=flag(self.alpha_to_coverage, "alpha_to_coverage"),
            ambient_occlusion=flag(self.ambient_occlusion, "ambient_occlusion"),
            ambient_occlusion_radius=optional_positive(
                self.ambient_occlusion_radius, "ambient_occlusion_radius"
            ),
        )

    @checks_types
    def pixels_of(self, size: float, height: int) -> float:
        """Return what a line's width or a point's size is in a picture of some height.

        Parameters
        ----------
        size : float
            `line_width` or `point_size`.
        height : int
            Pixels.

        Returns
        -------
        float
            Pixels. A size in shares of the picture is at least 1, so that thin lines keep together
            in small pictures, and at most 256.
        """
        if self.size_unit == "pixels":
            return size
        return min(max(1.0, size * height / _ROWS), MAX_LINE)


_DEFAULTS = RenderOptions()


@functools.lru_cache(16)
def with_both_sides(options: RenderOptions) -> RenderOptions:
    """Return the options without culling of faces: the same object each time."""
    return replace(options, cull="none")


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
