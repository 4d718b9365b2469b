"""Renders the panels of a sheet: drawings on paper, and pictures in a look."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...model.materials.material import Material
from ...model.scene.cameras import Camera
from ...model.scene.staged_scene import StagedScene
from ...model.scene.usage import uses_in
from ...rendering.frame import Frame
from ...rendering.renderer import Renderer
from ...stage.appearance import count_points, has_faces, point_size
from ...stage.blank import Sight
from ...stage.coloring import show_numbers
from ...stage.finish import finish_for
from ...stage.lighting import NO_LIGHTS, light_in
from ...stage.look import Look
from ...stage.overlays.numbers import take_marks
from ...stage.overlays.theme import LIGHT, Theme, theme_named
from ...stage.renderer import Renderer as PictureRenderer
from ...stage.scene_bounds import sphere_of_box
from ...stage.studio import Studio, theme_for
from ...stage.viewed_scene import ViewedScene
from ...stage.viewed_thing import settings_for
from ...stage.views.viewpoint import UP_DIRECTIONS
from ...stage.visibility import Visibility
from .layout import Rectangle

OUTPUTS = ("color", "depth", "object_id", "instance_id", "material_id", "face_id")
_SMALL = (160, 120)
_SAMPLES = 4


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
    material : Material or None
        Replaces the model's own materials.
    marks : Mapping
        Numbers to show, as keywords of `Renderer.render`.

    Attributes
    ----------
    staged : StagedScene
        The scene in that light.
    bounds : (2, 3) ndarray of float64
        Of the model.
    sphere : Sphere
        Round the model.
    has_faces, has_normal_maps : bool
    paper : Theme
        The ground of drawings, whose lines help the model to stand out.
    """

    paper: Theme = LIGHT

    def __init__(
        self,
        viewed: ViewedScene,
        up: str,
        drawing: Mapping[str, Any],
        look: Look,
        material: Material | None,
        marks: Mapping[str, Any],
    ) -> None:
        self._viewed, self._look, self._material, self._marks = viewed, look, material, marks
        show_numbers(viewed, take_marks(dict(marks)))
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
        self.has_faces = has_faces(self.scene)
        self._renderer: Renderer | None = None
        self._pictures: PictureRenderer | None = None
        self._settings = settings_for(look, material=material)
        self.staged = StagedScene(self.scene)
        self._light()
        shown_as = None if viewed.coloring is None else viewed.coloring.colored_thing
        Visibility(self.staged, shown_as, material)

    def _light(self) -> None:
        """Light drawings, whatever lights the scene has."""
        look, first = self._look, self._look.lights or NO_LIGHTS
        self.staged.read_textures(self._settings.filtering)
        self._settings.surroundings.put(self.staged, self.up if look.environment else None)
        self.staged.finish_materials(finish_for(look, self.staged, self._viewed.shows_numbers))
        self.staged.fog = None
        self._lighting, ambient = light_in(look, self.staged, self.up, first)
        self._lighting.choose(first)
        Studio(self.staged, self.up, ambient)

    def __enter__(self) -> PanelRenderer:
        return self

    def __exit__(self, *exception: object) -> None:
        for renderer in (self._renderer, self._pictures):
            if renderer is not None:
                renderer.close()

    def choose_paper(self, camera: Camera, pose: np.ndarray) -> None:
        """Choose paper that contrasts with a model without faces, as seen by a camera."""
        named = theme_named(self._look.background)
        if named is not None:
            self.paper = named
            return
        self.staged.background = None
        self._lighting.follow(pose)
        with Renderer(_SMALL, **self._drawing) as renderer:
            color = renderer.render(self.staged, (camera, pose), cull=self._cull).color
        self.paper = theme_for(color, self.has_faces)

    def draw(
        self,
        camera: Camera,
        pose: np.ndarray,
        rectangle: Rectangle,
        *,
        both_sides: bool = False,
    ) -> Frame:
        """Draw a panel on paper.

        Parameters
        ----------
        camera, pose
        rectangle : Rectangle
            Its size counts.
        both_sides : bool
            Whether all faces show both sides.
        """
        self._lighting.follow(pose)
        tone_mapping = self._viewed.appearance.get("tone_mapping", self._look.tone_mapping)
        options: dict[str, Any] = {"tone_mapping": tone_mapping}
        if both_sides:
            options["cull"] = "none"
        self.staged.background = self.paper.background
        outputs = (*OUTPUTS, "world_normal")
        return self.render(camera, pose, rectangle, outputs=outputs, **options)

    def picture(self, camera: Camera, pose: np.ndarray, rectangle: Rectangle) -> Frame:
        """Draw a panel as `engine3d.render` draws the model with this camera."""
        size = rectangle.width, rectangle.height
        if self._pictures is None:
            dress: dict[str, Any] = {"look": self._look, "material": self._material}
            self._pictures = PictureRenderer(size, **dress, **self._drawing)
        self._pictures.resize(size)
        return self._pictures.render(
            self._viewed,
            (camera, pose),
            outputs=OUTPUTS,
            transparent_outputs=True,
            **self._marks,
        )

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
