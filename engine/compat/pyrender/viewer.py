"""The viewer: a scene in a window of the engine's, turned by the mouse as in pyrender.

Drags turn, with Ctrl they roll, with Shift or the middle button they pan; the wheel and the right
button zoom. Keys are those of `_KEYS`, and of what a program registers.
"""

from __future__ import annotations

import copy
import threading

import numpy as np

from ...apps import events
from ...base.files.atomic_write import atomic_write
from ...base.side_by_side import Thread
from ._drawing import Drawing
from ._viewer_lights import direct_light, raymond_lights
from .camera import IntrinsicsCamera, OrthographicCamera, PerspectiveCamera
from .constants import DEFAULT_SCENE_SCALE, DEFAULT_Z_FAR, DEFAULT_Z_NEAR, RenderFlags
from .node import Node
from .scene import Scene
from .trackball import Trackball

_RENDER_FLAGS = {
    "flip_wireframe": False,
    "all_wireframe": False,
    "all_solid": False,
    "shadows": False,
    "vertex_normals": False,
    "face_normals": False,
    "cull_faces": True,
    "point_size": 1.0,
}
_VIEWER_FLAGS = {
    "mouse_pressed": False,
    "rotate": False,
    "rotate_rate": np.pi / 3.0,
    "rotate_axis": np.array([0.0, 0.0, 1.0]),
    "view_center": None,
    "record": False,
    "use_raymond_lighting": False,
    "use_direct_lighting": False,
    "lighting_intensity": 3.0,
    "use_perspective_cam": True,
    "save_directory": None,
    "window_title": "Scene Viewer",
    "refresh_rate": 30.0,
    "fullscreen": False,
    "show_world_axis": False,
    "show_mesh_axes": False,
    "caption": None,
}
#: Unsupported features, and alternatives for programs.
_ABSENT = {
    "vertex_normals": "normals are not drawn as lines",
    "face_normals": "normals are not drawn as lines",
    "record": "nothing is recorded: save pictures of an OffscreenRenderer",
    "show_world_axis": "axes are not drawn: add trimesh.creation.axis() to the scene",
    "show_mesh_axes": "axes are not drawn: add trimesh.creation.axis() to the scene",
    "caption": "captions are not drawn: draw on pictures with engine3d.Canvas",
}
_DRAGS = {"middle": Trackball.STATE_PAN, "right": Trackball.STATE_ZOOM}
#: The order of wireframe flags at each press of W.
_WIREFRAMES = (None, "flip_wireframe", "all_wireframe", "all_solid")
_POSITIONS = {"Space": " "}  # keys whose names differ from what they type


class Viewer:
    """A window that shows a scene until the user closes it.

    Parameters
    ----------
    scene : Scene
        The window has a camera of its own, which begins where the scene's is.
    viewport_size : (int, int), optional
        Pixels; by default 640x480.
    render_flags, viewer_flags : dict, optional
        As of pyrender.
    registered_keys : dict of str to callable or (callable, args, kwargs), optional
        Called with the viewer when a key is pressed.
    run_in_thread : bool
        Return at once, and show in a thread.
    auto_start : bool
        Whether to show now, or at `start`.
    **kwargs
        Flags of either kind.

    Raises
    ------
    DisplayError
        There is no screen.
    NotImplementedError
        A flag asks for axes, captions, lines of normals or recording, which there are not.
    """

    def __init__(
        self,
        scene: Scene,
        viewport_size=None,
        render_flags=None,
        viewer_flags=None,
        registered_keys=None,
        run_in_thread=False,
        auto_start=True,
        **kwargs,
    ):
        self._scene = scene
        self._size = tuple(int(side) for side in viewport_size or (640, 480))
        self._render_flags = {**_RENDER_FLAGS, **(render_flags or {})}
        self._viewer_flags = {**_VIEWER_FLAGS, **(viewer_flags or {})}
        for name, value in kwargs.items():
            for flags in (self._render_flags, self._viewer_flags):
                if name in flags:
                    flags[name] = value
        self._refuse_absent()
        self._keys = {key.lower(): value for key, value in (registered_keys or {}).items()}
        self._lock = threading.RLock()
        self._run_in_thread = bool(run_in_thread)
        self._is_active = self._should_close = False
        self._raymond, self._direct = raymond_lights(), direct_light()
        self._drawing = Drawing()
        self._error: BaseException | None = None
        self._take_camera()
        if self._run_in_thread:
            self._start_thread()
        elif auto_start:
            self.start()

    def _refuse_absent(self) -> None:
        flags = {**self._render_flags, **self._viewer_flags}
        for name, reason in _ABSENT.items():
            if flags[name]:
                raise NotImplementedError(f"Viewer({name}=…): {reason}")

    # ---- what programs read and set ----

    @property
    def scene(self) -> Scene:
        """The shown scene."""
        return self._scene

    @property
    def viewport_size(self) -> tuple[int, int]:
        """Width and height of the picture, in pixels."""
        return self._size

    @property
    def render_lock(self) -> threading.RLock:
        """A lock to hold while another thread changes the scene."""
        return self._lock

    @property
    def is_active(self) -> bool:
        """Whether the window is open."""
        return self._is_active

    @property
    def run_in_thread(self) -> bool:
        """Whether the viewer runs in a thread."""
        return self._run_in_thread

    @property
    def render_flags(self) -> dict:
        """Rendering flags, which may be changed."""
        return self._render_flags

    @property
    def viewer_flags(self) -> dict:
        """Viewer flags, which may be changed."""
        return self._viewer_flags

    @property
    def registered_keys(self) -> dict:
        """The functions called by keys."""
        return self._keys

    def close_external(self) -> None:
        """Close the window from another thread, and wait until it is closed."""
        self._should_close = True
        if self._run_in_thread and threading.current_thread() is not self._thread:
            self._thread.join()

    close = on_close = close_external

    def save_gif(self, filename=None) -> None:
        """Raise an error: recording is not supported."""
        raise NotImplementedError(f"save_gif: {_ABSENT['record']}")

    # ---- the camera ----

    def _take_camera(self) -> None:
        """Create cameras like the scene's, or such that the whole scene shows."""
        scene = self._scene
        self._prior = scene.main_camera_node
        lens = None if self._prior is None else copy.copy(self._prior.camera)
        scale = scene.scale
        far = max(scale * 10.0, DEFAULT_Z_FAR) if lens is None or lens.zfar is None else lens.zfar
        near = min(scale / 10.0 or DEFAULT_Z_NEAR, DEFAULT_Z_NEAR) if lens is None else lens.znear
        near = near or DEFAULT_Z_NEAR
        self._perspective = PerspectiveCamera(np.pi / 3.0, znear=near, zfar=far)
        self._orthographic = OrthographicCamera(scale or 1.0, scale or 1.0, znear=near, zfar=far)
        if isinstance(lens, PerspectiveCamera | IntrinsicsCamera):
            self._perspective = lens
        elif isinstance(lens, OrthographicCamera):
            self._orthographic = lens
        self._home = self._framing_pose() if lens is None else scene.get_pose(self._prior)
        self._node = Node(matrix=self._home, camera=self._lens())
        self._reset_view()

    def _lens(self):
        is_perspective = self._viewer_flags["use_perspective_cam"]
        return self._perspective if is_perspective else self._orthographic

    def _framing_pose(self) -> np.ndarray:
        """Return a pose above and in front of the scene that looks at its centre."""
        scale = self._scene.scale or DEFAULT_SCENE_SCALE
        half = 0.5 * np.sqrt(2.0)
        pose = np.array([[0, -half, half, 0], [1, 0, 0, 0], [0, half, half, 0], [0, 0, 0, 1.0]])
        distance = scale / (2.0 * np.tan(np.pi / 6.0))
        pose[:3, 3] = distance * np.array([1.0, 0.0, 1.0]) + self._scene.centroid
        return pose

    def _reset_view(self) -> None:
        target = self._viewer_flags["view_center"]
        target = self._scene.centroid if target is None else np.asarray(target)
        scale = self._scene.scale or DEFAULT_SCENE_SCALE
        self._trackball = Trackball(self._home, self._size, scale, target)

    # ---- the window ----

    def start(self) -> None:
        """Show the scene until the user closes the window."""
        from ...apps.viewer.window import Window

        rate = float(self._viewer_flags["refresh_rate"])
        title = str(self._viewer_flags["window_title"])
        with Window(self._size, title, max_fps=rate) as window:
            self._window = window
            self._is_active = True
            if self._viewer_flags["fullscreen"]:
                window.toggle_fullscreen()
            try:
                self._run(window)
            finally:
                self._is_active = False
                self._window = None

    def _start_thread(self) -> None:
        """Run in a thread; return once the window is open, or raise the reason why not."""
        opened = threading.Event()

        def run() -> None:
            try:
                self.start()
            except BaseException as error:
                self._error = error
            finally:
                opened.set()

        self._thread = Thread(target=run, daemon=True)
        self._opened = opened
        self._thread.start()
        opened.wait()
        if self._error is not None:
            raise self._error

    def _run(self, window) -> None:
        for event in window:
            self._handle(event)
            if self._should_close:
                return
            if isinstance(event, events.Tick):
                self._tick(window, event.dt)

    def _tick(self, window, seconds: float) -> None:
        flags = self._viewer_flags
        if flags["rotate"] and not flags["mouse_pressed"]:
            self._trackball.rotate(flags["rotate_rate"] * seconds, flags["rotate_axis"])
        with self._lock:
            window.present(self.draw())
        if self._run_in_thread:
            self._opened.set()

    def draw(self) -> np.ndarray:
        """Return the picture that the window shows now, (H, W, 3) uint8."""
        scene, flags = self._scene, self._viewer_flags
        self._node.matrix = self._trackball.pose
        self._node.camera = self._lens()
        lights = self._raymond if flags["use_raymond_lighting"] else []
        lights = [self._direct] if flags["use_direct_lighting"] else lights
        before = scene.main_camera_node
        scene.add_node(self._node)
        try:
            for light in lights:
                light.light.intensity = flags["lighting_intensity"] / len(lights)
                scene.add_node(light, parent_node=self._node)
            scene.main_camera_node = self._node
            size, points = self._size, float(self._render_flags["point_size"])
            color, _ = self._drawing.draw(scene, self._flags(), None, *size, points)
        finally:
            scene.remove_node(self._node)  # and the lights, its children
            self._node.children.clear()
            if before is not None:
                scene.main_camera_node = before
        return color

    def _flags(self) -> int:
        given = self._render_flags
        flags = RenderFlags.OFFSCREEN
        for name, flag in (
            ("flip_wireframe", RenderFlags.FLIP_WIREFRAME),
            ("all_wireframe", RenderFlags.ALL_WIREFRAME),
            ("all_solid", RenderFlags.ALL_SOLID),
            ("shadows", RenderFlags.SHADOWS_DIRECTIONAL | RenderFlags.SHADOWS_SPOT),
        ):
            flags |= flag if given[name] else 0
        return flags if given["cull_faces"] else flags | RenderFlags.SKIP_CULL_FACES

    # ---- what the user does ----

    def _handle(self, event) -> None:
        match event:
            case events.KeyDown(key):
                self._press(_POSITIONS.get(key, key).lower())
            case events.MouseButton():
                self._click(event)
            case events.MouseMotion(x=x, y=y) if self._viewer_flags["mouse_pressed"]:
                self._trackball.drag((x, self._size[1] - y))
            case events.Wheel(steps):
                self._trackball.scroll(steps)
            case events.Resized(width, height):
                self._size = width, height
                self._trackball.resize(self._size)
            case events.CloseRequested():
                self._should_close = True

    def _click(self, event) -> None:
        state = _DRAGS.get(event.button, Trackball.STATE_ROTATE)
        if event.button == "left" and event.control:
            state = Trackball.STATE_ZOOM if event.shift else Trackball.STATE_ROLL
        elif event.button == "left" and event.shift:
            state = Trackball.STATE_PAN
        self._trackball.set_state(state)
        self._trackball.down((event.x, self._size[1] - event.y))
        self._viewer_flags["mouse_pressed"] = event.down

    def _press(self, key: str) -> None:
        if key in self._keys:
            call = self._keys[key]
            call = call if isinstance(call, list | tuple) else (call,)
            args = call[1] if len(call) > 1 else ()
            call[0](self, *args, **(call[2] if len(call) > 2 else {}))
        elif key in _KEYS:
            _KEYS[key](self)

    def _flip(self, flags: dict, name: str) -> None:
        flags[name] = not flags[name]

    def _next_wireframe(self) -> None:
        shown = next((name for name in _WIREFRAMES[1:] if self._render_flags[name]), None)
        following = _WIREFRAMES[(_WIREFRAMES.index(shown) + 1) % len(_WIREFRAMES)]
        for name in _WIREFRAMES[1:]:
            self._render_flags[name] = name == following

    def _next_lights(self) -> None:
        flags = self._viewer_flags
        raymond, direct = flags["use_raymond_lighting"], flags["use_direct_lighting"]
        flags["use_raymond_lighting"] = not raymond and not direct
        flags["use_direct_lighting"] = raymond

    def _save_picture(self) -> None:
        """Write the picture into the save directory, under an unused name."""
        from pathlib import Path

        from ..._native.images import encode_png

        folder = Path(self._viewer_flags["save_directory"] or ".")
        number = 1
        while (folder / f"scene_{number}.png").exists():
            number += 1
        color = self.draw()
        opaque = np.full((*color.shape[:2], 1), 255, np.uint8)
        with atomic_write(folder / f"scene_{number}.png") as file:
            file.write(encode_png(np.concatenate([color, opaque], axis=2)))

    def _toggle_fullscreen(self) -> None:
        self._flip(self._viewer_flags, "fullscreen")
        self._window.toggle_fullscreen()

    def _quit(self) -> None:
        self._should_close = True


_KEYS = {
    "a": lambda viewer: viewer._flip(viewer._viewer_flags, "rotate"),
    "c": lambda viewer: viewer._flip(viewer._render_flags, "cull_faces"),
    "f": Viewer._toggle_fullscreen,
    "h": lambda viewer: viewer._flip(viewer._render_flags, "shadows"),
    "l": Viewer._next_lights,
    "o": lambda viewer: viewer._flip(viewer._viewer_flags, "use_perspective_cam"),
    "q": Viewer._quit,
    "s": Viewer._save_picture,
    "w": Viewer._next_wireframe,
    "z": Viewer._reset_view,
}

__all__ = ["Viewer"]
