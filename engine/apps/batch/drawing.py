"""Draws the pictures of a batch, in any process.

In: tasks, and drawing settings. Out: their files, and an `Outcome` for each. A process keeps one
renderer, its loaded models and its scripts.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base.files.portable_names import folded
from ...base.plugins.discovery import leaving_out
from ...base.plugins.participants import participants
from ...base.warning_scopes import gathered
from ...errors import Engine3DError, InvalidArgumentError
from ...io.reading.linked_files import found_files
from ...model.scene.cameras import Camera
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...rendering.frame import Frame
from ...rendering.options import RenderOptions
from ...stage.renderer import Renderer
from ...version import __version__
from ..datasets.generator import Generator
from ..datasets.kinds import named_in_errors
from ..datasets.samples import Move, Sample
from ..datasets.writer import Content, DatasetWriter
from .cameras import camera_of
from .file_digests import Inputs
from .loading import LoadedFiles, loading, not_written_to
from .plain import PlainWriter
from .records import is_done, write_picture
from .scripts import Said, Scripts
from .task import Task, default_look

if TYPE_CHECKING:
    from ...stage.blank import Reason


class How(NamedTuple):
    """Drawing settings of a batch.

    Attributes
    ----------
    out : str
        The folder that they are written to, as every process finds it.
    writer : DatasetWriter or None
        None where they are no data set.
    threads : int
        Of a renderer.
    backend : str
    resume : bool
        Leave out what is done.
    version : str
        Of the engine3d that asks: another one would draw other bytes.
    timeout : float or None
        Seconds that a picture may take where who draws cannot be ended (`limits`).
    plugins : bool
        Whether plug-ins count; a task may leave them out, too.
    """

    out: str
    writer: DatasetWriter | None
    threads: int
    backend: str
    resume: bool
    version: str
    timeout: float | None = None
    plugins: bool = True


class Outcome(NamedTuple):
    """The result of a task.

    Attributes
    ----------
    index : int
        Of the task.
    error : str or None
        None if the picture is there.
    drawn : bool
        Whether it was drawn now.
    seconds : float
    warnings : tuple of str
    """

    index: int
    error: str | None
    drawn: bool
    seconds: float
    warnings: tuple[str, ...]


def writer_of(task: Task, writer: DatasetWriter | None) -> DatasetWriter:
    """Return the writer that decides the files of a task's picture."""
    return PlainWriter(task.outputs) if writer is None else writer


def draw_chunk(tasks: Sequence[Task], how: How) -> list[Outcome]:
    """Draw some pictures; this is the call sent to other processes.

    Raises
    ------
    InvalidArgumentError
        This process has another version of engine3d.
    """
    if how.version != __version__:
        raise InvalidArgumentError(
            f"this process has engine3d {__version__}, and {how.version} asks it: its pictures "
            "might differ"
        )
    drawer = _drawer(how)
    with leaving_out(not how.plugins):
        return [drawer.outcome(task, how) for task in tasks]


_kept = threading.local()


def _drawer(how: How) -> Drawer:
    """Return the drawer of this thread."""
    kind = how.threads, how.backend
    if getattr(_kept, "kind", None) != kind:
        _kept.kind, _kept.drawer = kind, Drawer(*kind)
    return _kept.drawer


class Drawer:
    """Draws pictures one after the other.

    Parameters
    ----------
    threads : int
    backend : str
    """

    def __init__(self, threads: int, backend: Any) -> None:
        self._threads, self._backend = threads, backend
        self._files, self._scripts = LoadedFiles(), Scripts()
        self._renderer: Renderer | None = None

    def outcome(self, task: Task, how: How) -> Outcome:
        """Draw a picture, unless it is done; return its outcome."""
        start, writer = time.perf_counter(), writer_of(task, how.writer)
        with gathered() as texts:
            error, drawn = None, False
            inputs = Inputs(task.folder)
            try:
                with leaving_out(not task.plugins), participants(inputs.note_plugin):
                    if not (how.resume and is_done(how.out, task, writer)):
                        self._draw(task, how.out, writer, inputs)
                        drawn = True
            except Exception as problem:  # a fault of one picture must not affect others
                error = _told(problem)
        seconds = time.perf_counter() - start
        return Outcome(task.index, error, drawn, seconds, tuple(dict.fromkeys(texts)))

    def _draw(self, task: Task, out: str, writer: DatasetWriter, inputs: Inputs) -> None:
        for path in task.inputs:
            inputs.note(task.path(path))
        look = task.look or default_look(task)
        if task.look is not None or (look is not None and isinstance(writer, PlainWriter)):
            self._draw_look(task, look, out, writer, inputs)
            return
        with loading(self._files, inputs, out):
            scene, said = self._scene(task, inputs)
        camera, pose = _chosen_camera(task, scene, said)
        renderer = self._sized_renderer(task)
        options = RenderOptions(**{"cull": "auto", **task.render}, outputs=writer.outputs)
        frame = renderer.render(scene, (camera, pose), options=options)
        blank = self._why_blank(task, frame, scene, camera, pose, options)
        sample = Sample(
            task.name,
            task.index,
            frame,
            scene,
            camera,
            pose,
            renderer,
            said.labels,
            options,
            task.seed,
            _move(said.next),
            _move(said.previous),
        )
        files, note = _described(sample, writer)
        for end, data in said.files.items():
            with named_in_errors(writer):
                path = writer.beside(sample, end)
            if folded(path) in map(folded, files):
                raise InvalidArgumentError(f"{path} is written twice: it is an output")
            files[path] = data
        write_picture(out, task, task.key(writer), inputs, files, note, blank)

    def _why_blank(
        self, task: Task, frame: Frame, scene: Scene, camera: Camera, pose, options: RenderOptions
    ) -> Reason | None:
        """Return why a picture is blank, or None if it is not."""
        from ...stage.blank import SHOWING, Sight, may_be_blank, why_blank
        from ...stage.scenes_of_things import is_lit

        if is_lit(scene) and not may_be_blank(frame.stats, scene):
            return None  # else there may be no more than the ground of the look
        look = {name: getattr(options, name) for name in SHOWING}
        drawing = {"backend": self._backend, "threads": self._threads}
        return why_blank(Sight(scene, camera, pose, tuple(task.size), look, drawing))

    def _draw_look(
        self, task: Task, look: str, out: str, writer: DatasetWriter, inputs: Inputs
    ) -> None:
        """Draw a model as ``engine3d render`` does."""
        from .looks import draw_look

        if not isinstance(writer, PlainWriter):
            raise InvalidArgumentError("a look is for pictures, not for data sets")
        inputs.note(task.path(task.model))
        with found_files(inputs.note):
            frame, blank = draw_look(task, look, self._threads, self._backend, not_written_to(out))
        files = writer.files(task.name, frame)
        write_picture(out, task, task.key(writer), inputs, files, None, blank)

    def _scene(self, task: Task, inputs: Inputs) -> tuple[Scene, Said]:
        """Return the scene of a task, and its script's result."""
        path, root = task.model, task.root_path
        scene = Scene() if path is None else self._files.scene(task.path(path), root)
        for key, value in task.scene.items():
            setattr(scene, key, value)
        if task.script is None:
            return scene, Said()
        path, generator = task.path(task.script), Generator(task.seed)
        call = self._scripts.call
        return scene, call(path, task.function, task.arguments, scene, generator, inputs.note)

    def _sized_renderer(self, task: Task) -> Renderer:
        """Return the renderer for the task's size and samples."""
        renderer, kind = self._renderer, (task.samples, task.antialiasing)
        if renderer is None or (renderer.samples, renderer.antialiasing) != kind:
            if renderer is not None:
                renderer.close()
            renderer = self._renderer = Renderer(
                task.size,
                backend=self._backend,
                threads=self._threads,
                samples=task.samples,
                antialiasing=task.antialiasing,
            )
        elif renderer.size != tuple(task.size):
            renderer.resize(task.size)
        return renderer


def _described(sample: Sample, writer: DatasetWriter) -> tuple[dict[str, Content], Any]:
    """Return what a writer makes of a sample; errors name the plug-in if it is one's."""
    with named_in_errors(writer) as plugin:
        if plugin is not None:
            plugin.use()
        files, note = writer.describe(sample)
        return dict(files), note


def _told(error: Exception) -> str:
    """Return an error as one line; unforeseen errors include their type."""
    text = " ".join(str(error).split())
    if text and isinstance(error, (Engine3DError, OSError)):
        return text
    return f"{type(error).__name__}: {text}"


def _chosen_camera(task: Task, scene: Scene, said: Said) -> tuple[Camera, NDArray[np.float64]]:
    """Return the task's camera, else the script's, else the scene's."""
    if task.camera is not None:
        return camera_of(task.camera, scene, task.size)
    chosen = said.camera
    if chosen is None:
        nodes = (node for node in scene.nodes if isinstance(node.object, Camera) and node.shown)
        chosen = next(nodes, None)
    if chosen is None:
        return camera_of({}, scene, task.size)
    return _placed(chosen)


def _placed(chosen: Any) -> tuple[Camera, NDArray[np.float64]]:
    """Return a camera that a script chose, and its pose."""
    if isinstance(chosen, Node) and isinstance(chosen.object, Camera):
        return chosen.object, chosen.world_pose
    if isinstance(chosen, tuple) and len(chosen) == 2 and isinstance(chosen[0], Camera):
        return chosen[0], np.asarray(chosen[1], np.float64)
    raise InvalidArgumentError("camera must be a node of a camera, or (camera, pose)")


def _move(move: Callable[[], Any] | None) -> Move | None:
    """Return a script's function to another moment, whose camera is checked."""
    if move is None:
        return None

    def moved() -> tuple[Camera, NDArray[np.float64]] | None:
        chosen = move()
        return None if chosen is None else _placed(chosen)

    return moved
