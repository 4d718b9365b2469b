"""Rendering options, checked once and used for any number of frames.

In: options as callers write them. Out: immutable `RenderOptions`; _frame_options.py computes, for
each frame, what also depends on the scene.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING, Any, TypeAlias, TypedDict, cast, get_args

from .._native import rasterizer as _native
from ..base.calls import Function, checks_types, hints_keywords, refuse_unknown
from ..base.numbers import real, shown
from ..base.validation import choose, flag, one_of, optional_positive, whole_number
from ..choices import (
    ColorLike,
    Culling,
    FrameCull,
    HiddenSurfaces,
    LineShape,
    Mode,
    Normals,
    OutputMode,
    PointShape,
    Shading,
    SizeUnit,
    ToneMapping,
    Wireframe,
)
from ..errors import InvalidArgumentError
from ..model.materials.colors import check_color
from .frame import OUTPUTS, Output

if TYPE_CHECKING:
    from .camera_choice import CameraChoice
    from .frame import Frame

#: Checks the value of a named option, and returns the value to keep.
Check: TypeAlias = Callable[[Any, str], Any]
#: The core's numbers for the values of an option.
Numbers: TypeAlias = Mapping[Any, float]

#: Bytes that a frame may take besides its outputs and a few bytes per pixel: docs/reliability.md.
MAX_FRAME_BYTES = 1 << 30
WHITE = (1.0, 1.0, 1.0)
OUTPUT_MODES: tuple[OutputMode, ...] = get_args(OutputMode)
MODES: tuple[Mode | OutputMode, ...] = (*get_args(Mode), *OUTPUT_MODES)
MAX_LINE = 256.0  # pixels: the widest line, the largest point
_MAX_BLOOM = 100.0
_MAX_DEPTH = 8
SIZE_UNITS: tuple[SizeUnit, ...] = get_args(SizeUnit)
_ROWS = 1000  # the picture height at which sizes in "picture" equal pixels


def check_outputs(outputs: Iterable[str]) -> tuple[Output, ...]:
    """Return names of outputs, checked."""
    if isinstance(outputs, str) or not isinstance(outputs, Iterable):
        raise InvalidArgumentError(f"outputs must be a tuple of names, not {outputs!r}")
    names = tuple(choose(name, OUTPUTS, "outputs") for name in outputs)
    if not names:
        raise InvalidArgumentError('outputs must name at least one output, such as "color"')
    return names


def shows_light(outputs: Iterable[str]) -> bool:
    """Return whether the outputs show light, so that shadows and lighting must be computed."""
    return "color" in outputs or "radiance" in outputs


def lights_faces(options: RenderOptions, outputs: Iterable[str]) -> bool:
    """Return whether the outputs show lit faces; radiance does beneath edges, too."""
    shows_faces = options.wireframe != "only" or "radiance" in outputs
    return options.mode == "lit" and shows_faces and shows_light(outputs)


def drawn_mode(mode: Mode | OutputMode) -> Mode:
    """Return the mode that the core draws for one: an output is painted over the picture."""
    if mode in OUTPUT_MODES:
        return "lit" if mode == "radiance" else "unlit"
    return cast(Mode, mode)


def size_in_picture(pixels: float, height: int) -> float:
    """Convert a size in pixels to ``size_unit="picture"`` for a picture of given height."""
    return pixels * _ROWS / height


def _line_size(value: float, what: str) -> float:
    number = real(value)
    if not 0 < number <= MAX_LINE:
        raise InvalidArgumentError(
            f"{what} must be more than 0 and at most 256, not {shown(value)}"
        )
    return number


def _strength(value: float, what: str) -> float:
    number = real(value)
    if not 0 <= number <= _MAX_BLOOM:
        raise InvalidArgumentError(f"{what} must be in 0..{_MAX_BLOOM:g}, not {shown(value)}")
    return number


def _depth(value: int, what: str) -> int:
    return whole_number(value, what, 0, _MAX_DEPTH)


def _option(default: Any, check: Check, core: str = "", numbers: Numbers | None = None) -> Any:
    """Return a row of `RenderOptions`: ``check(value, name)`` returns what to keep, or raises.

    ``core`` is the member of e3d_frame that takes it unless something else decides, and ``numbers``
    maps values to the core's numbers.
    """
    return field(default=default, metadata={"check": check, "core": core, "numbers": numbers})


def _choice(default: str | None, numbers: Numbers, core: str) -> Any:
    return _option(default, one_of(tuple(numbers)), core, numbers)


class OptionKeywords(TypedDict, total=False):
    """The fields of `RenderOptions` as keyword arguments, for type checkers."""

    mode: Mode | OutputMode
    wireframe: Wireframe | None
    cull: FrameCull
    shading: Shading
    outputs: Iterable[Output]
    normals: Normals
    hidden_surfaces: HiddenSurfaces
    line_width: float
    line_color: ColorLike
    hidden_lines: bool
    point_size: float
    culling: Culling
    batching: bool
    transparent_outputs: bool
    tone_mapping: ToneMapping
    bloom: float
    line_shape: LineShape
    point_shape: PointShape
    size_unit: SizeUnit
    alpha_to_coverage: bool
    sample_shading: bool
    specular_antialiasing: bool
    ambient_occlusion: bool
    ambient_occlusion_radius: float | None
    mirror_depth: int
    refraction: bool


class RenderKeywords(OptionKeywords, total=False):
    """The keyword arguments of `Renderer.render`, for functions that pass them on."""

    out: Frame | None
    culling_camera: CameraChoice
    options: RenderOptions | None


@hints_keywords
@dataclass(frozen=True, kw_only=True)
class RenderOptions:
    """Options for drawing frames: created and checked once, used for any number of frames.

    Options are immutable; ``dataclasses.replace(options, mode="depth")`` makes others. They can be
    compared, hashed, copied and pickled.

    Parameters
    ----------
    mode : str
        What the colour shows: ``"lit"`` surfaces, ``"unlit"`` surface colours, a ``"random"``
        colour per triangle, nearness as ``"depth"``, view-space normals as ``"normal"``, IDs as
        ``"face_id"`` and ``"object_id"``, or how often each pixel was covered, ``"overdraw"``. An
        output is painted over the surfaces, and added to the frame together with ``depth``:
        ``"albedo"``, ``"position"``, ``"world_position"``, ``"world_normal"``, ``"uv"``,
        ``"barycentric"``, ``"metallic_roughness"``, ``"emissive"``, ``"tangent"``, ``"radiance"``,
        ``"range"``, ``"instance_id"`` or ``"material_id"``.
    wireframe : {None, "overlay", "only"}
        Draw the visible edges over the picture, or instead of its faces.
    cull : {"back", "front", "none", "auto"}
        Face culling: of back faces, front faces or none. ``"auto"`` shows both sides, but culls the
        back faces of opaque closed meshes where that does not change the picture.
    shading : {"deferred", "forward"}
        Deferred shades each visible pixel once, forward shades pixels as they are drawn. Both give
        the same bytes.
    outputs : iterable of str
        Which arrays the frame holds: see `Frame`.
    normals : {"auto", "smooth", "flat", "facet"}
        Vertex or face normals; ``"auto"`` follows each material's ``flat_shading``. With
        ``"facet"`` each triangle is also lit once, at its centre.
    hidden_surfaces : {"zbuffer", "painter", "none"}
        The method of hidden-surface removal: depth buffer, painter's algorithm (drawing from
        far to near), or none.
    line_width, point_size : float
        In ``size_unit``, above 0 and up to 256.
    line_color : str or sequence of 3 numbers
        Colour of the wireframe.
    hidden_lines : bool
        With ``wireframe="only"``: also show edges hidden behind faces.
    culling : {"all", "tree", "frustum", "none", "always"}
        The culling method. ``"all"``: frustum culling of nodes and clusters, back-face culling of
        clusters, and occlusion culling where it may pay; ``"always"`` tests occlusion in every
        frame. ``"tree"``: only frustum culling of nodes (and instances), by the scene's tree of
        boxes. ``"frustum"``: the same, by testing their boxes one by one. ``"none"``: no culling.
        The picture is the same; ``frame.stats["boxes_tested"]`` counts the tests.
    batching : bool
        Pass nodes with the same mesh to the core as one draw. The picture is the same.
    transparent_outputs : bool
        Whether outputs other than ``color`` show the nearest surface even if it is blended, instead
        of the nearest opaque one. ``radiance`` always has all layers. Modes other than "lit" and
        "unlit" always draw blended surfaces as opaque.
    tone_mapping : {"none", "neutral", "aces", "agx"}
        Tone mapping in mode "lit", of lit surfaces and an environment background. ``"none"`` clamps
        to 1; ``"neutral"`` (Khronos PBR Neutral) keeps colours up to 0.8 and compresses brighter
        ones; ``"aces"`` and ``"agx"`` look like film, the latter with softer contrast.
    bloom : float
        Strength of the glow around light above 1, in modes "lit" and "unlit", 0 to 100; 1 is
        strong. It leaves alpha unchanged, so no glow spreads over a transparent background.
    line_shape : {"plain", "round"}
        The shape of lines and wireframe edges. ``"plain"``: ends are cut along a row or column, and
        lines up to a pixel wide take one pixel per step, so that slanted lines look thinner.
        ``"round"``: exact width at any angle, with round caps, so that lines that meet have round
        joins.
    point_shape : {"square", "round"}
    size_unit : {"pixels", "picture"}
        Unit of line_width and point_size: pixels, or thousandths of the picture's height, so that a
        scene looks alike at every size; the result is clamped to 1 to 256 pixels.
    alpha_to_coverage : bool
        With ``antialiasing="msaa"``: materials with ``alpha_mode="mask"`` cover as many of a
        pixel's samples as lie on the side of the edge where alpha is above ``alpha_cutoff``, so
        that foliage has edges as smooth as those of faces, and does not vanish in the distance.
        Without it the alpha test keeps all samples of a pixel or none, as it always does of
        materials with ``transmission``.
    sample_shading : bool
        With ``antialiasing="msaa"``: each sample of a pixel gets a colour of its own, so that edges
        inside of faces are as smooth as those of faces: exact shadows, magnified
        ``filter="nearest"`` textures, sharp highlights. It takes nearly as long as as many samples
        a pixel without multisampling. Without it a face gets one colour in a pixel.
    specular_antialiasing : bool
        In mode "lit": highlights of physically based materials are as wide as normals differ within
        a pixel, of curved meshes and of normal maps seen from afar, so that small highlights do not
        flicker when something moves. Without it each sample shows the roughness of the material.
    ambient_occlusion : bool
        In mode "lit": darken ambient light in corners and hollows.
    ambient_occlusion_radius : float, optional
        World units: occluders farther away are ignored. By default a fraction of the diagonal of
        the scene's box.
    mirror_depth : int
        In mode "lit": how many mirrors (`Material.mirror`) light may meet on its way, 0 to 8. Each
        flat mirror in view takes a view of the scene of its own, and so does each mirror in it.
        Beyond, mirrors look as without.
    refraction : bool
        In mode "lit", with ``hidden_surfaces="zbuffer"``: materials with ``transmission`` bend what
        is behind them by ``thickness`` and ``ior``, and blur it by ``roughness``. Where such glass
        shows, opaque surfaces are drawn once more. Otherwise light passes straight and sharp.

    Raises
    ------
    InvalidArgumentError
    """

    mode: Mode | OutputMode = _option("lit", one_of(MODES), "mode", _native.MODES)
    wireframe: Wireframe | None = _choice(None, _native.WIREFRAMES, "wireframe")
    cull: FrameCull = _choice("auto", {**_native.CULLS, "auto": _native.CULLS["back"]}, "cull")
    shading: Shading = _choice("deferred", _native.SHADINGS, "shading")
    outputs: Iterable[Output] = _option(("color",), lambda value, _: check_outputs(value))
    normals: Normals = _choice("auto", _native.NORMALS, "normals")
    hidden_surfaces: HiddenSurfaces = _choice("zbuffer", _native.HIDDEN_SURFACES, "hidden")
    line_width: float = _option(1.0, _line_size)
    line_color: ColorLike = _option(WHITE, check_color)
    hidden_lines: bool = _option(False, flag, "remove_hidden_lines", {False: True, True: False})
    point_size: float = _option(1.0, _line_size)
    culling: Culling = _choice("all", _native.CULLINGS, "culling")
    batching: bool = _option(True, flag)
    transparent_outputs: bool = _option(False, flag, "transparent_outputs")
    tone_mapping: ToneMapping = _choice("none", _native.TONE_MAPPINGS, "tone_mapping")
    bloom: float = _option(0.0, _strength)
    line_shape: LineShape = _choice("plain", _native.LINE_SHAPES, "line_shape")
    point_shape: PointShape = _choice("square", _native.POINT_SHAPES, "point_shape")
    size_unit: SizeUnit = _option("pixels", one_of(SIZE_UNITS))
    alpha_to_coverage: bool = _option(True, flag, "alpha_to_coverage")
    sample_shading: bool = _option(False, flag, "sample_shading")
    specular_antialiasing: bool = _option(True, flag, "specular_antialiasing")
    ambient_occlusion: bool = _option(False, flag)
    ambient_occlusion_radius: float | None = _option(None, optional_positive)
    mirror_depth: int = _option(2, _depth)
    refraction: bool = _option(True, flag)

    def __post_init__(self) -> None:
        for one in fields(self):  # bypasses __setattr__, which refuses
            self.__dict__[one.name] = one.metadata["check"](self.__dict__[one.name], one.name)

    @checks_types
    def pixels_of(self, size: float, height: int) -> float:
        """Convert a line width or point size to pixels, for a picture of given height.

        Parameters
        ----------
        size : float
            `line_width` or `point_size`.
        height : int
            Pixels.

        Returns
        -------
        float
            Pixels. A size in ``"picture"`` units is clamped to 1 to 256 pixels, so that thin lines
            stay connected in small pictures.
        """
        if self.size_unit == "pixels":
            return size
        return min(max(1.0, size * height / _ROWS), MAX_LINE)


if RenderOptions.__doc__ is not None:  # which -OO leaves out
    _outputs = ",\n    ".join(f"``{name}``" for name in OUTPUTS)
    RenderOptions.__doc__ = inspect.cleandoc(RenderOptions.__doc__).replace(
        "holds: see `Frame`.", f"holds; see `Frame`:\n    {_outputs}."
    )
DEFAULTS = RenderOptions()


def checked_options(options: RenderOptions | None, keywords: OptionKeywords) -> RenderOptions:
    """Return the options of a call: the given ones, or those that its keywords name.

    Raises
    ------
    InvalidArgumentError
        An option is wrong, or both options and keywords were given.
    TypeError
        A keyword is not an option.
    """
    refuse_unknown("render", keywords, RenderKeywords.__annotations__)
    named = RenderOptions(**keywords) if keywords else DEFAULTS
    if options is None:
        return named
    if not isinstance(options, RenderOptions):
        raise InvalidArgumentError(f"options must be RenderOptions, not {type(options).__name__}")
    if named != DEFAULTS:
        raise InvalidArgumentError(
            "give options or keyword arguments, not both: dataclasses.replace makes other options"
        )
    return options


def core_numbers(options: RenderOptions) -> dict[str, float]:
    """Return the options that the core takes unchanged, by members of e3d_frame."""
    found = {}
    for one in fields(options):
        value, numbers = getattr(options, one.name), one.metadata["numbers"]
        if one.metadata["core"]:
            found[one.metadata["core"]] = numbers[value] if numbers else value
    return found


def shows_options(function: Function) -> Function:
    """Make ``help`` list the options among the keyword arguments of a function."""
    signature = inspect.signature(function)
    own = list(signature.parameters.values())[:-1]
    rows = [
        inspect.Parameter(
            one.name, inspect.Parameter.KEYWORD_ONLY, default=one.default, annotation=one.type
        )
        for one in fields(RenderOptions)
    ]
    vars(function)["__signature__"] = signature.replace(parameters=own + rows)
    return function


@functools.lru_cache(16)
def as_mirrored(options: RenderOptions, scale: int) -> RenderOptions:
    """Return the options of what a mirror shows: the same object each time.

    Parameters
    ----------
    options : RenderOptions
        Those of the picture with the mirror.
    scale : int
        How many of the mirror's pixels are side by side in a pixel of that picture.
    """
    depth, wide = options.mirror_depth - 1, scale if options.size_unit == "pixels" else 1
    sizes = (min(size * wide, MAX_LINE) for size in (options.line_width, options.point_size))
    line, point = sizes
    return replace(options, mirror_depth=depth, wireframe=None, line_width=line, point_size=point)


@functools.lru_cache(16)
def with_both_sides(options: RenderOptions) -> RenderOptions:
    """Return the options without face culling: the same object each time."""
    return replace(options, cull="none")
