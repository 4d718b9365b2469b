"""Drawing of scenes: colours, numbers of geoms, depths.

In: a scene, a context, a size. Out: arrays with the top row first.
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import numpy as np

from ...errors import warn
from ._scenes import camera_of
from .context import MjrContext

_FLAGS = ("WIREFRAME", "CULL_FACE", "REFLECTION", "SHADOW", "ADDITIVE", "FOG", "HAZE", "SKYBOX")


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


def prepare(scene: Any, context: MjrContext, *, lit: bool = True) -> Prepared:
    """Read a scene's memory."""
    view, model = context.view(scene), context.model
    geoms = view.geoms(model)
    view.set_moving_shapes(model)
    lights, ambient = view.lights(model, none=not lit)
    return Prepared(geoms, lights, ambient, [_has(scene, name) for name in _FLAGS])


def draw_colors(scene: Any, context: MjrContext, width: int, height: int) -> np.ndarray:
    """Return the scene's colours, (height, width, 3) uint8."""
    if is_segmented(scene):
        numbers = draw_segments(scene, context, width, height, numbers=True, depths=False)[0]
        assert numbers is not None
        return segment_colors(scene, context, numbers)
    if scene.stereo:
        half = width // 2
        eyes = [_draw_eye(scene, context, half, height, eye) for eye in (0, 1)]
        out = np.concatenate(eyes + [np.zeros((height, width - 2 * half, 3), np.uint8)], axis=1)
    else:
        out = _draw_eye(scene, context, width, height, -1)
    if scene.framewidth:
        _draw_frame(out, int(scene.framewidth), scene.framergb)
    return out


def _draw_eye(scene: Any, context: MjrContext, width: int, height: int, eye: int) -> np.ndarray:
    prepared, model = prepare(scene, context), context.model
    camera, straight = camera_of(scene, width / height, eye)
    out = np.empty((height, width, 3), np.uint8)
    context.picture.render(
        model.native,
        prepared.geoms,
        prepared.lights,
        camera,
        straight,
        model.samples,
        prepared.ambient,
        prepared.flags,
        out,
    )
    context.view(scene).warn_of_labels()
    if _has(scene, "DEPTH"):
        warn("the flag mjRND_DEPTH of scenes is not drawn: use enable_depth_rendering()")
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
    prepared: Prepared | None = None,
    camera: tuple | None = None,
) -> tuple[np.ndarray | None, np.ndarray | None]:
    """Return which geom shows in each pixel and its depth, (H, W) int32 and float32.

    The number of no geom is -1. Depths are 1 at the near plane, 0 at the far
    plane. Only geoms with a segid are drawn.
    """
    prepared = prepared or prepare(scene, context, lit=False)
    camera = camera or camera_of(scene, width / height)
    geom = np.empty((height, width), np.int32) if numbers else None
    depth = np.empty((height, width), np.float32) if depths else None
    context.picture.render(
        context.model.native,
        prepared.geoms,
        prepared.lights[:0],
        *camera,
        1,
        0.0,
        prepared.flags,
        None,
        geom,
        depth,
    )
    return geom, depth


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
