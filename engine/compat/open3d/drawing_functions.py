"""Open3D's functions that open a window, show geometries and return when it is closed."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from ...apps.viewer.show import show_viewed
from ...base.linalg import look_at
from ...base.validation import optional_positive
from ...errors import DisplayError, InvalidArgumentError, warn
from ...model.scene.cameras import Camera, IntrinsicsCamera, PerspectiveCamera
from ...stage.viewed_thing import settings_for, viewed_of
from ._drawn_scene import DrawnScene
from .key_callbacks import VisualizerWithKeyCallback
from .rendering.view_camera import Camera as PlacedCamera
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
    actions: Any = None,
    lookat: Any = None,
    eye: Any = None,
    up: Any = None,
    field_of_view: float = 60.0,
    intrinsic_matrix: Any = None,
    extrinsic_matrix: Any = None,
    bg_color: Any = (1.0, 1.0, 1.0, 1.0),
    bg_image: Any = None,
    ibl: Any = None,
    ibl_intensity: Any = None,
    show_skybox: bool | None = None,
    show_ui: bool | None = None,
    raw_mode: bool = False,
    point_size: int | None = None,
    line_width: int | None = None,
    animation_time_step: float = 1.0,
    animation_duration: float | None = None,
    rpc_interface: bool | str = False,
    on_init: Any = None,
    on_animation_frame: Any = None,
    on_animation_tick: Any = None,
    non_blocking_and_return_uid: bool = False,
    near_plane: float | None = None,
    far_plane: float | None = None,
    show_axes: bool | None = None,
    **others: Any,
) -> None:
    """Show geometries in the engine's viewer; without a screen a warning says so.

    Parameters
    ----------
    geometry : geometry, or list of geometries and of dictionaries
        A dictionary has the keys ``geometry``, and if you like ``name``, ``material`` and
        ``is_visible``. Without a material a geometry has its own: textures, or the material of one
        of ``open3d.t``.
    title : str
    width, height : int
    lookat, eye, up : (3,) float, optional
        The first view, all three together.
    field_of_view : float
        Vertical, in degrees.
    intrinsic_matrix, extrinsic_matrix : (3, 3) and (4, 4) float, optional
        The first view of a pinhole camera that looks along +Z with +Y down, both together.
    bg_color : (3,) or (4,) float
    point_size, line_width : int, optional
        Of geometries without a material. The viewer shows everything with the largest.
    near_plane, far_plane : float, optional
    show_axes : bool, optional
        Show the axes' directions in the corner.
    actions, bg_image, ibl, ibl_intensity, show_skybox, show_ui, raw_mode, animation_time_step, \
    animation_duration, rpc_interface, on_init, on_animation_frame, on_animation_tick, \
    non_blocking_and_return_uid, **others
        Not supported: a warning names those that are given.

    Raises
    ------
    InvalidArgumentError
        A geometry, a dictionary or a matrix is none.
    """
    _warn_of_others(locals())
    drawn = DrawnScene(bg_color, point_size, line_width)
    given = geometry if isinstance(geometry, list | tuple) else [geometry]
    for number, item in enumerate(given):
        if item is not None:
            drawn.add(item, f"Object {number + 1}")
    if lookat is not None and eye is not None and up is not None:
        lens: Camera = PerspectiveCamera(float(field_of_view) * math.pi / 180.0)
        drawn.scene.add(lens, pose=look_at(eye, lookat, up))
    elif intrinsic_matrix is not None and extrinsic_matrix is not None:
        placed = PlacedCamera()
        placed.set_extrinsic(extrinsic_matrix)
        drawn.scene.add(_pinhole(intrinsic_matrix), pose=placed.pose)
    viewed = viewed_of(drawn.scene)
    assert viewed is not None  # of a scene there is one
    viewed.title = title
    settings = settings_for("studio", drawn.options)
    settings.near = optional_positive(near_plane, "near_plane")
    settings.far = optional_positive(far_plane, "far_plane")
    settings.axes = bool(show_axes)
    try:
        show_viewed(viewed, settings, (int(width), int(height)))
    except DisplayError as error:
        warn(f"draw shows nothing: {error}")


#: The arguments of Open3D's `draw` that this one passes over.
_PASSED_OVER = (
    *("actions", "bg_image", "ibl", "ibl_intensity", "show_skybox", "show_ui", "raw_mode"),
    *("animation_time_step", "animation_duration", "rpc_interface", "on_init"),
    *("on_animation_frame", "on_animation_tick", "non_blocking_and_return_uid"),
)


def _warn_of_others(given: dict[str, Any]) -> None:
    """Name the arguments of `draw` that have no effect, unless they ask for nothing."""
    usual = {name: one.default for name, one in inspect.signature(draw).parameters.items()}
    asked = {name: given[name] for name in _PASSED_OVER} | given["others"]
    missed = [name for name, value in asked.items() if _asks(value, usual.get(name))]
    if missed:
        warn(f"draw does not support {', '.join(sorted(missed))}")


def _asks(value: Any, usual: Any) -> bool:
    """Return whether an argument asks for something; its value may be an array."""
    if value is None or value is False:
        return False
    return not (isinstance(value, int | float) and value == usual)


def _pinhole(matrix: Any) -> IntrinsicsCamera:
    """Return the camera of a matrix of intrinsic parameters in pixels."""
    rows = np.asarray(matrix, np.float64)
    if rows.shape != (3, 3):
        raise InvalidArgumentError(f"intrinsic_matrix must be (3, 3), not {rows.shape}")
    return IntrinsicsCamera(*(float(rows[place]) for place in ((0, 0), (1, 1), (0, 2), (1, 2))))
