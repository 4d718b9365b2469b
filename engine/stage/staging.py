"""The stage of a model: lights, ground and surroundings beside its scene.

In: a `ViewedScene` and the user's settings. Out: a `StagedScene`, which follows the camera; the
model's scene is not changed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, cast

import numpy as np

from ..base import linalg
from ..model.geometry.mesh import Mesh
from ..model.scene.ambient_lights import AmbientLight
from ..model.scene.lights import WHITE_INTENSITY, DirectionalLight
from ..model.scene.nodes import Node
from ..model.scene.staged_scene import StagedScene
from ..model.scene.surroundings import Background
from .appearance import Appearance, has_faces
from .chosen_surroundings import fog_color
from .filtering import Filtering
from .finish import finish_for
from .lighting import (
    NO_LIGHTS,
    OWN_LIGHTS,
    Lighting,
    OnlyLight,
    light_in,
    placed_light,
    switch_shadows,
)
from .look import THEMED, Look
from .near_origin import from_file
from .overlays.box_grid import BoxGrid
from .overlays.feature_lines import FeatureLines
from .overlays.grid_lines import grid
from .overlays.theme import Theme, theme_named
from .stage_settings import Settings
from .studio import BEHIND, Studio, theme_for
from .viewed_scene import ViewedScene
from .views.camera_view import AnyView
from .views.viewpoint import UP_DIRECTIONS, Sphere
from .visibility import Visibility

_PLAIN = Look.plain()
_BLACK = (0, 0, 0)  # the background of new scenes
#: A box around a sphere extends no farther than this, in radii.
_BOX_REACH = 1.75


class Staging:
    """The lights, ground and other things that a model is drawn with.

    Parameters
    ----------
    viewed : ViewedScene
    settings : Settings
    up : str
        As in `stand`.
    transparent : bool
        Whether there is no background.
    lights : str
        As in `stand`.

    Attributes
    ----------
    scene : StagedScene
        The scene to draw.
    lighting : Lighting or OnlyLight
    visibility : Visibility
    box : BoxGrid
    up : str
    alone : (H, W, 4) uint8 or None
        A small picture of the model on a transparent background, if one was drawn.
    azimuths : dict of str to float
        Those of first views that were looked for, by the up direction.
    """

    def __init__(
        self, viewed: ViewedScene, settings: Settings, up: str, transparent: bool, lights: str = ""
    ) -> None:
        self.viewed = viewed
        self.settings = settings
        sees_through = viewed.themed and self._backdrop is None
        self._transparent = transparent or (sees_through and settings.background is None)
        self.scene = scene = StagedScene(viewed.scene)
        coloring = viewed.coloring
        shown_as = None if coloring is None else coloring.colored_thing
        self.visibility = Visibility(scene, shown_as, settings.material)
        self.alone: np.ndarray | None = None
        self.azimuths: dict[str, float] = {}
        scene.read_textures(self._reading())
        self.show_textures(settings.textures)
        if settings.light_clamp is not None:
            scene.light_clamp = settings.light_clamp
        if settings.exposure is not None:
            scene.exposure = settings.exposure
        self._take_theme()
        self._lay_background()
        self.stand(up, lights)
        self._lay_fog()

    def _take_theme(self) -> None:
        """Take the theme that the look names, if it names one."""
        named = theme_named(self.settings.look.background)
        if named is not None and not self.settings.keeps_theme:
            self.theme = named

    def _reading(self) -> Filtering:
        """Return how textures are read: as looks do, if the model wears one that adds something."""
        settings = self.settings
        is_bare = settings.look == _PLAIN or self._is_lit_scene
        return settings.filtering.without_usual() if is_bare else settings.filtering

    @property
    def _is_lit_scene(self) -> bool:
        """Whether it is a program's scene with light of its own, which wears no look."""
        return self.viewed.is_scene and not self.viewed.themed

    @property
    def _backdrop(self) -> Any:
        """The background of the look, or the one that a program chose for its scene."""
        backdrop, own = self.settings.look.background, self.viewed.scene.background
        if backdrop != "auto" or not self.viewed.is_scene:
            return backdrop
        is_new = own is not None and own == _BLACK
        return backdrop if is_new else None if own is None else "scene"

    def _lay_background(self) -> None:
        """Give the scene the background of the user or of the look."""
        settings, background = self.settings, self._backdrop
        if self._transparent:
            self.scene.background = None
        elif settings.background is not None:
            self.scene.background = settings.background
        elif self.viewed.themed and (settings.keeps_theme or background in THEMED):
            self.scene.background = self._theme_background
        elif self.viewed.themed and background != "scene":
            self.scene.background = cast(Background, background)

    @property
    def _theme_background(self) -> Background:
        """The background of a model in the colours of the theme."""
        is_studio = self._backdrop in THEMED
        return self.theme.gradient if is_studio else self.theme.background

    def stand(self, up: str, lights: str = "") -> None:
        """Rebuild the stage with a given up direction.

        Parameters
        ----------
        up : str
            A key of `UP_DIRECTIONS`.
        lights : str
            The light set-up with that name if it exists, else the first one.
        """
        self.up = up
        self.scene.clear()
        self.box = BoxGrid(self.viewed, self.scene)
        self._grid: Node | None = None
        self._surround()
        self._ambient: AmbientLight | None = None  # of the look, where its lights shine
        self.lighting = self._light()
        self._cast_shadows()
        if lights in self.lighting.names:
            self.lighting.choose(lights)
        self._studio = self._make_studio()
        self._edges = self._make_edges()
        self._await_theme()
        self.show_grid(self.settings.grid)

    def _cast_shadows(self) -> None:
        """Let lights cast the shadows that the user chose, or else the look."""
        if self.settings.shadow is not None:
            switch_shadows(self.lighting.groups(), self.settings.shadow)
        elif self.viewed.themed and isinstance(self.lighting, Lighting):
            self.lighting.cast_shadows(self.settings.look.shadow)

    def _surround(self) -> None:
        """Give the scene its environment, and materials that reflect it."""
        look, scene, viewed = self.settings.look, self.scene, self.viewed
        reflects = look.environment and not self._is_lit_scene
        self.settings.surroundings.put(scene, UP_DIRECTIONS[self.up] if reflects else None)
        if viewed.themed:
            scene.finish_materials(finish_for(look, scene, viewed.shows_numbers))

    def _await_theme(self) -> None:
        """Let the next frame choose the theme, if the look leaves it open."""
        self._chooses_theme = self._backdrop == "auto" and self._shows_theme()

    @property
    def can_renew(self) -> bool:
        """Whether `renew` makes the stage the one that would be built anew.

        Lights of a scene's own, a light that the user placed, and fog depend on more.
        """
        settings = self.settings
        return self.viewed.themed and settings.light_position is None and settings.fog is None

    def renew(self) -> None:
        """Follow a scene whose nodes moved, hid or showed; what else there is stays."""
        self.box.fit(self.viewed)
        if self._studio is not None:
            self._studio.fit(self.viewed.places)
        if self._grid is not None:
            self._grid.object = self._lines()
        self._await_theme()

    def _light(self) -> Lighting | OnlyLight:
        viewed, settings = self.viewed, self.settings
        intensity = settings.light_intensity
        if settings.light_position is not None:
            position = from_file(viewed, settings.light_position)
            return placed_light(self.scene, position, viewed.bounds, intensity)
        look, intensity = settings.look, 1.0 if intensity is None else intensity
        if settings.light_direction is not None:
            strength = intensity * WHITE_INTENSITY
            light = DirectionalLight(settings.light_direction, intensity=strength)
            return OnlyLight(self.scene, light)
        lights = None if self._is_lit_scene else look.lights
        first = lights or (NO_LIGHTS if self._adds_nothing() else "headlight")
        lighting, ambient = light_in(look, self.scene, UP_DIRECTIONS[self.up], first, intensity)
        self._ambient = None if lighting.names[0] == OWN_LIGHTS else ambient
        return lighting

    def _adds_nothing(self) -> bool:
        """Return whether a scene without lights is lit by the renderer itself."""
        settings = self.settings
        is_usual = settings.light_intensity is None and settings.look.light_intensity == 1.0
        return is_usual and settings.shadow is None

    def _make_studio(self) -> Studio | None:
        """Return the studio of the model; None if the scene or the user's look has none."""
        look = self.settings.look
        if not self.viewed.themed or (look.lights is None and not look.ground):
            return None
        up, reflects = UP_DIRECTIONS[self.up], look.ground == "mirror"
        return Studio(self.scene, up, self._ambient, self.viewed.places, reflects)

    def _make_edges(self) -> FeatureLines | None:
        """Return the feature edges of the model; None if the look draws none."""
        wanted = self.settings.look.feature_edges
        is_painted = self.settings.material is not None or self.viewed.coloring is not None
        if not self.viewed.themed or not wanted or (wanted == "auto" and is_painted):
            return None
        of_model = wanted == "auto" and self.viewed.model_edges
        return FeatureLines(self.scene, of_all=wanted is True, of_model=of_model)

    def _shows_theme(self) -> bool:
        """Return whether the background is the theme's."""
        settings = self.settings
        kept = self._transparent or settings.background or settings.surroundings.shows
        return self.viewed.themed and not kept

    def follow(
        self,
        view: AnyView,
        appearance: Appearance,
        split: bool,
        draw_alone: Callable[[AnyView], np.ndarray],
    ) -> None:
        """Update the stage for a frame: its background, shadow and grid.

        Parameters
        ----------
        view : Viewpoint or CameraView
        appearance : Appearance
        split : bool
            Whether outputs are shown side by side.
        draw_alone : callable
            Draws a small picture of the model on a transparent background.
        """
        self._hide_grids()  # they cast no shadow on the ground
        self.choose_theme(view, draw_alone)
        studio, edges = self._studio, self._edges
        is_plain = appearance.mode in ("lit", "unlit") and appearance.wireframe is None
        is_plain = is_plain and not split
        if edges is not None:
            if is_plain and appearance.cull != "front":
                edges.follow(view.eye(), self.viewed.bounds, only_closed=appearance.cull == "back")
            else:
                edges.show(False)
        if studio is not None and self._has_ground:
            if is_plain and not self._transparent:
                light = self.lighting.main_direction()
                mirrors = appearance.mode == "lit" and appearance.mirror_depth > 0
                studio.lay_ground(self.viewed.bounds, view, light, appearance.cull, mirrors)
            else:
                studio.hide_ground()
        if self._grid is not None:
            self._grid.visible = self.settings.grid
        self.box.follow(view.position(), self.settings.axes_grid and not split)

    def _hide_grids(self) -> None:
        """Hide what the next frame shows again, if it is to be shown."""
        self.box.hide()
        if self._grid is not None:
            self._grid.visible = False

    def choose_theme(self, view: AnyView, draw_alone: Callable[[AnyView], np.ndarray]) -> None:
        """Choose the theme that the model contrasts with, as seen from a view; only once.

        Parameters
        ----------
        view, draw_alone
            As for `follow`.
        """
        if not self._chooses_theme:
            return
        if self._studio is not None:
            self._studio.hide_ground()
        if self._edges is not None:
            self._edges.show(False)
        self.alone = alone = None if self.settings.keeps_theme else draw_alone(view)
        chosen = None if alone is None else theme_for(alone, has_faces(self.viewed.scene))
        self.theme = chosen or self.theme

    @property
    def _has_ground(self) -> bool:
        """Whether the model casts a shadow on the ground."""
        return self._studio is not None and self.settings.look.ground is not False

    @property
    def theme(self) -> Theme:
        """The theme: colours of texts over the picture, and of the model's background."""
        return self.settings.theme

    @theme.setter
    def theme(self, theme: Theme) -> None:
        self.settings.theme = theme
        self._chooses_theme = False
        if self._shows_theme():
            self.scene.background = self._theme_background
            self._lay_fog()

    def _lay_fog(self) -> None:
        """Apply the user's fog to the scene."""
        fog = self.settings.fog
        if fog is not None:
            color = fog_color(self.scene.background) if self.settings.fog_follows else None
            self.scene.fog = fog if color is None else replace(fog, color=color)

    def show_textures(self, shown: bool) -> None:
        """Switch textures on or off."""
        self.settings.textures = shown
        self.scene.show_textures(shown)

    def show_grid(self, shown: bool) -> None:
        """Switch the grid under the model on or off."""
        self.settings.grid = shown
        if shown and self._grid is None:
            self._grid = self.scene.beside.add(self._lines(), name="grid", cast_shadows=False)
            self._grid.receive_shadows = False

    def _lines(self) -> Mesh:
        """Return the grid under the model."""
        return grid(self._lowest(), self.viewed.bounds, UP_DIRECTIONS[self.up])

    def _lowest(self) -> float:
        """Return the scene's lowest extent along the up direction, over all its motion."""
        up, bounds = UP_DIRECTIONS[self.up], self.viewed.bounds
        if self.viewed.update is not None:
            return float(linalg.dot(bounds.center, up)) - bounds.radius
        return float(linalg.dot(self.viewed.scene.bounds, up).min())

    @property
    def shows_grids(self) -> bool:
        """Whether a grid is drawn."""
        return self.settings.grid or self.box.shows

    @property
    def shows_more(self) -> bool:
        """Whether anything is drawn besides the model."""
        return self.shows_grids or (self._studio is not None and self._studio.shows_shadow)

    def reach(self, view: AnyView) -> Sphere:
        """Return what clip planes must enclose: animated parts, grids and ground included."""
        bounds = self.viewed.bounds
        margin = 1.0 if self.viewed.update is None else 1.6
        if self.settings.grid or self._has_ground:
            margin = max(margin, 3.2)
        if self.settings.axes_grid:
            margin = max(margin, _BOX_REACH)
        radius = bounds.radius * margin
        if self._has_ground:
            distance = float(linalg.length(view.position() - np.array(bounds.center)))
            radius += BEHIND * (distance + radius)
        return bounds._replace(radius=radius)
