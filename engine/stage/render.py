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
from .appearance import DARK
from .marked_scene import MarkedScene
from .numbers import MarkKeywords, take_marks
from .scenes_of_things import scene_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ..rendering._view import CameraChoice

#: The keywords of `render` for its renderer.
_RENDERER_KEYWORDS = ("size", "backend", "threads", "color_space", "samples", "antialiasing")


class PictureKeywords(RenderKeywords, MarkKeywords, total=False):
    """The keyword arguments of `render` besides those of its renderer."""

    edges: bool


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
    **options: Unpack[PictureKeywords],
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
    color_by : str or array, optional
        Show numbers as colours instead of the surfaces' own: a name in ``mesh.values``, ``"x"``,
        ``"y"`` or ``"z"``, the coordinates, or ``"normals"``; or an array, (N,) or (N, K), for the
        vertices, faces or points of the only mesh. Where there is no number (NaN), it is grey. By
        default, with any of the parameters below up to ``bar``, the first name in alphabetical
        order, or else the height.
    colormap : str, colour map of matplotlib, or (N, 3) array, optional
        ``"viridis"``, the default, ``"plasma"``, ``"inferno"``, ``"magma"``, ``"turbo"``,
        ``"coolwarm"`` or ``"gray"``; the path of a picture whose middle row it is; places from 0 to
        1 with their colours, such as ``"0,#000000,0.4,red,1,white"``; or display colours, lowest
        number first.
    clim : (float, float), optional
        The numbers of the first and last colour; by default the lowest and highest finite number.
    component : int, optional
        Which number of rows with several, from 0 on; -1, the default: their length; -2: they are
        colours.
    on : {"vertices", "faces", "points"}, optional
        What the numbers belong to, if their name or their length leaves that open.
    bar : bool
        Show which colour is which number.
    axes_grid : bool
        Show a grid behind the scene, with coordinates.
    edges : bool
        Draw the edges of faces over them: ``wireframe="overlay"``.
    **options
        As for `Renderer.render`: ``mode``, ``wireframe``, ``outputs`` and so on.

    Returns
    -------
    frame : Frame

    Raises
    ------
    InvalidArgumentError, BackendError, OutOfMemoryError
    """
    refuse_unknown("render", options, (*PictureKeywords.__annotations__, *_RENDERER_KEYWORDS))
    width, height = check_size(size)
    drawn = scene_of(scene)
    if drawn is None:
        raise InvalidArgumentError(
            f"a scene, a node or a mesh can be drawn, not {type(scene).__name__}"
        )
    given: dict[str, Any] = dict(options)
    marks = take_marks(given)
    if given.pop("edges", False):
        given = {"wireframe": "overlay", "line_color": DARK, **given}
    marked = MarkedScene(drawn, marks) if marks.shows_any else None
    with Renderer(
        width,
        height,
        backend=backend,
        threads=threads,
        color_space=color_space,
        samples=samples,
        antialiasing=antialiasing,
    ) as renderer:
        if marked is not None:
            return marked.render(renderer, camera, **given)
        return renderer.render(drawn, camera, **given)
