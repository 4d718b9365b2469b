"""What trimesh imports as ``trimesh.viewer.windowed``: the same names, drawn by engine3d.

In: a ``trimesh.Scene``, and the keyword arguments of trimesh's viewer. Out: PNG bytes, or a window.
"""

from __future__ import annotations

import io
import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from ..._native.images import encode_png
from ...apps.viewer.show import show_viewed
from ...base.files.atomic_write import atomic_write
from ...base.numbers import shown
from ...base.validation import choose, positive
from ...errors import InvalidArgumentError, warn
from ._asked_window import Asked, warn_of_missing
from ._scene_pictures import draw
from ._settings import Settings

__all__ = ["SceneViewer", "render_scene"]

_LARGEST = 16384
_FLAGS = ("cull", "axis", "grid", "fullscreen", "wireframe")
_AXES = (False, True, "world", "all", "without_world")


class SceneViewer:
    """Draws a scene as trimesh's viewer does.

    Parameters
    ----------
    scene : trimesh.Scene
    smooth : bool
        Smooth meshes of less than 60,000 faces where they are not sharp.
    flags : dict, optional
        ``cull``, ``wireframe``, ``axis`` (True, "world", "all", "without_world"), ``grid``.
    resolution : (2,) int, optional
        By default that of the scene's camera, which is set to it.
    start_loop : bool
        Show a window, and return when it is closed. It does not take ``fixed``, ``offset_lines``,
        ``record`` and what has no effect: a warning names them.
    callback : function, optional
        Gets the scene before each picture. A window follows what it moves and hides.
    fixed : iterable of str, optional
        Names of geometries that stay where the camera first saw them.
    offset_lines : bool
        Draw lines a little nearer, so that faces do not hide those that lie on them.
    line_settings : dict, optional
        ``line_width`` and ``point_size``, in pixels.
    background : color, optional
        RGB or RGBA; white by default.
    record : bool
        Collect PNG bytes in ``scene.metadata["recording"]``.
    caption : str, optional
        The title of the window.
    visible, fullscreen, resizable, window_conf, profile, callback_period
        Of pyglet's window; taken, and of no effect.

    Raises
    ------
    InvalidArgumentError
    """

    def __init__(
        self,
        scene: Any,
        smooth: bool = True,
        flags: Mapping[str, Any] | None = None,
        visible: bool = True,
        resolution: Any = None,
        fullscreen: bool = False,
        resizable: bool = True,
        start_loop: bool = True,
        callback: Callable[[Any], None] | None = None,
        callback_period: float | None = None,
        caption: str | None = None,
        fixed: Iterable[str] | None = None,
        offset_lines: bool = True,
        line_settings: Mapping[str, float] | None = None,
        background: Any = None,
        window_conf: Any = None,
        profile: bool = False,
        record: bool = False,
        **kwargs: Any,
    ) -> None:
        self.scene, self.callback = scene, callback
        has_size = resolution is not None or scene.has_camera
        self._smooth, self._record, self._fixed = bool(smooth), bool(record), fixed
        self._is_offset = bool(offset_lines)
        self._hidden: set[str] = set()
        if kwargs:
            warn(f"trimesh's viewer takes no {', '.join(map(repr, sorted(kwargs)))}")
        if resolution is not None:
            scene.camera.resolution = _checked_size(resolution)
        self._size = tuple(int(side) for side in scene.camera.resolution)
        _checked_size(self._size)
        self._first_transform = np.array(scene.camera_transform, np.float64)
        largest = max(self._size)
        self.line_settings = {"point_size": largest / 200, "line_width": largest / 400}
        self.line_settings.update(_options(line_settings, "line_settings"))
        self.background = background
        if record:
            scene.metadata["recording"] = []
        self.reset_view(flags)
        setattr(scene, "_redraw", self.on_draw)  # noqa: B010  its name in trimesh
        if start_loop:
            warn_of_missing(
                {
                    "visible": not visible,
                    "fullscreen": bool(fullscreen or self.view["fullscreen"]),
                    "resizable": not resizable,
                    "fixed": fixed is not None,
                    "offset_lines": not offset_lines,
                    "record": bool(record),
                    "callback_period": callback_period is not None,
                    "window_conf": window_conf is not None,
                    "profile": bool(profile),
                }
            )
            given = _options(flags, "flags"), _options(line_settings, "line_settings")
            asked = Asked(caption, self._smooth, *given, background, callback)
            viewed = asked.viewed(scene)
            show_viewed(viewed, asked.settings(), self._size if has_size else None)

    def reset_view(self, flags: Mapping[str, Any] | None = None) -> None:
        """Set the flags to their defaults, or to those given; put the camera back."""
        self.view: dict[str, Any] = dict.fromkeys(_FLAGS, False) | {"cull": True}
        for name, value in _options(flags, "flags").items():
            choose(name, _FLAGS, "flags")
            if name == "axis" and value not in _AXES:
                choose(value, ("world", "all", "without_world"), "flags['axis']")
            self.view[name] = value
        self.scene.camera_transform = self._first_transform

    def hide_geometry(self, node: str) -> None:
        """Leave a node out of pictures."""
        self._hidden.add(node)

    def unhide_geometry(self, node: str) -> None:
        """Undo `hide_geometry`."""
        self._hidden.discard(node)

    def toggle_culling(self) -> None:
        self.view["cull"] = not self.view["cull"]

    def toggle_wireframe(self) -> None:
        self.view["wireframe"] = not self.view["wireframe"]

    def toggle_grid(self) -> None:
        self.view["grid"] = not self.view["grid"]

    def toggle_axis(self) -> None:
        states = (False, "world", "all", "without_world")
        axis = "world" if self.view["axis"] is True else self.view["axis"]
        self.view["axis"] = states[(states.index(axis) + 1) % len(states)]

    def on_draw(self) -> None:
        """Call the callback; pictures are drawn when they are saved."""
        if self.callback is not None:
            self.callback(self.scene)
        if self._record:
            self.scene.metadata["recording"].append(self._png())

    def save_image(self, file_obj: Any) -> Any:
        """Draw the scene into a file, as PNG.

        Parameters
        ----------
        file_obj : path or binary file

        Returns
        -------
        file_obj
            The same.
        """
        data = self._png()
        if hasattr(file_obj, "write"):
            file_obj.write(data)
        elif isinstance(file_obj, (str, os.PathLike)):
            with atomic_write(file_obj) as file:
                file.write(data)
        else:
            raise InvalidArgumentError(f"file_obj must be a path or a file, not {shown(file_obj)}")
        return file_obj

    def _png(self) -> bytes:
        settings = Settings(
            size=self._size,
            is_smooth=self._smooth,
            flags=dict(self.view),
            line_width=positive(self.line_settings["line_width"], "line_settings['line_width']"),
            point_size=positive(self.line_settings["point_size"], "line_settings['point_size']"),
            lift=self.scene.scale / 1000 if self._is_offset else 0.0,
            background=self.background,
            hidden=frozenset(self._hidden),
            fixed=frozenset(self._fixed or ()),
            first_transform=self._first_transform,
        )
        return encode_png(draw(self.scene, settings))

    def close(self) -> None:
        """Do nothing: there is no window."""


def render_scene(
    scene: Any,
    resolution: Any = None,
    visible: bool = True,
    fullscreen: bool = False,
    resizable: bool = True,
    **kwargs: Any,
) -> bytes:
    """Return a picture of a scene as PNG; parameters as those of `SceneViewer`.

    Raises
    ------
    InvalidArgumentError
    """
    kwargs["start_loop"] = False
    viewer = SceneViewer(scene, resolution=resolution, **kwargs)
    viewer.on_draw()
    file = io.BytesIO()
    viewer.save_image(file)
    return file.getvalue()


def _options(given: Any, what: str) -> Mapping[str, Any]:
    """Return the options that a dict holds; none for None."""
    if given is not None and not isinstance(given, Mapping):
        raise InvalidArgumentError(f"{what} must be a dict, not {shown(given)}")
    return given or {}


def _checked_size(given: Any) -> tuple[int, int]:
    sides = np.asarray(given)
    if sides.shape != (2,) or sides.dtype.kind not in "iuf" or not np.isfinite(sides).all():
        raise InvalidArgumentError(f"resolution must be a width and a height, not {shown(given)}")
    width, height = int(sides[0]), int(sides[1])
    if not (1 <= width <= _LARGEST and 1 <= height <= _LARGEST):
        raise InvalidArgumentError(
            f"resolution must be 1 to {_LARGEST} pixels wide and high, not {width} x {height}"
        )
    return width, height
