"""The options of a frame, as the core takes them: `RenderOptions` and the scene's colours.

In: checked options. Out: `FrameOptions`, whose `native` the core takes as it is. It is rebuilt when
an option or a colour changes, and kept from frame to frame otherwise.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any, TypeAlias, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from .._native import rasterizer as _native
from .._native.rasterizer import same_objects
from ..base import linalg
from ..base.calls import refuse_unknown
from ..choices import Color, ColorSpace
from ..model.environments.environment import Environment
from ..model.materials.display_colors import display_color, exact_display_color, shading_color
from ..model.scene.fog import Fog
from ..model.scene.gradients import Gradient
from ..model.scene.lights import WHITE_INTENSITY
from ..model.scene.staged_scene import AnyScene
from ..model.scene.surroundings import values_of
from ._tone_inverse import light_that_shows
from .draw_list.draw_list import Listing
from .draw_list.light_list import Headlight
from .draw_list.native_handles import MeshNeeds, native_environment
from .draw_list.placement import Placing
from .options import (
    DEFAULTS,
    WHITE,
    OptionKeywords,
    RenderKeywords,
    RenderOptions,
    check_outputs,
    checked_options,
    core_numbers,
    shows_light,
)

Key = TypeVar("Key")
Value = TypeVar("Value")
#: Converts a colour to the core's format.
Convert: TypeAlias = Callable[[tuple[Any, ...], ColorSpace], Color]

_NO_CLAMP = (0.0, math.inf)
_MOST_BLURRED = 8.0  # the last level of an environment: E3D_ENVIRONMENT_LEVELS - 1
_MAX_KEPT = 16  # for programs that alternate between pictures
# Settings that differ if surfaces are drawn without colour.
_WITHOUT_COLOR = {
    "mode": _native.MODES["lit"],  # without what is blended or lets light pass
    "wireframe": _native.WIREFRAMES[None],
    "remove_hidden_lines": True,
    "transparent_outputs": False,
    "tone_mapping": _native.TONE_MAPPINGS["none"],
    "light_clamp": _NO_CLAMP,
    "exposure": 1.0,
}
# The backdrop of light that is not the scene's environment.
_AS_IT_IS = {"backdrop.light.intensity": 1.0, "backdrop.level": 0.0}
# Settings that differ if blended surfaces and edges are left out.
_OPAQUE = {"wireframe": _native.WIREFRAMES[None], "opaque_only": True}
# Modes whose colours go through the sRGB encoder; the others give display values.
_ENCODED_MODES = ("lit", "unlit")


class FrameOptions:
    """The options of a frame.

    Parameters
    ----------
    scene : Scene
        Its background, ambient light, environment and light clamp count as options.
    threads : int
        Threads that prepare environments; 0: all.
    color_space : {"srgb", "linear"}
    options : RenderOptions
    height : int
        Of the picture, in pixels.
    beyond : Environment, optional
        Its light takes the place of a plain background.

    Attributes
    ----------
    native : NativeOptions
    has_backdrop : bool
        Whether an environment is the background.
    is_transparent : bool
        Whether nothing is.
    """

    def __init__(
        self,
        scene: AnyScene,
        color_space: ColorSpace,
        options: RenderOptions,
        threads: int,
        height: int,
        beyond: Environment | None = None,
    ) -> None:
        self._options = options
        self._listings: dict[tuple[str, ...], Listing] = {}
        encoded = options.mode in _ENCODED_MODES and color_space == "srgb"
        convert = shading_color if encoded else display_color
        environment = backdrop = None
        if isinstance(scene.background, Environment) and options.mode in _ENCODED_MODES:
            backdrop = native_environment(scene.background, threads)
        elif beyond is not None:
            backdrop = native_environment(beyond, threads)
        if scene.environment is not None and options.mode == "lit":
            environment = native_environment(scene.environment, threads)
        ambient = shading_color(scene.ambient, color_space)
        self._headlight: Color | None = None
        if environment is None:
            red, green, blue = (WHITE_INTENSITY * max(0.0, 1.0 - part) for part in ambient)
            self._headlight = red, green, blue
        line_width = options.pixels_of(options.line_width, height)
        point_size = options.pixels_of(options.point_size, height)
        self._numbers = core_numbers(options) | {"line_width": line_width, "point_size": point_size}
        self._lit = (
            {
                **self._numbers,
                **_background(scene, color_space, convert),
                **_environment(scene),
                **(_AS_IT_IS if beyond is not None else {}),
                "line_color": convert(cast(Color, options.line_color), color_space),
                "encode_srgb": encoded,
                "decode_srgb": color_space == "srgb",
                "ambient": ambient,
                "light_clamp": scene.light_clamp or _NO_CLAMP,
                "exposure": 2.0**scene.exposure,
            },
            environment,
            backdrop,
            _fog(scene, color_space, options),
        )
        self.native = _native.NativeOptions(*self._lit)
        self.has_backdrop = backdrop is not None
        self.is_transparent = scene.background is None
        # Pixels: twice the reach of the widest line or point from its middle, to allow for
        # rounding.
        self._mark_size = 2.0 * (max(line_width, point_size) + 2.0)

    @cached_property
    def surfaces(self) -> _native.NativeOptions:
        """The same options for drawing without colour."""
        return _native.NativeOptions(self._numbers | _WITHOUT_COLOR)

    @cached_property
    def opaque(self) -> _native.NativeOptions:
        """The same options for drawing what isn't blended."""
        numbers, environment, backdrop, fog = self._lit
        return _native.NativeOptions(numbers | _OPAQUE, environment, backdrop, fog)

    def headlight(self, towards_viewer: Sequence[float]) -> Headlight | None:
        """Return the light of a scene without lights: with the ambient light it makes white.

        An environment replaces it.
        """
        return None if self._headlight is None else (self._headlight, towards_viewer)

    def listing(self, outputs: tuple[str, ...]) -> Listing:
        """Return how to list objects for a frame with given outputs."""
        known, options = self._listings.get(outputs), self._options
        if known is None:
            shaded = shows_light(outputs)
            reads_normals = any(name.endswith("normal") for name in outputs)
            reads_normals = reads_normals or (shaded and options.mode in ("lit", "normal"))
            needs = MeshNeeds(
                vertex_normals=reads_normals and options.normals not in ("flat", "facet"),
                face_normals=reads_normals and options.normals != "smooth",
                edges="color" in outputs and options.wireframe is not None,
            )
            known = Listing(needs, options.normals, options.cull == "auto")
            self._listings[outputs] = known
        return known

    def placing(self, frustum: NDArray[np.float64], size: tuple[int, int]) -> Placing:
        """Return how to place nodes in a picture of a given size and frustum."""
        culling = self._options.culling
        return Placing(
            None if culling == "none" else frustum,
            self._mark_size / min(size),
            culling == "frustum",
            self._options.batching,
        )


def _background(scene: AnyScene, color_space: ColorSpace, convert: Convert) -> dict[str, Any]:
    """Return the background for the core; an environment is passed separately."""
    background = scene.background
    if background is None:
        return {"background": (0.0, 0.0, 0.0, 0.0)}
    if isinstance(background, Environment):
        return {"background": (0.0, 0.0, 0.0, 1.0)}
    if isinstance(background, Gradient):
        ends = background.top, background.bottom
        top, bottom = (exact_display_color(cast(Color, end), color_space) for end in ends)
        shown = {"gradient.shows": True, "gradient.top": top, "gradient.bottom": bottom}
        return {"background": (0.0, 0.0, 0.0, 1.0), **shown}
    return {"background": (*convert(background, color_space), 1.0)}


def _environment(scene: AnyScene) -> dict[str, float]:
    """Return the rotation, intensity and blur of an environment, for the core."""
    turn, intensity = scene.environment_rotation, scene.environment_intensity
    cosine, sine = linalg.cos(turn), linalg.sin(turn)
    return {
        "environment.cosine": cosine,
        "environment.sine": sine,
        "environment.intensity": intensity,
        "backdrop.light.cosine": cosine,
        "backdrop.light.sine": sine,
        "backdrop.light.intensity": intensity * 2.0**scene.exposure,
        "backdrop.level": scene.background_blur * _MOST_BLURRED,
    }


def _fog(
    scene: AnyScene, color_space: ColorSpace, options: RenderOptions
) -> tuple[Any, ...] | None:
    """Return a scene's fog for the core: colours, depths and density; or None."""
    fog = scene.fog
    if fog is None:
        return None
    color = shading_color(cast(Color, fog.color), color_space)
    lit = light_that_shows(color, options.tone_mapping) if options.mode == "lit" else color
    if isinstance(fog, Fog):
        return color, lit, (fog.near, fog.far), 0.0
    return color, lit, None, fog.density


class OptionsCache:
    """The options of the last frames, each kept until one of its inputs changes.

    Inputs are compared by identity, because (255, 255, 255) and (255.0, 255.0, 255.0) are equal but
    not the same colour. Options with a mutable colour are not cached, since it could change in
    place.
    """

    def __init__(self, color_space: ColorSpace, threads: int) -> None:
        self._color_space = color_space
        self._threads = threads
        # By outputs and other keywords: their values, and the options they name.
        self._named: dict[tuple[object, ...], tuple[tuple[Any, ...], RenderOptions]] = {}
        # By identity of options: these, the scene's colours, and the frame options made from both.
        self._found: dict[int, tuple[tuple[Any, ...], FrameOptions]] = {}

    def named(self, options: RenderOptions | None, keywords: OptionKeywords) -> RenderOptions:
        """Return the options of a call as `checked_options` does; the same object each time."""
        if options is not None:
            return checked_options(options, keywords)
        return self._of_keywords(keywords) if keywords else DEFAULTS

    def _of_keywords(self, keywords: OptionKeywords) -> RenderOptions:
        names = keywords.pop("outputs", DEFAULTS.outputs)
        if type(names) is not tuple:
            names = check_outputs(names)
        key = names, *keywords
        given = tuple(keywords.values())
        try:
            known = self._named.get(key)
        except TypeError:  # an unhashable value names no output
            names = check_outputs(names)
        if known is not None and same_objects(given, known[0]):
            return known[1]
        refuse_unknown("render", keywords, RenderKeywords.__annotations__)
        keywords["outputs"] = names
        options = RenderOptions(**keywords)
        if type(keywords.get("line_color", WHITE)) is tuple:
            _keep(self._named, key, (given, options))
        return options

    def get(
        self,
        scene: AnyScene,
        options: RenderOptions,
        height: int,
        beyond: Environment | None = None,
    ) -> FrameOptions:
        """Return the frame options for a scene's current state and a picture's height."""
        seen = options, height, beyond, *values_of(scene)
        known = self._found.get(id(options))
        if known is None or not same_objects(seen, known[0]):
            how = self._color_space, options, self._threads, height, beyond
            known = seen, FrameOptions(scene, *how)
            _keep(self._found, id(options), known)
        return known[1]


def _keep(cache: dict[Key, Value], key: Key, value: Value) -> None:
    if len(cache) >= _MAX_KEPT:
        cache.clear()
    cache[key] = value
