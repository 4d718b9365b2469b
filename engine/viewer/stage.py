"""What a model stands in: light from all around, its shadow on the ground, a background.

In: a scene and how it is looked at. Out: nodes that are added to it, and a theme whose background
the model stands out from.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from .. import linalg
from ..scene.ambient_lights import HemisphereLight
from ..scene.orbiting import home_axes
from .ground_shadow import ground_shadow
from .theme import DARK, LIGHT, Theme
from .viewpoint import Sphere

#: Light from above and from below.
_SKY, _GROUND = (0.30, 0.32, 0.36), (0.18, 0.17, 0.16)
#: The outline of a model differs from its background by so many codes of 255, on average over it.
_CONTRAST = 60.0
#: Seconds for which the shadow of what moves stays as it is.
_SOME_TIME = 0.1


class Stage:
    """The light from all around a model, and its shadow.

    Parameters
    ----------
    scene : Scene
        Nodes are added to it.
    up : (3,) sequence of float
        The world's up direction.
    is_lit : bool
        Whether light from all around is added, in place of the scene's ambient light.
    """

    def __init__(self, scene, up, is_lit: bool):
        self._scene = scene
        self._up = up
        self._ambient = scene.ambient
        self._nodes = []
        self._shadow = None
        if is_lit:
            pose = np.eye(4)
            pose[:3, :3] = np.stack(home_axes(up), axis=1)
            self._nodes.append(scene.add(HemisphereLight(_SKY, _GROUND), pose=pose))
            scene.ambient = (0.0, 0.0, 0.0)

        self._lowest = float(linalg.dot(scene.bounds, up).min())
        self._laid_at: float | None = None

    @property
    def nodes(self) -> tuple:
        """What was added that is drawn."""
        return () if self._shadow is None else (self._shadow,)

    def lay_shadow(self, bounds: Sphere, azimuth: float, time: float) -> None:
        """Lay the shadow of the scene as it is at a time on the ground; see `ground_shadow`.

        What moves has its shadow laid anew when it was laid some time ago.
        """
        if self._laid_at is not None and abs(time - self._laid_at) < _SOME_TIME:
            return
        self.show_shadow(False)
        mesh = ground_shadow(self._scene, self._lowest, bounds, self._up, azimuth)
        if self._shadow is None:
            self._shadow = self._scene.add(mesh, name="shadow", cast_shadows=False)
            self._nodes.append(self._shadow)
        self._shadow.object = mesh
        self._laid_at = time

    def show_shadow(self, shown: bool) -> None:
        """Show the shadow or not, if there is one."""
        if self._shadow is not None:
            self._shadow.visible = shown

    def leave(self) -> None:
        """Leave the scene as it was."""
        for node in self._nodes:
            self._scene.remove(node)
        self._scene.ambient = self._ambient


def theme_for(picture: np.ndarray, themes: Iterable[Theme] = (LIGHT, DARK)) -> Theme:
    """Return the first theme whose background is far enough from a model, or the farthest.

    Parameters
    ----------
    picture : (H, W, 4) uint8
        The model before a transparent background.
    themes : iterable of Theme
    """
    distances = [(_distance(picture, theme), theme) for theme in themes]
    enough = [theme for distance, theme in distances if distance >= _CONTRAST]
    return enough[0] if enough else max(distances, key=lambda entry: entry[0])[1]


def _distance(picture: np.ndarray, theme: Theme) -> float:
    """How far the outline of a model is from a theme's background, in codes; 0 if it has none."""
    shows = picture[..., 3] > 0
    around = np.pad(shows, 1, mode="edge")
    inside = around[:-2, 1:-1] & around[2:, 1:-1] & around[1:-1, :-2] & around[1:-1, 2:]
    rows, columns = np.nonzero(shows & ~inside)
    if not len(rows):
        return 0.0
    top, bottom = (np.array(color, float) for color in (theme.gradient.top, theme.gradient.bottom))
    share = ((rows + 0.5) / len(picture))[:, np.newaxis]
    behind = top + (bottom - top) * share
    return float(np.abs(picture[rows, columns, :3] - behind).mean())
