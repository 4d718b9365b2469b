"""The user's wishes on the command line, whatever scene is shown.

Plain data: the command line fills it in, `ViewRenderer` applies it to each scene.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from ..choices import LightShadow
from ..model.scene.fog import ExponentialFog, Fog
from ..model.scene.gradients import Gradient
from .chosen_surroundings import Surroundings
from .filtering import Filtering
from .overlays.theme import DARK, Theme


@dataclass
class Settings:
    """What the user asked for, whatever the scene; None leaves it to the scene.

    Attributes
    ----------
    appearance : dict
        Fields of `Appearance` that were given.
    look : {"studio", "plain"}
        How models stand there: see `Stage`; or before one colour, without a shadow.
    up : str or None
        A key of `viewpoint.UP_DIRECTIONS`.
    background : (3,) tuple of int, Gradient or None
        sRGB, 0 to 255.
    fog : Fog, ExponentialFog or None
    fog_follows : bool
        Whether the fog takes its colour from the background.
    light_position : (3,) tuple of float or None
        World space.
    light_intensity : float or None
        See `lighting.OnlyLight` and `lighting.Lighting`.
    light_direction : (3,) tuple of float or None
        The way the only light travels, in world space.
    light_clamp : (float, float) or None
        See `Scene`.
    shadow : bool or None
        What ``shadow`` of the main lights is to be; None leaves it to the scene.
    surroundings : Surroundings
        The environment.
    exposure : float or None
        Stops.
    textures : bool
        Whether materials show their textures.
    filtering : Filtering
        How textures are read.
    near, far : float or None
        Distances of the clip planes; None encloses the scene.
    walks : bool
        Whether one who walks does so on the ground of a scene that stands still.
    walkable : tuple of str or None
        Names of the materials that one walks on; None is all.
    slope : float or None
        The steepest ground that one walks on, in radians.
    grid, axes, metadata, axes_grid, bar : bool
        What to draw besides the scene.
    ui_scale : int or None
        Factor on the size of texts; None chooses by the screen and the picture.
    theme : Theme
        Dark or light.
    keeps_theme : bool
        Whether models in the look "studio" do not choose the theme that they stand out from.
    """

    appearance: dict[str, Any]
    look: str = "plain"
    up: str | None = None
    background: tuple[int, int, int] | Gradient | None = None
    fog: Fog | ExponentialFog | None = None
    fog_follows: bool = False
    light_position: tuple[float, float, float] | None = None
    light_intensity: float | None = None
    light_direction: tuple[float, float, float] | None = None
    light_clamp: tuple[float, float] | None = None
    shadow: LightShadow | None = None
    surroundings: Surroundings = field(default_factory=Surroundings)
    exposure: float | None = None
    textures: bool = True
    filtering: Filtering = Filtering()
    near: float | None = None
    far: float | None = None
    walks: bool = False
    walkable: tuple[str, ...] | None = None
    slope: float | None = None
    grid: bool = False
    axes: bool = False
    metadata: bool = False
    axes_grid: bool = False
    bar: bool = False
    ui_scale: int | None = None
    theme: Theme = DARK
    keeps_theme: bool = False
