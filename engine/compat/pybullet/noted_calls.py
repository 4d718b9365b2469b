"""Puts `getCameraImage` in the place of PyBullet's, and notes what PyBullet does not tell.

In: calls of pybullet's functions. Out: the same results; the `World` of the client knows of
textures, of single shapes that were painted, of meshes made of vertices, and of resets.
"""

from __future__ import annotations

import functools
import inspect
import types
from collections.abc import Callable
from itertools import zip_longest
from typing import Any

import numpy as np

from ...base import linalg
from ...base.optional_packages import require
from ...errors import Engine3DError, warn
from ...model.geometry.mesh import Mesh
from ._arguments import CLIENT, arguments
from ._files import found_file, plain_mesh, read_texture, search_folder, search_in
from ._forms import MESH
from ._world import Origin, World
from ._worlds import client_of, forget
from .camera_image import getCameraImage

_NO_TEXTURE = -2
# The arguments of changeVisualShape if they are not given.
_USUAL = {"objectUniqueId": -1, "linkIndex": -1, "shapeIndex": -1, "textureUniqueId": _NO_TEXTURE}
_WHICH = tuple(_USUAL)
_USUAL |= {"rgbaColor": None}
# What a file without a name shows.
_NOTHING = plain_mesh(np.zeros((0, 3)), np.zeros((0, 3), int), np.zeros((0, 3)), None)


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


def _world(given: dict[str, Any]) -> World:
    return client_of(given[CLIENT]).world


def _search_path(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    given = arguments("setAdditionalSearchPath", args, keywords)
    result = call()
    search_in(given["path"])
    return result


def _load_texture(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    given = arguments("loadTexture", args, keywords)
    number, world = call(), _world(given)
    if number >= 0:
        try:
            path = found_file(given["textureFilename"], search_folder())
            world.textures[number] = read_texture(path)
        except Engine3DError as error:
            warn(f"a texture of PyBullet is not drawn: {error}")
    return number


def _change_shape(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    given = {**_USUAL, **arguments("changeVisualShape", args, keywords)}
    uid, link, place, number = (given[name] for name in _WHICH)
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
    given = arguments("createVisualShape", args, keywords)
    number, visuals = call(), _world(given).visuals
    visuals.pop(number, None)  # of another shape that had its number
    if number >= 0 and _has_vertices(given) and given.get("indices") is not None:
        # A file without a name is a shape of its own, and empty.
        visuals[number] = [_NOTHING] * (given.get("fileName") == "") + [_mesh_of(given)]
    return number


def _mesh_of(given: dict[str, Any]) -> Mesh:
    """Return the mesh of the vertices of a visual shape."""
    positions = np.asarray(given["vertices"], np.float64).reshape(-1, 3)
    normals, uvs = given.get("normals"), given.get("uvs")
    if normals is None or len(normals) != len(positions):
        normals = linalg.normalize(positions)  # as TinyRenderer has it
    if uvs is not None and len(uvs) != len(positions):
        uvs = None
    return plain_mesh(positions, np.reshape(given["indices"], (-1, 3)), normals, uvs)


def _create_collision(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    given = arguments("createCollisionShape", args, keywords)
    number, hulls = call(), _world(given).hulls
    hulls.discard(number)
    if number >= 0 and _has_vertices(given):
        hulls.add(number)
    return number


def _has_vertices(given: dict[str, Any]) -> bool:
    return given.get("shapeType") == MESH and given.get("vertices") is not None


def _create_body(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    given = arguments("createMultiBody", args, keywords)
    result = call()
    world = _world(given)
    pairs = zip_longest(_shapes(given, "Visual"), _shapes(given, "Collision"), fillvalue=-1)
    meshes = {}
    for link, (visual, collision) in enumerate(pairs, start=-1):
        if visual >= 0:
            meshes[link] = world.visuals.get(visual, [])
        elif collision in world.hulls:  # TinyRenderer shows nothing of it, either
            meshes[link] = [_NOTHING]
    bodies = result if isinstance(result, (tuple, list)) else [result]
    world.origins.update(dict.fromkeys(bodies, Origin(search_folder(), meshes)))
    return result


def _shapes(given: dict[str, Any], kind: str) -> list[int]:
    """Return the shapes of a kind that a body has, of its base and its links."""
    links = given.get(f"link{kind}ShapeIndices")
    return [given.get(f"base{kind}ShapeIndex", -1), *(() if links is None else links)]


def _reset(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    _world(arguments("resetSimulation", args, keywords)).clear()
    return call()


def _remove(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    given = arguments("removeBody", args, keywords)
    result = call()
    _world(given).forget(given["bodyUniqueId"])  # another body may get its number
    return result


def _disconnect(call: Callable[[], Any], *args: Any, **keywords: Any) -> Any:
    forget(arguments("disconnect", args, keywords)[CLIENT])
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
    "createCollisionShape": _create_collision,
    "createMultiBody": _create_body,
    "removeBody": _remove,
    "resetSimulation": _reset,
    "disconnect": _disconnect,
    "loadMJCF": _load_mjcf,
}
