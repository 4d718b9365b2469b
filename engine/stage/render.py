"""Renders one picture of anything drawable, in one call.

In: a path, a scene, a part of one, a mesh, points, or another library's object. Out: a `Frame`,
from its own `Renderer`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base.calls import keywords_of, refuse_unknown
from ..choices import Antialiasing, Backend, ColorSpace, Samples
from ..errors import warn
from ..io.scenes.other_libraries import has_points, is_of_library
from ..model.materials.material import Material
from ..model.scene.scene import Scene
from ..rendering.camera_choice import find_camera
from ..rendering.frame import Frame
from ..rendering.framing import frame_scene
from ..rendering.options import RenderKeywords
from .blank import SHOWING, Reason, Sight, may_be_blank, why_blank
from .look import LookChoice
from .renderer import DrawingKeywords, Renderer

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ..rendering.camera_choice import CameraChoice


class PictureKeywords(RenderKeywords, DrawingKeywords, total=False):
    """The keyword arguments of `render` besides those of its renderer."""


def render(
    scene: Any,
    camera: CameraChoice = None,
    *,
    size: tuple[int, int] = (1280, 720),
    look: LookChoice = "studio",
    material: Material | None = None,
    backend: Backend = "auto",
    threads: int = 0,
    color_space: ColorSpace = "srgb",
    samples: Samples = 4,
    antialiasing: Antialiasing = "msaa",
    **options: Unpack[PictureKeywords],
) -> Frame:
    """Draw one frame of a file, a scene, a node, a mesh or points.

    Parameters
    ----------
    scene : path-like, Scene, Node, Mesh, InstancedMesh, array, or another library's object
        An array of shape (N, 3) holds points, (N, 6) points with colours, (N, 2, 3) segments,
        (N, 3, 3) triangles, (H, W) heights, (X, Y, Z) of bool voxels; a pair of arrays holds
        vertices and faces. Other libraries are trimesh, PyVista, meshio, Open3D,
        CadQuery, build123d and vedo.
        A file gives the picture of ``engine3d render``, with the same bytes. A node is drawn with
        its subtree at its world pose, lit by the lights of that subtree.
    camera : None, Node or (Camera, pose)
        By default a scene's first camera, else one that shows everything.
    size : (int, int)
        Width and height in pixels.
    look, material, backend, threads, color_space, samples, antialiasing
        As for `Renderer`. Scenes with light of their own wear no look.
    **options
        As for `Renderer.render`: ``mode``, ``wireframe``, ``outputs``, ``color_by`` and so on.

    Returns
    -------
    frame : Frame

    Raises
    ------
    InvalidArgumentError, BackendError, OutOfMemoryError, FileFormatError, FileAccessError

    Warns
    -----
    Engine3DWarning
        Nothing shows: it says why.

    Examples
    --------
    >>> e3d.render("model.glb").save("model.png")
    >>> e3d.render(e3d.torus(), look="plain", material=e3d.Material(color=(200, 40, 40)))
    """
    refuse_unknown("render", options, (*PictureKeywords.__annotations__, *keywords_of(render)))
    given: Any = options
    renderer = _OnePicture(
        size,
        look=look,
        material=material,
        backend=backend,
        threads=threads,
        color_space=color_space,
        samples=samples,
        antialiasing=antialiasing,
    )
    with renderer:
        frame = renderer.render(scene, camera, **given)
        if (reason := renderer.why_blank(frame, scene, camera, options)) is not None:
            warn(f"nothing shows: {reason.sentence}")
        return frame


class _OnePicture(Renderer):
    """Draws one picture, and tells why it is blank: nobody would look for the cause in a loop."""

    @np.errstate(all="ignore")
    def why_blank(
        self, frame: Frame, thing: Any, camera: CameraChoice, options: Mapping[str, Any]
    ) -> Reason | None:
        """Return why a frame of a thing shows nothing of it; None if it does."""
        staged = self._stages.last
        if staged is not None:
            view_renderer = staged.view_renderer
            if is_of_library(thing) and not has_points(view_renderer.viewed.scene):
                return None  # its conversion has warned
            return view_renderer.why_blank()
        if not isinstance(thing, Scene) or not may_be_blank(frame.stats, thing):
            return None
        aspect = self.width / self.height
        seen_by, pose = find_camera(thing, camera) or frame_scene(thing, aspect=aspect)
        drawing = {name: self._drawing[name] for name in ("backend", "threads")}
        look = {name: options[name] for name in SHOWING if name in options}
        return why_blank(Sight(thing, seen_by, pose, self.size, look, drawing))
