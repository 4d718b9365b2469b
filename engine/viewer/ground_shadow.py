"""The soft shadow of a model on an invisible ground.

In: a scene, and where its ground is. Out: a `Mesh`, a square that is black where little light comes
down to the ground and lets the background through elsewhere.

A picture from below tells how high the lowest surface over each place of the ground is. Surfaces
are parted by their heights. What a part takes of the light is spread over the ground about as far
as the part is high: so the shadow is dark and sharp where the model stands, and soft below what
overhangs. The sky's light comes straight down, the key light at a slant. All of it is done in
integers, which are the same on every machine.
"""

from __future__ import annotations

import numpy as np

from .. import linalg
from ..geometry.mesh import Mesh
from ..materials.material import Material
from ..materials.textures import Texture
from ..rendering.renderer import Renderer
from ..scene.cameras import OrthographicCamera
from ..scene.orbiting import cosine, home_axes, sine
from .viewpoint import Sphere

#: The square reaches so many radii from the middle of the model, in so many texels a side.
REACH, SIDE = 2.0, 256
#: Heights, in radii, at which the parts end.
_PARTS = (0.06, 0.14, 0.3, 0.6, 1.1, 2.0)
#: How dark it is where none of the sky's light arrives, and none of the key light.
_SKY, _KEY = 0.42, 0.26
#: How far both spread, and how far to the left and back the key light's shadow moves, in heights.
_SKY_SPREAD, _KEY_SPREAD = 0.55, 0.18
_LEFT, _BACK = 0.42, 0.5
_ONE = 1 << 16


def ground_shadow(scene, lowest: float, sphere: Sphere, up, azimuth: float) -> Mesh:
    """Return the shadow of a scene.

    Parameters
    ----------
    scene : Scene
    lowest : float
        How high the ground lies along the up direction.
    sphere : Sphere
        The scene's bounding sphere; sets the size of the square.
    up : (3,) sequence of float
        The world's up direction.
    azimuth : float
        Of one who looks at the scene, in radians; the key light stands behind their right shoulder.

    Returns
    -------
    Mesh
        In world space; seen from above only.
    """
    axes = home_axes(up)
    up = axes[1]
    center = np.array(sphere.center)
    middle = center + up * (lowest - float(linalg.dot(center, up)))
    alpha = _darkness(_heights(scene, middle, axes, sphere.radius), azimuth)
    return _square(alpha, middle, axes, REACH * sphere.radius)


def _heights(scene, middle: np.ndarray, axes, radius: float) -> np.ndarray:
    """How high over the ground the lowest surfaces are, in radii: infinite where there are none.

    Rows go from the back to the front, columns from the left to the right.
    """
    right, up, back = axes
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2] = right, back, -up  # looks up from below
    pose[:3, 3] = middle - up * (0.01 * radius)
    camera = OrthographicCamera(REACH * radius, znear=0.005 * radius, zfar=3.0 * radius)
    with Renderer(SIDE, SIDE) as renderer:
        depth = renderer.render(scene, (camera, pose), outputs=("depth",), cull="none").depth
    heights = np.maximum(depth / np.float32(radius) - np.float32(0.01), 0)
    return np.where(depth > 0, heights, np.inf)[::-1]


def _darkness(heights: np.ndarray, azimuth: float) -> np.ndarray:
    """Return (SIDE, SIDE) uint8 alphas."""
    texels = SIDE / (2 * REACH)  # of a radius
    turned, tipped = cosine(azimuth), sine(azimuth)
    across, down = -_LEFT * turned - _BACK * tipped, _LEFT * tipped - _BACK * turned
    sky, key = np.zeros(heights.shape, np.int64), np.zeros(heights.shape, np.int64)
    low = 0.0
    for high in _PARTS:
        part = ((heights >= low) & (heights < high)) * np.int64(_ONE)
        height = (low + high) / 2 * texels
        sky += _spread(part, round(_SKY_SPREAD * height))
        moved = _moved(part, round(across * height), round(down * height))
        key += _spread(moved, round(_KEY_SPREAD * height))
        low = high
    dark = _SKY * np.minimum(sky, _ONE) + _KEY * np.minimum(key, _ONE)
    return np.rint(dark * (255 / _ONE)).astype(np.uint8)


def _moved(part: np.ndarray, columns: int, rows: int) -> np.ndarray:
    """Return a picture moved to the right and downward; what comes in is 0."""
    moved = np.zeros_like(part)
    to = tuple(slice(max(step, 0), SIDE + min(step, 0)) for step in (rows, columns))
    source = tuple(slice(max(-step, 0), SIDE + min(-step, 0)) for step in (rows, columns))
    moved[to] = part[source]
    return moved


def _spread(part: np.ndarray, reach: int) -> np.ndarray:
    """Return a picture spread about as by a normal distribution: by three means along each side."""
    for _ in range(6 if reach and part.any() else 0):
        part = _means(part, reach).T
    return part


def _means(rows: np.ndarray, reach: int) -> np.ndarray:
    sums = np.cumsum(np.pad(rows, ((0, 0), (reach + 1, reach))), axis=1)
    return (sums[:, 2 * reach + 1 :] - sums[:, : -2 * reach - 1]) // (2 * reach + 1)


def _square(alpha: np.ndarray, middle: np.ndarray, axes, reach: float) -> Mesh:
    pixels = np.zeros((SIDE, SIDE, 4), np.uint8)
    pixels[..., 3] = alpha
    texture = Texture(pixels, filter="bilinear", wrap="clamp")
    right, _, back = axes
    corners = [(-1, 1), (1, 1), (1, -1), (-1, -1)]
    return Mesh(
        np.array([middle + right * (reach * x) + back * (reach * y) for x, y in corners]),
        [(0, 1, 2), (0, 2, 3)],
        uvs=[(0, 0), (1, 0), (1, 1), (0, 1)],
        materials=[Material(texture=texture, alpha_mode="blend", unlit=True)],
        name="shadow",
    )
