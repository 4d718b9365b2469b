"""Thumbnails for notebooks, of what can be drawn quickly.

In: a scene, a mesh, or what one of them is made of. Out: a PNG, or None if it shows nothing or has
too many faces to draw while somebody waits for a cell's text.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from .._native.images import encode_png
from ..errors import Engine3DError
from ..model.environments.environment import Environment
from ..model.geometry.mesh import Mesh
from ..model.materials.colors import srgb_bytes
from ..model.materials.material import Material
from ..model.materials.textures import Texture
from ..model.primitives import uv_sphere
from ..model.scene.cameras import OrthographicCamera
from ..model.scene.instances import InstancedMesh
from ..model.scene.lights import WHITE_INTENSITY, DirectionalLight
from ..model.scene.scene import Scene
from ..model.scene.shown import shown_object
from ..rendering.renderer import Renderer
from .render import render

SIZE = (400, 300)
SIDE = 256  # of pictures of materials, and the most of those of textures and environments
#: Faces, lines and points together: half a second on one processor.
MOST_PARTS = 1_000_000
Thing: TypeAlias = Scene | Mesh | Material | Texture | Environment


def thumbnail(thing: Thing) -> bytes | None:
    """Return a picture as the bytes of a PNG, or None."""
    try:
        if isinstance(thing, Texture):
            return encode_png(_small(thing.pixels))
        if isinstance(thing, Environment):
            return _panorama(thing)
        if isinstance(thing, Material):
            return _ball(thing)
        return _view(thing)
    except Engine3DError:  # such as for coordinates that no camera can frame
        return None


def _small(pixels: np.ndarray) -> np.ndarray:
    """Return every nth pixel, so that no side is longer than `SIDE`."""
    step = max(-(-max(pixels.shape[:2]) // SIDE), 1)
    return np.ascontiguousarray(pixels[::step, ::step])


def _panorama(environment: Environment) -> bytes:
    """Return the picture of an environment; what is brighter than white shows white."""
    light = _small(environment.pixels)
    colors = np.ones((*light.shape[:2], 4))
    colors[..., :3] = light
    return encode_png(srgb_bytes(colors.reshape(-1, 4)).reshape(colors.shape))


def _ball(material: Material) -> bytes:
    """Draw a material on a ball in a studio."""
    scene = Scene(background=None, ambient=(0, 0, 0))
    scene.environment, scene.environment_intensity = Environment.studio(), 0.7
    ball = uv_sphere(1.0, (64, 32))
    ball.materials = [material]
    scene.add(ball)
    scene.add(DirectionalLight((-0.5, -0.7, -0.6), intensity=0.5 * WHITE_INTENSITY))
    camera = scene.add(OrthographicCamera(1.1), translation=(0.0, 0.0, 4.0))
    with Renderer((SIDE, SIDE), samples=4, antialiasing="msaa") as renderer:
        return renderer.render(scene, camera, tone_mapping="neutral").encode()


def _view(thing: Scene | Mesh) -> bytes | None:
    """Draw a scene or a mesh as `engine3d.render` does."""
    shown: list[object] = [thing]
    if isinstance(thing, Scene):
        shown = [shown_object(node) for node in thing.nodes if node.shown]
    if not 0 < sum(map(_parts, shown)) <= MOST_PARTS:
        return None
    return render(thing, size=SIZE).encode()


def _parts(shown: object) -> int:
    mesh = shown.mesh if isinstance(shown, InstancedMesh) else shown
    if not isinstance(mesh, Mesh):
        return 0  # a light, a camera, a group
    count = len(shown.poses) if isinstance(shown, InstancedMesh) else 1
    return count * (len(mesh.faces) + len(mesh.lines) + len(mesh.points))
