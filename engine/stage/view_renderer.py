"""Renders a viewed scene: shared by the window, the turntable and still pictures.

In: a `ViewedScene`, a size, an `Appearance`, a `Viewpoint`. Out: a `Frame`, with a grid and text
drawn on it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, TypedDict

import numpy as np

from ..base import linalg
from ..choices import Antialiasing, Backend, Samples
from ..model.scene.cameras import Camera, PerspectiveCamera
from ..model.spatial.rays import RayHit
from ..rendering.canvas import Canvas
from ..rendering.frame import Frame, Output
from ..rendering.framing import lens_for
from ..rendering.options import OUTPUT_MODES, size_in_picture
from ..rendering.renderer import Renderer
from ..rendering.support_functions import (
    SupportFunction,
    support_of_points,
    support_of_scene,
)
from .appearance import Appearance, count_points, point_size
from .blank import SHOWING, BlankWatch, Reason, Sight
from .lighting import Lighting, OnlyLight
from .output_pictures import (
    COVERAGE,
    SPLIT_OUTPUTS,
    paint,
    split,
    whole_pixel,
)
from .overlays.culling_study import CullingStudy
from .overlays.debug_lines import draw_lines
from .overlays.labels import draw_labels
from .overlays.selection_outline import CLICK_OUTPUTS
from .overlays.theme import Theme
from .overlays.ui_scale import scale_for
from .scene_bounds import turning_outline, turning_outline_of_points
from .stage_settings import Settings
from .staging import Staging
from .viewed_scene import ViewedScene
from .views.camera_view import AnyView, CameraView
from .views.flat_sides import SIZE as SMALL
from .views.flat_sides import choose_azimuth
from .views.free_region import NOTHING, Taken
from .views.viewpoint import UP_DIRECTIONS, WALKING_YFOV, Sphere, Viewpoint, with_clip_planes
from .visibility import Visibility

if TYPE_CHECKING:
    from typing_extensions import Unpack

#: Radius of ambient occlusion, in radii of the scene.
_OCCLUSION_REACH = 0.2
#: Factor on the viewing distance that makes room for numbers around the scene.
_LABEL_ROOM = 1.12


class _Options(TypedDict, total=False):
    """The options that all renderers of a view share."""

    backend: Backend
    threads: int
    antialiasing: Antialiasing


class ViewRenderer:
    """A renderer with a viewed scene and its stage.

    Parameters
    ----------
    viewed : ViewedScene
        The first scene to draw; `show` replaces it.
    settings : Settings
        The user's settings.
    size : (int, int)
        Width and height in pixels.
    samples : int
        As in `Renderer`; assignable.
    transparent : bool
        Whether pixels that show no surface get alpha 0.
    report : callable, optional
        Called with each frame.
    renderer : Renderer, optional
        Draws the frames; it is not closed. By default renderers of its own do.
    **options
        Other options of `Renderer`.

    Attributes
    ----------
    samples : int
        Samples per pixel of future frames.
    split : bool
        Whether frames show nine outputs side by side.
    culling : CullingStudy
        The culling visualisation.
    staging : Staging
        The stage of the scene.
    appearance : Appearance
        The drawing options.
    stats : dict
        Statistics of the last frame drawn while culling was not frozen.
    turned_up : str or None
        The up direction chosen with `turn_up`.
    screen_scale : float
        Scale factor of the screen that shows the frames.
    """

    def __init__(
        self,
        viewed: ViewedScene,
        settings: Settings,
        size: tuple[int, int],
        *,
        samples: Samples = 1,
        transparent: bool = False,
        report: Callable[[Frame], object] | None = None,
        renderer: Renderer | None = None,
        **options: Unpack[_Options],
    ) -> None:
        self._lent = renderer
        self._transparent = transparent
        self._report = report
        self._options: _Options = options
        self.samples = samples
        self.size = size
        self.stats: dict[str, Any] = {}
        self.split = False
        self.culling = CullingStudy()
        self.screen_scale = 1.0
        self.turned_up: str | None = None
        self._renderers: dict[int, Renderer] = {}
        self._small: Renderer | None = None  # of pictures of the model alone
        self._outline: np.ndarray | None = None  # None: to be found
        self.settings = settings
        self.show(viewed)

    @property
    def renderer(self) -> Renderer:
        """The renderer for the current number of samples per pixel."""
        if self._lent is not None:
            return self._lent
        if self.samples not in self._renderers:
            renderer = Renderer(self.size, samples=self.samples, **self._options)
            self._renderers[self.samples] = renderer
        return self._renderers[self.samples]

    def show(self, viewed: ViewedScene, *, keep_appearance: bool = False) -> None:
        """Replace the scene to draw.

        Parameters
        ----------
        viewed : ViewedScene
            The scene to draw.
        keep_appearance : bool
            Keep the drawing options and lights of the previous scene.
        """
        settings = self.settings
        lights = self.lighting.name if keep_appearance else ""
        if not keep_appearance:
            look = settings.look.options if viewed.themed else {}
            self.appearance = Appearance(**(look | viewed.appearance | settings.appearance))
        self._blanks = BlankWatch()
        self._measure(viewed)
        up = self.turned_up or settings.up or viewed.up
        self.staging = Staging(viewed, settings, up, self._transparent, lights)
        self._find_outline()

    def _measure(self, viewed: ViewedScene) -> None:
        """Measure a scene in its current pose."""
        if viewed.swept is not None:
            self._support: SupportFunction | None = support_of_points(viewed.swept)
        else:
            self._support = support_of_scene(viewed.scene) if viewed.focus is None else None
        self._points = count_points(viewed.scene)

    def renew(self) -> None:
        """Follow a scene whose nodes moved, hid or showed, as if it were shown anew.

        Only stages that `Staging.can_renew` can do so.
        """
        viewed = self.viewed
        viewed.forget_bounds()
        self._measure(viewed)
        self.staging.renew()
        self._outline = None

    def _find_outline(self) -> np.ndarray:
        viewed = self.viewed
        outline, up = viewed.focus, UP_DIRECTIONS[self.staging.up]
        if viewed.swept is not None:
            outline = turning_outline_of_points(viewed.swept, up)
        elif outline is None:
            outline = turning_outline(viewed.scene, up)
        self._outline = outline
        return outline

    def turn_up(self, up: str) -> None:
        """Change the up direction of the scene."""
        self.turned_up = up
        self.staging.stand(up, self.lighting.name)
        self._find_outline()

    @property
    def viewed(self) -> ViewedScene:
        """The scene to draw."""
        return self.staging.viewed

    @property
    def bounds(self) -> Sphere:
        """The bounding sphere of the scene in its first pose, in world space."""
        return self.viewed.bounds

    @property
    def lighting(self) -> Lighting | OnlyLight:
        """The lighting of the scene."""
        return self.staging.lighting

    @property
    def visibility(self) -> Visibility:
        """The visibility of parts of the scene."""
        return self.staging.visibility

    @property
    def theme(self) -> Theme:
        """The theme: colours of texts over the picture, and of the model's background."""
        return self.staging.theme

    def _picture_alone(self, view: AnyView) -> np.ndarray:
        """Return a small picture of the model on a transparent background, without shadows."""
        scene = self.staging.scene
        background, scene.background = scene.background, None
        width, height = self.size
        scale = max(width, height) / 240
        size = max(1, round(width / scale)), max(1, round(height / scale))
        try:
            look, camera = self._appearance(), (self.camera(view), view.pose())
            look["ambient_occlusion"] = False
            with self.lighting.without_shadows():
                return self._small_renderer(size).render(scene, camera, **look).color
        finally:
            scene.background = background

    def _small_renderer(self, size: tuple[int, int]) -> Renderer:
        if self._small is None:
            options = self._options.copy()
            options["antialiasing"] = "ssaa"
            self._small = Renderer(size, **options)
        self._small.resize(size)
        return self._small

    def resize(self, size: tuple[int, int]) -> None:
        """Change the size of future frames."""
        if size != self.size:
            self.size = size
            for renderer in self._renderers.values():
                renderer.resize(size)

    @property
    def aspect(self) -> float:
        """Width over height of the frames."""
        return self.size[0] / self.size[1]

    def view(self, yfov: float | None = None) -> Viewpoint:
        """Return the first view of the scene, with a vertical field of view in radians.

        By default the longer side has 38 degrees; scenes to walk in have a wider view.
        """
        view = self._view_direction(yfov)
        self.frame(view)
        return view

    def filling_view(self) -> Viewpoint:
        """Return the first view of the scene, which it fills in its current pose."""
        view = self._view_direction(None)
        self.fill(view)
        return view

    def _view_direction(self, yfov: float | None) -> Viewpoint:
        """Return the first view, for which a place is still to be found."""
        if yfov is None:
            walks = self.viewed.walker is not None
            yfov = WALKING_YFOV if walks else lens_for(self.aspect)
        viewed, up = self.viewed, UP_DIRECTIONS[self.staging.up]
        azimuth = self.staging.azimuths.get(self.staging.up, viewed.azimuth)
        if viewed.may_turn and self.staging.up not in self.staging.azimuths:
            azimuth = choose_azimuth(azimuth, self._normals_from)
            self.staging.azimuths[self.staging.up] = azimuth
        return Viewpoint(np.zeros(3), 1.0, azimuth, viewed.elevation, up, yfov)

    def _normals_from(self, azimuth: float) -> np.ndarray:
        """Return the normals of the pixels, (N, 3), of a small picture from an azimuth."""
        if self._support is None:
            return np.zeros((0, 3), np.float32)
        aspect, up = SMALL[0] / SMALL[1], UP_DIRECTIONS[self.staging.up]
        view = Viewpoint(np.zeros(3), 1.0, azimuth, self.viewed.elevation, up, lens_for(aspect))
        view.fit(self._support, np.array(self.bounds.center), aspect)
        frame = self._small_renderer(SMALL).render(
            self.staging.scene, (self.camera(view), view.pose()), outputs=("object_id", "normal")
        )
        return frame.normal[self.staging.scene.own_pixels(frame.object_id)]

    def frame(self, view: Viewpoint) -> None:
        """Move a view along its direction until the whole scene fits."""
        outline = self._find_outline() if self._outline is None else self._outline
        view.frame_beside(outline, self.aspect, self._taken())

    def fill(self, view: Viewpoint) -> None:
        """Move a view so that the scene, in its first pose, fills the picture.

        That is closer than `frame`, which leaves room for the scene to turn.
        """
        corners = self.staging.box.corners
        if self.settings.axes_grid:
            view.frame_beside(corners, self.aspect, self._taken())
            view.distance *= _LABEL_ROOM
        elif self.settings.dimensions:
            view.fit(support_of_points(corners), corners.mean(axis=0), self.aspect, self._taken())
            view.distance *= _LABEL_ROOM
        elif self._support is None:
            self.frame(view)
        else:
            view.fit(self._support, np.array(self.bounds.center), self.aspect, self._taken())

    def _taken(self) -> Taken:
        """Return the part of the picture that the colour bar takes."""
        bar = self.viewed.bar if self.settings.bar else None
        if bar is None:
            return NOTHING
        from .overlays.scalar_bar import place_bar

        return place_bar(*self.size, bar, self.ui_scale).taken(*self.size)

    def choose_theme(self, view: Viewpoint) -> None:
        """Choose the theme that the model contrasts with as seen from a view, if none is chosen."""
        self._light(view.pose())
        self.staging.choose_theme(view, self._picture_alone)

    def draw(
        self,
        view: AnyView,
        time: float = 0.0,
        outputs: Iterable[Output] = ("color",),
        **passed: Any,
    ) -> Frame:
        """Return the frame at ``time`` (seconds) as seen from ``view``.

        Parameters
        ----------
        view : Viewpoint or CameraView
        time : float
        outputs : iterable of str
        **passed
            Other keyword arguments of `Renderer.render`: ``out``, ``culling_camera``.
        """
        frame = self._render(view, time, outputs, **passed)
        if self.culling.drawing is not None:
            lines = self.culling.lines(self.viewed.scene, self.size)
            draw_lines(frame, lines, self.text_scale(frame))
        if self.split:
            split(frame, self.bounds, self.theme, self.text_scale(frame))
        draw_labels(frame, view, self.staging, self.split, self.text_scale)
        if self.culling.camera is None:
            self.stats = frame.stats
            if self._report is not None:
                self._report(frame)
        return frame

    def pick(self, view: Viewpoint, time: float, x: int, y: int) -> RayHit | None:
        """Return the hit at a pixel of the picture, or None."""
        if not (0 <= x < self.size[0] and 0 <= y < self.size[1]):
            return None
        if self.split:
            x, y = whole_pixel(x, y, self.size)
        frame = self._render(view, time, CLICK_OUTPUTS)
        self.visibility.tell_whole_face(frame, x, y)
        return self.viewed.scene.pick(frame, x, y)

    def _render(
        self, view: AnyView, time: float, outputs: Iterable[Output], **passed: Any
    ) -> Frame:
        if self.viewed.update is not None:
            self.viewed.update(time)
        pose = view.pose()
        self._light(pose)
        if self.viewed.follow is not None:
            self.viewed.follow(pose[:3, 3])
        self.staging.follow(view, self.appearance, self.split, self._picture_alone)
        camera, mode = self.camera(view), self.appearance.mode
        if self.viewed.detail is not None:
            self.viewed.detail(camera, pose, self.size)
        if self.split:
            outputs = (*outputs, *SPLIT_OUTPUTS)
        elif mode in OUTPUT_MODES:
            outputs = (*outputs, mode, COVERAGE)
        frame = self.renderer.render(
            self.staging.scene,
            (camera, pose),
            outputs=tuple(dict.fromkeys(outputs)),
            **{"culling_camera": self.culling.camera, **passed},
            **self._appearance(),
        )
        if mode in OUTPUT_MODES and not self.split and "color" in outputs:
            paint(frame, mode, self.bounds)
        self._blanks.look(frame, self.staging, lambda: self._sight(camera, pose))
        return frame

    def _light(self, pose: np.ndarray) -> None:
        """Fit the lights to a view and to the picture."""
        self.lighting.follow(pose)
        self.lighting.soften(self.size)

    def _sight(self, camera: Camera, pose: np.ndarray) -> Sight:
        """Return what a frame looks at."""
        look = self._appearance()
        look = {name: look[name] for name in SHOWING if name in look}
        drawing = {name: held for name, held in self._options.items() if name != "antialiasing"}
        return Sight(self.viewed.scene, camera, pose, self.size, look, drawing)

    def why_blank(self) -> Reason | None:
        """Return why all frames so far were blank; None if one was not."""
        return self._blanks.reason()

    def _appearance(self) -> dict[str, Any]:
        """Return the drawing options of a frame."""
        options = self.appearance.arguments(self.staging.scene.background, self.point_size)
        if options["ambient_occlusion_radius"] is None:
            options["ambient_occlusion_radius"] = _OCCLUSION_REACH * self.bounds.radius
        return options

    @property
    def point_size(self) -> float:
        """Return the size of points, in the appearance's `size_unit`."""
        if self.appearance.point_size is not None:
            return self.appearance.point_size
        pixels = point_size(self._points, self.size)
        return (
            pixels
            if self.appearance.size_unit == "pixels"
            else size_in_picture(pixels, self.size[1])
        )

    def camera(self, view: AnyView) -> Camera:
        """Return the camera of a view."""
        if isinstance(view, CameraView):
            return self._reaching_camera(view)
        clearance = self.viewed.clearance
        free = 0.0 if clearance is None else clearance(view.position()) / view.stretch(self.aspect)
        camera = view.camera(self.staging.reach(view), self.viewed.nearest, free)
        camera = with_clip_planes(camera, self.settings.near, self.settings.far)
        if isinstance(camera, PerspectiveCamera) and self.settings.far is None:
            camera.reversed_depth = True
        return camera

    def _reaching_camera(self, view: CameraView) -> Camera:
        """Return a program's camera, which shows the ground if it shows the whole model."""
        if not self.staging.shows_more:
            return view.camera
        ahead, reach = -view.pose()[:3, 2], self.staging.reach(view)
        eye = float(linalg.dot(view.position(), ahead))
        needed = float(linalg.dot(np.array(reach.center), ahead)) - eye + reach.radius
        if self._support is None:
            return view.camera_reaching(needed - reach.radius + self.bounds.radius, needed)
        return view.camera_reaching(float(self._support(ahead[np.newaxis])[0]) - eye, needed)

    def freeze_culling(self, view: Viewpoint | None) -> None:
        """Freeze culling at a view's camera; None culls for each frame's camera again.

        While culling is frozen, `stats` stay unchanged, and frames are not reported.
        """
        self.culling.camera = None if view is None else (self.camera(view), view.pose())

    def choose_debug(self, drawing: str | None, view: Viewpoint) -> None:
        """Choose a debug drawing of culling, one of `DEBUG_DRAWINGS`, as seen from a view."""
        self.culling.choose(drawing, (self.camera(view), view.pose()))

    @property
    def ui_scale(self) -> float:
        """The scale of texts, panels and marks over frames of the present size."""
        return self._text_scale(*self.size)

    def text_scale(self, picture: Canvas | Frame) -> float:
        """Return the font scale of texts over a `Canvas` or `Frame`."""
        return self._text_scale(picture.width, picture.height)

    def _text_scale(self, width: int, height: int) -> float:
        return self.settings.ui_scale or scale_for(width, height, self.screen_scale)

    def close(self) -> None:
        """Free the renderers' memory."""
        while self._renderers:
            self._renderers.popitem()[1].close()
        if self._small is not None:
            self._small.close()
            self._small = None

    def __enter__(self) -> ViewRenderer:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()
