"""`getCameraImage`, with the arguments and the result of PyBullet's."""

from __future__ import annotations

import operator
from typing import Any

import numpy as np

from ...base.numbers import shown
from ...errors import InvalidArgumentError, warn
from ._worlds import client_of, matrix_of

_MOST_SIDE = 16384
_WITH_LINKS, _WITHOUT_MASKS, _PROJECTIVE = 1, 4, 2


def getCameraImage(  # the name is PyBullet's
    width: int,
    height: int,
    viewMatrix: Any = None,
    projectionMatrix: Any = None,
    lightDirection: Any = None,
    lightColor: Any = None,
    lightDistance: float = -1,
    shadow: int = -1,
    lightAmbientCoeff: float = -1,
    lightDiffuseCoeff: float = -1,
    lightSpecularCoeff: float = -1,
    renderer: int = -1,
    flags: int = -1,
    projectiveTextureView: Any = None,
    projectiveTextureProj: Any = None,
    physicsClientId: int = 0,
) -> tuple[int, int, np.ndarray, np.ndarray, np.ndarray]:
    """Draw what a camera sees, as PyBullet's TinyRenderer does.

    Parameters
    ----------
    width, height : int
    viewMatrix, projectionMatrix : sequence of 16 float
        As PyBullet's ``compute…Matrix`` give them; without them, PyBullet's usual camera.
    lightDirection, lightColor : sequence of 3 float
        As all values of the light, they hold for later calls of the client, too.
    lightDistance, lightAmbientCoeff, lightDiffuseCoeff, lightSpecularCoeff : float
    shadow : {0, 1}
    renderer : int
        Whichever it is, the picture is TinyRenderer's.
    flags : int
        ``ER_SEGMENTATION_MASK_OBJECT_AND_LINKINDEX``, ``ER_NO_SEGMENTATION_MASK``.
    projectiveTextureView, projectiveTextureProj
        Left out, as in TinyRenderer.
    physicsClientId : int

    Returns
    -------
    width, height : int
    rgbaPixels : (H, W, 4) uint8
    depthPixels : (H, W) float32
        0 at the near plane, 1 at the far one.
    segmentationMask : (H, W) int32
        The body's number, or that of body and link; -1 where nothing is.

    Raises
    ------
    InvalidArgumentError
        A size, a matrix or a vector is wrong.
    pybullet.error
        The client is not connected.
    """
    import pybullet

    size = _side(width, "width"), _side(height, "height")
    number = operator.index(physicsClientId)
    pybullet.getNumBodies(physicsClientId=number)  # raises if there is no such client
    client = client_of(number)
    with client.lock:
        client.light = client.light.changed(
            direction=_vector(lightDirection, "lightDirection"),
            color=_vector(lightColor, "lightColor"),
            distance=_given(lightDistance),
            shadow=None if shadow < 0 else bool(shadow),
            ambient=_given(lightAmbientCoeff),
            diffuse=_given(lightDiffuseCoeff),
            specular=_given(lightSpecularCoeff),
        )
        if viewMatrix is None or projectionMatrix is None:
            projection, view = client.usual_camera(pybullet)
        else:
            projection = _matrix(projectionMatrix, "projectionMatrix")
            view = _matrix(viewMatrix, "viewMatrix")
            client.note_lens(projection)
        chosen = max(operator.index(flags), 0)
        if chosen & _PROJECTIVE:
            warn("ER_USE_PROJECTIVE_TEXTURE is for OpenGL alone: left out, as TinyRenderer does")
        client.world.update()
        picture = client.painter.draw(
            client.world, size, projection, view, client.light, bool(chosen & _WITH_LINKS)
        )
    masks = np.zeros_like(picture.masks) if chosen & _WITHOUT_MASKS else picture.masks
    return *size, picture.colors, picture.depths, masks


def _side(value: int, what: str) -> int:
    try:
        side = operator.index(value)
    except TypeError:
        raise TypeError(f"{what} must be an integer, not {shown(value)}") from None
    if not 1 <= side <= _MOST_SIDE:
        raise InvalidArgumentError(f"{what} must be from 1 to {_MOST_SIDE}, not {side}")
    return side


def _given(value: float) -> float | None:
    return float(value) if value >= 0 else None


def _matrix(value: Any, what: str) -> np.ndarray:
    try:
        matrix = matrix_of(value)
    except (TypeError, ValueError):
        raise InvalidArgumentError(f"{what} must be 16 numbers, not {shown(value)}") from None
    if not np.isfinite(matrix).all():
        raise InvalidArgumentError(f"{what} must be finite, not {shown(value)}")
    return matrix


def _vector(value: Any, what: str) -> tuple[float, ...] | None:
    if value is None:
        return None
    try:
        vector = np.asarray(value, np.float32).reshape(3)
    except (TypeError, ValueError):
        raise InvalidArgumentError(f"{what} must be 3 numbers, not {shown(value)}") from None
    if not np.isfinite(vector).all():
        raise InvalidArgumentError(f"{what} must be finite, not {shown(value)}")
    return tuple(vector.tolist())
