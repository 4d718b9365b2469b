"""The studio look: ambient light, a shadow on the ground, and a background.

In: a scene and its view. Out: nodes beside it, and a theme whose background contrasts with the
model.

The ground never covers the model: it lies no higher than any part of it, and shows only from above.
So each line of sight meets the model first, even where the model touches the ground. To keep that
with limited depth precision, the ground is drawn farther away along the line of sight, by a
fraction of its distance, which looks the same.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike

from ..base import linalg
from ..choices import FrameCull
from ..model.geometry.mesh import Mesh
from ..model.materials.material import Material, textures_of
from ..model.materials.textures import Texture
from ..model.scene.ambient_lights import AmbientLight
from ..model.scene.nodes import Node
from ..model.scene.orbiting import home_axes
from ..model.scene.staged_scene import StagedScene
from .ground.ground_shadow import REACH, SIDE, GroundShadow, slant_along, usual_slant
from .ground.mirror_floor import MirrorFloor
from .overlays.theme import DARK, LIGHT, Theme
from .views.camera_view import AnyView
from .views.viewpoint import Sphere

#: The required contrast between a model's outline and its background, as mean difference in 8-bit
#: codes: of faces, which are shaded, and of points and lines alone.
_CONTRAST, _THIN_CONTRAST = 5.0, 60.0
#: How much farther away the ground is drawn, as a fraction of its distance from the eye.
BEHIND = 1 / 4
#: Lines of sight that descend less steeply than this do not show the ground.
_LEVEL = 2e-3


class Studio:
    """The ambient light and ground shadow of a model.

    Parameters
    ----------
    staged : StagedScene
        The studio adds nodes beside it.
    up : (3,) sequence of float
        The world's up direction.
    ambient : AmbientLight or None
        Replaces the ambient light of the scene, unless it has an environment; None leaves it.
    places : (N, 3) ndarray of float64, optional
        Points that bound the moving scene, in world space; by default it is static.
    reflects : bool
        Whether a floor reflects the model.
    """

    def __init__(
        self,
        staged: StagedScene,
        up: ArrayLike,
        ambient: AmbientLight | None,
        places: np.ndarray | None = None,
        reflects: bool = False,
    ) -> None:
        self._staged = staged
        self._axes = home_axes(up)
        if ambient is not None:
            staged.ambient = (0.0, 0.0, 0.0)
        if ambient is not None and staged.environment is None:
            pose = np.eye(4)
            pose[:3, :3] = np.stack(tuple(self._axes), axis=1)
            staged.beside.add(ambient, pose=pose)
        self._floor = MirrorFloor(staged) if reflects else None
        self._ground: Node | None = None
        self._square = _square()
        self._shadow = GroundShadow(staged, self._square, self._axes)
        self.fit(places)

    def fit(self, places: np.ndarray | None) -> None:
        """Stand the ground under a scene that moved; ``places`` are those of the studio."""
        places = self._staged.scene.bounds if places is None else places
        self._usual = float(linalg.dot(places, self._axes[1]).min())

    @property
    def shows_shadow(self) -> bool:
        """Whether the shadow is drawn."""
        return self._ground is not None and self._ground.visible

    def lay_ground(
        self,
        bounds: Sphere,
        view: AnyView,
        light: np.ndarray | None,
        cull: FrameCull,
        mirrors: bool,
    ) -> None:
        """Draw the scene's current shadow on the ground, and the floor that reflects, if any.

        Parameters
        ----------
        bounds : Sphere
            The scene's bounds, which determine the size of the shadow.
        view : Viewpoint or CameraView
        light : (3,) ndarray of float64 or None
            The direction in which the key light travels; None: from behind the viewer's shoulder.
        cull : str
            As in `GroundShadow.alphas`.
        mirrors : bool
            Whether the picture shows what mirrors reflect.
        """
        eye = view.eye()
        self.hide_ground()
        lowest = min(self._usual, self._lowest())
        up, center = self._axes[1], np.array(bounds.center)
        middle = center + up * (lowest - float(linalg.dot(center, up)))
        towards = np.array(eye[:3]) - middle * eye[3]
        if not float(linalg.dot(towards, up)) > _LEVEL * float(linalg.length(towards)):
            return
        slant = usual_slant(view.azimuth) if light is None else slant_along(light, self._axes)
        alphas = self._shadow.alphas(lowest, bounds, slant, cull)
        ground = self._darkened(alphas)
        farther = 1.0 + BEHIND * eye[3]
        turn, pose = np.stack(tuple(self._axes), axis=1), np.eye(4)
        pose[:3, :3] = turn * (farther * bounds.radius)
        pose[:3, 3] = middle - towards * (BEHIND if eye[3] else BEHIND * bounds.radius)
        ground.pose = pose
        ground.visible = True
        if self._floor is not None and mirrors:
            self._floor.lay(middle, turn, bounds.radius)

    def _lowest(self) -> float:
        """Return the scene's current lowest extent."""
        return float(linalg.dot(self._staged.bounds, self._axes[1]).min())

    def _darkened(self, alphas: np.ndarray) -> Node:
        """Return the ground with a shadow on it; the node is added on first use."""
        if self._ground is None:
            self._ground = self._staged.beside.add(self._square, name="shadow", cast_shadows=False)
            self._ground.receive_shadows = False
        material = self._square.materials[0]
        known = textures_of(material).get("texture")
        if known is None or (known.pixels[..., 3] != alphas).any():
            pixels = np.zeros((SIDE, SIDE, 4), np.uint8)
            pixels[..., 3] = alphas
            material.texture = Texture(pixels, filter="bilinear", wrap="clamp")
        return self._ground

    def hide_ground(self) -> None:
        """Hide the shadow and the floor, if there are any."""
        if self._ground is not None:
            self._ground.visible = False
        if self._floor is not None:
            self._floor.hide()


def _square() -> Mesh:
    """Return a black ground square, visible from above, around its node's origin."""
    corners = [(-1, 1), (1, 1), (1, -1), (-1, -1)]
    return Mesh(
        [(REACH * x, 0.0, REACH * z) for x, z in corners],
        [(0, 1, 2), (0, 2, 3)],
        uvs=[(0, 0), (1, 0), (1, 1), (0, 1)],
        materials=[Material(alpha_mode="blend", unlit=True)],
        name="shadow",
    )


def theme_for(
    picture: np.ndarray, has_faces: bool = True, themes: Iterable[Theme] = (LIGHT, DARK)
) -> Theme:
    """Return the first theme whose background contrasts enough with a model, or the best one.

    Parameters
    ----------
    picture : (H, W, 4) uint8
        The model on a transparent background.
    has_faces : bool
        Whether the model has faces, and not only points and lines.
    themes : iterable of Theme
    """
    shows = picture[..., 3] > 0
    around = np.pad(shows, 1, mode="edge")
    inside = around[:-2, 1:-1] & around[2:, 1:-1] & around[1:-1, :-2] & around[1:-1, 2:]
    outline = np.nonzero(shows & ~inside)
    needed = _CONTRAST if has_faces else _THIN_CONTRAST
    distances = [(_distance(picture, outline, theme), theme) for theme in themes]
    enough = [theme for distance, theme in distances if distance >= needed]
    return enough[0] if enough else max(distances, key=lambda entry: entry[0])[1]


def _distance(picture: np.ndarray, outline: tuple[np.ndarray, ...], theme: Theme) -> float:
    """Return an outline's mean difference to a theme's background; 0 without an outline."""
    rows, columns = outline
    if not len(rows):
        return 0.0
    top, bottom = (np.array(color, float) for color in (theme.gradient.top, theme.gradient.bottom))
    share = ((rows + 0.5) / len(picture))[:, np.newaxis]
    behind = top + (bottom - top) * share
    return float(np.abs(picture[rows, columns, :3] - behind).mean())
