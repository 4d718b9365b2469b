"""The first view of a model: its own, the user's, or that of a camera in its file."""

from __future__ import annotations

import functools
from dataclasses import dataclass

from ...model.scene.cameras import Camera, IntrinsicsCamera
from ...model.scene.lenses.lens_camera import LensCamera
from ...model.scene.nodes import Node
from ..near_origin import from_file
from ..view_renderer import ViewRenderer
from ..viewed_scene import NotInModelError
from .viewpoint import Viewpoint, look_through

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class FirstView:
    """The settings of a model's first view; missing ones are chosen so that the whole model shows.

    Attributes
    ----------
    yfov : float or None
        Vertical field of view in radians; None gives the longer side 38 degrees.
    azimuth, elevation : float
        Added to the model's own view, in radians.
    zoom : float
        Divides the distance from the focal point.
    orthographic : bool
    position, focal_point : (3,) float or None
        In the file's coordinates.
    direction, up : (3,) float or None
        View direction, and up direction in the picture; a position overrides the view direction.
    camera : int or None
        The model's camera to look through; overrides all other settings.
    lens : LensCamera, IntrinsicsCamera or None
        What to look through instead of a pinhole.
    """

    yfov: float | None = None
    azimuth: float = 0.0
    elevation: float = 0.0
    zoom: float = 1.0
    orthographic: bool = False
    position: Vector | None = None
    focal_point: Vector | None = None
    direction: Vector | None = None
    up: Vector | None = None
    camera: int | None = None
    lens: LensCamera | IntrinsicsCamera | None = None

    def place(self, view_renderer: ViewRenderer, *, turns: bool = True) -> Viewpoint:
        """Return the view of a renderer's scene.

        Parameters
        ----------
        view_renderer : ViewRenderer
        turns : bool
            Whether the model must fit however it turns; otherwise its current pose fills the
            picture.

        Raises
        ------
        NotInModelError
            There is no such camera.
        """
        view = view_renderer.view(self.yfov)
        view.orthographic, view.lens = self.orthographic, self.lens
        if self.camera is not None:
            look_through(view, _camera_node(view_renderer, self.camera), view_renderer.bounds)
            return view
        if self.up is not None:
            view.up = self.up
        place = functools.partial(from_file, view_renderer.viewed)
        target = None if self.focal_point is None else place(self.focal_point)
        if self.position is not None:
            view.look_from(place(self.position), target or view_renderer.bounds.center)
        elif self.direction is not None:
            view.look_from(view.target - self.direction, view.target)
        view.azimuth += self.azimuth
        view.elevation += self.elevation
        if self.position is None:
            (view_renderer.frame if turns else view_renderer.fill)(view)
            if target is not None:
                view.target[:] = target
        view.distance /= self.zoom
        return view


def _camera_node(view_renderer: ViewRenderer, index: int) -> Node:
    viewed = view_renderer.viewed
    nodes = [node for node in viewed.scene.nodes if isinstance(node.object, Camera)]
    if index >= len(nodes):
        known = f"the last is {len(nodes) - 1}" if nodes else "there are none"
        raise NotInModelError(f"{viewed.title} has no camera {index} ({known})")
    return nodes[index]


def view_of_scene(view_renderer: ViewRenderer) -> Viewpoint | None:
    """Return the view of the scene's first visible camera; None if none has an eye.

    The theme is then the one of pictures by `engine3d.render`, whatever the camera sees.
    """
    view_renderer.choose_theme(view_renderer.filling_view())
    node = view_renderer.viewed.scene.data.camera_node()
    if node is None:
        return None
    view = view_renderer.view()
    look_through(view, node, view_renderer.bounds)
    return view
