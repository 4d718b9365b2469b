"""`show`: displays a scene, node, mesh or picture in a window until the user closes it.

In: a thing to show. Out: nothing; lights and ground are beside the scene, not in it.
"""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base.calls import checks_types, keywords_of, refuse_unknown
from ...base.foreign_arrays import is_foreign_array
from ...base.image_size import check_size
from ...base.language import speaking, usual_language
from ...base.numbers import as_array, shown
from ...choices import PixelFormat
from ...errors import DisplayError, InvalidArgumentError
from ...model.geometry.mesh import Mesh
from ...model.scene.instances import InstancedMesh
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...rendering.canvas import Canvas
from ...rendering.frame import Frame
from ...stage.look import LookChoice
from ...stage.overlays.numbers import MarkKeywords, take_marks
from ...stage.stage_settings import Settings
from ...stage.view_renderer import ViewRenderer
from ...stage.viewed_scene import TURN_SECONDS, ViewedScene
from ...stage.viewed_thing import settings_for, viewed_thing
from ...stage.views.first_view import view_of_scene
from .picture_window import PictureWindow, fitting_size
from .pixels import Picture, as_pixels
from .program_window import ProgramWindow
from .sampling import Sampling
from .viewer import HINT, Viewer
from .window import Window

if TYPE_CHECKING:
    from typing_extensions import Unpack

SIZE = (1280, 720)


@checks_types
def show(
    thing: Scene | Node | Mesh | InstancedMesh | Picture | Any,
    *,
    size: tuple[int, int] | None = None,
    title: str | None = None,
    look: LookChoice = "studio",
    up: str | None = None,
    update: Callable[[float], None] | None = None,
    period: float = TURN_SECONDS,
    format: PixelFormat | None = None,
    **marks: Unpack[MarkKeywords],
) -> None:
    """Show a thing in a window until the user closes it.

    Scenes, nodes and meshes are shown in the viewer, with all its keys (H lists them). Pictures are
    fitted into the window; the wheel, + and - zoom, drags move, R fits again, 1 shows real size,
    and the title shows the pixel under the mouse. Q closes the window; for pictures Escape does
    too.

    Parameters
    ----------
    thing : path, Scene, Node, Mesh, InstancedMesh, Frame, Canvas, array, or another library's
        Other libraries are trimesh, PyVista, meshio and Open3D.
        A file of a model is opened as by ``engine3d run``. A node is shown with its subtree and the
        lights in it. The first view of a scene is its camera's, if it has one. Arrays are as for
        `Window.present`.
    size : (int, int), optional
        Width and height of the window in pixels; by default 1280x720, or fitted to the picture.
    title : str, optional
        Text of the title bar.
    look : {"studio", "plain"} or Look
        As for `Renderer`; pictures have none.
    up : {"+X", "-X", "+Y", "-Y", "+Z", "-Z"}, optional
        The up direction of a scene; by default +Y, or that of the file.
    update : callable, optional
        Called with the time in seconds before each picture of a scene, to move its nodes:
        ``animator.seek``, or your own function. It plays from the start; Space pauses it. By
        default, the first of ``scene.animations`` plays.
    period : float
        Seconds after which the time restarts at 0.
    format : {"rgba", "bgra"}, optional
        Byte order of an array; see `Window.present`.
    **marks
        ``color_by``, ``colormap``, ``clim``, ``component``, ``on``, ``bar`` and ``axes_grid``: see
        `render`.

    Raises
    ------
    DisplayError
        There is no screen.
    InvalidArgumentError
        The thing cannot be shown.

    Examples
    --------
    >>> e3d.show(e3d.torus())
    >>> e3d.show(e3d.render(scene, mode="depth"))
    """
    refuse_unknown("show", marks, (*keywords_of(show), *MarkKeywords.__annotations__))
    taken = take_marks(dict(marks))
    motion = {"title": title, "up": up, "update": update, "period": period}
    with _telling_of_notebooks():
        _show(thing, size, format, settings_for(look, marks=taken), marks=taken, **motion)


def show_viewed(viewed: ViewedScene, settings: Settings, size: tuple[int, int] | None) -> None:
    """Show a viewed scene as `show` does, with any settings.

    Raises
    ------
    DisplayError
        There is no screen.
    InvalidArgumentError
        The size is none of a picture.
    """
    with _telling_of_notebooks():
        _show_scene(viewed, settings, None if size is None else check_size(size))


@contextlib.contextmanager
def _telling_of_notebooks() -> Iterator[None]:
    """Say in the error of a missing screen what notebooks have instead."""
    try:
        yield
    except DisplayError as error:
        if not _in_a_kernel():
            raise
        raise DisplayError(
            f"{error}; in a notebook, engine3d.notebook.View(scene) shows it in the page, and a "
            "frame shows by itself at the end of a cell"
        ) from None


def _in_a_kernel() -> bool:
    """Return whether the program runs in a notebook kernel."""
    shell = sys.modules.get("IPython")
    return shell is not None and hasattr(shell.get_ipython(), "kernel")


def _show(thing, size, format, settings: Settings, **how: Any) -> None:
    size = None if size is None else check_size(size)
    viewed = None
    if is_foreign_array(thing) and not isinstance(thing, Frame):
        thing = as_array(thing, "thing")
    if not isinstance(thing, np.ndarray | Frame | Canvas):
        viewed = viewed_thing(thing, **how)
    if viewed is None:
        if not isinstance(thing, (Frame, Canvas, np.ndarray, Sequence)):
            raise InvalidArgumentError(
                f"thing must be a scene, a node, a mesh or a picture, not {shown(thing)}"
            )
        _show_picture(thing, size, how["title"], format)
        return
    _show_scene(viewed, settings, size)


def _show_scene(viewed: ViewedScene, settings: Settings, size: tuple[int, int] | None) -> None:
    with (
        speaking(usual_language()),
        ProgramWindow(size, SIZE, f"{viewed.title} - engine3d") as window,
        ViewRenderer(viewed, settings, window.size, antialiasing="msaa") as view_renderer,
    ):
        view = view_of_scene(view_renderer)
        try:
            viewer = Viewer(view_renderer, window, view=view, sampling=Sampling())
            viewer.controls.shown = True
            viewer.say(HINT)
            viewer.run()
        finally:
            if viewed.player is not None:
                viewed.player.stop()


def _show_picture(picture, size, title: str | None, format: PixelFormat | None) -> None:
    pixels, order = as_pixels(picture, format)
    height, width = pixels.shape[:2]
    title = title or f"{type(picture).__name__.lower()} {width}x{height}"
    size = size or fitting_size((width, height), SIZE)
    with Window(size, title, wait=True) as window:
        PictureWindow(window, pixels, order).run()
