"""A scene with numbers as colours, their bar, and a grid with numbers around it, for `render`.

In: a scene, and the `Marks` to show. Out: pictures of a staged scene, with the marks over them; the
scene itself is unchanged.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..model.scene.cameras import Camera, PerspectiveCamera
from ..model.scene.nodes import Node
from ..model.scene.scene import Scene
from ..model.scene.staged_scene import StagedScene
from ..rendering.frame import Frame
from ..rendering.framing import frame_scene
from ..rendering.renderer import Renderer
from ..rendering.support_functions import support_of_scene
from .coloring import ScalarBar, coloring_of
from .numbers import Marks
from .overlays.box_grid import BoxGrid
from .overlays.overlay import text_scale_for
from .overlays.scalar_bar import draw_scalar_bar, place_bar
from .overlays.theme import DARK, LIGHT, Theme
from .scene_bounds import bounding_sphere
from .viewed_scene import ViewedScene
from .views.free_region import NOTHING, Taken
from .views.viewpoint import UP_DIRECTIONS, Viewpoint

if TYPE_CHECKING:
    from ..rendering._view import CameraChoice

#: A box around a sphere extends no farther than this, in radii.
BOX_REACH = 1.75
#: Factor on the viewing distance that makes room for numbers around the scene.
LABEL_ROOM = 1.12
_BRIGHT = 128  # mean of a border's sRGB values


class MarkedScene:
    """A scene whose pictures show numbers.

    Parameters
    ----------
    scene : Scene
    marks : Marks

    Raises
    ------
    InvalidArgumentError
        No mesh has such numbers.
    """

    def __init__(self, scene: Scene, marks: Marks) -> None:
        self._scene, self._axes_grid = scene, marks.axes_grid
        self._staged = StagedScene(scene)
        self._bar: ScalarBar | None = None
        if marks.numbers is not None:
            coloring = coloring_of(scene, marks.numbers)
            self._staged.hide((), coloring.colored_thing)
            self._bar = coloring.bar if marks.bar else None
        self._box = BoxGrid(ViewedScene(scene, ""), self._staged)

    def render(self, renderer: Renderer, camera: CameraChoice, **options: Any) -> Frame:
        """Draw a frame as `Renderer.render` does, with the marks."""
        size = renderer.width, renderer.height
        if isinstance(camera, Node) and camera.scene is not self._scene:
            return renderer.render(self._scene, camera)  # which says what is wrong
        node = self._scene.data.camera_node() if camera is None else camera
        chosen: Any = (node.object, node.world_pose) if isinstance(node, Node) else node
        chosen = self._framed(*size) if chosen is None else chosen
        if self._axes_grid:
            self._box.follow(_position(chosen), True)
        frame = renderer.render(self._staged, chosen, **options)
        theme, scale = _theme_on(frame.color), text_scale_for(*size)
        self._box.label(frame, scale, theme)
        if self._bar is not None:
            draw_scalar_bar(frame.canvas(), self._bar, scale, theme)
        return frame

    def _framed(self, width: int, height: int) -> tuple[Camera, NDArray[np.float64]]:
        """Return a camera that shows the scene beside the marks."""
        aspect = width / height
        if self._bar is None and not self._axes_grid:
            return frame_scene(self._scene, aspect=aspect)
        taken: Taken = NOTHING
        if self._bar is not None:
            scale = text_scale_for(width, height)
            taken = place_bar(width, height, self._bar, scale).taken(width, height)
        view = Viewpoint(np.zeros(3), 1.0, up=UP_DIRECTIONS["+Y"])
        bounds = bounding_sphere(self._scene)
        support = None if self._axes_grid else support_of_scene(self._scene)
        if support is None:
            view.frame_beside(self._box.corners, aspect, taken)
            view.distance *= LABEL_ROOM
            bounds = bounds._replace(radius=bounds.radius * BOX_REACH)
        else:
            view.fit(support, np.array(bounds.center), aspect, taken)
        camera = view.camera(bounds)
        if isinstance(camera, PerspectiveCamera):
            camera.reversed_depth = True
        return camera, view.pose()


def _position(chosen: Any) -> NDArray[np.float64]:
    """Return the position of a camera with its pose; any for what the renderer refuses."""
    try:
        return np.asarray(chosen[1], np.float64)[:3, 3]
    except (TypeError, ValueError, IndexError):
        return np.zeros(3)


def _theme_on(color: NDArray[np.uint8]) -> Theme:
    """Return the theme of texts over a picture: light if its border is bright."""
    border = np.concatenate([color[0], color[-1], color[:, 0], color[:, -1]])
    values = border[:, :3].astype(np.int64)
    return LIGHT if int(values.sum()) >= _BRIGHT * values.size else DARK
