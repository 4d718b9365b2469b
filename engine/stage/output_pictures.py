"""Visualises the outputs of a frame (the G-buffer) as pictures.

In: a `Frame` that holds the outputs, and the scene's bounds. Out: (H, W, 3) uint8 per output.
"""

from __future__ import annotations

import functools

import numpy as np

from ..model.materials.colors import srgb_to_linear_table
from ..rendering.frame import Frame, Output
from .overlays.lettering import text_font
from .overlays.theme import Theme
from .overlays.ui_scale import scaled
from .views.viewpoint import Sphere

#: This output tells surfaces from background.
COVERAGE: Output = "depth"
#: The outputs of the split view, row by row.
SPLIT: tuple[tuple[Output, ...], ...] = (
    ("color", "albedo", "world_normal"),
    ("world_position", "depth", "uv"),
    ("object_id", "face_id", "material_id"),
)
SPLIT_OUTPUTS = tuple(name for row in SPLIT for name in row)
#: Three odd factors that turn an ID into red, green and blue.
_SPREAD = np.array([2654435761, 2246822519, 3266489917], np.uint32)
_CODES = 4096
#: Pixels between the corner of a small picture and its name.
INSET = 6


def picture_of(name: str, values: np.ndarray, bounds: Sphere) -> np.ndarray:
    """Return an output as colours.

    Parameters
    ----------
    name : str
        The output.
    values : ndarray
        The frame's array of the output.
    bounds : Sphere
        The scene's bounds, which map positions to colours.
    """
    if name in ("depth", "range"):
        return _nearness(values)
    if name in ("albedo", "emissive", "radiance"):
        return _encoded(values)
    if name == "metallic_roughness":  # as in textures: roughness green, metallic blue
        zeros = np.zeros_like(values[..., :1])
        return _bytes(np.concatenate([zeros, values[..., 1:], values[..., :1]], axis=-1))
    if name == "tangent":
        return _bytes(values[..., :3] * np.float32(0.5) + np.float32(0.5))
    if name.endswith("_id"):
        return _identities(values)
    if name.endswith("normal"):
        return _bytes(values * np.float32(0.5) + np.float32(0.5))
    if name.endswith("position"):
        return _bytes(_placed(name, values, bounds))
    if name == "uv":
        return _bytes(np.dstack([values - np.floor(values), np.zeros_like(values[..., :1])]))
    return _bytes(values)


def paint(frame: Frame, name: str, bounds: Sphere) -> None:
    """Paint an output over the surfaces in a frame's colour."""
    covered = frame.depth > 0
    frame.color[covered, :3] = picture_of(name, getattr(frame, name), bounds)[covered]


def split(frame: Frame, bounds: Sphere, theme: Theme, scale: float = 1.0) -> None:
    """Replace a frame's colour by nine outputs side by side, each at a third of the size."""
    height, width = frame.height // 3, frame.width // 3
    third = slice(1, 3 * height, 3), slice(1, 3 * width, 3)
    covered, whole = frame.depth[third] > 0, frame.color[third].copy()
    canvas, font, inset = frame.canvas(), text_font(scale), scaled(INSET, scale)
    for row, names in enumerate(SPLIT):
        for column, name in enumerate(names):
            picture = whole.copy()
            if name != "color":
                values = np.ascontiguousarray(getattr(frame, name)[third])
                picture[covered, :3] = picture_of(name, values, bounds)[covered]
            top, left = row * height, column * width
            frame.color[top : top + height, left : left + width] = picture
            canvas.text(
                left + inset, top + inset, name, theme.text, font=font, background=theme.block
            )


def whole_pixel(x: int, y: int, size: tuple[int, int]) -> tuple[int, int]:
    """Return the pixel of the whole picture that a pixel of the split view shows."""
    width, height = (max(1, side // 3) for side in size)
    return x % width * 3 + 1, y % height * 3 + 1


def _bytes(values: np.ndarray) -> np.ndarray:
    return (np.clip(values, 0, 1) * np.float32(255) + np.float32(0.5)).astype(np.uint8)


@functools.cache
def _codes() -> np.ndarray:
    """Return the sRGB codes of linear values from 0 to 1, in equal steps."""
    table = srgb_to_linear_table()
    steps = np.arange(_CODES) / (_CODES - 1)
    return np.searchsorted((table[1:] + table[:-1]) / 2, steps).astype(np.uint8)


def _encoded(linear: np.ndarray) -> np.ndarray:
    return _codes()[(np.clip(linear, 0, 1) * np.float32(_CODES - 1)).astype(np.int32)]


def _identities(ids: np.ndarray) -> np.ndarray:
    """Return colours that distinguish neighbouring IDs, none of them dark."""
    mixed = (ids.astype(np.uint32)[..., np.newaxis] + np.uint32(1)) * _SPREAD
    return (64 + (mixed >> 24) * 3 // 4).astype(np.uint8)


def _nearness(depth: np.ndarray) -> np.ndarray:
    """Return nearness as grey: white is nearest, dark is farthest in the picture."""
    covered = depth[depth > 0]
    low, high = (covered.min(), covered.max()) if covered.size else (0.0, 1.0)
    span = np.float32(high - low) or np.float32(1)
    grey = 1 - np.float32(0.85) * ((depth - np.float32(low)) / span)
    return np.repeat(_bytes(grey)[..., np.newaxis], 3, axis=2)


def _placed(name: str, positions: np.ndarray, bounds: Sphere) -> np.ndarray:
    """Return positions relative to the bounds, from 0 to 1; in view space around the camera."""
    center = bounds.center if name == "world_position" else (0.0, 0.0, 0.0)
    middle, reach = np.array(center, np.float32), np.float32(2 * bounds.radius)
    return (positions - middle) / reach + np.float32(0.5)
