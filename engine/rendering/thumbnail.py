"""Thumbnails of scenes and meshes for notebooks, if they can be drawn quickly.

In: a scene or a mesh. Out: a PNG, or None if it shows nothing or has too many faces to draw while
somebody waits for a cell's text.
"""

from __future__ import annotations

from ..errors import Engine3DError
from ..model.geometry.mesh import Mesh
from ..model.scene.instances import InstancedMesh
from ..model.scene.scene import Scene
from ..model.scene.shown import shown_object
from .renderer import Renderer

SIZE = (400, 300)
#: Faces, lines and points together: half a second on one processor.
MOST_PARTS = 1_000_000


def thumbnail(thing: Scene | Mesh) -> bytes | None:
    """Return a picture as the bytes of a PNG, or None."""
    scene = Scene(background=None) if isinstance(thing, Mesh) else thing
    if isinstance(thing, Mesh):
        scene.add(thing)
    shown = [shown_object(node) for node in scene.nodes if node.shown]
    if not 0 < sum(map(_parts, shown)) <= MOST_PARTS:
        return None
    try:
        with Renderer(*SIZE, samples=4, antialiasing="msaa") as renderer:
            frame = renderer.render(scene, cull="auto")
    except Engine3DError:  # such as for coordinates that no camera can frame
        return None
    return frame.encode()


def _parts(shown: object) -> int:
    mesh = shown.mesh if isinstance(shown, InstancedMesh) else shown
    if not isinstance(mesh, Mesh):
        return 0  # a light, a camera, a group
    count = len(shown.poses) if isinstance(shown, InstancedMesh) else 1
    return count * (len(mesh.faces) + len(mesh.lines) + len(mesh.points))
