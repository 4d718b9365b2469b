"""Open3D's functions that open a window, show geometries and return when it is closed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from .key_callbacks import VisualizerWithKeyCallback
from .visualizer import Visualizer


def draw_geometries(
    geometry_list: Iterable[Any],
    window_name: str = "Open3D",
    width: int = 1920,
    height: int = 1080,
    left: int = 50,
    top: int = 50,
    point_show_normal: bool = False,
    mesh_show_wireframe: bool = False,
    mesh_show_back_face: bool = False,
    lookat: Any = None,
    up: Any = None,
    front: Any = None,
    zoom: float | None = None,
) -> None:
    """Show geometries in a window; without a screen a warning says so.

    Parameters
    ----------
    geometry_list : iterable of open3d.geometry.Geometry
    window_name : str
    width, height : int
    left, top : int
        Taken and ignored.
    point_show_normal, mesh_show_wireframe, mesh_show_back_face : bool
        As `RenderOption` has them.
    lookat, up, front : (3,) float, optional
        The first view, as of `ViewControl`.
    zoom : float, optional
    """
    visualizer = _opened(Visualizer(), geometry_list, window_name, width, height)
    option = visualizer.get_render_option()
    option.point_show_normal = point_show_normal
    option.mesh_show_wireframe = mesh_show_wireframe
    option.mesh_show_back_face = mesh_show_back_face
    control = visualizer.get_view_control()
    for value, take in (
        (lookat, control.set_lookat),
        (up, control.set_up),
        (front, control.set_front),
        (zoom, control.set_zoom),
    ):
        if value is not None:
            take(value)
    _run(visualizer)


def draw_geometries_with_animation_callback(
    geometry_list: Iterable[Any],
    callback_function: Callable[[Visualizer], bool],
    window_name: str = "Open3D",
    width: int = 1920,
    height: int = 1080,
    left: int = 50,
    top: int = 50,
) -> None:
    """Show geometries, and call a function before each picture; see `draw_geometries`.

    Without a screen it runs, too, until the function calls ``close``.
    """
    visualizer = _opened(Visualizer(), geometry_list, window_name, width, height)
    visualizer.register_animation_callback(callback_function)
    _run(visualizer)


def draw_geometries_with_key_callbacks(
    geometry_list: Iterable[Any],
    key_to_callback: Mapping[int, Callable[[Visualizer], bool]],
    window_name: str = "Open3D",
    width: int = 1920,
    height: int = 1080,
    left: int = 50,
    top: int = 50,
) -> None:
    """Show geometries, with functions for keys; see `draw_geometries`."""
    visualizer = VisualizerWithKeyCallback()
    _opened(visualizer, geometry_list, window_name, width, height)
    for key, function in key_to_callback.items():
        visualizer.register_key_callback(key, function)
    _run(visualizer)


def _opened(visualizer: Visualizer, geometries, name: str, width: int, height: int) -> Visualizer:
    visualizer.create_window(name, width, height)
    for geometry in geometries:
        visualizer.add_geometry(geometry)
    return visualizer


def _run(visualizer: Visualizer) -> None:
    try:
        visualizer.run()
    finally:
        visualizer.destroy_window()
