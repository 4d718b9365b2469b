"""A scene, lit and drawn: what the window, the turntable and the still picture have in common.

In: a `ViewedScene`, a size, an `Appearance`, a `Viewpoint`. Out: a `Frame`, with a grid and text
drawn on it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .. import linalg
from ..rendering.options import size_in_picture
from ..rendering.renderer import Renderer
from ..rendering.support_functions import support_of_scene
from ..scene.cameras import PerspectiveCamera
from ..scene.lights import DirectionalLight
from ..scene.nodes import Node
from ..spatial.rays import RayHit
from .appearance import Appearance, count_points, point_size
from .blank import Reason, Sight, may_be_blank, why_blank
from .box_grid import BoxGrid
from .chosen_surroundings import fog_color
from .debug_lines import Lines, box_lines, draw_lines, frustum_lines, tree_lines
from .free_region import NOTHING, Taken, frame_beside
from .grid_lines import grid
from .lighting import OWN_LIGHTS, Lighting, OnlyLight, placed_light
from .near_origin import from_file
from .output_pictures import (
    COVERAGE,
    OUTPUT_MODES,
    SPLIT_OUTPUTS,
    paint,
    split,
    whole_pixel,
)
from .scene_bounds import turning_outline
from .selection_outline import CLICK_OUTPUTS
from .shadow_switch import ShadowSwitch
from .stage_settings import Settings
from .studio import BEHIND, Stage, theme_for
from .theme import Theme
from .untextured import Textures
from .viewed_scene import ViewedScene
from .viewpoint import DEFAULT_YFOV, UP_DIRECTIONS, Sphere, Viewpoint, with_clip_planes
from .visibility import DRAWABLE, Visibility

#: What the look "studio" draws with unless the scene or the user says otherwise.
STUDIO = {"tone_mapping": "neutral", "ambient_occlusion": True}
#: How far ambient occlusion reaches, in radii of what is shown.
_OCCLUSION_REACH = 0.2
#: A box around a sphere reaches no farther than this, in radii.
_BOX_REACH = 1.75
#: How much farther away what has numbers around it is seen from.
_LABEL_ROOM = 1.12


class ViewRenderer:
    """Holds a renderer and what it draws.

    Parameters
    ----------
    viewed : ViewedScene
        What to draw first; `show` changes it.
    settings : Settings
        What the user asked for.
    size : (int, int)
        Width and height in pixels.
    backend, threads, samples, antialias
        As in `Renderer`.
    transparent : bool
        Whether pixels that show no surface get alpha 0.
    report : callable, optional
        Called with each frame.

    Attributes
    ----------
    samples : int
        Samples per pixel of the frames to come.
    split : bool
        Whether frames show nine outputs side by side.
    debug : str or None
        What is drawn of culling; see `choose_debug`.
    stats : dict
        Of the last frame that was drawn while culling was not frozen.
    turned_up : str or None
        The direction up that was chosen with `turn_up`.
    screen_scale : int
        How many times finer than usual the screen is that shows the frames.
    """

    def __init__(
        self,
        viewed: ViewedScene,
        settings: Settings,
        size: tuple[int, int],
        *,
        backend: str = "auto",
        threads: int = 0,
        samples: int = 1,
        antialias: str = "ssaa",
        transparent: bool = False,
        report=None,
    ):
        self._transparent = transparent
        self._report = report
        self._options = {"backend": backend, "threads": threads, "antialias": antialias}
        self.samples = samples
        self.size = size
        self._culling_camera = None
        self.stats: dict = {}
        self.split = False
        self.debug: str | None = None
        self._debug_camera = None
        self.screen_scale = 1
        self.turned_up: str | None = None
        self._renderers: dict[int, Renderer] = {}
        self.settings = settings
        self.show(viewed)

    @property
    def renderer(self) -> Renderer:
        """What draws with as many samples per pixel as are asked for now."""
        if self.samples not in self._renderers:
            renderer = Renderer(*self.size, samples=self.samples, **self._options)
            self._renderers[self.samples] = renderer
        return self._renderers[self.samples]

    def show(self, viewed: ViewedScene, *, keep_appearance: bool = False) -> None:
        """Draw another scene from now on.

        Parameters
        ----------
        viewed : ViewedScene
            What to draw.
        keep_appearance : bool
            Draw it as the last one was drawn, in the same lights.
        """
        settings = self.settings
        self.viewed = viewed
        self._has_shown, self._doubtful, self._alone = False, None, None
        settings.filtering.put(viewed.scene)
        self._textures = Textures(viewed.scene)
        self.show_textures(settings.textures)
        if settings.light_clamp is not None:
            viewed.scene.light_clamp = settings.light_clamp
        if settings.exposure is not None:
            viewed.scene.exposure = settings.exposure
        lights = self.lighting.name if keep_appearance else ""
        if not keep_appearance:
            look = STUDIO if settings.look == "studio" and viewed.themed else {}
            self.appearance = Appearance(**(look | viewed.appearance | settings.appearance))
        self.bounds = viewed.bounds
        self._grid = None
        self._box = BoxGrid(viewed)
        self._stand(self.turned_up or settings.up or viewed.up)
        self._support = support_of_scene(viewed.scene) if viewed.focus is None else None
        self._points = count_points(viewed.scene)
        if self._transparent:
            viewed.scene.background = None
        elif settings.background is not None:
            viewed.scene.background = settings.background
        elif viewed.themed:
            viewed.scene.background = self.theme.background
        settings.surroundings.put(viewed.scene)
        self._lay_fog()
        self.lighting = self._light()
        if lights in self.lighting.names:
            self.lighting.choose(lights)
        self._stage = self._make_stage()
        self.show_grid(settings.grid)

    def _stand(self, up: str) -> None:
        """Take a direction as the one that points up."""
        self.up = up
        # Without the grid, which is no part of what the first view shows.
        self._outline = self.viewed.focus
        if self._outline is None:
            self._outline = turning_outline(self.viewed.scene, UP_DIRECTIONS[up])

    def turn_up(self, up: str) -> None:
        """Look at the scene with another direction up, from now on."""
        lights = self.lighting.name
        self._take_lights_and_grid()
        self._grid = None
        self.turned_up = up
        self._stand(up)
        self.lighting = self._light()
        self.lighting.choose(lights)
        self._stage = self._make_stage()
        self.show_grid(self.settings.grid)

    def _light(self) -> Lighting | OnlyLight:
        """Light the scene, with shadows as the user asked for."""
        lighting = self._lit()
        self._shadows = None
        if self.settings.shadow is not None:
            self._shadows = ShadowSwitch(lighting.groups(), self.settings.shadow)
        return lighting

    def _lit(self) -> Lighting | OnlyLight:
        scene, settings = self.viewed.scene, self.settings
        intensity = settings.light_intensity
        if settings.light_position is not None:
            position = from_file(self.viewed, settings.light_position)
            return placed_light(scene, position, self.bounds, intensity)
        intensity = 1.0 if intensity is None else intensity
        if settings.light_direction is not None:
            light = DirectionalLight(settings.light_direction, (1.0, 1.0, 1.0), intensity, "white")
            return OnlyLight(scene, light)
        return Lighting(scene, UP_DIRECTIONS[self.up], intensity)

    def _make_stage(self) -> Stage | None:
        """Return what the model stands in; None where the scene or the user's look says so."""
        if self.settings.look != "studio" or not self.viewed.themed:
            return None
        lights = isinstance(self.lighting, Lighting) and self.lighting.names[0] != OWN_LIGHTS
        is_lit = lights and self.viewed.scene.environment is None
        self._chooses_theme = self._shows_theme()
        return Stage(self.viewed.scene, UP_DIRECTIONS[self.up], is_lit, self.viewed.focus)

    def _shows_theme(self) -> bool:
        """Whether the theme's background is what is behind the model."""
        kept = self._transparent or self.settings.background or self.settings.surroundings.shows
        return self.viewed.themed and not kept

    def _set_stage(self, view: Viewpoint) -> None:
        """Set the stage for a frame: a background that the model stands out from, its shadow."""
        stage, appearance = self._stage, self.appearance
        if stage is None:
            return
        if self._chooses_theme:
            stage.show_shadow(False)
            kept = self.settings.keeps_theme
            self._alone = None if kept else self._picture_alone(view)
            self.theme = self.theme if self._alone is None else theme_for(self._alone)
        is_plain = appearance.mode in ("lit", "unlit") and appearance.wireframe is None
        if is_plain and not self.split and not self._transparent:
            stage.lay_shadow(self.bounds, view.azimuth, appearance.cull, view.eye())
        else:
            stage.show_shadow(False)

    def _picture_alone(self, view: Viewpoint) -> np.ndarray:
        """Return a small picture of the model before a transparent background."""
        scene = self.viewed.scene
        background, scene.background = scene.background, None
        width, height = self.size
        scale = max(width, height) / 240
        size = max(1, round(width / scale)), max(1, round(height / scale))
        with Renderer(*size, **{**self._options, "antialias": "ssaa"}) as renderer:
            try:
                look = self._appearance()
                return renderer.render(scene, (self._camera(view), view.pose()), **look).color
            finally:
                scene.background = background

    def show_textures(self, shown: bool) -> None:
        """Draw with textures, or without."""
        self.settings.textures = shown
        if shown:
            self._textures.put_on()
        else:
            self._textures.take_off()

    def leave_scene(self) -> None:
        """Leave the scene, which is not drawn any more, as it was before."""
        self._textures.put_on()
        self._take_lights_and_grid()
        self._box.leave()

    def _take_lights_and_grid(self) -> None:
        if self._shadows is not None:
            self._shadows.leave()
        self.lighting.leave()
        if self._stage is not None:
            self._stage.leave()
        if self._grid is not None:
            self.viewed.scene.remove(self._grid)

    @property
    def theme(self) -> Theme:
        """The colours of texts over the picture, and of the background of models."""
        return self.settings.theme

    @theme.setter
    def theme(self, theme: Theme) -> None:
        self.settings.theme = theme
        self._chooses_theme = False
        if self._shows_theme():
            background = theme.background if self._stage is None else theme.gradient
            self.viewed.scene.background = background
            self._lay_fog()

    def _lay_fog(self) -> None:
        """Give the scene the fog that the user asked for."""
        fog, scene = self.settings.fog, self.viewed.scene
        if fog is not None:
            color = fog_color(scene.background) if self.settings.fog_follows else None
            scene.fog = fog if color is None else replace(fog, color=color)

    def show_grid(self, shown: bool) -> None:
        """Draw a grid under the scene, or not."""
        self.settings.grid = shown
        if shown and self._grid is None:
            scene = self.viewed.scene
            lines = grid(self._lowest(), self.bounds, UP_DIRECTIONS[self.up])
            self._grid = scene.add(lines, name="grid")
        if self._grid is not None:
            self._grid.visible = shown

    def visibility(self) -> Visibility:
        """Return what hides parts of the scene that is shown."""
        return Visibility(self.viewed.scene, self._added())

    def _added(self) -> tuple:
        """What is drawn that was added to the scene: the grids and the shadow."""
        grids = self._grids()
        return grids if self._stage is None else (*grids, *self._stage.nodes)

    def _grids(self) -> tuple:
        return self._box.nodes if self._grid is None else (self._grid, *self._box.nodes)

    def _lowest(self) -> float:
        """Return how low the scene reaches along the up direction, however it moves."""
        up = UP_DIRECTIONS[self.up]
        if self.viewed.update is not None:
            return float(linalg.dot(self.bounds.center, up)) - self.bounds.radius
        return float(linalg.dot(self.viewed.scene.bounds, up).min())

    def resize(self, width: int, height: int) -> None:
        """Draw frames of another size from now on."""
        if (width, height) != self.size:
            self.size = (width, height)
            for renderer in self._renderers.values():
                renderer.resize(width, height)

    @property
    def aspect(self) -> float:
        """Width over height of the frames."""
        return self.size[0] / self.size[1]

    def view(self, yfov: float = DEFAULT_YFOV) -> Viewpoint:
        """Return the first view of the scene, with a vertical field of view in radians."""
        viewed, up = self.viewed, UP_DIRECTIONS[self.up]
        view = Viewpoint(np.zeros(3), 1.0, viewed.azimuth, viewed.elevation, up, yfov)
        self.frame(view)
        return view

    def frame(self, view: Viewpoint) -> None:
        """Move a view along its direction to where all of the scene shows."""
        frame_beside(view, self._outline, self.aspect, self._taken())

    def fill(self, view: Viewpoint) -> None:
        """Move a view to where the scene, as it first stands, fills the picture.

        That is nearer than `frame`, which leaves room for the scene to turn.
        """
        if self.settings.axes_grid:
            frame_beside(view, self._box.corners, self.aspect, self._taken())
            view.distance *= _LABEL_ROOM
        elif self._support is None:
            self.frame(view)
        else:
            view.fit(self._support, np.array(self.bounds.center), self.aspect, self._taken())

    def _taken(self) -> Taken:
        """What of the picture the bar of numbers takes."""
        bar = self.viewed.bar if self.settings.bar else None
        if bar is None:
            return NOTHING
        from .scalar_bar import place_bar

        scale = self._text_scale(*self.size)
        return place_bar(*self.size, bar, scale).taken(*self.size)

    def draw(self, view: Viewpoint, time: float = 0.0, outputs=("color",)):
        """Return the frame at ``time`` (seconds) as seen by ``view``."""
        frame = self._render(view, time, outputs)
        if self.debug is not None:
            draw_lines(frame, self._debug_lines(), self.text_scale(frame.canvas()))
        if self.split:
            split(frame, self.bounds, self.theme)
        self._draw_overlays(frame, view)
        if self._culling_camera is None:
            self.stats = frame.stats
            if self._report is not None:
                self._report(frame)
        return frame

    def pick(self, view: Viewpoint, time: float, x: int, y: int) -> RayHit | None:
        """Return what the picture shows at a pixel, or None."""
        if not (0 <= x < self.size[0] and 0 <= y < self.size[1]):
            return None
        if self.split:
            x, y = whole_pixel(x, y, self.size)
        return self.viewed.scene.pick(self._render(view, time, CLICK_OUTPUTS), x, y)

    def _render(self, view: Viewpoint, time: float, outputs):
        if self.viewed.update is not None:
            self.viewed.update(time)
        pose = view.pose()
        self.lighting.follow(pose)
        if self.viewed.follow is not None:
            self.viewed.follow(pose[:3, 3])
        self._set_stage(view)
        self._box.follow(view, self.settings.axes_grid and not self.split)
        camera, mode = self._camera(view), self.appearance.mode
        if self.viewed.detail is not None:
            self.viewed.detail(camera, pose, self.size)
        if self.split:
            outputs = (*outputs, *SPLIT_OUTPUTS)
        elif mode in OUTPUT_MODES:
            outputs = (*outputs, mode, COVERAGE)
        frame = self.renderer.render(
            self.viewed.scene,
            (camera, pose),
            culling_camera=self._culling_camera,
            outputs=tuple(dict.fromkeys(outputs)),
            **self._appearance(),
        )
        if mode in OUTPUT_MODES and not self.split and "color" in outputs:
            paint(frame, mode, self.bounds)
        if not self._has_shown:
            self._look_for_something(frame, camera, pose)
        return frame

    def _look_for_something(self, frame, camera, pose: np.ndarray) -> None:
        """Note whether a frame certainly shows something; else keep the first such sight."""
        scene, added = self.viewed.scene, self._added()
        if not any(_is_drawn(node) for node in added):
            self._has_shown = not may_be_blank(frame.stats, scene)
        elif self._alone is not None and not any(map(_is_drawn, self._grids())):
            self._has_shown = bool(self._alone[..., 3].any())
        self._alone = None
        if self._has_shown or self._doubtful is not None:
            return
        ids = np.array([node.id for node in scene.nodes if node not in added], np.int64)
        look = self._appearance()
        look = {name: look[name] for name in ("cull", "point_size", "size_unit") if name in look}
        drawing = {name: self._options[name] for name in ("backend", "threads")}
        self._doubtful = Sight(scene, camera, pose, self.size, ids, look, drawing)

    def why_blank(self) -> Reason | None:
        """Return why no frame so far has shown anything of the scene; None if one has."""
        if self._has_shown or self._doubtful is None:
            return None
        return why_blank(self._doubtful)

    def _appearance(self) -> dict:
        """Return the drawing options of a frame."""
        options = self.appearance.arguments(self.viewed.scene.background, self.point_size)
        if options["ambient_occlusion_radius"] is None:
            options["ambient_occlusion_radius"] = _OCCLUSION_REACH * self.bounds.radius
        return options

    @property
    def point_size(self) -> float:
        """How large points are, in the appearance's `size_unit`."""
        if self.appearance.point_size is not None:
            return self.appearance.point_size
        pixels = point_size(self._points, self.size)
        return (
            pixels
            if self.appearance.size_unit == "pixels"
            else size_in_picture(pixels, self.size[1])
        )

    def _camera(self, view: Viewpoint):
        clearance = self.viewed.clearance
        free = 0.0 if clearance is None else clearance(view.position()) / view.stretch(self.aspect)
        camera = view.camera(self._clip_bounds(view), self.viewed.nearest, free)
        camera = with_clip_planes(camera, self.settings.near, self.settings.far)
        if isinstance(camera, PerspectiveCamera) and self.settings.far is None:
            camera.reversed_depth = True
        return camera

    def freeze_culling(self, view: Viewpoint | None) -> None:
        """Draw only what this view shows, wherever it is seen from; None: what each frame shows.

        Meanwhile `stats` stay as they are, and no frames are reported.
        """
        self._culling_camera = None if view is None else (self._camera(view), view.pose())

    def choose_debug(self, drawing: str | None, view: Viewpoint) -> None:
        """Draw what culling works with: one of `debug_lines.DEBUG_DRAWINGS`.

        A frustum is the one of this view, wherever it is seen from; but while culling is frozen it
        is the one that culls.
        """
        self.debug = drawing
        self._debug_camera = self._camera(view), view.pose()

    def _debug_lines(self) -> list[Lines]:
        if self.debug == "frustum":
            return frustum_lines(*(self._culling_camera or self._debug_camera), self.size)
        if self.debug == "boxes":
            return box_lines(self.viewed.scene, self._added())
        return tree_lines(self.viewed.scene)

    def _draw_overlays(self, frame, view: Viewpoint) -> None:
        settings, bar = self.settings, self.viewed.bar if self.settings.bar else None
        if not (settings.axes or settings.metadata or settings.axes_grid or bar is not None):
            return
        from .overlay import draw_axes, draw_block
        from .scalar_bar import draw_scalar_bar

        canvas = frame.canvas()
        scale = self.text_scale(canvas)
        if settings.axes_grid and not self.split:
            self._box.label(frame, scale, self.theme)
        if bar is not None:
            draw_scalar_bar(canvas, bar, scale, self.theme)
        if settings.axes:
            draw_axes(canvas, view, scale)
        if settings.metadata:
            draw_block(canvas, self.metadata(), corner="top right", scale=scale, theme=self.theme)

    def text_scale(self, canvas) -> int:
        """Return the factor on the font's size of texts over a picture."""
        return self._text_scale(canvas.width, canvas.height)

    def _text_scale(self, width: int, height: int) -> int:
        from .overlay import text_scale_for

        return self.settings.ui_scale or text_scale_for(width, height, self.screen_scale)

    def _clip_bounds(self, view: Viewpoint) -> Sphere:
        """Return what the clip planes must enclose: animated parts, grids and ground included."""
        margin = 1.0 if self.viewed.update is None else 1.6
        if self.settings.grid or self._stage is not None:
            margin = max(margin, 3.2)
        if self.settings.axes_grid:
            margin = max(margin, _BOX_REACH)
        radius = self.bounds.radius * margin
        if self._stage is not None:
            distance = float(linalg.length(view.position() - np.array(self.bounds.center)))
            radius += BEHIND * (distance + radius)
        return self.bounds._replace(radius=radius)

    def metadata(self) -> list[str]:
        """Return what the scene's file holds, line by line."""
        return [self.viewed.title, *self.viewed.details]

    def close(self) -> None:
        """Free the renderers' buffers."""
        while self._renderers:
            self._renderers.popitem()[1].close()

    def __enter__(self) -> ViewRenderer:
        return self

    def __exit__(self, *exception) -> None:
        self.close()


def _is_drawn(node: Node) -> bool:
    return node.shown and isinstance(node.object, DRAWABLE)
