"""Drawing of scenes: colours, numbers of geoms, depths.

In: a scene, a context, a size. Out: arrays with the top row first.
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import numpy as np

from ...errors import warn
from ._buffer_depths import Draw
from ._scenes import camera_of
from .context import MjrContext

_FLAGS = ("WIREFRAME", "CULL_FACE", "REFLECTION", "SHADOW", "ADDITIVE", "FOG", "HAZE", "SKYBOX")

_OPAQUE_ALPHA = np.float32(0.995)
_PLANE = 0  # of mjtGeom


@cache
def _flag_number(name: str) -> int | None:
    import mujoco

    number = getattr(mujoco.mjtRndFlag, f"mjRND_{name}", None)  # older versions have fewer
    return None if number is None else int(number)


def _has(scene: Any, name: str) -> bool:
    """Return whether a flag of the scene is set."""
    number = _flag_number(name)
    return number is not None and bool(scene.flags[number])


class Prepared(NamedTuple):
    """A scene as it was when it was drawn.

    Attributes
    ----------
    geoms, lights : ndarray
        Records for the core.
    ambient : float
        The light where no light is.
    flags : list of bool
        For `NativePicture.render`.
    """

    geoms: np.ndarray
    lights: np.ndarray
    ambient: float
    flags: list[bool]


class View(NamedTuple):
    """What a camera sees, in a picture or beside another view.

    Attributes
    ----------
    camera : tuple
        From `camera_of`.
    width : int
    """

    camera: tuple[np.ndarray, bool]
    width: int


def prepare(scene: Any, context: MjrContext, *, lit: bool = True) -> Prepared:
    """Read a scene's memory."""
    view, model = context.view(scene), context.model
    context.hand_over()
    geoms = view.geoms(model)
    if view.has_moving_shapes():
        context.settle_depths()  # shapes are kept once, as they were last
        view.set_moving_shapes(model)
    lights, ambient = view.lights(model, none=not lit)
    return Prepared(geoms, lights, ambient, [_has(scene, name) for name in _FLAGS])


def _prepare_segments(scene: Any, context: MjrContext) -> Prepared:
    """Read a scene's memory for pictures of geoms alone."""
    drawn = prepare(scene, context, lit=False)
    return drawn._replace(flags=[*drawn.flags[:-1], False])  # without the sky


def _views_of(scene: Any, width: int, height: int) -> list[View]:
    """Return the views of a picture, from left to right: one, or in stereo those of both eyes."""
    if not scene.stereo:
        return [View(camera_of(scene, width / height), width)]
    half = width // 2
    return [View(camera_of(scene, half / height, eye), half) for eye in (0, 1)]


def _beside(parts: list[np.ndarray], width: int, nothing: int) -> np.ndarray:
    """Return pictures beside one another; an odd width leaves a column where nothing is."""
    left = width - sum(part.shape[1] for part in parts)
    if len(parts) == 1 and not left:
        return parts[0]
    first = parts[0]
    rest = np.full((len(first), left, *first.shape[2:]), nothing, first.dtype)
    return np.concatenate([*parts, rest], axis=1)


def draw_colors(scene: Any, context: MjrContext, width: int, height: int) -> np.ndarray:
    """Return the scene's colours, (height, width, 3) uint8."""
    if is_segmented(scene):
        numbers = draw_segments(scene, context, width, height, numbers=True, depths=False)[0]
        assert numbers is not None
        out = segment_colors(scene, context, numbers)
    else:
        prepared = prepare(scene, context)
        views = _views_of(scene, width, height)
        out = _beside([_draw_view(prepared, context, v, height) for v in views], width, 0)
        context.view(scene).warn_of_labels()
    if _has(scene, "DEPTH"):
        warn("the flag mjRND_DEPTH of scenes is not drawn: use enable_depth_rendering()")
    if scene.framewidth:
        _draw_frame(out, int(scene.framewidth), scene.framergb)
    return out


def _draw_view(prepared: Prepared, context: MjrContext, view: View, height: int) -> np.ndarray:
    model = context.model
    assert model.quality is not None
    out = np.empty((height, view.width, 3), np.uint8)
    context.picture.render(
        model.native,
        prepared.geoms,
        prepared.lights,
        *view.camera,
        model.quality.samples,
        prepared.ambient,
        prepared.flags,
        out,
    )
    return out


def _draw_frame(out: np.ndarray, width: int, rgb: Any) -> None:
    code = np.floor(np.clip(np.array(rgb, np.float32), 0, 1) * np.float32(255) + np.float32(0.5))
    for rows, columns in (
        (slice(0, width), slice(None)),
        (slice(max(len(out) - width, 0), None), slice(None)),
        (slice(None), slice(0, width)),
        (slice(None), slice(max(out.shape[1] - width, 0), None)),
    ):
        out[rows, columns] = code.astype(np.uint8)


def draw_segments(
    scene: Any,
    context: MjrContext,
    width: int,
    height: int,
    *,
    numbers: bool,
    depths: bool,
) -> tuple[np.ndarray | None, np.ndarray | None]:
    """Return which geom shows in each pixel and its depth, (H, W) int32 and float32.

    The number of no geom is -1. Depths are 1 at the near plane, 0 at the far
    plane. Only geoms with a segid are drawn.
    """
    prepared = _prepare_segments(scene, context)
    parts = [
        _draw_segments_of(prepared, context, view, height, numbers=numbers, depths=depths)
        for view in _views_of(scene, width, height)
    ]
    geom = _beside([part[0] for part in parts], width, -1) if numbers else None
    depth = _beside([part[1] for part in parts], width, 0) if depths else None
    return geom, depth


def _draw_segments_of(
    prepared: Prepared,
    context: MjrContext,
    view: View,
    height: int,
    *,
    numbers: bool,
    depths: bool,
) -> tuple[Any, Any]:
    geom = np.empty((height, view.width), np.int32) if numbers else None
    depth = np.empty((height, view.width), np.float32) if depths else None
    context.picture.render(
        context.model.native,
        prepared.geoms,
        prepared.lights[:0],
        *view.camera,
        1,
        0.0,
        prepared.flags,
        None,
        geom,
        depth,
    )
    return geom, depth


def later_depths(scene: Any, context: MjrContext, width: int, height: int) -> Draw:
    """Return what draws the depths that a picture of the scene, as it is now, leaves behind.

    Colours leave those of the sky and the haze, and none of transparent geoms (R250).
    """
    views = _views_of(scene, width, height)
    if is_segmented(scene):
        kept = _prepare_segments(scene, context)
    else:
        kept = prepare(scene, context, lit=False)
        eye = camera_of(scene, width / height)[0][12:15]
        kept.geoms["segid"] = np.where(_is_transparent(kept.geoms, eye), -1, 0)

    def draw(context: MjrContext) -> np.ndarray:
        parts = [
            _draw_segments_of(kept, context, view, height, numbers=False, depths=True)[1]
            for view in views
        ]
        return _beside(parts, width, 0)

    return draw


def _is_transparent(geoms: np.ndarray, eye: np.ndarray) -> np.ndarray:
    """Return which geoms are blended (R250)."""
    away = eye - geoms["pos"]
    normal = geoms["mat"][:, 2::3]
    behind = (away[:, 0] * normal[:, 0] + away[:, 1] * normal[:, 1]) + away[:, 2] * normal[:, 2] < 0
    return (geoms["rgba"][:, 3] < _OPAQUE_ALPHA) | ((geoms["type"] == _PLANE) & behind)


def segment_colors(scene: Any, context: MjrContext, geom: np.ndarray) -> np.ndarray:
    """Return the colours by which mjRND_SEGMENT tells geoms, (H, W, 3) uint8."""
    ids = context.view(scene).segment_ids().astype(np.int64)
    table = np.zeros((len(ids) + 1, 3), np.uint8)  # the last one is the background's
    if _has(scene, "IDCOLOR"):
        number = ids + 1
        for c in range(3):
            table[:-1, c] = (number >> 8 * c) & 255
    else:
        for c, base in enumerate((2, 3, 5)):
            table[:-1, c] = np.floor((0.1 + 0.8 * _halton(ids + 10, base)) * 255 + 0.5)
    return table[geom]


def _halton(index: np.ndarray, base: int) -> np.ndarray:
    """Return Halton's sequence at some places."""
    left, share, out = np.maximum(index, 0).copy(), 1.0 / base, np.zeros(len(index))
    while (left > 0).any():
        out += share * (left % base)
        left //= base
        share /= base
    return out


def is_segmented(scene: Any) -> bool:
    """Return whether the scene's flag mjRND_SEGMENT is set."""
    return _has(scene, "SEGMENT")
