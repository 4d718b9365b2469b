"""Draws pictures and animations of a scene into a file, in a thread of its own.

In: what to draw, from where, and a path. Out: the file, whole or not at all, drawn by the library's
own renderer; and how far it is. The scene must not change meanwhile.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base.side_by_side import Thread
from ...choices import LookName, Samples
from ...errors import Engine3DError
from ...io.output.animation_saving import save_animation
from ...model.scene.cameras import Camera
from ...model.scene.scene import Scene
from ...stage.renderer import Renderer


@dataclass(frozen=True)
class Shot:
    """A picture to be drawn.

    Attributes
    ----------
    camera : Camera
    pose : (4, 4) float64
        World-from-camera.
    time : float or None
        Of the scene's animator; None leaves the nodes where they are.
    node : int or None
        The place of the camera among the scene's nodes, if it moves with them.
    """

    camera: Camera
    pose: Any
    time: float | None = None
    node: int | None = None


class RenderJob:
    """A file being drawn.

    Parameters
    ----------
    scene : Scene
        A copy if shots have times, since these move its nodes.
    shots : sequence of Shot
        More than one give an animation.
    path : str
    size : (int, int)
    look : {"studio", "plain"}
    samples : int
    fps : float

    Attributes
    ----------
    done, count : int
        Pictures.
    error : str
        Why there is no file; empty if there is one.
    """

    def __init__(
        self,
        scene: Scene,
        shots: Sequence[Shot],
        path: str,
        *,
        size: tuple[int, int],
        look: LookName = "studio",
        samples: Samples = 4,
        fps: float = 25.0,
    ) -> None:
        self.path = path
        self.done, self.count, self.error = 0, len(shots), ""
        self._scene, self._shots, self._fps = scene, shots, fps
        self._how: dict[str, Any] = {"size": size, "look": look, "samples": samples}
        self._stops = threading.Event()
        self._ended = threading.Event()
        self._thread = Thread(target=self._run, daemon=True)
        self._thread.start()

    @property
    def is_ended(self) -> bool:
        """Whether it is over: done, failed or stopped."""
        return self._ended.is_set()

    @property
    def is_stopped(self) -> bool:
        """Whether `stop` came before the end."""
        return self._stops.is_set()

    def stop(self) -> None:
        """Give up; there will be no file."""
        self._stops.set()

    def wait(self) -> None:
        """Wait for the end."""
        self._ended.wait()

    def _run(self) -> None:
        try:
            self._write()
        except _Stopped:
            self.error = "stopped"
        except Engine3DError as error:
            self.error = str(error)
        except Exception as error:  # the window must hear of every end
            self.error = f"{type(error).__name__}: {error}"
        finally:
            self._ended.set()

    def _write(self) -> None:
        with Renderer(**self._how) as renderer:
            if self.count > 1:
                save_animation(self._pictures(renderer), self.path, fps=self._fps)
                return
            shot = self._shots[0]
            self._seek(shot)
            frame = renderer.render(self._scene, (shot.camera, shot.pose))
            if self._stops.is_set():
                raise _Stopped
            frame.save(self.path)
            self.done = 1

    def _pictures(self, renderer: Renderer) -> Iterator[np.ndarray]:
        for shot in self._shots:
            if self._stops.is_set():
                raise _Stopped
            self._seek(shot)
            pose = shot.pose if shot.node is None else self._scene.nodes[shot.node].world_pose
            yield renderer.render(self._scene, (shot.camera, pose)).color
            self.done += 1

    def _seek(self, shot: Shot) -> None:
        if shot.time is not None and self._scene.animator is not None:
            self._scene.animator.seek(shot.time)


class _Stopped(Exception):
    """Ends the drawing, and with it the unfinished file."""
