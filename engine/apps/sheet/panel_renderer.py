"""Renders the panels of a sheet: drawings on paper, and pictures in a look."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...choices import FrameCull
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ...model.scene.cameras import Camera
from ...model.scene.staged_scene import StagedScene
from ...model.scene.usage import uses_in
from ...rendering.frame import Frame
from ...rendering.renderer import Renderer
from ...stage.appearance import count_points, point_size
from ...stage.blank import Sight
from ...stage.chosen_surroundings import Surroundings
from ...stage.lighting import NO_LIGHTS, Lighting
from ...stage.look import THEMED, Look
from ...stage.overlays.theme import DARK, LIGHT, Theme
from ...stage.scene_bounds import sphere_of_box
from ...stage.studio import Studio, theme_for
from ...stage.viewed_scene import ViewedScene
from ...stage.views.viewpoint import UP_DIRECTIONS
from .layout import Rectangle

OUTPUTS = ("color", "depth", "object_id", "instance_id", "material_id", "face_id")
_SMALL = (160, 120)
_SAMPLES = 4
#: Radius of ambient occlusion, in radii of the model.
_OCCLUSION = 0.2


class PanelRenderer:
    """Renders panels of a scene in a sheet's lighting; a context manager that frees the buffers.

    Parameters
    ----------
    viewed : ViewedScene
    up : str
        A key of `UP_DIRECTIONS`.
    drawing : Mapping
        ``backend`` and ``threads`` of `Renderer`.
    look : Look
        That of pictures.

    Attributes
    ----------
    staged : StagedScene
        The scene in that light.
    bounds : (2, 3) ndarray of float64
        Of the model.
    sphere : Sphere
        Round the model.
    has_faces, has_normal_maps : bool
    paper, stage_theme : Theme
        Grounds that the model stands out from: of drawings, whose lines help, and of pictures.
    """

    paper: Theme = LIGHT
    stage_theme: Theme = LIGHT

    def __init__(
        self, viewed: ViewedScene, up: str, drawing: Mapping[str, Any], look: Look
    ) -> None:
        self._look = look
        self.scene = viewed.scene
        self.up = UP_DIRECTIONS[up]
        self.bounds = np.array(self.scene.bounds, np.float64)
        self.sphere = sphere_of_box(self.bounds)
        self.has_normal_maps = any(
            isinstance(thing, Material) and thing.normal_texture is not None
            for thing in uses_in([self.scene])
        )
        self._options = {"samples": _SAMPLES, "antialiasing": "msaa", **drawing}
        self._drawing = dict(drawing)
        self._cull = viewed.appearance.get("cull", "auto")
        self._points = count_points(self.scene)
        self.has_faces = any(isinstance(t, Mesh) and len(t.faces) for t in uses_in([self.scene]))
        self._renderer: Renderer | None = None
        self.staged = StagedScene(self.scene)
        Surroundings().put(self.staged, look.environment)
        self.staged.fog = None
        first = look.lights or NO_LIGHTS
        self._lighting = Lighting(self.staged, self.up, look.light_intensity, first)
        self._lighting.choose(first)
        is_lit = look.lights is not None and self.staged.environment is None
        self._studio = Studio(self.staged, self.up, is_lit)

    def __enter__(self) -> PanelRenderer:
        return self

    def __exit__(self, *exception: object) -> None:
        if self._renderer is not None:
            self._renderer.close()

    def choose_theme(self, camera: Camera, pose: np.ndarray) -> None:
        """Choose backgrounds that contrast with the model, as seen by a camera.

        Otherwise, the background is light.
        """
        self.staged.background = None
        self._lighting.follow(pose)
        with Renderer(_SMALL, **self._drawing) as renderer:
            color = renderer.render(self.staged, (camera, pose), cull=self._cull).color
        themes = {"dark": (DARK,), "light": (LIGHT,)}
        chosen = self._look.background if isinstance(self._look.background, str) else ""
        self.stage_theme = theme_for(color, themes.get(chosen, (LIGHT, DARK)))
        if not self.has_faces:
            self.paper = self.stage_theme

    def draw(
        self,
        camera: Camera,
        pose: np.ndarray,
        rectangle: Rectangle,
        *,
        on_stage: bool = False,
        azimuth: float = 0.0,
        both_sides: bool = False,
    ) -> Frame:
        """Draw a panel.

        Parameters
        ----------
        camera, pose
        rectangle : Rectangle
            Its size counts.
        on_stage : bool
            Draw it in its look rather than on paper.
        azimuth : float
            From where it is looked at then, in radians.
        both_sides : bool
            Whether all faces show both sides.
        """
        self._lighting.follow(pose)
        options: dict[str, Any] = {"tone_mapping": self._look.tone_mapping}
        if both_sides:
            options["cull"] = "none"
        if on_stage:
            self._lay_ground(pose, azimuth, options.get("cull", self._cull))
            options["ambient_occlusion"] = self._look.ambient_occlusion
            options["ambient_occlusion_radius"] = _OCCLUSION * self.sphere.radius
        else:
            self._studio.show_shadow(False)
        self.staged.background = self._backdrop if on_stage else self.paper.background
        outputs = OUTPUTS if on_stage else (*OUTPUTS, "world_normal")
        return self.render(camera, pose, rectangle, outputs=outputs, **options)

    def _lay_ground(self, pose: np.ndarray, azimuth: float, cull: FrameCull) -> None:
        """Draw the shadow on the ground, if the look has one."""
        if self._look.ground:
            self._studio.lay_shadow(self.sphere, azimuth, cull, (*pose[:3, 2], 0.0))

    @property
    def _backdrop(self) -> Any:
        """The background of pictures."""
        background = self._look.background
        if isinstance(background, str):
            is_own = background not in THEMED
            return self.scene.background if is_own else self.stage_theme.gradient
        return background

    def options(self, rectangle: Rectangle, *, both_sides: bool) -> dict[str, Any]:
        """Return the options that draw the same pixels: ``cull``, ``backend`` and so on."""
        cull, points = "none" if both_sides else self._cull, self._point_size(rectangle)
        return {"cull": cull, "point_size": points, **self._drawing}

    def _point_size(self, rectangle: Rectangle) -> float:
        return point_size(self._points, (rectangle.width, rectangle.height))

    def sight(self, camera: Camera, pose: np.ndarray, rectangle: Rectangle) -> Sight:
        """Return a camera's sight, to find out why it is blank."""
        size = rectangle.width, rectangle.height
        options = {"cull": self._cull, "point_size": self._point_size(rectangle)}
        return Sight(self.scene, camera, pose, size, options, self._options)

    def render(
        self, camera: Camera, pose: np.ndarray, rectangle: Rectangle, **options: Any
    ) -> Frame:
        """Render any outputs of a panel."""
        size = rectangle.width, rectangle.height
        if self._renderer is None:
            self._renderer = Renderer(size, **self._options)
        elif size != (self._renderer.width, self._renderer.height):
            self._renderer.resize(size)
        options = {"cull": self._cull, "point_size": self._point_size(rectangle), **options}
        return self._renderer.render(
            self.staged, (camera, pose), transparent_outputs=True, **options
        )
