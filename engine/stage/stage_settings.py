"""The user's settings from the command line, for any scene.

Plain data: the command line fills it in, `ViewRenderer` applies it to each scene.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ..choices import LightShadow
from ..model.materials.material import Material
from ..model.scene.fog import ExponentialFog, Fog
from ..model.scene.gradients import Gradient
from .chosen_surroundings import Surroundings
from .filtering import Filtering
from .look import Look, check_look
from .overlays.theme import DARK, Theme

if TYPE_CHECKING:
    from .overlays.measurements import Measurement


@dataclass
class Settings:
    """The user's settings for any scene; None leaves a value to the scene.

    Attributes
    ----------
    appearance : dict
        Fields of `Appearance` that were given.
    look : Look
        The look of models; a name is accepted.
    material : Material or None
        Replaces all materials and vertex colours of the scene.
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
        Direction of the only light, in world space.
    light_clamp : (float, float) or None
        See `Scene`.
    shadow : bool or None
        The value of ``shadow`` for the main lights; None leaves it to the scene.
    surroundings : Surroundings
        The environment.
    exposure : float or None
        Stops.
    textures : bool
        Whether materials show their textures.
    filtering : Filtering
        Texture filtering.
    near, far : float or None
        Distances of the clip planes; None encloses the scene.
    walks : bool
        Whether walking follows the ground of a static scene.
    walkable : tuple of str or None
        Names of walkable materials; None is all.
    slope : float or None
        The steepest walkable slope, in radians.
    grid, axes, metadata, axes_grid, bar, dimensions : bool
        What to draw besides the scene.
    measured : tuple of Measurement
        What to measure in pictures; points are in the file's coordinates.
    ui_scale : float or None
        Factor on the size of texts; None chooses by the screen and the picture.
    theme : Theme
        Dark or light.
    keeps_theme : bool
        Whether to keep the theme, instead of choosing one that contrasts with the model.
    """

    appearance: dict[str, Any]
    look: Look = field(default_factory=Look.plain)
    material: Material | None = None
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
    dimensions: bool = False
    measured: tuple[Measurement, ...] = ()
    ui_scale: float | None = None
    theme: Theme = DARK
    keeps_theme: bool = False

    def __post_init__(self) -> None:
        self.look = check_look(self.look)
