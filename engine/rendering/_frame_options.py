"""How a frame is drawn: `RenderOptions` and the scene's colours, as the core takes them.

In: checked options. Out: `FrameOptions`, whose `native` the core takes as it is. They are made when
an option or a colour changes, and kept from frame to frame meanwhile.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from operator import is_

from .._native import rasterizer as _native
from ..materials.display_colors import display_color, shading_color
from ..scene.scene import Scene
from ._native_handles import MeshNeeds
from .options import RenderOptions, check_outputs

_NO_CLAMP = (0.0, math.inf)
# Modes whose colours go through the sRGB encoder; the others give display values.
_ENCODED_MODES = ("lit", "unlit")


class FrameOptions:
    """The options of a frame.

    Parameters
    ----------
    scene : Scene
        Its background, ambient light and limits of light count as options.
    color_space : {"srgb", "linear"}
    options : RenderOptions

    Attributes
    ----------
    native : NativeOptions
    headlight_color : tuple of 3 float
        Of the light of scenes without lights; with the ambient it adds up to white.
    mark_size : float
        Pixels; lines and points reach less than half of this beyond where they are.
    """

    def __init__(self, scene: Scene, color_space: str, options: RenderOptions) -> None:
        self._options = options
        self._needs: dict[tuple[str, ...], MeshNeeds] = {}
        encoded = options.mode in _ENCODED_MODES and color_space == "srgb"
        convert = shading_color if encoded else display_color
        if scene.background is None:
            background = (0.0, 0.0, 0.0, 0.0)
        else:
            background = (*convert(scene.background, color_space), 1.0)
        ambient = shading_color(scene.ambient, color_space)
        self.headlight_color = tuple(max(0.0, 1.0 - component) for component in ambient)
        self.native = _native.NativeOptions(
            mode=_native.MODES[options.mode],
            cull=_native.CULLS[options.cull],
            wireframe=_native.WIREFRAMES[options.wireframe],
            hidden=_native.HIDDEN_SURFACES[options.hidden_surfaces],
            shading=_native.SHADINGS[options.shading],
            normals=_native.NORMALS[options.normals],
            culling=_native.CULLINGS[options.culling],
            remove_hidden_lines=not options.hidden_lines,
            line_width=options.line_width,
            point_size=options.point_size,
            line_color=convert(options.line_color, color_space),
            background=background,
            encode_srgb=encoded,
            decode_srgb=color_space == "srgb",
            ambient=ambient,
            light_clamp=scene.light_clamp or _NO_CLAMP,
        )
        # Twice as far from its middle as the widest line or point reaches, and for rounding.
        self.mark_size = 2.0 * (max(options.line_width, options.point_size) + 2.0)

    def needs(self, outputs: tuple[str, ...]) -> MeshNeeds:
        """Return which derived arrays of meshes a frame with these outputs reads."""
        known, options = self._needs.get(outputs), self._options
        if known is None:
            shaded = "color" in outputs
            reads_normals = "normal" in outputs or "world_normal" in outputs
            reads_normals = reads_normals or (shaded and options.mode in ("lit", "normal"))
            known = self._needs[outputs] = MeshNeeds(
                vertex_normals=reads_normals and options.normals != "flat",
                face_normals=reads_normals and options.normals != "smooth",
                edges=shaded and options.wireframe is not None,
            )
        return known


class OptionsCache:
    """The options of the last frame, for as long as none changes.

    Identity decides, because (255, 255, 255) and (255.0, 255.0, 255.0) are equal, but not the same
    colour. What is compared cannot change in place: a colour that could is not kept.
    """

    def __init__(self, color_space: str) -> None:
        self._color_space = color_space
        self._given: tuple = ()
        self._made: RenderOptions | None = None
        self._seen: tuple = ()
        self._frame_options: FrameOptions | None = None

    def of_keywords(self, keywords: dict, outputs: Iterable[str]) -> RenderOptions:
        """Return the options that the keyword arguments of a frame name.

        Raises
        ------
        InvalidArgumentError
        """
        names = outputs if type(outputs) is tuple else check_outputs(outputs)
        given = (*keywords.values(), *names)
        if len(given) != len(self._given) or not all(map(is_, given, self._given)):
            self._given = ()
            self._made = RenderOptions(outputs=names, **keywords)
            if type(keywords["line_color"]) is tuple:
                self._given = given
        return self._made

    def get(self, scene: Scene, options: RenderOptions) -> FrameOptions:
        """Return what the options are for a scene as it is now."""
        seen = options, scene.background, scene.ambient, scene.light_clamp
        if not self._seen or not all(map(is_, seen, self._seen)):
            self._frame_options = FrameOptions(scene, self._color_space, options)
            self._seen = seen
        return self._frame_options
