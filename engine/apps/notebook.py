"""Interactive scenes in notebooks: Jupyter, VS Code, Colab and others.

In: a scene, mouse and key events from a browser. Out: its pictures there. The widget is based on
jupyter_rfb, which sends JPEGs during motion and a PNG at rest.
"""

from __future__ import annotations

import asyncio
import base64
import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .._native.images import encode_png
from ..base.calls import keywords_of, refuse_unknown
from ..base.image_size import check_size
from ..base.optional_packages import needed
from ..errors import InvalidArgumentError
from ..model.geometry.mesh import Mesh
from ..model.scene.instances import InstancedMesh
from ..model.scene.nodes import Node
from ..model.scene.scene import Scene
from ..stage.look import LookChoice
from ..stage.overlays.numbers import MarkKeywords, take_marks
from ..stage.view_renderer import ViewRenderer
from ..stage.viewed_scene import TURN_SECONDS
from ..stage.viewed_thing import check_motion, settings_for, viewed_thing
from ..stage.views.first_view import view_of_scene
from . import events
from .viewer.sampling import Sampling
from .viewer.viewer import Viewer

if TYPE_CHECKING:
    from typing_extensions import Unpack

try:
    from jupyter_rfb import RemoteFrameBuffer
except ImportError as error:
    raise ImportError(
        needed("engine3d.notebook needs", "jupyter_rfb", "notebook"),
        name=error.name,
    ) from error

__all__ = ["View"]

_BUTTONS = {1: "left", 2: "right", 3: "middle"}
_KEYS = {
    " ": "Space",
    "Enter": "Return",
    "ArrowLeft": "Left",
    "ArrowRight": "Right",
    "ArrowUp": "Up",
    "ArrowDown": "Down",
}
#: Pixels of a browser's wheel per step.
_WHEEL_PIXELS = 100.0


class View(RemoteFrameBuffer):
    """An interactive scene, node or mesh in a cell's output: drag to turn, wheel to zoom.

    The keys are the viewer's, once the picture was clicked: H lists them. A scene that was changed
    by another cell shows so after `update`.

    Parameters
    ----------
    thing : path, Scene, Node, Mesh, InstancedMesh, array, or another library's object
        Arrays are as for `render`. Other libraries are trimesh, PyVista, meshio and Open3D.
        As for `engine3d.render`.
    size : (int, int)
        Width and height in the page's pixels, at first: the corner can be dragged.
    look : {"studio", "plain"} or Look
        As for `engine3d.Renderer`.
    up : {"+X", "-X", "+Y", "-Y", "+Z", "-Z"}, optional
        Which way is up; by default +Y, or as the file says.
    update : callable, optional
        Called with the time in seconds before each picture, to move the scene's nodes. Left out,
        the first of ``scene.animations`` plays when Space is pressed.
    period : float
        Seconds after which the time begins again at 0.
    quality : int
        Of the JPEGs while something moves, 1 to 100; with 100 they are PNGs as well.
    **marks
        ``color_by``, ``colormap``, ``clim``, ``component``, ``on``, ``bar`` and ``axes_grid``: see
        `engine3d.render`.

    Raises
    ------
    InvalidArgumentError
        It is nothing of these, or another argument is wrong.

    Examples
    --------
    >>> from engine3d.notebook import View
    >>> View(e3d.torus())
    """

    _page: _Page | None = None
    _view_renderer: ViewRenderer | None = None
    _event_compatibility = 2  # use the event names that jupyter_rfb documents now

    def __init__(
        self,
        thing: Scene | Node | Mesh | InstancedMesh | Any,
        *,
        size: tuple[int, int] = (640, 400),
        look: LookChoice = "studio",
        up: str | None = None,
        update: Callable[[float], None] | None = None,
        period: float = TURN_SECONDS,
        quality: int = 80,
        **marks: Unpack[MarkKeywords],
    ) -> None:
        refuse_unknown(View, marks, (*keywords_of(View.__init__), *MarkKeywords.__annotations__))
        width, height = check_size(size)
        check_motion(update, "update")
        taken = take_marks(dict(marks))
        settings = settings_for(look, marks=taken)
        viewed = viewed_thing(thing, title=None, up=up, update=update, period=period, marks=taken)
        if viewed is None:
            raise InvalidArgumentError(
                f"a view shows a scene, a node or a mesh, not {type(thing).__name__}"
            )
        if not (isinstance(quality, int) and 1 <= quality <= 100):
            raise InvalidArgumentError(f"quality must be a whole number in 1..100, not {quality!r}")
        super().__init__(css_width=f"{width}px", css_height=f"{height}px", quality=quality)
        self._page = _Page((width, height))
        self._view_renderer = ViewRenderer(viewed, settings, (width, height), antialiasing="msaa")
        self._viewer = Viewer(
            self._view_renderer,
            self._page,
            view=view_of_scene(self._view_renderer),
            sampling=Sampling(),
        )

    def update(self) -> None:
        """Redraw after a change of the scene."""
        self._viewer.redraw()
        self.request_draw()

    def close(self) -> None:
        """Remove the view, and restore the scene; may be called twice."""
        if self._page is None:
            return  # construction failed, and Python deletes the incomplete object
        if self._view_renderer is not None:
            if self._view_renderer.viewed.player is not None:
                self._view_renderer.viewed.player.stop()
            self._view_renderer.close()
            self._view_renderer = None
        super().close()

    def _repr_mimebundle_(self, **options) -> Any:
        """Return the widget, and a picture for pages without a running kernel."""
        bundle = super()._repr_mimebundle_(**options)
        data = bundle[0] if isinstance(bundle, tuple) else bundle
        if data and self._view_renderer is not None:
            data["image/png"] = base64.b64encode(self._still()).decode("ascii")
        return bundle

    def _still(self) -> bytes:
        """Return the current picture as a PNG; the page always gets a first picture."""
        self._viewer.draw(self._viewer.sampling.at_rest())
        self._viewer.redraw()
        rgb = self._page.picture
        return encode_png(np.dstack([rgb, np.full(rgb.shape[:2], 255, np.uint8)]))

    # Called by jupyter_rfb

    def handle_event(self, event: dict) -> None:
        """Handle an event from the browser."""
        if event["type"] == "close" or self._view_renderer is None:
            return
        for happened in self._page.translated(event):
            self._viewer.handle(happened)
        if self._viewer.lively:
            self.request_draw()  # it cancels a pending PNG, so call it only if needed

    def get_frame(self) -> np.ndarray | None:
        """Return the picture, (H, W, 3) uint8, if there is a new one to show."""
        if self._view_renderer is None:
            return None
        viewer = self._viewer
        drawn = viewer.run_once()
        viewer.running = True  # Q closes windows, but not this part of a page
        self._draw_later(viewer)
        return self._page.picture if drawn else None

    def _draw_later(self, viewer: Viewer) -> None:
        """Schedule the viewer's next turn, if it has anything to do."""
        if viewer.lively:
            self.request_draw()
            return
        seconds = min(viewer.sampling.until_rest(), viewer.messages.remaining())
        if math.isfinite(seconds):
            asyncio.get_running_loop().call_later(seconds, self.request_draw)


class _Page:
    """Stands in for a window: translates events, and keeps the last picture."""

    minimised = False
    writes_text = False
    title = ""

    def __init__(self, size: tuple[int, int]) -> None:
        self.size = size
        self.scale = 1
        self.picture: np.ndarray | None = None
        self._ratio = 1.0
        self._mouse = (0, 0)

    def present(self, pixels: np.ndarray) -> None:
        """Keep (H, W, 4) uint8 pixels until they are sent."""
        self.picture = np.ascontiguousarray(pixels[..., :3])

    def events(self, timeout: float = 0.0) -> list:
        """Return nothing: events come with the browser's messages."""
        return []

    def key_at(self, position: str) -> str:
        """Return the position: no keyboard's layout is known."""
        return position

    def capture_mouse(self, captured: bool) -> None:
        """Do nothing: a page cannot capture the pointer."""

    def toggle_fullscreen(self) -> None:
        """Do nothing: a picture cannot choose its page's size."""

    def translated(self, event: dict) -> list:
        """Return a jupyter_rfb event as events of `engine3d.events`."""
        translate = _TRANSLATIONS.get(event["type"])
        return [] if translate is None else translate(self, event)

    def _place(self, event: dict) -> tuple[int, int]:
        return int(event["x"] * self._ratio), int(event["y"] * self._ratio)

    def _resize(self, event: dict) -> list:
        self._ratio = event["ratio"]
        self.scale = max(1, round(self._ratio))
        self.size = max(int(event["pwidth"]), 1), max(int(event["pheight"]), 1)
        return [events.Resized(*self.size)]

    def _button(self, event: dict) -> list:
        button = _BUTTONS.get(event["button"])
        if button is None:
            return []
        down, held = event["type"] == "pointer_down", event["modifiers"]
        self._mouse = self._place(event)
        shift, control = "Shift" in held, _holds_control(held)
        return [events.MouseButton(button, down, shift, control, *self._mouse)]

    def _double_click(self, event: dict) -> list:
        """Return a second press and release: browsers report the clicks before."""
        place = self._place(event)
        return [events.MouseButton("left", down, False, False, *place, 2) for down in (True, False)]

    def _motion(self, event: dict) -> list:
        before, self._mouse = self._mouse, self._place(event)
        (x, y), (left, top) = self._mouse, before
        return [events.MouseMotion(x - left, y - top, x, y)]

    def _wheel(self, event: dict) -> list:
        return [events.Wheel(-event["dy"] / _WHEEL_PIXELS, *self._place(event))]

    def _key(self, event: dict) -> list:
        key = _KEYS.get(event["key"], event["key"])
        key = key.upper() if len(key) == 1 else key
        if event["type"] == "key_up":
            return [events.KeyUp(key, key)]
        held = event["modifiers"]
        return [events.KeyDown(key, key, "Shift" in held, _holds_control(held))]

    def _typed(self, event: dict) -> list:
        return [events.TextEntered(event["data"])] if event.get("data") else []

    def _left(self, event: dict) -> list:
        return [events.MouseLeft()]


def _holds_control(held: Sequence[str]) -> bool:
    # The browser may run on macOS, wherever this process does: "Meta" is Cmd there.
    return "Control" in held or "Meta" in held


_TRANSLATIONS = {
    "resize": _Page._resize,
    "pointer_down": _Page._button,
    "pointer_up": _Page._button,
    "pointer_move": _Page._motion,
    "pointer_leave": _Page._left,
    "double_click": _Page._double_click,
    "wheel": _Page._wheel,
    "key_down": _Page._key,
    "key_up": _Page._key,
    "char": _Page._typed,
}
