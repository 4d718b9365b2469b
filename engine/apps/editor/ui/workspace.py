"""The workspace shared by the panels: the document, the camera, the display settings.

In: actions of panels. Out: the shared state. It draws nothing.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Hashable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ....base import linalg
from ....base.language import translated
from ....choices import Culling, LookName, Mode
from ....errors import Engine3DError
from ....io.loaders import load_mesh, load_texture
from ....model.materials.material import Material
from ....model.scene.cameras import Camera, PerspectiveCamera
from ....model.scene.nodes import Node
from ....model.scene.orbiting import home_axes
from ....model.scene.scene import Scene
from ....stage.views.orbit import OrbitController
from ....stage.views.viewpoint import UP_DIRECTIONS, Sphere, Viewpoint
from ...desktop.recent_files import RecentFiles
from ..autosave import Autosave
from ..clipboard import Clipboard
from ..console import Console
from ..document import SceneDocument
from ..dropping import drop_file
from ..hierarchy import Hierarchy
from ..history import Command
from ..new_things.starts import STARTS, Start, empty
from ..recovery import Recovery
from ..resource_list import ResourceList
from ..value_commands import SetValues
from .view.ground_grid import with_grid
from .view.standard_views import look_from
from .view.through_camera import ThroughCamera

#: The panels, by their titles.
PANELS = ("Hierarchy", "Scene", "Properties", "Resources", "Materials", "Timeline", "Console")
#: Pictures drawn until a field receives the focus.
FOCUSING = 6
#: Half the side of the ground that is framed, and the radius of what is shown, while there is
#: nothing.
EMPTY_REACH, EMPTY_RADIUS = 2.5, 4.0
_TALL = 1000  # pixels of a picture's height
#: Maximum time step of one picture, in seconds.
LONGEST_STEP = 0.1


@dataclass
class Tools:
    """The active tool for the selection.

    Attributes
    ----------
    chosen : str
        ``"select"``, ``"move"``, ``"rotate"`` or ``"scale"``.
    is_local : bool
        Whether tools work along the axes of the node.
    snaps : bool
    is_uniform : bool
        Whether one number of a scale changes the others in proportion.
    steps : dict of str to float
        What tools snap to, and how far keys go: units, degrees, per cent.
    """

    chosen: str = "select"
    is_local: bool = False
    snaps: bool = False
    is_uniform: bool = False
    steps: dict[str, float] = field(
        default_factory=lambda: {"move": 0.25, "rotate": 15.0, "scale": 10.0}
    )


@dataclass
class Panels:
    """The state of the panels.

    Attributes
    ----------
    closed : set of str
        Those that the user closed.
    wants_usual_places : bool
        Whether they are to go where they are at first.
    pictures_to_focus : int
        As long as it is not 0, what is typed waits for a field to appear.
    offers_start, shows_keys : bool
        Whether the choice of scenes to start from, or the list of keys, is open.
    goes_to_menus : bool
        Whether the keyboard is to go to the menu bar.
    goes_to : str
        The panel that the keyboard is to go to; "" for none.
    goes_to_rows : bool
        Whether the keyboard is to go to the rows of the tree.
    goes_to_search : bool
        Whether the keyboard is to go to the search of the tree.
    has_dialog, shows_cursor : bool
        Whether a dialog, a list or a menu is open, and whether ImGui's cursor showed before it.
    """

    closed: set[str] = field(default_factory=set)
    wants_usual_places: bool = False
    pictures_to_focus: int = 0
    offers_start: bool = False
    shows_keys: bool = False
    goes_to_menus: bool = False
    goes_to: str = ""
    goes_to_rows: bool = False
    goes_to_search: bool = False
    has_dialog: bool = False
    shows_cursor: bool = False


@dataclass
class Display:
    """How the scene is drawn.

    Attributes
    ----------
    mode : Mode
    wireframe : bool
    look : {"studio", "plain"} or None
        The look of a scene without light of its own. None is ``"studio"`` as rendered; else it is
        ``"plain"``, which costs nothing when a node is dragged.
    as_rendered : bool
        Whether the view is exactly what `engine3d.render` draws, without marks of the editor.
    culls_hidden : bool
        Whether what others hide is left out, too: with ``culls``, and where it may pay.
    culls : bool
        Whether what is out of view is left out before it is drawn: the picture is the same.
    fps : int
        Pictures a second of rendered motion, by which the view counts frames.
    """

    mode: Mode = "lit"
    wireframe: bool = False
    look: LookName | None = None
    as_rendered: bool = False
    culls_hidden: bool = True
    culls: bool = True
    fps: int = 24

    @property
    def culling(self) -> Culling:
        """What is left out before it is drawn."""
        if not self.culls:
            return "none"
        return "all" if self.culls_hidden else "tree"

    @property
    def worn_look(self) -> LookName:
        """The look that the view has."""
        return self.look or ("studio" if self.as_rendered else "plain")


class Workspace:
    """An edited document with its display state.

    Attributes
    ----------
    document : SceneDocument
    hierarchy : Hierarchy
    view : Viewpoint
    orbit : OrbitController
    through : ThroughCamera
    display : Display
    tools : Tools
    panels : Panels
    plays : bool
        Whether time goes on.
    lines_to_run : list of str
        Of Python, that were entered and did not run yet.
    guard : callable
        As in `Prompt`.
    aspect : float
        Width over height of the picture.
    changes : int
        Grows whenever something was done that may show.
    recent : RecentFiles
    clipboard : Clipboard
    wants_exit : bool
        Whether the editor is to close.
    """

    def __init__(self) -> None:
        self.display = Display()
        self.tools = Tools()
        self.panels = Panels()
        self.plays = False
        self.lines_to_run: list[str] = []
        self.guard: Callable[[], AbstractContextManager[Any]] = contextlib.nullcontext
        self.aspect = 16 / 9
        self.changes = 0
        self.wants_exit = False
        self.recent = RecentFiles()
        self.clipboard = Clipboard()
        self._drags = 0
        self._autosave: Autosave | None = None
        self.start(STARTS[0])

    def _take(self, document: SceneDocument) -> None:
        if self._autosave is not None:
            self._autosave.discard()
        self.document = document
        document.prompt.guard = lambda: self.guard()
        self.plays = False
        self.panels.offers_start = False  # by keys, a file may be opened behind the choice
        self._autosave = Autosave(document)
        self.hierarchy = Hierarchy(document.scene)
        self.view = Viewpoint(np.zeros(3), 10.0)
        self.orbit = OrbitController(self.view)
        self.through = ThroughCamera(self.view)
        self._bounds: tuple[tuple, Sphere] | None = None
        self.frame(())

    @property
    def scene(self) -> Scene:
        """The scene that is edited."""
        return self.document.scene

    @property
    def resources(self) -> ResourceList:
        """What the document holds and can use."""
        return self.document.resources

    @property
    def console(self) -> Console:
        """The log, which goes on from document to document."""
        return self.document.console

    def new(self) -> None:
        """Start a new scene, and offer others to start from."""
        self.start(STARTS[0])
        self.panels.offers_start = True

    def start(self, start: Start) -> None:
        """Edit a scene to start from."""
        console = self.console if hasattr(self, "document") else None
        self._take(SceneDocument(start.make(), console=console))
        camera = self.scene.data.camera_node()
        if start.is_seen_through and camera is not None:
            self.through.look(camera, self.bounds)
            self.through.leave()

    def begin(self, path: str) -> None:
        """Edit a file's scene, or a new one if the file does not exist.

        Raises
        ------
        FileFormatError, FileAccessError
        """
        self._edit(SceneDocument.begin(path, console=self.console, new=empty), path)

    def open(self, path: str) -> bool:
        """Edit a file's scene; errors go to the console."""
        try:
            document = SceneDocument.open(path, console=self.console)
        except Engine3DError as error:
            self.console.write("error", str(error))
            return False
        self._edit(document, path)
        return True

    def _edit(self, document: SceneDocument, path: str) -> None:
        self._take(document)
        if os.path.exists(path):
            self.recent.add(path)
        if document.up != "+Y":
            self.view.up = UP_DIRECTIONS[document.up]
            self.frame(())

    def recover(self, copy: Recovery) -> None:
        """Edit a recovery copy of a crashed editor."""
        try:
            document = SceneDocument.recover(copy, console=self.console)
        except Engine3DError as error:
            self.console.write("error", str(error))
            return
        self._take(document)

    def add_file(self, path: str, onto: Node | None = None) -> bool:
        """Add a model to the scene, or apply an image to a node; errors go to the console."""
        try:
            with self.console.warnings_noted():
                command = drop_file(self.scene, path, onto=onto)
        except Engine3DError as error:
            self.console.write("error", str(error))
            return False
        self.recent.add(path)
        return self.do(command)

    def load_texture(self, path: str, materials: Sequence[Material], slot: str) -> bool:
        """Use an image as a texture of materials; errors go to the console."""
        try:
            texture = load_texture(path)
        except Engine3DError as error:
            self.console.write("error", str(error))
            return False
        label = translated("Load {name}", name=os.path.basename(path))
        return self.do(SetValues(materials, {slot: texture}, label))

    def load_mesh(self, path: str, node: Node) -> bool:
        """Give a file's mesh to a node; errors go to the console."""
        try:
            with self.console.warnings_noted():
                mesh = load_mesh(path)
        except Engine3DError as error:
            self.console.write("error", str(error))
            return False
        label = translated("Load {name}", name=os.path.basename(path))
        return self.do(SetValues([node], {"object": mesh}, label))

    def save(self, path: str | None = None, *, overwrite: bool = False) -> bool:
        """Save the scene; errors go to the console."""
        saved = self.document.save(path, overwrite=overwrite)
        if saved and self.document.path is not None:
            self.recent.add(self.document.path)
        return saved

    def tick(self) -> None:
        """Autosave if due; call this often."""
        self._autosave.tick()

    def keep_copy(self) -> None:
        """Save a recovery copy of unsaved work for the next editor."""
        if self.document.is_modified:
            self._autosave.save()

    def close(self) -> None:
        """Discard unsaved work and its recovery copy."""
        self._autosave.discard()

    def do(self, command: Command, *, drag: Hashable = None) -> bool:
        """Run a command of the document."""
        self.changes += 1
        return self.document.do(command, drag=drag)

    def undo(self) -> None:
        """Undo the last step."""
        self.changes += 1
        self.document.undo()

    def redo(self) -> None:
        """Redo the last undone step."""
        self.changes += 1
        self.document.redo()

    def run_lines(self) -> None:
        """Run the entered lines of Python."""
        while self.lines_to_run:
            self.changes += 1
            self.document.prompt.push(self.lines_to_run.pop(0))

    # Time

    @property
    def is_moving(self) -> bool:
        """Whether the next picture shows another time."""
        return self.plays and self.document.moves

    def animate(self, seconds: float) -> None:
        """Advance the time, if it plays."""
        if self.is_moving:
            self.document.animator.advance(min(seconds, LONGEST_STEP), self.view.position())

    def play_or_pause(self) -> None:
        """Start or pause the time."""
        self.plays = not self.plays
        if not self.plays:
            self.document.settle()
        elif not self.document.moves:
            self.plays = False
            said = translated("nothing moves: the menu Motion lets the selected node")
            self.console.write("message", said)

    def rewind(self) -> None:
        """Go to time 0."""
        if self.document.moves:
            self.document.animator.seek(0.0)

    # The view

    def look_from(self, name: str) -> None:
        """Look from one of the standard views."""
        self.through.leave()
        look_from(self.view, name)

    def turn(self, azimuth: float, elevation: float) -> None:
        """Turn the view around what it looks at, by angles in radians."""
        self.through.leave()
        self.orbit.turn(azimuth, elevation)

    def move_view(self, right: float, up: float) -> None:
        """Move the view by parts of the picture's height."""
        self.through.leave()
        self.orbit.pan(-right * _TALL, up * _TALL, _TALL)

    def approach(self, steps: float) -> None:
        """Bring the view nearer, by steps of the wheel."""
        self.through.leave()
        self.orbit.dolly(steps)

    def toggle_orthographic(self) -> None:
        """Look with or without perspective."""
        self.through.leave()
        self.view.orthographic = not self.view.orthographic

    def look_through(self) -> None:
        """Look through the selected camera, or the first one; or stop looking through one."""
        if self.through.node is not None:
            self.through.leave()
            return
        selected = self.document.selection.active
        is_camera = selected is not None and isinstance(selected.object, Camera)
        node = selected if is_camera else self.scene.data.camera_node()
        if node is None:
            self.console.write("message", translated("there is no camera: Add has one"))
        else:
            self.through.look(node, self.bounds)

    def hold_keys(self) -> None:
        """Queue typed text until a field has the focus."""
        self.panels.pictures_to_focus = FOCUSING

    def go_to(self, panel: str) -> None:
        """Let the keyboard go to a panel, and what is typed wait for it."""
        self.panels.closed.discard(panel)
        self.panels.goes_to = panel
        self.hold_keys()

    def next_drag(self) -> int:
        """Return a key shared by all commands of one mouse drag."""
        self._drags += 1
        return self._drags

    def camera(self) -> tuple[Camera, np.ndarray]:
        """Return the camera of the view and its pose, for `engine3d.render`."""
        node = self.through.node
        if node is not None:
            return node.object, node.world_pose
        camera = self.view.camera(with_grid(self.bounds, self.view))
        if isinstance(camera, PerspectiveCamera):
            camera.reversed_depth = True
        return camera, self.view.pose()

    @property
    def bounds(self) -> Sphere:
        """A sphere around the box of all visible objects, cached until a change.

        For thousands of nodes, the smallest sphere would take seconds at every step of a drag.
        """
        key = self.changes, self.scene.data.arrays.changes
        if self._bounds is None or self._bounds[0] != key:
            low, high = self.scene.bounds
            radius = float(linalg.length((high - low) * 0.5)) or EMPTY_RADIUS
            self._bounds = key, Sphere((low + high) * 0.5, radius)
        return self._bounds[1]

    def frame(self, nodes: tuple[Node, ...]) -> None:
        """Frame some nodes, or the whole scene."""
        self.through.leave()
        boxes = [_corners(node.bounds) for node in nodes if node.bounds is not None]
        boxes += [node.world_pose[:3, 3][None] for node in nodes]
        points = np.concatenate(boxes or [_corners(self.scene.bounds)])
        if (points.max(axis=0) == points.min(axis=0)).all():  # a light, or nothing at all
            points = _around(points[0], self.view.up, bool(nodes))
        self.view.frame(points, self.aspect)
        self.changes += 1


def _around(point: np.ndarray, up: tuple[float, float, float], is_node: bool) -> np.ndarray:
    """Return the corners of a cube around a node's place, or of the ground around the origin."""
    if is_node:
        return _corners(point + np.array([[-1.0], [1.0]]) * np.ones(3))
    right, _, back = home_axes(up) * EMPTY_REACH
    return np.array([point + x * right + z * back for x in (-1, 1) for z in (-1, 1)])


def _corners(box: np.ndarray) -> np.ndarray:
    """Return the eight corners of a box, (2, 3): (8, 3)."""
    return box[np.indices((2, 2, 2)).reshape(3, -1).T, np.arange(3)]
