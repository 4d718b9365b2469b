"""Thumbnails of meshes, materials and textures, drawn by the engine and cached.

In: an object. Out: its picture, redrawn when the object changes. The least recently used pictures
are dropped first.
"""

from __future__ import annotations

import time
from collections import OrderedDict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..._native.loaders import frozen
from ...model.geometry.mesh import Mesh
from ...model.materials.linear_colors import linear
from ...model.materials.material import Material, textures_of
from ...model.materials.textures import Texture
from ...model.primitives import uv_sphere
from ...model.scene.lights import WHITE_INTENSITY, DirectionalLight
from ...model.scene.scene import Scene
from ...rendering.canvas import lay_over
from ...rendering.renderer import Renderer

MOST = 512
BACKGROUND = (43, 46, 53)
_CHECKERS = np.array([(90, 90, 90), (140, 140, 140)], np.uint8)
_CHECKER = 8  # pixels


class Thumbnails:
    """Draws and caches thumbnails.

    Parameters
    ----------
    size : int
        Width and height in pixels.
    """

    def __init__(self, size: int = 96) -> None:
        self._size = size
        self._renderer = Renderer((size, size), samples=4, antialiasing="msaa")
        self._pictures: OrderedDict[int, tuple[Any, tuple, NDArray[np.uint8]]] = OrderedDict()
        self._ball: Mesh | None = None

    def get(self, thing: Mesh | Material | Texture) -> NDArray[np.uint8]:
        """Return the thumbnail of an object, (size, size, 4) uint8, read-only."""
        versions = _versions(thing)
        held = self._pictures.get(id(thing))
        if held is None or held[0] is not thing or held[1] != versions:
            picture = frozen(self._drawn(thing))
            held = self._pictures[id(thing)] = thing, versions, picture
        self._pictures.move_to_end(id(thing))
        while len(self._pictures) > MOST:
            self._pictures.popitem(last=False)
        return held[2]

    def get_if_time(
        self, thing: Mesh | Material | Texture, deadline: float
    ) -> NDArray[np.uint8] | None:
        """Return a thumbnail if it is cached, or can be started before a deadline; else None.

        Parameters
        ----------
        thing : Mesh, Material or Texture
        deadline : float
            Of ``time.perf_counter()``: a panel that shows many draws some of them a frame.
        """
        held = self._pictures.get(id(thing))
        if held is not None and held[0] is thing and held[1] == _versions(thing):
            return self.get(thing)
        return self.get(thing) if time.perf_counter() < deadline else None

    def clear(self) -> None:
        """Drop all thumbnails."""
        self._pictures.clear()

    def _drawn(self, thing: Mesh | Material | Texture) -> NDArray[np.uint8]:
        if isinstance(thing, Texture):
            return shrunk(thing, self._size)
        mesh = thing if isinstance(thing, Mesh) else self._dressed_ball(thing)
        scene = Scene(background=BACKGROUND, ambient=linear(0.25, 0.25, 0.25))
        scene.add(mesh)
        scene.add(DirectionalLight((-0.4, -0.7, -0.6), intensity=0.8 * WHITE_INTENSITY))
        return self._renderer.render(scene, cull="auto").color.copy()

    def _dressed_ball(self, material: Material) -> Mesh:
        if self._ball is None:
            self._ball = uv_sphere(0.5, (48, 24))
        self._ball.materials = [material]
        return self._ball


def _versions(thing: Mesh | Material | Texture) -> tuple:
    """Return versions that differ if the thumbnail changes."""
    if isinstance(thing, Mesh):
        return (thing.version, *(part for m in thing.materials for part in _versions(m)))
    if isinstance(thing, Material):
        return (thing.version, *(texture.version for texture in textures_of(thing).values()))
    return (thing.version,)


def shrunk(texture: Texture, size: int) -> NDArray[np.uint8]:
    """Return a scaled texture, with a chequerboard behind transparent parts."""
    height, width = texture.pixels.shape[:2]
    longest = max(height, width)
    rows, columns = (max(1, side * size // longest) for side in (height, width))
    places = [
        (2 * np.arange(count) + 1) * side // (2 * count)
        for count, side in ((rows, height), (columns, width))
    ]
    pixels = texture.pixels[places[0][:, np.newaxis], places[1]]
    line = np.arange(size) // _CHECKER
    picture = np.full((size, size, 4), 255, np.uint8)
    picture[:, :, :3] = _CHECKERS[(line[:, np.newaxis] + line) % 2]
    top, left = (size - rows) // 2, (size - columns) // 2
    lay_over(picture[top : top + rows, left : left + columns], pixels)
    return picture
