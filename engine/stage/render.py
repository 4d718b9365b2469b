"""Renders one picture of anything drawable, in one call.

In: a scene, a part of one, a mesh, or a trimesh object. Out: a `Frame`, from its own `Renderer`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..base.calls import refuse_unknown
from ..base.image_size import check_size
from ..choices import Antialias, Backend, ColorSpace, Samples
from ..errors import InvalidArgumentError
from ..model.geometry.mesh import Mesh
from ..model.scene.instances import InstancedMesh
from ..model.scene.nodes import Node
from ..model.scene.scene import Scene
from ..rendering.frame import Frame
from ..rendering.options import RenderKeywords
from ..rendering.renderer import Renderer
from .scenes_of_things import scene_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ..rendering._view import CameraChoice

#: The keywords of `render` for its renderer.
_RENDERER_KEYWORDS = ("size", "backend", "threads", "color_space", "samples", "antialiasing")


def render(
    scene: Scene | Node | Mesh | InstancedMesh | Any,
    camera: CameraChoice = None,
    *,
    size: tuple[int, int] = (1280, 720),
    backend: Backend = "auto",
    threads: int = 0,
    color_space: ColorSpace = "srgb",
    samples: Samples = 1,
    antialiasing: Antialias = "ssaa",
    **options: Unpack[RenderKeywords],
) -> Frame:
    """Draw one frame of a scene, a node or a mesh.

    Parameters
    ----------
    scene : Scene, Node, Mesh, InstancedMesh, or a scene or geometry of trimesh
        Anything but a scene is drawn on black. A node is drawn with its subtree at its world pose,
        lit by the lights of that subtree.
    camera : None, Node or (Camera, pose)
    size : (int, int)
        Width and height in pixels.
    backend, threads, color_space, samples, antialiasing
        As for `Renderer`.
    **options
        As for `Renderer.render`: ``mode``, ``wireframe``, ``outputs`` and so on.

    Returns
    -------
    frame : Frame

    Raises
    ------
    InvalidArgumentError, BackendError, OutOfMemoryError
    """
    refuse_unknown("render", options, (*RenderKeywords.__annotations__, *_RENDERER_KEYWORDS))
    width, height = check_size(size)
    drawn = scene_of(scene)
    if drawn is None:
        raise InvalidArgumentError(
            f"a scene, a node or a mesh can be drawn, not {type(scene).__name__}"
        )
    with Renderer(
        width,
        height,
        backend=backend,
        threads=threads,
        color_space=color_space,
        samples=samples,
        antialiasing=antialiasing,
    ) as renderer:
        return renderer.render(drawn, camera, **options)
