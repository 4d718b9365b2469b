"""Takes the place of VTK's drawing, so that programs for PyVista run unchanged.

In: nothing. Out: plotters made afterwards have a window without OpenGL, whose pictures engine3d
draws: ``show``, ``screenshot``, ``image``, ``get_image_depth``, films, notebooks.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pyvista import _vtk
from pyvista.plotting import plotter, render_window_interactor, renderer

from ...errors import DisplayError, warn
from . import _windows
from ._live_window import LiveWindow
from ._window_pictures import is_smooth, picture_of
from ._windows import Window

#: What was replaced: objects, names, and what they had.
_kept: list[tuple[Any, str, Any]] = []


def install() -> None:
    """Let engine3d draw all plotters that are made from now on.

    Examples
    --------
    >>> import engine3d.compat.pyvista
    >>> engine3d.compat.pyvista.install()
    """
    if _kept:
        return
    interactor = render_window_interactor.RenderWindowInteractor
    _replace(_vtk, "vtkRenderWindow", _windows.new_window)
    _replace(plotter, "_warn_xserver", lambda: None)
    _replace(renderer, "check_depth_peeling", lambda *limits: True)  # asks OpenGL
    _replace(plotter, "image_from_window", _image_of(plotter.image_from_window))
    _replace(plotter, "run_image_filter", _depth_of(plotter.run_image_filter))
    _replace(plotter.Plotter, "show", _going_on(plotter.Plotter.show))
    for name, instead in _INSTEAD.items():
        _replace(interactor, name, _unless_ours(getattr(interactor, name), instead))


def uninstall() -> None:
    """Undo `install`: plotters that are made from now on draw by VTK again."""
    while _kept:
        setattr(*_kept.pop())


def _replace(owner: Any, name: str, value: Any) -> None:
    _kept.append((owner, name, getattr(owner, name)))
    setattr(owner, name, value)


def _image_of(original: Any) -> Any:
    """Return what takes the place of `pyvista.plotting.utilities.regression.image_from_window`."""

    def image_from_window(
        render_window: Any, as_vtk: bool = False, ignore_alpha: bool = False, scale: int = 1
    ) -> Any:
        if as_vtk or not isinstance(render_window, Window):
            return original(render_window, as_vtk=as_vtk, ignore_alpha=ignore_alpha, scale=scale)
        found = picture_of(render_window, scale, is_smooth=is_smooth(render_window))
        return found.rgba[..., :3].copy() if ignore_alpha else found.rgba

    return image_from_window


def _depth_of(original: Any) -> Any:
    """Return what takes the place of `run_image_filter`, which reads the depths of a window."""

    def run_image_filter(image_filter: Any) -> NDArray[Any]:
        window = image_filter.GetInput()
        if not isinstance(window, Window):
            return original(image_filter)
        scale = image_filter.GetScale()[0]
        found = picture_of(window, scale, is_smooth=is_smooth(window), wants_depth=True)
        return _codes(window, found.depth)[..., None]

    return run_image_filter


def _codes(window: Window, depth: Any) -> NDArray[np.float64]:
    """Return depths as OpenGL's buffer has them, of the camera that PyVista reads them with."""
    camera = _windows.active_camera(window)
    near, far = camera.GetClippingRange()
    distance = np.where(depth > 0.0, depth, far).astype(np.float64)
    if camera.GetParallelProjection():
        return np.where(depth > 0.0, (distance - near) / (far - near), 1.0)
    codes = 0.5 + (near + far - 2.0 * near * far / distance) / (2.0 * (far - near))
    return np.where(depth > 0.0, codes, 1.0)


def _going_on(original: Any) -> Any:
    """Return what takes the place of `pyvista.Plotter.show`, which may let the program go on."""
    signature = inspect.signature(original)

    @functools.wraps(original)
    def show(self: Any, *args: Any, **keywords: Any) -> Any:
        result = original(self, *args, **keywords)
        given = signature.bind(self, *args, **keywords).arguments
        if given.get("interactive_update") and given.get("interactive") is not False:
            _begin_live(self)
        return result

    return show


def _begin_live(shown: Any) -> None:
    """Open a window that `pyvista.Plotter.update` draws anew."""
    window = shown.render_window
    if not isinstance(window, Window) or shown.off_screen or shown.notebook or window.live:
        return
    try:
        window.live = LiveWindow(shown)
    except DisplayError as error:
        _tell_not_shown(error)
    else:
        window.live.update()


def _unless_ours(original: Any, instead: Callable[[Any], None]) -> Any:
    """Return a method of an interactor that does something else for windows of ours."""

    def method(self: Any) -> Any:
        if not isinstance(self.interactor.GetRenderWindow(), Window):
            return original(self)
        return instead(self)

    return method


def _show(interactor: Any) -> None:
    """Show a plotter in a window of engine3d; without a display, only say so."""
    try:
        interactor._plotter.engine3d.show()
    except DisplayError as error:
        _tell_not_shown(error)


def _tell_not_shown(error: DisplayError) -> None:
    warn(f"the plotter is drawn, but not shown: {error}")


def _update(interactor: Any) -> None:
    """Draw a window anew that is open while the program goes on."""
    live = interactor.interactor.GetRenderWindow().live
    if live is not None:
        live.update()


def _do_nothing(interactor: Any) -> None:
    """Begin nothing: a window of ours needs no preparation."""


#: What is done instead of VTK's interactor's methods.
_INSTEAD = {"start": _show, "initialize": _do_nothing, "process_events": _update}
