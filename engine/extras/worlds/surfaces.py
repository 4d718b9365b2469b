"""The surfaces of a city: its materials by name, and their textures.

In: nothing. Out: `materials`, made anew for each mesh list but sharing textures, and the numbers
and sizes that the geometry needs. Textures are computed from integer hashes in float64, element by
element, so their bytes are the same everywhere.
"""

from __future__ import annotations

import functools
from collections.abc import Sequence

import numpy as np

from ...model.materials.linear_colors import linear
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from .hashing import unit_floats

#: name -> (sRGB colour, texture or None, metres that the texture spans or 0 to fit the quad)
_SURFACES = {
    "asphalt": ((92, 94, 98), "speckle", 4.0),
    "stone": ((196, 190, 178), "slabs", 4.0),
    "marking": ((226, 226, 218), "speckle", 4.0),
    "water": ((84, 128, 142), "waves", 16.0),
    "grass": ((112, 142, 74), "turf", 8.0),
    "gravel": ((206, 192, 160), "speckle", 3.0),
    "soil": ((112, 96, 76), "speckle", 3.0),
    "masonry": ((168, 160, 146), "blocks", 4.0),
    "concrete": ((158, 158, 154), "speckle", 6.0),
    "brick red": ((170, 92, 74), "bricks", 2.0),
    "brick brown": ((138, 104, 82), "bricks", 2.0),
    "brick yellow": ((204, 172, 118), "bricks", 2.0),
    "plaster cream": ((232, 220, 190), "plaster", 5.0),
    "plaster ochre": ((216, 172, 104), "plaster", 5.0),
    "plaster rose": ((216, 164, 148), "plaster", 5.0),
    "plaster white": ((234, 232, 226), "plaster", 5.0),
    "plaster grey": ((176, 180, 182), "plaster", 5.0),
    "plaster green": ((164, 184, 160), "plaster", 5.0),
    "trim": ((226, 220, 206), None, 4.0),
    "window": ((255, 255, 255), "window", 0.0),
    "window lit": ((255, 255, 255), "window", 0.0),
    "shop window": ((255, 255, 255), "shop", 0.0),
    "shop window lit": ((255, 255, 255), "shop", 0.0),
    "door": ((255, 255, 255), "door", 0.0),
    "tower glass": ((150, 186, 206), "mullions", 1.5),
    "tower glass dark": ((96, 118, 128), "mullions", 1.5),
    "tower glass bronze": ((176, 150, 116), "mullions", 1.5),
    "roof tiles": ((186, 100, 72), "tiles", 2.4),
    "roof slate": ((98, 106, 120), "tiles", 2.4),
    "roof gravel": ((150, 146, 138), "speckle", 5.0),
    "roof copper": ((116, 168, 146), None, 4.0),
    "metal": ((58, 62, 64), None, 4.0),
    "rubber": ((34, 34, 36), None, 4.0),
    "wood": ((140, 100, 64), None, 4.0),
    "lamp glass": ((255, 240, 208), None, 4.0),
    "awning red": ((178, 54, 48), None, 4.0),
    "awning green": ((46, 104, 76), None, 4.0),
    "awning blue": ((54, 82, 134), None, 4.0),
    "paint red": ((160, 36, 34), None, 4.0),
    "paint blue": ((44, 76, 138), None, 4.0),
    "paint silver": ((188, 192, 196), None, 4.0),
    "paint black": ((38, 40, 44), None, 4.0),
    "bark": ((98, 78, 60), None, 4.0),
    "leaves": ((84, 124, 52), "turf", 3.0),
    "leaves dark": ((58, 98, 52), "turf", 3.0),
    "leaves light": ((124, 148, 62), "turf", 3.0),
}
#: Emission in linear light.
_EMISSIVE = {
    "window lit": (0.34, 0.22, 0.08),
    "shop window lit": (0.42, 0.32, 0.16),
    "lamp glass": (0.9, 0.75, 0.45),
}
_GLOSS = {
    "water": (0.5, 120.0),
    "tower glass": (0.45, 90.0),
    "tower glass dark": (0.45, 90.0),
    "tower glass bronze": (0.45, 90.0),
    "window": (0.25, 60.0),
    "shop window": (0.25, 60.0),
    "paint red": (0.4, 50.0),
    "paint blue": (0.4, 50.0),
    "paint silver": (0.4, 50.0),
    "paint black": (0.4, 50.0),
}
#: Where people walk; everything else is water, grass, or too steep.
WALKABLE = frozenset({"asphalt", "stone", "marking", "gravel"})
#: What one walks through.
FOLIAGE = frozenset({"leaves", "leaves dark", "leaves light"})

NUMBER = {name: number for number, name in enumerate(_SURFACES)}
FITTED = np.array([metres == 0.0 for _, _, metres in _SURFACES.values()])
TEXTURE_METRES = np.array([metres or 1.0 for _, _, metres in _SURFACES.values()])
_SIDE = 128


def numbers(*names: str) -> np.ndarray:
    """Return the material numbers for names, (N,) int32."""
    return np.array([NUMBER[name] for name in names], np.int32)


def materials() -> list[Material]:
    """Return the materials, in the order of their numbers."""
    made = []
    for name, (color, texture, _) in _SURFACES.items():
        gloss, shininess = _GLOSS.get(name, (0.0, 32.0))
        made.append(
            Material(
                name=name,
                color=color,
                texture=None if texture is None else _texture(texture),
                specular=linear(gloss, gloss, gloss),
                shininess=shininess,
                emissive=linear(_EMISSIVE.get(name, (0, 0, 0))),
            )
        )
    return made


@functools.cache
def _texture(name: str) -> Texture:
    return Texture(_PAINTERS[name](), name=name)


def _noise(channel: int, side: int, cell: int = 1) -> np.ndarray:
    """Return noise in [0, 1), (side, side), with one value for each square of ``cell`` pixels."""
    rows = np.arange(side)[:, np.newaxis] // cell
    return unit_floats(0, channel, rows, np.arange(side) // cell)


def _soft(noise: np.ndarray, times: int) -> np.ndarray:
    """Average each value with its neighbours, wrapping around, so that the image tiles."""
    for _ in range(times):
        for axis in (0, 1):
            noise = (noise + np.roll(noise, 1, axis)) * 0.5
    return noise


def _grey(level: np.ndarray, tint: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> np.ndarray:
    """Return levels of light, 0 to 1, as pixels (H, W, 3)."""
    pixels = np.stack([level * part for part in tint], axis=-1)
    return (np.clip(pixels, 0.0, 1.0) * 255.0).astype(np.uint8)


def _speckle() -> np.ndarray:
    coarse = _soft(_noise(1, _SIDE, 16), 12)
    return _grey(0.78 + 0.16 * _soft(_noise(2, _SIDE), 1) + 0.14 * (coarse - 0.5))


def _plaster() -> np.ndarray:
    coarse = _soft(_noise(3, _SIDE, 32), 24)
    return _grey(0.90 + 0.12 * (coarse - 0.5) + 0.06 * _noise(4, _SIDE))


def _turf() -> np.ndarray:
    coarse, fine = _soft(_noise(5, _SIDE, 16), 16), _soft(_noise(6, _SIDE), 1)
    level = 0.70 + 0.24 * fine + 0.16 * (coarse - 0.5)
    pixels = np.stack([level * (0.9 + 0.2 * coarse), level, level * 0.9], axis=-1)
    return (np.clip(pixels, 0.0, 1.0) * 255.0).astype(np.uint8)


def _waves() -> np.ndarray:
    ridges = _soft(_noise(7, _SIDE, 8), 10)
    ridges = (ridges + np.roll(_soft(_noise(8, _SIDE, 4), 6), 5, 0)) * 0.5
    level = 0.80 + 0.7 * (ridges - 0.5) + 0.04 * _noise(9, _SIDE)
    return _grey(level, (0.94, 1.0, 1.0))


def _courses(rows: int, columns: int, joint: int, channel: int, spread: float) -> np.ndarray:
    """Return blocks in courses, each shifted by half a block, with joints of ``joint`` pixels."""
    height, width = _SIDE // rows, _SIDE // columns
    y, x = np.mgrid[0:_SIDE, 0:_SIDE]
    course = y // height
    x = (x + (course % 2) * (width // 2)) % _SIDE
    tone = unit_floats(0, channel, course, x // width)
    level = 1.0 - spread * tone - 0.05 * _noise(channel + 1, _SIDE)
    joints = (y % height < joint) | (x % width < joint)
    return np.where(joints, level * 0.74, level)


def _slabs() -> np.ndarray:
    return _grey(_courses(4, 4, 1, 20, 0.13))


def _tiles() -> np.ndarray:
    level = _courses(8, 8, 1, 30, 0.22)
    y = np.arange(_SIDE)[:, np.newaxis] % (_SIDE // 8)
    return _grey(level * (0.78 + 0.22 * y / (_SIDE // 8)))


def _sash(
    level: np.ndarray,
    left: int,
    right: int,
    top: int,
    bottom: int,
    bars: Sequence[tuple[int | None, int | None]],
) -> np.ndarray:
    """Return a white window frame with bars, around glass of the given level."""
    pixels = np.full((_SIDE, _SIDE, 3), 228, np.uint8)
    glass = np.zeros((_SIDE, _SIDE), bool)
    glass[top:bottom, left:right] = True
    for row, column in bars:
        if row is not None:
            glass[row - 2 : row + 2] = False
        if column is not None:
            glass[:, column - 3 : column + 3] = False
    pixels[glass] = _grey(level, (0.72, 0.86, 1.0))[glass]
    return pixels


def _reflection() -> np.ndarray:
    """Return the reflection in glass: bright sky above, dark houses below, curtains beside."""
    y, x = np.mgrid[0:_SIDE, 0:_SIDE] / (_SIDE - 1.0)
    slant = y + 0.35 * x
    level = np.where(slant < 0.62, 0.56 - 0.25 * slant, 0.20 + 0.05 * slant)
    curtain = np.abs(x - 0.5) > 0.36 - 0.10 * y
    folds = 0.06 * ((x * 40.0) % 1.0)
    return np.where(curtain, 0.58 + folds, level)


def _window() -> np.ndarray:
    return _sash(_reflection(), 8, 120, 6, 122, ((44, None), (None, 64)))


def _shop() -> np.ndarray:
    y, x = np.mgrid[0:_SIDE, 0:_SIDE] / (_SIDE - 1.0)
    goods = _soft(_noise(10, _SIDE, 8), 3)
    level = np.where(y > 0.58, 0.25 + 0.5 * goods, 0.24 + 0.22 * (y + 0.4 * x < 0.5))
    pixels = _sash(level, 5, 123, 5, 114, ((26, None),))
    pixels[pixels == 228] = 70
    return pixels


def _door() -> np.ndarray:
    pixels = np.empty((_SIDE, _SIDE, 3), np.uint8)
    pixels[:] = (92, 62, 44)
    pixels[_SIDE // 2 - 1 : _SIDE // 2 + 1] = (60, 40, 30)
    for left in (10, 72):
        pixels[8:30, left : left + 46] = (120, 150, 168)
        for low in (40, 82):
            pixels[low : low + 34, left : left + 46] = (110, 76, 54)
    pixels[:, 62:66] = (56, 38, 28)
    pixels[62:68, 56:60] = (200, 180, 110)
    return pixels


def _mullions() -> np.ndarray:
    y, x = np.mgrid[0:_SIDE, 0:_SIDE]
    level = 0.70 + 0.22 * _soft(_noise(11, _SIDE, 32), 20) + 0.1 * (y / (_SIDE - 1.0))
    return _grey(np.where((x < 5) | (y < 4), 0.34, level))


_PAINTERS = {
    "speckle": _speckle,
    "plaster": _plaster,
    "turf": _turf,
    "waves": _waves,
    "slabs": _slabs,
    "blocks": lambda: _grey(_courses(8, 4, 1, 24, 0.16)),
    "bricks": lambda: _grey(_courses(16, 8, 1, 28, 0.24)),
    "tiles": _tiles,
    "window": _window,
    "shop": _shop,
    "door": _door,
    "mullions": _mullions,
}
