"""The alpha of Wavefront materials: ``d``, ``Tr``, opacity maps, and images with alpha.

In: an MTL library's statements on a material. Out: its `alpha_mode`, alpha and texture. The format
has no modes. A black-and-white map is a mask (foliage, fences); maps with intermediate values are
blended. A colour image's alpha is a mask if it is black and white; any other alpha is taken for
something else, such as a gloss map.
"""

from __future__ import annotations

import numpy as np

from ....model.materials.colors import with_alpha
from ....model.materials.material import Material
from ....model.materials.textures import Texture

#: Opacity map statements, in lower case -> whether the map holds transparency.
OPACITY_MAPS = {"map_d": False, "map_opacity": False, "map_tr": True}
_LOW, _HIGH = 8, 247  # limits for transparent and opaque, of 255
_MOST_BETWEEN = 0.1  # of a mask's texels: its edges are smoothed
_LEAST_EACH = 0.002  # minimum fraction of transparent and of opaque texels


def set_alpha(
    material: Material, opacity: float, opacity_map: Texture | None, inverted: bool
) -> None:
    """Make a material masked or blended if its file says so.

    Parameters
    ----------
    material : Material
        The material, with its colour and texture.
    opacity : float
        0 to 1: ``d``, or 1 - ``Tr``.
    opacity_map : Texture or None
    inverted : bool
        Whether white in the map means transparent.
    """
    given = material.texture
    texture = given if isinstance(given, Texture) else None
    if opacity_map is not None:
        alpha = _map_values(opacity_map, inverted)
        material.texture = _with_alpha(texture, opacity_map, alpha)
        material.alpha_mode = "mask" if opacity == 1 and _is_mask(alpha) else "blend"
    elif texture is not None and _is_mask(texture.pixels[:, :, 3]):
        material.alpha_mode = "mask" if opacity == 1 else "blend"
    elif opacity < 1:
        material.alpha_mode = "blend"
    if opacity < 1:
        material.color = with_alpha(material.rgb, opacity)


def _map_values(texture: Texture, inverted: bool) -> np.ndarray:
    """Return (H, W) uint8: the map's alpha if it has any, else its red channel."""
    pixels = texture.pixels
    values = pixels[:, :, 3] if (pixels[:, :, 3] != 255).any() else pixels[:, :, 0]
    return 255 - values if inverted else values


def _is_mask(alpha: np.ndarray) -> bool:
    out, within = np.mean(alpha <= _LOW), np.mean(alpha >= _HIGH)
    return bool(min(out, within) >= _LEAST_EACH and 1 - out - within <= _MOST_BETWEEN)


def _with_alpha(texture: Texture | None, opacity_map: Texture, alpha: np.ndarray) -> Texture:
    """Return the colour image with this alpha, at the larger of both sizes, by nearest texels."""
    given = opacity_map if texture is None else texture
    height = max(given.height, alpha.shape[0])
    width = max(given.width, alpha.shape[1])
    pixels = np.full((height, width, 4), 255, np.uint8)
    if texture is not None:
        pixels[:, :, :3] = _resized(texture.pixels[:, :, :3], height, width)
    pixels[:, :, 3] = _resized(alpha, height, width)
    return Texture(
        pixels,
        color_space=given.color_space,
        filter=given.filter,
        wrap=given.wrap,
        name=given.name,
    )


def _resized(pixels: np.ndarray, height: int, width: int) -> np.ndarray:
    rows = np.arange(height) * pixels.shape[0] // height
    columns = np.arange(width) * pixels.shape[1] // width
    return pixels[rows[:, np.newaxis], columns]
