"""Open3D's functions that open a window, show geometries and return when it is closed."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from ...apps.viewer.show import show
from ...base.linalg import look_at
from ...errors import DisplayError, InvalidArgumentError, warn
from ...model.scene.cameras import PerspectiveCamera
from ...model.scene.scene import Scene
from ._loading import load
from .key_callbacks import VisualizerWithKeyCallback
from .rendering._things import thing_of
from .visualizer import Visualizer

__all__ = [
    "draw",
    "draw_geometries",
    "draw_geometries_with_animation_callback",
    "draw_geometries_with_key_callbacks",
]


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


def draw(
    geometry: Any = None,
    title: str = "Open3D",
    width: int = 1024,
    height: int = 768,
    *,
    lookat: Any = None,
    eye: Any = None,
    up: Any = None,
    field_of_view: float = 60.0,
    bg_color: Any = (1.0, 1.0, 1.0, 1.0),
    point_size: int | None = None,
    line_width: int | None = None,
    **others: Any,
) -> None:
    """Show geometries in the engine's viewer; without a screen a warning says so.

    Parameters
    ----------
    geometry : geometry, or list of geometries and of dictionaries
        A dictionary has the keys ``geometry``, and if you like ``name``, ``material`` and
        ``is_visible``.
    title : str
    width, height : int
    lookat, eye, up : (3,) float, optional
        The first view, all three together.
    field_of_view : float
        Vertical, in degrees.
    bg_color : (3,) or (4,) float
    point_size, line_width : int, optional
        Of geometries without a material.
    **others
        Other arguments of Open3D's function: not supported, a warning names them.
    """
    missed = sorted(name for name, value in others.items() if value not in (None, False))
    if missed:
        warn(f"draw does not support {', '.join(missed)}")
    scene = Scene(background=tuple(float(part) for part in bg_color[:3]))
    given = geometry if isinstance(geometry, list | tuple) else [geometry]
    for number, item in enumerate(given):
        if item is not None:
            _add(scene, item, f"Object {number + 1}", point_size, line_width)
    if lookat is not None and eye is not None and up is not None:
        lens = PerspectiveCamera(float(field_of_view) * math.pi / 180.0)
        scene.add(lens, pose=look_at(eye, lookat, up))
    try:
        show(scene, title=title, size=(int(width), int(height)))
    except DisplayError as error:
        warn(f"draw shows nothing: {error}")


def _add(scene: Scene, item: Any, name: str, point_size, line_width) -> None:
    row = item if isinstance(item, dict) else {"geometry": item}
    if "geometry" not in row:
        raise InvalidArgumentError(f"a dictionary for draw needs a geometry: {sorted(row)}")
    record = row.get("material")
    if record is None:
        record = load().visualization.rendering.MaterialRecord()
        record.shader = "defaultLit" if _has_normals(row["geometry"]) else "defaultUnlit"
        record.point_size = float(point_size or 3)
        record.line_width = float(line_width or 1)
    thing = thing_of(row["geometry"], record, (0.1, 1000.0))
    if thing is None:
        warn(f"draw shows no {type(row['geometry']).__name__}")
    elif row.get("is_visible", True):
        scene.add(thing.mesh, name=str(row.get("name", name)))


def _has_normals(geometry: Any) -> bool:
    for name in ("has_vertex_normals", "has_normals"):
        if hasattr(geometry, name):
            return bool(getattr(geometry, name)())
    return False
