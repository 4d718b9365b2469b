"""Open3D's `Visualizer`, drawn by this engine: no OpenGL, no EGL, no display."""

from __future__ import annotations

import numpy as np

from ...base import linalg
from ...base.image_size import check_size
from ...errors import InvalidArgumentError, warn
from ...io.scenes.open3d_scenes import legacy_of
from ._geometry_parts import Part, kind_of, parts_of
from ._keys import CONTROL, PRESS, RELEASE, SHIFT, press
from ._loading import load
from ._phong import Lighting
from ._shots import Drawer, Shot
from .captures import Captures
from .render_option import RenderOption
from .view_control import ViewControl

_DRAGS = {0: "rotate", 2: "translate"}  # by GLFW's numbers of mouse buttons


class Visualizer(Captures):
    """A view of geometries, in a window or only in pictures.

    The geometries stay Open3D's: what is drawn are copies, renewed by `update_geometry`.
    """

    def __init__(self) -> None:
        self._name = "Open3D"
        self._control: ViewControl | None = None
        self._option: RenderOption | None = None
        self._parts: dict[int, tuple[object, list[Part] | None]] = {}
        self._frame_mesh = None
        self._drawer = Drawer()
        self._ordered: Shot | None = None
        self._picture: tuple[Shot, np.ndarray] | None = None
        self._needs_drawing = True
        self._should_close = False
        self._animation = None
        self._window = None
        self._drag: str | None = None

    def __repr__(self) -> str:
        return f"{type(self).__name__} with name {self._name}"

    # ---- the window ----

    def create_window(
        self,
        window_name: str = "Open3D",
        width: int = 1920,
        height: int = 1080,
        left: int = 50,
        top: int = 50,
        visible: bool = True,
    ) -> bool:
        """Begin; a window opens if ``visible`` and there is a screen.

        Parameters
        ----------
        window_name : str
        width, height : int
            Pixels of pictures.
        left, top : int
            Taken and ignored: the system places windows.
        visible : bool

        Returns
        -------
        bool
            True.
        """
        size = check_size((int(width), int(height)))
        self._name = str(window_name)
        if self._control is None:
            self._control, self._option = ViewControl(), RenderOption()
        self._control.change_window_size(*size)
        self._should_close, self._needs_drawing = False, True
        if visible and self._window is None:
            from ._window import open_window

            self._window = open_window(self, size)
        return True

    def destroy_window(self) -> None:
        """End: pictures and copies are freed; `create_window` may begin anew."""
        if self._window is not None:
            self._window.close()
        name = self._name
        Visualizer.__init__(self)
        self._name = name

    def get_window_name(self) -> str:
        """Return the name of the window."""
        return self._name

    def close(self) -> None:
        """Let `run` return, and `poll_events` return False."""
        self._should_close = True

    def run(self) -> None:
        """Show the window until the user closes it.

        Without a screen, or with a window that is not visible, it runs as long as there is a
        function of `register_animation_callback`, until `close`; then a warning says that nothing
        was shown.
        """
        self._begun()
        self._add_axes()
        while self._window is not None or self._animation is not None:
            if not self.poll_events(wait=self._animation is None):
                return
            if self._animation is not None:
                if self._animation(self):
                    self.update_geometry()
                self.update_renderer()
        if self._control is not None:
            warn(
                "Visualizer.run shows nothing: there is no screen, or the window is not visible; "
                "capture_screen_image(file, do_render=True) draws without"
            )

    def poll_events(self, *, wait: bool = False) -> bool:
        """Draw if something has changed, and take what the user did; return whether to go on."""
        if self._control is None:
            return False
        if self._needs_drawing:
            self._order()
        if self._window is not None:
            self._window.take_events(wait=wait)
        return not self._should_close

    def update_renderer(self) -> None:
        """Draw anew at the next `poll_events`."""
        self._needs_drawing = True

    def register_animation_callback(self, callback_func) -> None:
        """Call a function with this visualizer before each picture of `run`; None ends it.

        It returns whether geometries have changed.
        """
        self._animation = callback_func

    def set_full_screen(self, fullscreen: bool) -> None:
        """Fill the screen, or not; nothing happens without a window."""
        if self._window is not None:
            self._window.set_full_screen(bool(fullscreen))

    def toggle_full_screen(self) -> None:
        """Fill the screen, or no longer."""
        self.set_full_screen(not self.is_full_screen())

    def is_full_screen(self) -> bool:
        """Return whether the window fills the screen."""
        return self._window is not None and self._window.is_full_screen

    # ---- geometries ----

    def add_geometry(self, geometry, reset_bounding_box: bool = True) -> bool:
        """Add a geometry; return whether it is drawn.

        Parameters
        ----------
        geometry : open3d.geometry.Geometry
            Those of ``open3d.t`` are converted.
        reset_bounding_box : bool
            Look at everything from the front anew.
        """
        if self._control is None or geometry is None:
            return False
        if kind_of(legacy_of(geometry)) is None:
            warn(f"a Visualizer draws no {type(geometry).__name__}")
            return False
        self._parts[id(geometry)] = geometry, None
        if reset_bounding_box:
            self._control.fit_in(legacy_of(geometry))
            self.reset_view_point()
        self.update_geometry(geometry)
        return True

    def remove_geometry(self, geometry, reset_bounding_box: bool = True) -> bool:
        """Remove a geometry; return whether it was there."""
        if self._parts.pop(id(geometry), None) is None:
            return False
        if reset_bounding_box:
            self.reset_view_point(True)
        self._needs_drawing = True
        return True

    def clear_geometries(self) -> bool:
        """Remove all geometries."""
        self._parts.clear()
        self._needs_drawing = True
        return self._control is not None

    def update_geometry(self, geometry=None) -> bool:
        """Copy a geometry, or all, before the next picture."""
        for key, (one, _) in self._parts.items():
            if geometry is None or one is geometry:
                self._parts[key] = one, None
        self._needs_drawing = True
        return self._control is not None

    def reset_view_point(self, reset_bounding_box: bool = False) -> None:
        """Look from the front; with True, at the box of what is there now."""
        control = self._begun()
        if reset_bounding_box:
            control.reset_bounding_box()
            for one, _ in self._parts.values():
                control.fit_in(legacy_of(one))
        control.reset()
        self._needs_drawing = True

    def get_view_control(self) -> ViewControl:
        """Return what places the camera."""
        return self._begun()

    def get_render_option(self) -> RenderOption:
        """Return the options of drawing."""
        self._begun()
        return self._option

    def get_view_status(self) -> str:
        """Return the view as JSON."""
        return self._begun().status()

    def set_view_status(self, view_status_str: str) -> None:
        """Take the view of a JSON of `get_view_status`."""
        self._begun().take_status(view_status_str)
        self._needs_drawing = True

    # ---- the user ----

    def _key(self, key: int, action: int, mods: int) -> None:
        if action != RELEASE:
            press(self, key, mods)

    def _mouse_button(self, button: int, action: int, mods: int) -> None:
        if action != PRESS:
            self._drag = None
        elif button in _DRAGS:
            self._begun().reset_camera_local_rotate()
            self._drag = "translate" if mods & CONTROL else _DRAGS[button]
            if self._drag == "rotate" and mods & SHIFT:
                self._drag = "roll"

    def _mouse_moved(self, x: float, y: float, dx: float, dy: float) -> None:
        if self._drag is not None:
            moved = (dx,) if self._drag == "roll" else (dx, dy)
            getattr(self._begun(), self._drag)(*moved)
            self._needs_drawing = True

    def _scrolled(self, x: float, y: float) -> None:
        self._begun().scale(y)
        self._needs_drawing = True

    # ---- pictures ----

    def _begun(self) -> ViewControl:
        if self._control is None:
            raise InvalidArgumentError("there is no window: call create_window first")
        return self._control

    def _order(self) -> Shot:
        """Order a picture of what is there now; it is drawn when someone looks at it."""
        control, option = self._begun(), self._option
        for key, (one, parts) in self._parts.items():
            if parts is None:
                self._parts[key] = one, parts_of(legacy_of(one), option, control.box)
        every = [part for _, parts in self._parts.values() for part in parts or ()]
        if self._frame_mesh is not None and option.show_coordinate_frame:
            every += parts_of(self._frame_mesh, RenderOption(), control.box)
        projection, view = np.eye(4), np.eye(4)
        if 0 < control.box.get_max_extent() < np.inf:
            projection, view = control.projection, control.view
        elif every:
            warn("the box of all is one point or not finite: nothing shows, as in Open3D")
            every = []
        self._needs_drawing = False
        self._ordered = Shot(
            parts=every,
            size=control.size,
            projection=projection,
            view=view,
            planes=control.planes,
            background=np.array(option.background_color),
            lighting=_lighting(control, option, linalg.inverse(view)[:3, 3]),
            point_size=float(option.point_size),
            line_width=float(option.line_width),
            shows_back_faces=bool(option.mesh_show_back_face),
            shows_wires=bool(option.mesh_show_wireframe),
        )
        return self._ordered

    def _shot(self, anew: bool) -> Shot:
        """Return the ordered shot, or with True one of what is there now."""
        return self._order() if anew or self._ordered is None else self._ordered

    def _colors(self, anew: bool) -> np.ndarray:
        shot = self._shot(anew)
        if self._picture is None or self._picture[0] is not shot:
            self._picture = shot, self._drawer.color(shot)
        return self._picture[1]

    def _depths(self, anew: bool) -> tuple[np.ndarray, np.ndarray]:
        return self._drawer.depth(self._shot(anew))

    def _add_axes(self) -> None:
        """Make the coordinate frame that ``show_coordinate_frame`` shows."""
        box = self._begun().box
        self._frame_mesh = load().geometry.TriangleMesh.create_coordinate_frame(
            max(0.01, box.get_max_extent() * 0.2), box.min_bound
        )


def _lighting(control: ViewControl, option: RenderOption, eye: np.ndarray) -> Lighting:
    """Return the lights, which go with the view, and the box."""
    box = control.box
    right, up, front = control.axes
    if not option.light_on or not np.isfinite(box.get_max_extent()):
        return Lighting(eye, np.zeros((0, 3)), (), np.ones(3))
    extent, middle = box.get_max_extent(), np.array(box.get_center())
    places = [
        middle + (right * lamp.place[0] + up * lamp.place[1] + front * lamp.place[2]) * extent
        for lamp in option.lamps
    ]
    return Lighting(eye, np.array(places), option.lamps, np.array(option.ambient))
