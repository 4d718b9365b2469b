"""MuJoCo's functions that draw to a context and read from it: mjr_…"""

from __future__ import annotations

import numbers
from typing import Any

import numpy as np

from ...base.numbers import shown
from ...base.validation import is_one_of, whole_number
from ...errors import InvalidArgumentError, warn
from ._frames import draw_colors, later_depths
from ._model import Model
from .context import (
    MjrContext,
    check_context,
    check_model,
    check_numbers,
    check_scene,
    warn_of_windows,
)

_ZERO_FAR = 1  # of mjtDepthMap
_ORDERS = {6407: slice(None), 32992: slice(None, None, -1)}  # GL_RGB, GL_BGR


def _clipped(viewport: Any, con: MjrContext) -> tuple[int, int, int, int]:
    import mujoco

    check_context(con)
    if not isinstance(viewport, mujoco.MjrRect):
        raise InvalidArgumentError(f"viewport must be a mujoco.MjrRect, not {shown(viewport)}")
    left, bottom = int(viewport.left), int(viewport.bottom)
    width, height = int(viewport.width), int(viewport.height)
    if left < 0 or bottom < 0 or left + width > con.offWidth or bottom + height > con.offHeight:
        raise InvalidArgumentError(
            f"the viewport {left}, {bottom}, {width} x {height} is not within the offscreen buffer "
            f"of {con.offWidth} x {con.offHeight}: enlarge <visual><global offwidth= offheight=>"
        )
    return left, bottom, width, height


def mjr_render(viewport: Any, scn: Any, con: MjrContext) -> None:
    """Draw a scene to a rectangle of the context's buffer.

    Parameters
    ----------
    viewport : mujoco.MjrRect
    scn : mujoco.MjvScene
    con : MjrContext
    """
    rectangle = left, bottom, width, height = _clipped(viewport, con)
    check_scene(scn)
    if width <= 0 or height <= 0:
        return
    with con.lock:
        con.depths.begin(rectangle)
        colors = draw_colors(scn, con, width, height)
        con.depths.add(rectangle, later_depths(scn, con, width, height), con)
        con.colors[bottom : bottom + height, left : left + width] = colors[::-1]


def mjr_readPixels(rgb: Any, depth: Any, viewport: Any, con: MjrContext) -> None:
    """Read a rectangle of the context's buffer, the lowest row first.

    Parameters
    ----------
    rgb : array of uint8, of width * height * 3 elements, or None
    depth : array of float32, of width * height elements, or None
        Of the pixels' centres; 0 at the near plane and 1 at the far plane, or with the context's
        readDepthMap mjDEPTH_ZEROFAR the other way round.
    viewport : mujoco.MjrRect
    con : MjrContext
    """
    rectangle = left, bottom, width, height = _clipped(viewport, con)
    with con.lock:
        if rgb is not None:
            order = _order_of(con.readPixelFormat)
            _fill(rgb, con.colors[bottom : bottom + height, left : left + width, order], "rgb")
        if depth is not None:
            values = con.depths.of(rectangle, con)
            _fill(
                depth, values if con.readDepthMap == _ZERO_FAR else np.float32(1) - values, "depth"
            )


def _order_of(pixel_format: Any) -> slice:
    """Return the order of a format's channels."""
    if not is_one_of(pixel_format, _ORDERS):
        raise InvalidArgumentError(
            f"readPixelFormat must be GL_RGB (6407) or GL_BGR (32992), not {shown(pixel_format)}"
        )
    return _ORDERS[pixel_format]


def _fill(out: np.ndarray, values: np.ndarray, name: str) -> None:
    out[...] = values.reshape(_checked_pixels(out, values.size, name).shape)


def _checked_pixels(array: np.ndarray, size: int, name: str) -> np.ndarray:
    check_numbers(array, name)
    if array.size != size:
        raise InvalidArgumentError(f"{name} has {array.size} elements: the viewport has {size}")
    return array


def mjr_setBuffer(framebuffer: Any, con: MjrContext) -> None:
    """Say where to draw. There is an offscreen buffer only."""
    check_context(con)
    framebuffer = getattr(framebuffer, "value", framebuffer)
    if whole_number(framebuffer, "framebuffer", 0, 1) == 0:
        warn_of_windows()


def mjr_restoreBuffer(con: MjrContext) -> None:
    """Do nothing: a context keeps its buffer."""


def mjr_resizeOffscreen(width: int, height: int, con: MjrContext) -> None:
    """Set the size of the buffer; what it showed is lost, unless the size is the same."""
    check_context(con)
    with con.lock:
        con.resize(width, height)


def mjr_maxViewport(con: MjrContext) -> Any:
    """Return the rectangle of the whole buffer."""
    import mujoco

    check_context(con)
    return mujoco.MjrRect(0, 0, con.offWidth, con.offHeight)


def mjr_uploadMesh(m: Any, con: MjrContext, meshid: int) -> None:
    """Read a mesh of the model again."""
    model, number = _model_of(m, con), _checked(meshid, m.nmesh, "mesh")
    with con.lock:
        con.settle_depths()
        model.read_from(m)
        model.upload_mesh(number)


def mjr_uploadHField(m: Any, con: MjrContext, hfieldid: int) -> None:
    """Read a height field of the model again."""
    model, number = _model_of(m, con), _checked(hfieldid, m.nhfield, "height field")
    with con.lock:
        con.settle_depths()
        model.read_from(m)
        model.upload_hfield(number)


def mjr_uploadTexture(m: Any, con: MjrContext, texid: int) -> None:
    """Read a texture of the model again."""
    model, number = _model_of(m, con), _checked(texid, m.ntex, "texture")
    with con.lock:
        model.read_from(m)
        model.upload_texture(number)


def _model_of(model: Any, con: MjrContext) -> Model:
    check_model(model)
    check_context(con)
    return con.model


def _checked(number: int, count: int, what: str) -> int:
    if not (isinstance(number, numbers.Integral) and 0 <= number < count):
        raise InvalidArgumentError(f"there is no {what} {shown(number)}: the model has {count}")
    return int(number)


def mjr_finish() -> None:
    """Do nothing: a picture is finished when its call returns."""


def mjr_getError() -> int:
    """Return 0."""
    return 0


def mjr_rectangle(viewport: Any, r: float, g: float, b: float, a: float) -> None:
    """Warn: it names no context, so that it is not known where to draw."""
    warn("mjr_rectangle is not drawn")


def mjr_drawPixels(rgb: Any, depth: Any, viewport: Any, con: MjrContext) -> None:
    """Write colours to a rectangle of the buffer, the lowest row first; depths are not written."""
    left, bottom, width, height = _clipped(viewport, con)
    if rgb is not None:
        out = con.colors[bottom : bottom + height, left : left + width]
        out[...] = _checked_pixels(rgb, out.size, "rgb").reshape(out.shape)
    if depth is not None:
        warn("mjr_drawPixels writes colours only")


def _undrawn(name: str) -> Any:
    def call(*args: Any, **kwargs: Any) -> None:
        warn(f"{name} is not drawn")

    call.__name__ = call.__qualname__ = name
    call.__doc__ = "Warn: it is not drawn."
    return call


#: What is not drawn, each a warning that names it.
UNDRAWN = (
    *("mjr_overlay", "mjr_text", "mjr_figure", "mjr_label", "mjr_changeFont", "mjr_blitBuffer"),
    *("mjr_addAux", "mjr_setAux", "mjr_blitAux"),
)
globals().update({name: _undrawn(name) for name in UNDRAWN})

DRAWN = (
    *("mjr_render", "mjr_readPixels", "mjr_setBuffer", "mjr_restoreBuffer", "mjr_resizeOffscreen"),
    *("mjr_maxViewport", "mjr_uploadMesh", "mjr_uploadHField", "mjr_uploadTexture", "mjr_finish"),
    *("mjr_getError", "mjr_rectangle", "mjr_drawPixels"),
)

__all__ = [*DRAWN, *UNDRAWN]
