"""Puts `getCameraImage` in the place of PyBullet's, and notes what PyBullet does not tell.

In: calls of pybullet's functions. Out: the same results; the `World` of the client knows of
textures, of single shapes that were painted, of meshes made of vertices, and of resets.
"""

from __future__ import annotations

import functools
import inspect
import types
from collections.abc import Callable
from typing import Any

import numpy as np

from ...base import linalg
from ...base.optional_packages import require
from ...errors import Engine3DError, warn
from ._files import found_file, plain_mesh, read_texture
from ._world import World
from ._worlds import client_of, forget
from .camera_image import getCameraImage

_CLIENT = "physicsClientId"
_NO_TEXTURE = -2
# The arguments of changeVisualShape, and what they are if they are not given.
_OF_CHANGE = ("objectUniqueId", "linkIndex", "shapeIndex", "textureUniqueId", "rgbaColor")
_OF_CHANGE += ("specularColor", "flags")
_USUAL = {"objectUniqueId": -1, "linkIndex": -1, "shapeIndex": -1, "textureUniqueId": _NO_TEXTURE}
_USUAL |= {"rgbaColor": None}


class _Replaced:
    """A function that counts as one of C, so that clients of `bullet_client` add their number.

    They look at ``__class__``.
    """

    def __init__(self, original: Callable[..., Any], call: Callable[..., Any]) -> None:
        functools.update_wrapper(self, original, updated=())
        self._call = call

    def __call__(self, *args: Any, **keywords: Any) -> Any:
        return self._call(*args, **keywords)

    @property
    def __class__(self) -> type:  # type: ignore[override]
        return types.BuiltinFunctionType


def install() -> None:
    """Make ``pybullet.getCameraImage`` this renderer's, for clients of ``bullet_client``, too.

    Call it before textures are loaded and shapes are made: PyBullet does not tell of them later.
    Another call changes nothing.
    """
    require("pybullet", "engine3d.compat.pybullet", "pybullet")
    import pybullet

    if isinstance(inspect.getattr_static(pybullet, "getCameraImage"), _Replaced):
        return
    for name, note in _NOTES.items():
        original = getattr(pybullet, name)
        setattr(pybullet, name, _Replaced(original, functools.partial(_noted, original, note)))
    original = pybullet.getCameraImage
    pybullet.getCameraImage = _Replaced(original, getCameraImage)


def _noted(
    original: Callable[..., Any], note: Callable[..., Any], *args: Any, **keywords: Any
) -> Any:
    """Call a function of pybullet, and note what it did."""
    return note(lambda: original(*args, **keywords), *args, **keywords)


def _given(args: tuple[Any, ...], keywords: dict[str, Any], *names: str) -> dict[str, Any]:
    """Return arguments by name; those that are named last are the client's number."""
    return {_CLIENT: 0, **dict(zip((*names, _CLIENT), args, strict=False)), **keywords}


def _world(given: dict[str, Any]) -> World:
    return client_of(given.get(_CLIENT, 0)).world


def _search_path(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    given = _given(args, keywords, "path")
    result = call()
    _world(given).folders.append(given["path"])
    return result


def _load_texture(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    given = _given(args, keywords, "textureFilename")
    number, world = call(), _world(given)
    if number >= 0:
        try:
            path = found_file(given["textureFilename"], tuple(world.folders[::-1]))
            world.textures[number] = read_texture(path)
        except Engine3DError as error:
            warn(f"a texture of PyBullet is not drawn: {error}")
    return number


def _change_shape(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    given = {**_USUAL, **_given(args, keywords, *_OF_CHANGE)}
    uid, link, place, number = (given[name] for name in _OF_CHANGE[:4])
    world = _world(given)
    try:
        world.body(uid)  # as it is before
    except (_errors(), TypeError):
        return call()  # which says what is wrong
    result = call()
    if given["rgbaColor"] is not None:
        world.paint(uid, link, place, tuple(map(float, given["rgbaColor"])))
    if number > _NO_TEXTURE:
        texture = world.textures.get(number)
        if texture is None and number >= 0:
            warn(f"texture {number} was loaded before install(), and is not drawn")
        world.dress(uid, link, place, texture)
    return result


def _create_visual(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    number = call()
    vertices, indices = keywords.get("vertices"), keywords.get("indices")
    if number >= 0 and vertices is not None and indices is not None:
        positions = np.asarray(vertices, np.float64).reshape(-1, 3)
        normals, uvs = keywords.get("normals"), keywords.get("uvs")
        if normals is None or len(normals) != len(positions):
            normals = linalg.normalize(positions)  # as TinyRenderer has it
        if uvs is not None and len(uvs) != len(positions):
            uvs = None
        mesh = plain_mesh(positions, np.reshape(indices, (-1, 3)), normals, uvs)
        _world(keywords).visuals[number] = mesh
    return number


def _create_body(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    names = ("baseMass", "baseCollisionShapeIndex", "baseVisualShapeIndex")
    given = {**dict(zip(names, args, strict=False)), **keywords}
    visuals = [given.get("baseVisualShapeIndex", -1), *given.get("linkVisualShapeIndices", ())]
    result = call()
    world = _world(keywords)
    made = {
        link: [world.visuals[visual]]
        for link, visual in enumerate(visuals, start=-1)
        if visual in world.visuals
    }
    if made:
        bodies = result if isinstance(result, (tuple, list)) else [result]
        world.given.update(dict.fromkeys(bodies, made))
    return result


def _reset(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    _world(_given(args, keywords, "flags")).clear()
    return call()


def _remove(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    given = _given(args, keywords, "bodyUniqueId")
    result = call()
    _world(given).forget(given["bodyUniqueId"])  # another body may get its number
    return result


def _disconnect(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    forget(_given(args, keywords)[_CLIENT])
    return call()


def _load_mjcf(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    warn("PyBullet does not tell how capsules of MJCF files lie: they are drawn along z")
    return call()


def _errors() -> type[Exception]:
    import pybullet

    return pybullet.error


_NOTES: dict[str, Callable[..., Any]] = {
    "setAdditionalSearchPath": _search_path,
    "loadTexture": _load_texture,
    "changeVisualShape": _change_shape,
    "resetVisualShapeData": _change_shape,
    "createVisualShape": _create_visual,
    "createMultiBody": _create_body,
    "removeBody": _remove,
    "resetSimulation": _reset,
    "disconnect": _disconnect,
    "loadMJCF": _load_mjcf,
}
